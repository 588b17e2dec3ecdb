"""Half a minute of live readings, through emulators on real ports: none is lost."""

import pytest

from benchmarks.soak import soak

SECONDS = 30
TRIES = 3  # a machine that others keep busy may stand still, though hardly every time


pytestmark = pytest.mark.usefixtures("busy_machine")


@pytest.mark.slow
def test_no_scan_is_dropped_and_none_comes_late():
    for _ in range(TRIES):
        came = soak(SECONDS, "odometry")
        all_there = came.made > 0.95 * 10 * SECONDS and not came.bytes
        if all_there and came.dropped <= came.stood and came.lag <= 1 + came.stood:
            return
    raise AssertionError(came)


def test_readings_that_nobody_takes_in_time_are_told_as_dropped(monkeypatch):
    import time

    from slamlab.estimators import Odometry

    monkeypatch.setattr(Odometry, "step", lambda self, reading: time.sleep(0.4))
    came = soak(4, "odometry")
    assert came.dropped > 10 and came.lag == 2
