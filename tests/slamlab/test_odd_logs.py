"""Robustness to odd logs: empty scans, timestamp anomalies, a kidnapped robot."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.estimators.plausibility_check import timestamp_anomaly
from slamlab.geometry import between
from slamlab.readings import Scan

KINDS = ("icp", "walls", "graph")
EMPTY = Scan(np.linspace(-3, 3, 400), np.full(400, np.nan))
POINT = Scan(np.array([0.3]), np.array([1.5]))


def after(kind, change):
    """The estimator after a tour of the room whose readings were changed, and its errors [m]."""
    source = sources.open("sim:room", np.random.default_rng(2))
    readings, truth = change(list(source), source.truth.poses)
    slam = estimators.make(kind, source)
    for reading in readings:
        slam.step(reading)
    poses = slam.trajectory().poses
    assert len(poses) == len(readings)
    assert slam.layers()
    off = between(between(truth[0], truth), between(poses[0], poses))
    odd = {what: n for what, n in slam.counts.items() if "loop" not in what}
    return slam, np.hypot(off[:, 0], off[:, 1]), odd


def with_scans(scan, rows):
    """A change that puts a scan in place of those in some rows."""

    def change(readings, truth):
        for i in range(len(readings))[rows]:
            readings[i] = replace(readings[i], scan=scan)
        return readings, truth

    return change


def with_times(stamp):
    """A change of every reading's stamp: stamp(row, time) [s]."""

    def change(readings, truth):
        return [replace(r, time=stamp(i, r.time)) for i, r in enumerate(readings)], truth

    return change


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("scan", "rows"),
    [
        (EMPTY, slice(40, 44)),
        (EMPTY, slice(0, 2)),
        (POINT, slice(3, None, 7)),
        (None, slice(0, None, 3)),
    ],
)
def test_scans_with_next_to_nothing_in_them_cost_no_more_than_themselves(kind, scan, rows):
    slam, errors, odd = after(kind, with_scans(scan, rows))
    if scan is not None or kind == "graph":
        assert errors.max() < (0.2 if kind == "graph" else 0.1)
        assert errors[-1] < (0.05 if kind == "graph" else 0.03)
    if scan is EMPTY or (scan is POINT and kind != "walls"):  # a point is no wall, yet it is drawn
        assert slam.skipped == len(range(86)[rows])
    if scan is None and kind == "graph":
        assert slam.skipped == 0
    assert not odd


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("stamp", "counted"),
    [
        (lambda i, t: t + 10.0 * (i >= 40), {"gaps": 1}),
        (lambda i, t: t - 0.5 * (i in (20, 50)), {"timestamps repeated": 2}),
        (lambda i, t: t - 4.5 * (i == 40), {"timestamps going back": 1}),
        (lambda i, t: t - 9.0 * (i >= 40), {"timestamps going back": 1}),
    ],
)
def test_timestamp_anomalies_change_no_pose_and_are_counted_in_the_status(kind, stamp, counted):
    slam, errors, odd = after(kind, with_times(stamp))
    assert errors.max() < (0.2 if kind == "graph" else 0.03)
    assert errors[-1] < (0.05 if kind == "graph" else 0.03)
    assert odd == counted
    ((what, n),) = counted.items()
    assert f"{n} {what}" in slam.status


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "event"),
    [("icp", "matches with few inliers"), ("walls", "scans with only unknown walls")],
)
def test_a_kidnapped_robot_goes_on_and_its_status_reports_an_anomaly(kind, event):
    def carried(readings, truth):
        order = [*range(50), *range(20, 60)]
        moved = [replace(readings[i], time=0.5 * k) for k, i in enumerate(order)]
        moved[50] = replace(moved[50], odometry=np.zeros(3))
        return moved, truth[order]

    slam, errors, _ = after(kind, carried)
    # neither can know where it was put down: from there on it is right but for that
    assert errors[:50].max() < 0.03
    assert slam.counts[event] >= 1
    assert event in slam.status
    assert event not in after(kind, lambda *unchanged: unchanged)[0].status


def test_a_gap_is_found_by_the_median_period_and_going_back_leaves_none():
    usual = [0.1 * k for k in range(30)]
    assert timestamp_anomaly([], 5.0) == timestamp_anomaly([1.0], 9.0) == ""
    assert timestamp_anomaly(usual, 3.0) == ""
    assert timestamp_anomaly(usual, 13.0) == "gaps"
    assert timestamp_anomaly([60.0 * k for k in range(9)], 600.0) == ""
    assert timestamp_anomaly([*usual, 1.0], 3.0) == ""
    assert timestamp_anomaly(usual, usual[-1]) == "timestamps repeated"
    assert timestamp_anomaly(usual, 1.0) == "timestamps going back"
