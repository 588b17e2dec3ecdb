"""Trajectory files of the world: read with their columns, units and times."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.evaluation import absolute_error, load_trajectory, save_tum
from slamlab.readings import Trajectory
from tests.property_testing import assert_same_pose
from tests.slamlab.formats.trajectory_writing import (
    CAMERA,
    COUNT,
    EPOCH,
    HEADED,
    SEPARATED,
    THETA,
    TIMES,
    TRUTH,
    TUM,
    C,
    O,
    S,
    X,
    Y,
    assert_is_the_truth,
    kitti,
    matrices,
    nanoseconds,
    read,
    table,
)


@pytest.mark.parametrize("text", HEADED.values(), ids=HEADED)
def test_a_header_names_the_columns_and_their_units(tmp_path, text):
    found, reported = read(tmp_path, text)
    assert_is_the_truth(found)
    assert not reported


@pytest.mark.parametrize("text", SEPARATED.values(), ids=SEPARATED)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_separators_line_ends_and_encodings_are_read_equally(tmp_path, text, encoding):
    found, reported = read(tmp_path, text.encode(encoding))
    assert_is_the_truth(found)
    assert not reported


def test_euroc_without_a_header_has_nanoseconds_and_w_first(tmp_path):
    text = table((nanoseconds(EPOCH), X, Y, O, C, O, O, S, *[O] * 9), ",")
    found, reported = read(tmp_path, text)
    assert_is_the_truth(found, EPOCH)
    assert not reported


@pytest.mark.parametrize(
    ("digits", "unit"), [(3, "milliseconds"), (6, "microseconds"), (9, "nanoseconds")]
)
def test_stamps_since_1970_in_another_unit_are_seconds_and_it_is_reported(tmp_path, digits, unit):
    stamps = [str(EPOCH * 10**digits + round(t * 10**digits)) for t in TIMES]
    found, reported = read(tmp_path, table((stamps, *TUM[1:])))
    assert_is_the_truth(found, EPOCH)
    assert f"read as TUM: its timestamps are {unit} since 1970" in reported


@pytest.mark.parametrize("turns", [-9, 0, 9])
def test_headings_of_several_turns_are_radians(tmp_path, turns):
    text = "time,x,y,theta\n" + table((TIMES, X, Y, THETA + turns * 2 * np.pi), ",")
    assert_is_the_truth(read(tmp_path, text)[0])


def test_stamps_that_can_be_no_seconds_are_reported(tmp_path):
    _, reported = read(tmp_path, table((nanoseconds(100), *TUM[1:])))
    assert "in another unit, name it in a header, such as time [ns]" in reported


@pytest.mark.parametrize(("axes", "expected"), [(None, ""), (CAMERA, "camera axes")])
def test_kitti_takes_its_times_from_the_file_beside_it(tmp_path, axes, expected):
    (tmp_path / "times.txt").write_text(table((TIMES,), number="{:e}".format))
    found, message = read(tmp_path, kitti(axes))
    np.testing.assert_allclose(found.times, TIMES, atol=1e-5)
    assert_same_pose(found.poses, TRUTH.poses)
    assert expected in message and bool(message) == bool(expected)


def test_kitti_s_own_folders_are_known(tmp_path):
    for folder in ("poses", "sequences/07"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "sequences/07/times.txt").write_text(table((TIMES,)))
    assert_is_the_truth(read(tmp_path / "poses", kitti(), "07.txt")[0])


def test_kitti_without_times_has_indices_and_it_is_reported(tmp_path):
    found, reported = read(tmp_path, kitti())
    np.testing.assert_array_equal(found.times, np.arange(COUNT))
    assert "read as KITTI: without times.txt" in reported
    with pytest.raises(ValueError, match="the times of the estimate are its indices"):
        absolute_error(found, TRUTH)


def test_matrices_with_stamps_or_of_four_rows_are_read(tmp_path):
    rows = np.array(list(matrices()))
    whole = np.column_stack([rows, np.tile([0.0, 0.0, 0.0, 1.0], (COUNT, 1))])
    for matrix in (rows, whole):
        assert_is_the_truth(read(tmp_path, table([TIMES, *matrix.T]))[0])
    found, _ = read(tmp_path, table(whole.T))
    assert_same_pose(found.poses, TRUTH.poses)


def test_a_camera_that_goes_straight_has_no_turns_but_a_path_along_z(tmp_path):
    rows = np.tile([1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], (COUNT, 1))
    rows[:, 11] = 0.5 * np.arange(COUNT)
    found, reported = read(tmp_path, table(rows.T))
    np.testing.assert_allclose(found.poses[:, 0], rows[:, 11])
    assert "camera axes" in reported


def test_what_leaves_the_plane_is_projected_and_reported(tmp_path):
    climbing = (TIMES, X, Y, 0.1 * np.arange(COUNT), O, O, S, C)
    found, reported = read(tmp_path, table(climbing))
    assert_is_the_truth(found)
    assert "not in a plane (tilted by up to 0°, heights over 3.9 m)" in reported
    half = np.radians(20) / 2  # pitched up by 20°
    rolled, upright = np.sin(half), np.cos(half)
    turned = -rolled * S, rolled * C, upright * S, upright * C
    found, reported = read(tmp_path, table((TIMES, X, Y, O, *turned)))
    assert_is_the_truth(found)
    assert "tilted by up to 20°" in reported


@pytest.mark.parametrize("length", [0.6, 1.9])
def test_quaternions_are_normalised(tmp_path, length):
    assert_is_the_truth(read(tmp_path, table((*TUM[:6], length * S, -length * -C)))[0])


@given(st.lists(st.floats(0, 4e9), min_size=1, max_size=8, unique=True).map(sorted), st.data())
def test_what_is_saved_is_loaded_again(tmp_path_factory, times, data):
    number = st.floats(-1e6, 1e6, allow_subnormal=False)
    angle = st.floats(-3.14, 3.14)
    poses = data.draw(
        st.lists(st.tuples(number, number, angle), min_size=(n := len(times)), max_size=n)
    )
    way = Trajectory(np.array(times), np.array(poses))
    path = tmp_path_factory.mktemp("saved") / "way.tum"
    save_tum(way, path)
    again = load_trajectory(path)
    np.testing.assert_array_equal(again.times, way.times)
    np.testing.assert_array_equal(again.poses[:, :2], way.poses[:, :2])
    assert_same_pose(again.poses, way.poses, 1e-12)
