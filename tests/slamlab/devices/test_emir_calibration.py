"""Calibration drive: counts that, by what was measured, give the size of a count."""

from types import SimpleNamespace

import numpy as np
import pytest

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir.emir_calibration import calibration_run
from slamlab.devices.emir.status import Status
from slamlab.devices.emulator.emulated_robot import COUNT_SIZE
from slamlab.devices.errors import DeviceNotResponding
from slamlab.geometry import between
from slamlab.simulation import worlds
from slamlab.sources.emulated_devices import EmulatedDevices


@pytest.fixture
def devices():
    with EmulatedDevices(worlds.room(), np.random.default_rng(7), None, SimulatedClock()) as made:
        yield made


def test_distance_and_turn_over_their_counts_are_the_size_of_a_count(devices):
    marks = []
    counts = calibration_run(devices.emir, lambda: marks.append(devices.bench.body.pose))
    steps = between(np.array(marks[:-1]), np.array(marks[1:]))
    assert len(steps) == 5
    measured = np.hypot(*steps[0, :2]), steps[1:, 2].sum()
    np.testing.assert_allclose(measured / counts, COUNT_SIZE, rtol=0.05)


def test_a_robot_that_is_closed_meanwhile_is_reported():
    closed = SimpleNamespace(status=Status(), translate=lambda *_: None, wait=lambda: None)
    with pytest.raises(DeviceNotResponding, match="eMIR sends no status"):
        calibration_run(closed)
