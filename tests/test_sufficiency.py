"""Who works on too little says so: in the status, in the summary, on the terminal."""

import json
from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.cli import main
from slamlab.estimators.sufficiency import (
    against_odometry,
    hardly_surer,
    mostly_unknown,
    thin_matches,
    wider_than_map,
)
from slamlab.filters.mak import MAK
from slamlab.simulation.range_scanners import ULTRASONIC
from slamlab.sources import simulation
from slamlab.sources.simulated_robot import THESIS_LIDAR

WIDER = "wider than all that it has mapped"


def told(name, source, steps=None, **options):
    """What an estimator warns of after a source's first readings."""
    slam = estimators.make(name, source, **options)
    for reading in islice(source, steps):
        slam.step(reading)
    for sentence in slam.warnings:
        assert f"warning: {sentence}" in slam.status
    assert slam.warnings or "warning" not in slam.status
    return " / ".join(slam.warnings)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("icp", "most matches rest on under 60 points"),
        ("graph", "most matches rest on under 60 points"),
        ("walls", "hardly surer than by odometry alone"),
        ("mak", "hardly surer than by odometry alone"),
        ("walls-foot", "hardly surer than by odometry alone"),
    ],
)
@pytest.mark.parametrize("seed", [1, 2])
def test_ultrasound_is_too_little_and_each_says_so(name, says, seed):
    rng = np.random.default_rng(seed)
    assert says in told(name, simulation("room", rng, lidar=ULTRASONIC))


@pytest.mark.slow
def test_among_the_arenas_boxes_scan_matching_says_so():
    assert "under 60 points" in told("icp", simulation("arena", np.random.default_rng(1)))


@pytest.mark.slow
def test_a_box_no_better_than_odometry_says_so_and_so_does_one_that_can_tell_no_corners_apart():
    source = simulation("arena", np.random.default_rng(1))
    wide = "by it the place is no surer than by odometry alone"
    assert wide in told("bor", source)
    own = told("bor", source, names="own")
    assert wide in own and "observations are ambiguous and ignored" in own


def test_a_box_whose_bounds_are_broken_says_since_when():
    lost = told("bor", simulation("room", np.random.default_rng(1)), 40, bounds="tuned")
    assert "lost at 0.5 s" in lost and "contradictions" in lost


@pytest.mark.parametrize("name", ["mak", "montecarlo", "fastslam"])
def test_a_map_of_one_landmark_says_that_it_fixes_no_pose(name):
    source = simulation("landmarks", np.random.default_rng(1))
    slam, first = estimators.make(name, source), None
    for reading in islice(source, 40):
        seen = reading.observations
        first = seen.ids[0] if first is None and len(seen.ids) else first
        slam.step(replace(reading, observations=seen.subset(seen.ids == first)))
    assert any("single landmark" in sentence for sentence in slam.warnings)


@pytest.mark.parametrize("name", ["montecarlo", "fastslam"])
def test_samples_that_see_nothing_again_are_no_surer_than_odometry_and_say_so(name):
    source = simulation("landmarks", np.random.default_rng(1))
    slam = estimators.make(name, source)
    for reading in islice(source, 40):
        slam.step(replace(reading, observations=None))
    assert slam.warnings == [
        "its place is hardly surer than by odometry alone: too little is seen again"
    ]


@pytest.mark.parametrize("name", ["mak", "mak-first-estimates", "montecarlo", "fastslam", "walls"])
def test_who_has_left_all_that_it_mapped_says_that_its_place_is_wider_than_the_map(name):
    world = "room" if name == "walls" else "landmarks"
    source = simulation(world, np.random.default_rng(1))
    slam = estimators.make(name, source)
    for seen in islice(source, 25):
        slam.step(seen)
    assert WIDER not in slam.status
    blind = seen.scan and replace(seen.scan, ranges=np.full_like(seen.scan.ranges, np.nan))
    away = replace(seen, odometry=np.array([20.0, 0.0, 0.3]), observations=None, scan=blind)
    for k in range(60):
        slam.step(replace(away, time=seen.time + k + 1))
    assert any(WIDER in each for each in slam.warnings) and WIDER in slam.status


def test_a_place_is_wider_than_the_map_where_95_percent_of_the_belief_are():
    places, P = np.array([[0.0, 0.0], [4.0, 1.0]]), np.diag([0.01, 1.0])
    assert wider_than_map(P, places, 20) == []
    (said,) = wider_than_map(1.1 * P, places, 20)
    assert said.startswith("its place is known to ±2.06 m")
    assert wider_than_map(1.1 * P, places, 19) == wider_than_map(1.1 * P, places[:1], 20) == []


