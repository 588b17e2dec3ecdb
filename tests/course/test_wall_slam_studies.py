"""Studies of lesson 09: wall SLAM loop, its faults, the corridor, ultrasonic walls."""

import numpy as np
import pytest

from course.studies import (
    corridor,
    line_extraction_errors,
    wall_slam_faults,
    wall_slam_loop,
)
from course.studies.study_command import stored
from course.studies.wall_slam_faults import RIGHT, VARIANTS
from slamlab import estimators
from slamlab.estimators.wall_slam import WallSlam
from slamlab.sources import simulation


@pytest.fixture(scope="module")
def room():
    return simulation("situation-2", np.random.default_rng(0))


@pytest.fixture(scope="module")
def found(room):
    return wall_slam_faults.extracted_lines(room)


@pytest.mark.slow
def test_the_small_loop_believes_what_the_packages_does(room, found):
    loop = VARIANTS[RIGHT](room)
    poses, P, maps = wall_slam_faults.driven(room, loop, found)
    whole = WallSlam(room.robot, room.sensor, np.random.default_rng(0))
    ran = estimators.run(room, whole)
    np.testing.assert_allclose(poses, ran.trajectory.poses, atol=1e-9)
    np.testing.assert_allclose(loop.mak.P, whole.filter.P, atol=1e-9)
    assert len(maps) == len(P) == len(room)
    assert len(maps[-1]) == len(loop.mak.ids)


@pytest.mark.slow
def test_a_tally_loses_no_line_and_no_wall(room, found):
    count = wall_slam_loop.tally(room, found)
    assert count["steps"] == len(room)
    assert count["lines"] == count["known"] + count["new"] + count["unclear"]
    assert count["walls"] == count["entered"] - count["merged"]
    _, _, maps = wall_slam_faults.driven(room, VARIANTS[RIGHT](room), found)
    assert count["walls"] == len(maps[-1])


def test_redrawn_lines_have_the_errors_of_their_covariance(room, found):
    lines = wall_slam_faults.redrawn(room, found, np.random.default_rng(1))
    assert line_extraction_errors.squared_errors(room, lines).mean() == pytest.approx(2, abs=0.2)
    loop = VARIANTS[RIGHT](room)
    wall_slam_faults.driven(room, loop, lines)
    errors, per_entry = wall_slam_faults.map_errors(room, loop)
    assert errors.shape == (9, 2)
    assert np.abs(errors).max() < 0.02
    assert 0.3 < per_entry < 2


def test_the_stored_table_supports_lesson_09():
    table = stored("wall_slam_faults")
    low, high = table["band_95"]
    for name in ("situation-1", "situation-2"):
        rows = table["situations"][name]
        assert low < rows[RIGHT]["nees"] < high
        assert 0.82 < rows[RIGHT]["map_nees_drawn"] < 1.15, "nothing speaks against the filter"
        assert rows["placed before prediction"]["low_m"] > 0, "worse than odometry"
        for part in ("degrees in the Jacobians", "y = a x + b"):
            assert rows[part]["high_m"] < 0, "better than odometry"
            assert rows[part]["nees"] > high, "and overconfident"
            assert rows[part]["walls"] > 1.5 * rows[RIGHT]["walls"]
        assert rows["associated before prediction"]["turned_deg"] > 10 * rows[RIGHT]["turned_deg"]
        assert rows["associated before prediction"]["rms_m"] < 0.01
        assert rows["never merged"]["rms_m"] < 1.1 * rows[RIGHT]["rms_m"]
    assert table["situations"]["situation-2"][RIGHT]["map_nees"] > 1.4, "the lines' R is too small"
    assert all(row["low_m"] > 0 for row in table["listing"].values())
    bent = table["situations"][wall_slam_faults.OUT_OF_LINE]
    assert bent["infinite lines"]["rms_m"] == pytest.approx(bent[RIGHT]["rms_m"], abs=5e-4)


def test_measured_walls_leave_the_direction_along_them_uncertain_and_foot_points_hide_it():
    measured, foot_points = (corridor.simulate_runs(12, kind) for kind in (True, False))
    steps = np.arange(1, 101)
    np.testing.assert_allclose(measured.claimed, 0.01 * np.sqrt(steps), rtol=0.2)
    assert 0.7 < measured.errors[-1] / measured.claimed[-1] < 1.4
    assert foot_points.errors[-1] > 1.5 * foot_points.wheels[-1] > 5 * foot_points.claimed[-1]
    assert foot_points.nees > 100 > 10 * measured.nees


def test_a_wall_at_the_end_helps_both_and_foot_points_stay_overconfident():
    both = (corridor.simulate_runs(6, kind, end_wall=True) for kind in (True, False))
    measured, foot_points = both
    assert max(measured.errors[-1], foot_points.errors[-1]) < 0.05
    assert foot_points.nees > 5 * measured.nees


def test_lines_of_walls_hold_their_ends(room):
    walls = room.world.walls
    lines = line_extraction_errors.lines_of(walls)
    normals = np.stack([np.cos(lines[:, 1]), np.sin(lines[:, 1])], axis=-1)
    along = np.einsum("nek,nk->ne", walls.reshape(-1, 2, 2), normals)
    np.testing.assert_allclose(along, lines[:, :1] * [1, 1], atol=1e-9)
    assert (lines[:, 0] >= 0).all()
    under = [line_extraction_errors.wall_under(ends, walls) for ends in walls.reshape(-1, 2, 2)]
    assert under == list(range(len(walls)))


def test_errors_of_lines_found_at_true_poses_match_their_R(room, found):
    assert 1.8 < line_extraction_errors.squared_errors(room, found).mean() < 2.4


@pytest.mark.slow
def test_of_two_foot_points_the_nearest_is_right_and_the_first_often_not():
    rooms = simulation("situation-1", np.random.default_rng(1))
    counts = line_extraction_errors.choices(rooms, wall_slam_faults.extracted_lines(rooms), 0.5)
    assert counts["observations"] > 10 * counts["with a choice"] > 0
    assert counts["the nearest"] > 0.95 * counts["with a choice"]
    assert counts["the first"] < 0.7 * counts["with a choice"]


def test_the_stored_ultrasound_runs_support_lesson_09():
    table = stored("ultrasound_walls")
    assert table["drives"]["cone model"]["high_m"] < 0 < table["drives"]["lidar's lines"]["low_m"]
    wrong = [row["no_wall"] / row["lines"] for row in table["slopes"]]
    assert wrong == sorted(wrong, reverse=True)
    assert wrong[0] > 0.15 > 0.03 > wrong[3]
    low, high = table["band_95"]
    assert table["nees"]["cone model"][-1] > high
    straight, bent = (table[key]["cone model, wheels slip"] for key in ("nees", "nees_along_arcs"))
    assert low < straight[-1] < high < straight[1]  # the second is above the band,
    assert all(low < size < high for size in bent)  # and only for the bend
    assert table["incidences"][-1]["lines"] < 0.02 * table["incidences"][0]["lines"]
