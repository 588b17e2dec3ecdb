"""BreezySLAM's logs, made here as their format specifies; public recordings open by name."""

import numpy as np
import pytest

from slamlab import sources
from slamlab.estimators import make
from slamlab.estimators.runner import run
from slamlab.geometry import compose
from slamlab.layers import Points
from slamlab.sources.breezyslam import TICKS_PER_TURN, WHEEL_BASE, WHEEL_RADIUS
from slamlab.sources.public_datasets import RECORDINGS
from tests.slamlab.support import public


def breezy_lines(ticks):
    """Scans of a wall 1 m ahead of a lidar whose wheels have made these ticks."""
    beams = np.linspace(-np.radians(120), np.radians(120), 682)
    with np.errstate(divide="ignore"):
        wall = np.where(np.abs(beams) < 1.2, 1000 / np.cos(beams), 0).astype(int)
    return [
        " ".join(map(str, [100_000 * k, 0, left, right, *[0] * 20, *wall, 0]))
        for k, (left, right) in enumerate(ticks)
    ]


def opened(tmp_path, text):
    path = tmp_path / "log"
    path.write_text("\n".join(text) + "\n")
    return sources.open(path)


def test_breezyslam_wheels_that_never_turn_are_no_odometry(tmp_path):
    source = opened(tmp_path, breezy_lines([(500, 500)] * 3))
    assert not source.has_odometry and [r.odometry for r in source] == [None] * 3


def test_breezyslam_wheels_with_equal_motion_drive_straight(tmp_path):
    readings = list(opened(tmp_path, breezy_lines([(0, 0), (2000, 2000), (3000, 3000)])))
    assert np.allclose(readings[1].odometry, [2 * np.pi * WHEEL_RADIUS, 0, 0])
    assert np.allclose(readings[2].odometry, [np.pi * WHEEL_RADIUS, 0, 0])
    assert [r.time for r in readings] == pytest.approx([0, 0.1, 0.2])


def test_breezyslam_wheels_that_go_apart_bring_the_lidar_round_in_a_circle(tmp_path):
    # once round on the spot, in 40 steps
    once = np.pi * WHEEL_BASE / (2 * np.pi * WHEEL_RADIUS) * TICKS_PER_TURN
    ticks = [(round(-k * once / 40), round(k * once / 40)) for k in range(41)]
    pose, distances = np.zeros(3), []
    for reading in opened(tmp_path, breezy_lines(ticks)):
        pose = compose(pose, reading.odometry)
        distances.append(np.hypot(*pose[:2]))
    assert np.allclose(pose, 0, atol=2e-3)
    # the lidar stands ahead of the axle
    assert max(distances) == pytest.approx(2 * 0.145, rel=0.01)


def test_breezyslam_scans_run_from_right_to_left_with_zero_for_nothing(tmp_path):
    scan = next(iter(opened(tmp_path, breezy_lines([(0, 0)])))).scan
    assert scan.angles[0] == pytest.approx(-np.radians(120))
    assert not scan.valid[0] and np.allclose(scan.points()[:, 0], 1, atol=3e-3)


def test_a_truncated_breezyslam_line_is_counted_and_the_rest_is_read(tmp_path):
    text = breezy_lines([(0, 0), (10, 10), (20, 20), (30, 30)])
    text[1], text[3] = text[1][:500], text[3].replace(" 30 ", " thirty ", 1)
    source = opened(tmp_path, text)
    assert len(source) == 2 and source.skipped == 2
    assert source.damage["lines without a complete scan"] == 2


NO_LOGS = "intel-relations", "victoria-park"  # recordings without readings


@pytest.mark.parametrize("name", [n for n in RECORDINGS if n not in NO_LOGS and ".g2o" not in n])
def test_every_recording_opens_by_its_name(name):
    public(name)
    source = sources.open(name)
    first = next(iter(source))
    assert len(source) > 5 and first.scan.valid.sum() > 100


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["icp", "graph"])
def test_a_matched_breezyslam_log_sees_its_walls_more_sharply_than_odometry_does(kind):
    source = sources.open(public("exp1"))
    result = run(source, make(kind, source))
    cells = {
        layer.name: len(np.unique(np.round(layer.xy / 0.05), axis=0))
        for layer in result.estimator.layers()
        if isinstance(layer, Points)
    }
    assert cells["corrected"] < 0.8 * cells["naive"]
