"""Files of relations: separators, headers, encodings, damage; stamps of another clock."""

import gzip

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.cli.run_results import error_table
from slamlab.evaluation import Relations, load_relations, relations_error
from slamlab.files import SourceError
from slamlab.geometry import between
from slamlab.readings import Trajectory
from tests.slamlab.formats.mutations import mutated
from tests.slamlab.support import refuses

RNG = np.random.default_rng(8)
TIMES = 1e9 + 0.25 * np.arange(30)
POSES = RNG.normal(size=(30, 3))
PAIRS = RNG.integers(0, 30, (50, 2))
WANTED = between(*POSES[PAIRS].transpose(1, 0, 2))
ROWS = [
    [*TIMES[pair].tolist(), x, y, 0.0, 0.0, 0.0, yaw]
    for pair, (x, y, yaw) in zip(PAIRS, WANTED.tolist(), strict=True)
]


def text(separator=" ", end="\n", number=repr, rows=ROWS):
    return "".join(separator.join(map(number, row)) + end for row in rows)


NAMED = [[t1, t2, yaw, y, x] for t1, t2, x, y, *_, yaw in ROWS]
READABLE = {
    "blanks": text(),
    "commas": text(", "),
    "semicolons": text(";"),
    "a comment": "# t1 t2 x y z roll pitch yaw\n" + text(),
    "a header": "t1,t2,x,y,z,roll,pitch,yaw\n" + text(","),
    "another order": "t1 [s], t2 [s], yaw [rad], y [m], x [m]\n" + text(",", rows=NAMED),
}


@pytest.mark.parametrize("content", READABLE.values(), ids=READABLE)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_relations_are_read_as_they_are_written(tmp_path, content, encoding):
    (tmp_path / "relations").write_bytes(content.encode(encoding))
    found = load_relations(tmp_path / "relations")
    np.testing.assert_array_equal(found.stamps, TIMES[PAIRS])
    np.testing.assert_array_equal(found.poses, WANTED)
    assert not found.damage


def test_damage_is_counted_by_its_kind(tmp_path):
    damaged = "1 2 3\n1 2 x 0 0 0 0 0\n3 4 1 2 0 0 0 nan\n"
    torn = gzip.compress((text() + damaged + text()).encode())[:-60]
    (tmp_path / "relations").write_bytes(torn)
    found = load_relations(tmp_path / "relations")
    assert found.damage == {
        "rows that are not relations": 2,
        "rows that are not finite": 1,
        "file truncated": 1,
    }
    assert 50 < len(found.poses) < 100


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("nothing here\n", "contains no relation: a row has 8 numbers, t1 t2 x y z"),
        ("1 2 3\n", "3 numbers in a row, contains no relation: a row has 8"),
        ("1 2 3 4 5 6 7 nan\n", "not finite: 1 .first in line 1.. contains no relation: a row"),
        ("1 2 0 0 0 0 0 0\n1 2 0 0 0 0 0 90\n", "relations, line 2: a yaw of 90 is no.*π/180"),
    ],
)
def test_an_invalid_relation_is_refused_with_line_and_remedy(tmp_path, content, message):
    (tmp_path / "relations").write_text(content)
    with pytest.raises(SourceError, match=message):
        load_relations(tmp_path / "relations")


test_relations_of_another_clock_are_refused_with_the_reason = refuses(
    lambda times: relations_error(Trajectory(times, POSES), Relations(TIMES[PAIRS], WANTED)),
    (
        TIMES - 1e9,
        "begins 1e.09 s before the file of relations, probably because one counts from 1970",
    ),
    (1e3 * TIMES, "the timestamps of the log are in milliseconds, not seconds"),
    (1e-9 * TIMES, "the timestamps of the file of relations are in nanoseconds"),
    (TIMES + 0.1, "do they belong to this log"),
)


VALID = [content.encode() for content in READABLE.values()]


@given(st.sampled_from(VALID).flatmap(mutated))
def test_a_mutated_file_raises_nothing_but_a_source_error(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("mutated") / "relations"
    path.write_bytes(content)
    try:
        found = load_relations(path)
    except SourceError:
        return
    assert len(found.poses) == len(found.stamps) > 0
    assert np.isfinite(found.poses).all()


def test_a_run_reports_what_its_errors_leave_out():
    compared = {"naive_m": 1.0, "corrected_m": 0.5, "naive_rad": None, "corrected_rad": 0.1}
    relations = compared | {"count": 3, "of": 5, "damage": {"rows that are not relations": 2}}
    summary = {"estimator": "icp", "relations": relations, "no_truth": "the stamps do not rise"}
    *table, truth, count, damage = error_table(summary)
    assert [line.split()[-2:] for line in table[1:]] == [["1.000", "0.500"], ["none", "0.100"]]
    assert truth == "no errors relative to the true poses: the stamps do not rise"
    assert count.startswith("3 of 5 relations were compared")
    assert damage == "damage of the relations: rows that are not relations: 2"