@pytest.mark.slow
@pytest.mark.parametrize("world", ["room", "landmarks"])
@pytest.mark.parametrize("name", ["bor", "montecarlo", "fastslam"])
def test_boxes_and_samples_among_plenty_of_landmarks_say_nothing(name, world):
    assert told(name, simulation(world, np.random.default_rng(1))) == ""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["montecarlo", "fastslam"])
def test_samples_in_the_arena_say_nothing(name):
    assert told(name, simulation("arena", np.random.default_rng(1))) == ""


@pytest.mark.slow
@pytest.mark.parametrize("world", ["room", "situation-2"])
@pytest.mark.parametrize("name", ["icp", "graph", "walls", "mak"])
def test_where_a_lidar_sees_a_room_nobody_says_anything(name, world):
    assert told(name, simulation(world, np.random.default_rng(1))) == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "world"), [("mak", "arena"), ("walls", "arena"), ("mak", "landmarks")]
)
def test_what_sees_enough_corners_or_walls_again_says_nothing(name, world):
    assert told(name, simulation(world, np.random.default_rng(1))) == ""


@pytest.mark.parametrize(
    "name",
    ["icp", "mak", *(pytest.param(name, marks=pytest.mark.slow) for name in ("graph", "walls"))],
)
def test_on_the_intel_log_nobody_says_anything(name):
    try:
        path = sources.recording("intel")
    except sources.SourceError as error:
        pytest.skip(str(error))
    with sources.open(str(path)) as log:
        assert told(name, log, 450) == ""


@pytest.mark.slow
def test_a_run_says_it_on_the_terminal_and_in_its_summary(tmp_path, capsys):
    assert main(["run", "sim:arena", "--estimator", "icp", "--out", str(tmp_path)]) == 0
    (sentence,) = json.loads((tmp_path / "summary.json").read_text())["warnings"]
    assert f"warning: {sentence}" in capsys.readouterr().out
    assert main(["run", "sim:room", "--out", str(tmp_path)]) == 0
    assert json.loads((tmp_path / "summary.json").read_text())["warnings"] == []
    assert "warning" not in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("world", ["situation-1", "situation-2"])
def test_the_listing_as_printed_leaves_what_odometry_allows_and_says_so(world, seed):
    assert "one of the two is wrong" in told(
        "walls-foot", simulation(world, np.random.default_rng(seed), lidar=THESIS_LIDAR)
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_feet_with_all_mends_in_a_room_say_nothing(seed):
    source = simulation("room", np.random.default_rng(seed), lidar=THESIS_LIDAR)
    assert told("walls-foot", source, mends="all") == ""


def test_a_pose_is_against_odometry_six_standard_deviations_from_its_own():
    alone = MAK(np.array([1.0, 0.0, 3.1]), np.diag([0.1, 0.2, 0.05]) ** 2)
    for off, says in (([0.59, 0, 0], 0), ([0.61, 0, 0], 1), ([0, 0, 0.29], 0), ([0, 0, 0.31], 1)):
        assert len(against_odometry(alone.pose + off, alone, 20)) == says
    around = alone.pose + np.array([0, 0, 2 * np.pi])
    assert against_odometry(around, alone, 20) == []
    assert against_odometry(alone.pose + np.array([9.0, 0, 0]), alone, 19) == []


def test_of_a_few_steps_nothing_is_said():
    unsure = MAK(np.zeros(3), np.eye(3))
    assert thin_matches(19, 19, 0) == mostly_unknown(19, 19) == []
    assert hardly_surer(unsure.block([0, 1]), unsure, 19) == []
    assert len(hardly_surer(unsure.block([0, 1]), unsure, 20)) == len(mostly_unknown(7, 20)) == 1
    assert thin_matches(0, 9, 0, since=19) == []
    assert "last 20 steps" in thin_matches(0, 9, 0, since=20)[0]
    assert len(thin_matches(11, 20, 0)) == 1 and "no match" in thin_matches(0, 9, 11)[0]


def test_a_robot_whose_odometry_is_perfect_is_not_blamed_for_a_map_that_helps_nothing():
    sure = MAK(np.zeros(3), np.zeros((3, 3)))
    assert hardly_surer(sure.block([0, 1]), sure, 100) == []
