"""The RPLIDAR grabber's text and BreezySLAM's logs, made here as their formats say."""

import numpy as np
import pytest

from slamlab import sources
from slamlab.estimators import make
from slamlab.estimators.runner import run
from slamlab.files.published_recordings import RECORDINGS
from slamlab.geometry import compose
from slamlab.layers import Points
from slamlab.sources import SourceError
from slamlab.sources.breezyslam import TICKS_PER_TURN, WHEEL_BASE, WHEEL_RADIUS


def grabber_text(turns=3, points=400):
    """Turns of a lidar in the middle of a round room of 2 m, every 40th return empty."""
    out = ["Ultra simple LIDAR data grabber for RPLIDAR.", "Version: 1.11.0"]
    for _ in range(turns):
        for k in range(points):
            distance = 0 if k % 40 == 0 else 2000
            out.append(f"   theta: {k * 360 / points:.2f} Dist: {distance:08.2f} Q: 47 ")
    return out


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


def test_a_grabbed_turn_runs_clockwise_from_the_front_in_metres(tmp_path):
    source = opened(tmp_path, grabber_text())
    readings = list(source)
    assert len(source) == len(readings) == 3
    scan = readings[0].scan
    assert scan.angles[100] == pytest.approx(-np.pi / 2)
    assert np.isnan(scan.ranges[::40]).all()
    assert np.allclose(np.hypot(*scan.points().T), 2.0)
    assert [r.time for r in readings] == pytest.approx([0, 0.1, 0.2])


def test_a_turn_cut_at_either_end_is_left_out(tmp_path):
    assert len(opened(tmp_path, grabber_text(4)[150:-100])) == 2


def test_a_grabbers_line_that_cannot_be_read_is_counted_and_costs_itself(tmp_path):
    text = grabber_text()
    text[50] = "   theta: nonsense Dist: 02000.00 Q: 47"
    text[60] = "   theta: 22.50 Dist: -2.00 Q: 47"
    text[70] = "   theta: 40.0"
    source = opened(tmp_path, text)
    assert source.damage["lines without a readable point"] == 3
    assert [len(r.scan.ranges) for r in source] == [397, 400, 400]


def test_less_than_a_turn_is_refused(tmp_path):
    with pytest.raises(SourceError, match="no whole turn"):
        opened(tmp_path, grabber_text(1)[:200])


def test_breezyslam_wheels_that_go_alike_drive_straight(tmp_path):
    readings = list(opened(tmp_path, breezy_lines([(0, 0), (2000, 2000), (3000, 3000)])))
    assert np.allclose(readings[1].odometry, [2 * np.pi * WHEEL_RADIUS, 0, 0])
    assert np.allclose(readings[2].odometry, [np.pi * WHEEL_RADIUS, 0, 0])
    assert [r.time for r in readings] == pytest.approx([0, 0.1, 0.2])


def test_breezyslam_wheels_that_go_apart_bring_the_lidar_round_in_a_circle(tmp_path):
    # once round on the spot, in 40 steps
    once = np.pi * WHEEL_BASE / (2 * np.pi * WHEEL_RADIUS) * TICKS_PER_TURN
    ticks = [(round(-k * once / 40), round(k * once / 40)) for k in range(41)]
    pose, ways = np.zeros(3), []
    for reading in opened(tmp_path, breezy_lines(ticks)):
        pose = compose(pose, reading.odometry)
        ways.append(np.hypot(*pose[:2]))
    assert np.allclose(pose, 0, atol=2e-3)
    assert max(ways) == pytest.approx(2 * 0.145, rel=0.01)  # the lidar stands ahead of the axle


def test_breezyslam_scans_run_from_right_to_left_with_zero_for_nothing(tmp_path):
    scan = next(iter(opened(tmp_path, breezy_lines([(0, 0)])))).scan
    assert scan.angles[0] == pytest.approx(-np.radians(120))
    assert not scan.valid[0] and np.allclose(scan.points()[:, 0], 1, atol=3e-3)


def test_a_torn_breezyslam_line_is_counted_and_the_rest_read(tmp_path):
    text = breezy_lines([(0, 0), (10, 10), (20, 20), (30, 30)])
    text[1], text[3] = text[1][:500], text[3].replace(" 30 ", " thirty ", 1)
    source = opened(tmp_path, text)
    assert len(source) == 2 and source.skipped == 2
    assert source.damage["lines that hold no whole scan"] == 2


@pytest.mark.parametrize("name", [n for n in RECORDINGS if "relations" not in n])
def test_every_recording_opens_by_its_name(name):
    try:
        source = sources.open(name)
    except SourceError as error:
        pytest.skip(str(error))
    first = next(iter(source))
    assert len(source) > 5 and first.scan.valid.sum() > 100


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["icp", "graph"])
def test_a_matched_breezyslam_log_sees_its_walls_more_sharply_than_odometry_does(kind):
    try:
        source = sources.open("exp1")
    except SourceError as error:
        pytest.skip(str(error))
    result = run(source, make(kind, source))
    cells = {
        layer.name: len(np.unique(np.round(layer.xy / 0.05), axis=0))
        for layer in result.estimator.layers()
        if isinstance(layer, Points)
    }
    assert cells["corrected"] < 0.8 * cells["naive"]
