"""Half a minute of live readings in real time, through emulators on real ports, without loss."""

import pytest

from benchmarks.soak import soak
from tests.slamlab.devices.conftest import busy_machine  # noqa: F401

SECONDS = 30
TRIES = 3  # a machine that others keep busy may stand still, though hardly every time


pytestmark = [pytest.mark.usefixtures("busy_machine"), pytest.mark.slow, pytest.mark.soak]


def test_no_scan_is_dropped_and_none_comes_late():
    for _ in range(TRIES):
        result = soak(SECONDS, "odometry")
        made = result.made + result.stalled  # the emulated world stood, too
        all_there = made > 0.95 * 10 * SECONDS and not result.bytes
        if all_there and result.dropped <= result.stalled and result.lag <= 1 + result.stalled:
            return
    raise AssertionError(result)


def test_readings_that_nobody_takes_in_time_are_reported_as_dropped(monkeypatch):
    import time

    from slamlab.estimators import DeadReckoning

    monkeypatch.setattr(DeadReckoning, "step", lambda self, reading: time.sleep(0.4))
    result = soak(4, "odometry")
    assert result.dropped > 10 and result.lag == 2
