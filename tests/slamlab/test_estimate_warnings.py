"""Warnings of an estimator with too little data: in the status, the summary and the terminal."""

import json
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.cli import main
from slamlab.estimators.estimate_warnings import (
    contradicts_odometry,
    little_better_than_odometry,
    mostly_unknown_walls,
    uncertainty_wider_than_map,
    weak_matches,
)
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.simulation.range_scanners import ULTRASONIC
from slamlab.sources import simulation
from slamlab.sources.simulated_robot import THESIS_LIDAR
from tests.slamlab.support import public

WIDER = "wider than the map"


def report(name, source, steps=None, **options):
    """What an estimator warns of after a source's first readings."""
    slam = estimators.make(name, source, **options)
    for reading in islice(source, steps):
        slam.step(reading)
    for sentence in slam.warnings:
        assert f"warning: {sentence}" in slam.status
    assert slam.warnings or "warning" not in slam.status
    return " / ".join(slam.warnings)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["icp", "graph", "walls", "mak", "walls-foot-points"])
@pytest.mark.parametrize("seed", [1, 2])
def test_ultrasound_is_too_little_and_each_reports_it(name, seed):
    message = "hardly more certain than by odometry alone"
    if name in ("icp", "graph"):
        message = "most matches have fewer than 60 points"
    source = simulation("room", np.random.default_rng(seed), lidar=ULTRASONIC)
    assert message in report(name, source)


@pytest.mark.slow
def test_in_the_arena_weak_matches_and_boxes_no_better_than_odometry_are_reported():
    source = simulation("arena", np.random.default_rng(1))
    assert "fewer than 60 points" in report("icp", source)
    wide = "the position is no more certain than by odometry alone"
    assert wide in report("bor", source)
    own = report("bor", source, association="own")
    assert wide in own and "observations are ambiguous and ignored" in own


def test_broken_bounds_are_reported_with_their_time():
    lost = report("bor", simulation("room", np.random.default_rng(1)), 40, bounds="tuned")
    assert "lost at 0.5 s" in lost and "contradictions" in lost


@pytest.mark.parametrize("name", ["mak", "montecarlo", "fastslam"])
def test_a_map_of_one_landmark_is_reported_to_fix_no_pose(name):
    source = simulation("landmarks", np.random.default_rng(1))
    slam, first = estimators.make(name, source), None
    for reading in islice(source, 40):
        seen = reading.observations
        first = seen.ids[0] if first is None and len(seen.ids) else first
        slam.step(replace(reading, observations=seen.subset(seen.ids == first)))
    assert any("single landmark" in sentence for sentence in slam.warnings)


@pytest.mark.parametrize("name", ["montecarlo", "fastslam"])
def test_particles_without_reobservations_are_no_more_certain_than_odometry_and_report_it(name):
    source = simulation("landmarks", np.random.default_rng(1))
    slam = estimators.make(name, source)
    for reading in islice(source, 40):
        slam.step(replace(reading, observations=None))
    assert slam.warnings == [
        "the position is hardly more certain than by odometry alone: few landmarks are observed "
        "again"
    ]


@pytest.mark.parametrize("name", ["mak", "mak-first-estimates", "montecarlo", "fastslam", "walls"])
def test_an_estimator_far_from_its_map_reports_a_position_box_wider_than_the_map(name):
    world = "room" if name == "walls" else "landmarks"
    source = simulation(world, np.random.default_rng(1))
    slam = estimators.make(name, source)
    for seen in islice(source, 25):
        slam.step(seen)
    assert WIDER not in slam.status
    blind = seen.scan and replace(seen.scan, ranges=np.full_like(seen.scan.ranges, np.nan))
    away = replace(seen, odometry=np.array([10.0, 0.0, 0.3]), observations=None, scan=blind)
    for k in range(120):
        slam.step(replace(away, time=seen.time + 4 * (k + 1)))
    assert any(WIDER in each for each in slam.warnings) and WIDER in slam.status


