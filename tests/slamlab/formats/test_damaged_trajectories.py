"""Trajectory files with damage: the row alone is lost and reported, or the file is refused."""

import gzip
import tracemalloc
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.evaluation import load_trajectory
from slamlab.files import SourceError
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
    nanoseconds,
    read,
    table,
)

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
