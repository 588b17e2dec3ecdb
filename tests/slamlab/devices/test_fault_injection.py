"""Slow readers, and unplugged devices behind real ports."""

import numpy as np
import pytest

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.rplidar import RPLidar
from slamlab.simulation import worlds

PERIOD = 0.1  # of a turn [s]
pytestmark = pytest.mark.usefixtures("busy_machine")


@pytest.mark.parametrize("latest", [True, False])
def test_a_slow_consumer_gets_the_newest_scan_and_drops_are_counted(latest):
    it = run_emulators(worlds.polygon(), np.random.default_rng(0), clock=SimulatedClock())
    with RPLidar(it.ports["lidar"], opener=it.opener, clock=it.clock) as driver:
        first = driver.revolution()
        number, taken = driver.stats["revolutions dropped"] + 1, 1
        for _ in range(8):
            it.clock.sleep(0.5)
            made = driver.stats["revolutions"]
            turn = driver.revolution(latest)
            taken += 1
            # its own times identify the turn; two are kept
            this = number + round((turn.times[-1] - first.times[-1]) / PERIOD)
            assert this == made - (0 if latest else 1)
        driver.stop()
        stats = driver.stats
        assert stats["revolutions"] == 40 + 1 and not stats["bytes dropped"]
        # those not dropped were taken, or passed over, or the last one is kept
        passed, kept = (8, 0) if latest else (0, 1)
        assert stats["revolutions dropped"] == stats["revolutions"] - taken - passed - kept
