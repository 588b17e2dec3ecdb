"""Lesson 09's studies: the small loop and the package's, spoilt parts, the corridor, sound."""

import numpy as np
import pytest

from slamlab import estimators
from slamlab.estimators.wall_slam import WallSlam
from slamlab.sources import simulation
from slamlab.studies import corridor, heard_walls, line_truth, spoilt_walls, wall_loop
from slamlab.studies.spoilt_walls import RIGHT, VARIANTS
from slamlab.studies.study_command import stored


@pytest.fixture(scope="module")
def room():
    return simulation("situation-2", np.random.default_rng(0))


@pytest.fixture(scope="module")
def found(room):
    return spoilt_walls.found_by(room)


@pytest.mark.slow
def test_the_small_loop_believes_what_the_packages_does(room, found):
    loop = VARIANTS[RIGHT](room)
    poses, P, maps = spoilt_walls.driven(room, loop, found)
    whole = WallSlam(room.robot, room.sensor, np.random.default_rng(0))
    ran = estimators.run(room, whole)
    np.testing.assert_allclose(poses, ran.trajectory.poses, atol=1e-9)
    np.testing.assert_allclose(loop.mak.P, whole.filter.P, atol=1e-9)
    assert len(maps) == len(P) == len(room)
    assert len(maps[-1]) == len(loop.mak.ids)


@pytest.mark.slow
def test_a_tally_loses_no_line_and_no_wall(room, found):
    count = wall_loop.tally(room, found)
    assert count["steps"] == len(room)
    assert count["lines"] == count["known"] + count["new"] + count["unclear"]
    assert count["walls"] == count["entered"] - count["merged"]
    _, _, maps = spoilt_walls.driven(room, VARIANTS[RIGHT](room), found)
    assert count["walls"] == len(maps[-1])


@pytest.mark.slow
@pytest.mark.parametrize("name", [RIGHT, "degrees in the Jacobians", "paired before predict"])
def test_a_drive_gives_its_numbers_of_the_stored_table_again(room, name):
    rows = spoilt_walls.rows_of("situation-2", room, {name: VARIANTS[name]})
    for (_, variant), row in rows.items():
        was = stored("spoilt_walls")["seed_0"][variant]
        assert row["rms_m"] == pytest.approx(was, abs=2e-6)


def test_the_stored_table_says_what_lesson_09_says():
    table = stored("spoilt_walls")
    low, high = table["band_95"]
    for name in ("situation-1", "situation-2"):
        rows = table["situations"][name]
        assert low < rows[RIGHT]["nees"] < high
        assert rows["placed before predict"]["low_m"] > 0, "worse than odometry"
        for part in ("degrees in the Jacobians", "y = a x + b"):
            assert rows[part]["high_m"] < 0, "better than odometry"
            assert rows[part]["nees"] > high, "and overconfident"
            assert rows[part]["walls"] > 1.5 * rows[RIGHT]["walls"]
        assert rows["paired before predict"]["turned_deg"] > 10 * rows[RIGHT]["turned_deg"]
        assert rows["paired before predict"]["rms_m"] < 0.01
        assert rows["never merged"]["rms_m"] < 1.1 * rows[RIGHT]["rms_m"]
    assert all(row["low_m"] > 0 for row in table["listing"].values())
    bent = table["situations"][spoilt_walls.OUT_OF_LINE]
    assert bent["infinite lines"]["rms_m"] == pytest.approx(bent[RIGHT]["rms_m"], abs=5e-4)


def test_of_fewer_than_six_drives_there_is_no_interval():
    for study in (spoilt_walls.study, heard_walls.study):
        with pytest.raises(ValueError, match="at least 6, not 5"):
            study(5)


def test_measured_walls_leave_the_way_along_them_in_doubt_and_feet_deny_it():
    measured, feet = (corridor.drives(12, kind) for kind in (True, False))
    steps = np.arange(1, 101)
    np.testing.assert_allclose(measured.believes, 0.01 * np.sqrt(steps), rtol=0.2)
    assert 0.7 < measured.errs[-1] / measured.believes[-1] < 1.4
    assert feet.errs[-1] > 1.5 * feet.wheels[-1] > 5 * feet.believes[-1]
    assert feet.nees > 100 > 10 * measured.nees


def test_a_wall_at_the_end_helps_both_and_feet_stay_overconfident():
    measured, feet = (corridor.drives(6, kind, end_wall=True) for kind in (True, False))
    assert max(measured.errs[-1], feet.errs[-1]) < 0.05
    assert feet.nees > 5 * measured.nees


@pytest.mark.slow
def test_a_drive_by_sound_gives_its_numbers_of_the_stored_table_again():
    found = heard_walls.errors_of(0)
    for name, was in stored("heard_walls")["seed_0"].items():
        assert found[name][0] == pytest.approx(was, abs=2e-6)


def test_lines_of_walls_hold_their_ends(room):
    walls = room.world.walls
    lines = line_truth.lines_of(walls)
    normals = np.stack([np.cos(lines[:, 1]), np.sin(lines[:, 1])], axis=-1)
    along = np.einsum("nek,nk->ne", walls.reshape(-1, 2, 2), normals)
    np.testing.assert_allclose(along, lines[:, :1] * [1, 1], atol=1e-9)
    assert (lines[:, 0] >= 0).all()
    pieces = walls.reshape(-1, 2, 2)
    assert [line_truth.wall_under(ends, walls) for ends in pieces] == list(range(len(walls)))


def test_lines_found_at_true_poses_are_as_good_as_their_R_says(room, found):
    assert 1.8 < line_truth.squared_errors(room, found).mean() < 2.4


@pytest.mark.slow
def test_of_two_feet_the_nearest_is_right_and_the_first_often_not():
    rooms = simulation("situation-1", np.random.default_rng(1))
    counts = line_truth.choices(rooms, spoilt_walls.found_by(rooms), 0.5)
    assert counts["sightings"] > 10 * counts["with a choice"] > 0
    assert counts["the nearest"] > 0.95 * counts["with a choice"]
    assert counts["the first"] < 0.7 * counts["with a choice"]


def test_the_stored_drives_by_sound_say_what_lesson_09_says():
    table = stored("heard_walls")
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