def test_a_95_percent_confidence_interval_may_be_wider_than_the_map():
    landmarks, P = np.array([[0.0, 0.0], [4.0, 1.0]]), np.diag([0.01, 1.0])
    assert uncertainty_wider_than_map(P, landmarks, 20) == []
    (message,) = uncertainty_wider_than_map(1.1 * P, landmarks, 20)
    assert message.startswith("the position is known to ±2.06 m")
    assert uncertainty_wider_than_map(1.1 * P, landmarks, 19) == []
    assert uncertainty_wider_than_map(1.1 * P, landmarks[:1], 20) == []


ENOUGH = {  # worlds, and the estimators that observe enough in them
    "room": ("bor", "montecarlo", "fastslam", "icp", "graph", "walls", "mak"),
    "situation-2": ("icp", "graph", "walls", "mak"),
    "landmarks": ("bor", "montecarlo", "fastslam", "mak"),
    "arena": ("montecarlo", "fastslam", "mak", "walls"),
}


@pytest.mark.slow
@pytest.mark.parametrize(("world", "name"), [(w, name) for w in ENOUGH for name in ENOUGH[w]])
def test_an_estimator_that_observes_enough_reports_nothing(world, name):
    assert report(name, simulation(world, np.random.default_rng(1))) == ""


@pytest.mark.parametrize(
    "name",
    ["icp", "mak", *(pytest.param(name, marks=pytest.mark.slow) for name in ("graph", "walls"))],
)
def test_on_the_intel_log_no_estimator_reports_a_warning(name):
    with sources.open(public("intel")) as log:
        assert report(name, log, 450 if name == "walls" else 200) == ""


@pytest.mark.slow
def test_a_run_reports_it_on_the_terminal_and_in_its_summary(tmp_path, capsys):
    assert main(["run", "sim:arena", "--estimator", "icp", "--out", str(tmp_path)]) == 0
    (sentence,) = json.loads((tmp_path / "summary.json").read_text())["warnings"]
    assert f"warning: {sentence}" in capsys.readouterr().out
    assert main(["run", "sim:room", "--out", str(tmp_path)]) == 0
    assert json.loads((tmp_path / "summary.json").read_text())["warnings"] == []
    assert "warning" not in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("world", ["situation-1", "situation-2"])
def test_the_listing_as_printed_diverges_from_odometry_and_reports_it(world, seed):
    assert "one of the two is wrong" in report(
        "walls-foot-points", simulation(world, np.random.default_rng(seed), lidar=THESIS_LIDAR)
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_foot_points_with_all_corrections_in_a_room_report_nothing(seed):
    source = simulation("room", np.random.default_rng(seed), lidar=THESIS_LIDAR)
    assert report("walls-foot-points", source, corrections="all") == ""


def test_a_pose_is_against_odometry_six_standard_deviations_from_its_own():
    alone = MAK(np.array([1.0, 0.0, 3.1]), np.diag([0.1, 0.2, 0.05]) ** 2)
    for near, far in (([0.59, 0, 0], [0.61, 0, 0]), ([0, 0, 0.29], [0, 0, 0.31])):
        assert contradicts_odometry(alone.pose + near, alone, 20) == []
        assert len(contradicts_odometry(alone.pose + far, alone, 20)) == 1
    around = alone.pose + np.array([0, 0, 2 * np.pi])
    assert contradicts_odometry(around, alone, 20) == []
    assert contradicts_odometry(alone.pose + np.array([9.0, 0, 0]), alone, 19) == []


def test_for_a_few_steps_nothing_is_reported():
    uncertain = MAK(np.zeros(3), np.eye(3))
    assert weak_matches(19, 19, 0) == mostly_unknown_walls(19, 19) == []
    assert little_better_than_odometry(uncertain.block([0, 1]), uncertain, 19) == []
    assert len(little_better_than_odometry(uncertain.block([0, 1]), uncertain, 20)) == 1
    assert len(mostly_unknown_walls(7, 20)) == 1
    assert weak_matches(0, 9, 0, since=19) == []
    assert "last 20 steps" in weak_matches(0, 9, 0, since=20)[0]
    assert len(weak_matches(11, 20, 0)) == 1 and "not matched" in weak_matches(0, 9, 11)[0]


def test_a_robot_whose_odometry_is_perfect_is_not_blamed_for_a_map_that_helps_nothing():
    sure = MAK(np.zeros(3), np.zeros((3, 3)))
    assert little_better_than_odometry(sure.block([0, 1]), sure, 100) == []
