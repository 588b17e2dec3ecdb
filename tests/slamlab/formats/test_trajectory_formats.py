"""Trajectory files of the world: read with their columns, units and times, or refused."""

import gzip
import tracemalloc
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.evaluation import absolute_error, load_trajectory, save_tum
from slamlab.files import SourceError
from slamlab.readings import Trajectory
from tests.property_testing import assert_same_pose
from tests.slamlab.formats.mutations import mutated
from tests.slamlab.formats.trajectory_writing import (
    CAMERA,
    COUNT,
    EPOCH,
    EUROC,
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


LINES = table(TUM).splitlines(keepends=True)
DAMAGED = {
    "tracking lost, as NaN": (
        "9 nan nan nan nan nan nan nan\n",
        "not finite: 1 (first in line 11)",
    ),
    "tracking lost, as no quaternion": ("9 1 1 0 0 0 0 0\n", "length 0: 1 (first in line 11)"),
    "too few numbers": ("9 1 1\n", "not poses: 1 (first in line 11)"),
    "words": ("9 1 1 0 0 0 0 one\n", "not poses: 1"),
    "MSVC's NaN": ("9 -nan(ind) 1 0 0 0 0 1\n", "not poses: 1"),
    "a quaternion of length 5": ("9 1 1 0 0 0 3 4\n", "not of length 1: 1"),
}


@pytest.mark.parametrize(("line", "message"), DAMAGED.values(), ids=DAMAGED)
def test_one_damaged_row_costs_that_row_and_is_reported(tmp_path, line, message):
    found, text = read(tmp_path, "".join([*LINES[:10], line, *LINES[10:]]))
    assert_is_the_truth(found)
    assert "read as TUM: skipped " in text and message in text


def test_a_compressed_file_that_is_cut_short_is_read_so_far(tmp_path):
    torn = gzip.compress(table(TUM).encode())[:-200]
    found, reported = read(tmp_path, torn)
    assert 0 < len(found) < COUNT and "file truncated" in reported
    assert_same_pose(found.poses, TRUTH.poses[: len(found)])


UNREADABLE = {
    "repeated": (
        "".join([*LINES[:3], *LINES[2:]]),
        "TUM, line 4: its timestamp repeats that of line 3",
    ),
    "two in one": (
        "".join(LINES * 2),
        "line 41: its timestamp is before that of line 40: sort the rows",
    ),
    "few digits": (
        table((TIMES + EPOCH, *TUM[1:]), number="{:g}".format),
        "line 2: its timestamp repeats that of line 1.*more digits",
    ),
    "columns in another order": (table((TIMES, S, C, O, O, X, Y, THETA)), "TUM.*not of length 1"),
    "no trajectory": (table((TIMES, X, Y, THETA)), "4 numbers in a row.*name.*first line"),
    "positions alone": ("time,x,y\n" + table((TIMES, X, Y), ","), "line 1.*names of 3 columns"),
    "unknown names": ("a b c d e f g h\n" + table(TUM), "line 1, .*a, b, c.*begin comments with #"),
    "degrees": (
        "time,x,y,theta\n" + table((TIMES, X, Y, np.degrees(THETA)), ","),
        "up to 257.8 match the path in degrees, not in radians; name their unit.*deg",
    ),
    "TUM with w first": (table((TIMES, X, Y, O, C, O, O, S)), "TUM: .* tilted, .*qw is the first"),
    "EuRoC with w last": (
        table((nanoseconds(EPOCH), *TUM[1:]), ","),
        "EuRoC: .* tilted, .*qw is the last of the four numbers: name the columns",
    ),
    "no rotations": (kitti(scale=3.0), "KITTI: 0 usable poses; matrices that are not rotations"),
    "KITTI with a damaged row": (kitti() + "1 2 3\n", "not poses: 1 .first in line 41.*correct"),
    "values left out": (table([[""] * COUNT, *TUM], ","), "contains no pose"),
    "text": (
        "a trajectory\nof nothing\n",
        "contains no pose: a row of TUM has 8.*; line 1 begins with 'a trajectory'",
    ),
    "binary": (bytes(range(256)) * 40, "contains no pose"),
}


@pytest.mark.parametrize(("content", "message"), UNREADABLE.values(), ids=UNREADABLE)
def test_an_invalid_trajectory_is_refused_with_format_line_and_remedy(tmp_path, content, message):
    with pytest.raises(SourceError, match=message):
        read(tmp_path, content)


def test_empty_fields_do_not_shift_the_columns(tmp_path):
    with pytest.raises(SourceError, match="rows that are not poses: 20"):
        read(tmp_path, table((TIMES, X, Y, ["0", ""] * (COUNT // 2), O, O, S, C), ","))


@pytest.mark.parametrize("count", [COUNT - 1, COUNT + 1])
def test_times_beside_kitti_that_are_not_as_many_are_refused(tmp_path, count):
    (tmp_path / "times.txt").write_text(table((np.arange(float(count)),)))
    with pytest.raises(SourceError, match=f"times.txt has {count} times.* 40 poses"):
        read(tmp_path, kitti())


VALID = [
    text.encode()
    for text in (*HEADED.values(), *SEPARATED.values(), kitti(CAMERA), EUROC + table(TUM, ","))
]
SCRAPS = [
    *b"# , ; \t \n \r _ [ - \0".split(b" "),
    *(b"nan", b"1e308", b"-1e999", b"1,5", b"[ns]", b"time,x,y,theta", b"\xff\xfe"),
]


@given(st.sampled_from(VALID).flatmap(lambda valid: mutated(valid, SCRAPS)))
def test_a_mutated_file_raises_nothing_but_a_source_error(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("mutated") / "trajectory"
    path.write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = load_trajectory(path)
        except SourceError as error:
            assert "array" not in str(error)
            return
    assert len(found.times) == len(found.poses) > 0
    assert np.isfinite(found.times).all() and (np.diff(found.times) > 0).all()
    assert np.isfinite(found.poses).all()


def test_memory_is_bounded_by_a_multiple_of_the_file(tmp_path):
    count = 20_000
    rows = np.zeros((count, 8))
    rows[:, 0], rows[:, 7] = np.arange(count), 1
    path = tmp_path / "long"
    path.write_text(table(rows.T))
    tracemalloc.start()
    try:
        load_trajectory(path)
        assert tracemalloc.get_traced_memory()[1] < 12 * path.stat().st_size + 4e6
    finally:
        tracemalloc.stop()
