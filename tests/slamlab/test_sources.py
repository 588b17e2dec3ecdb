"""Logs in, readings out, whatever the damage."""

import gzip
import json
import zlib
from dataclasses import asdict

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import sources
from slamlab.geometry import compose
from slamlab.readings import Observations, Reading, Scan
from slamlab.sources import SourceError
from tests.slamlab.support import Given


def flaser(i, ranges=(1.0, 1.5, 2.0, 81.83)):
    numbers = " ".join(map(str, ranges))
    pose = f"{0.1 * i:.6f} {0.02 * i:.6f} {0.05 * i:.6f}"
    return f"FLASER {len(ranges)} {numbers} 9 9 9 {pose} {1000 + i}.25 host 0.5"


LINES = [flaser(i) for i in range(12)]
WHOLE = ("\n".join(LINES) + "\n").encode()


def opened(tmp_path, content, name="log"):
    path = tmp_path / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return sources.open(path)


def test_a_carmen_line_is_read_as_the_format_specifies(tmp_path):
    source = opened(tmp_path, WHOLE)
    first, second = list(source)[:2]
    assert len(source) == 12
    assert (first.time, second.time) == (1000.25, 1001.25)
    assert np.array_equal(first.odometry, np.zeros(3))
    assert np.allclose(second.odometry, [0.1, 0.02, 0.05])
    assert first.scan.valid.tolist() == [True, True, True, False]
    assert np.allclose(first.scan.angles, np.radians([-90, -30, 30, 90]))


@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_comments_and_other_messages_are_passed_over(tmp_path, ending):
    other = ["# a comment", "PARAM robot_front_laser_max 50.0", "ODOM 1 2 3 0 0 0 1 h 1", ""]
    source = opened(tmp_path, ending.join([*other, *LINES, "SYNC x"]))
    assert len(source) == 12
    assert not source.damage
    assert source.sensor.range_max == 50.0


@pytest.mark.parametrize(
    ("line", "kind"),
    [
        ("FLASER", "lines without a number of ranges"),
        ("FLASER many 1 2", "lines without a number of ranges"),
        ("FLASER 5 1 2 3 4 9 9 9 0 0 0 1 host 2", "lines with a word instead of a number"),
        ("FLASER 3 1 2 3 4 5 9 9 9 0 0 0 1 host 2", "lines with a wrong number of ranges"),
        ("FLASER 9999999999 1 2", "lines with a wrong number of ranges"),
        ("FLASER 2 1 zwei 9 9 9 0 0 0 1 host 2", "lines with a word instead of a number"),
        ("FLASER 2 1 2 9 9 9 0 nan 0 1 host 2", "lines with invalid odometry or timestamp"),
        ("FLASER 2 1 2 9 9 9 0 0 0 inf host 2", "lines with invalid odometry or timestamp"),
        ("FLASER 2 1 2 9 9 9 1e99 0 0 1 host 2", "lines with invalid odometry or timestamp"),
    ],
)
def test_a_damaged_line_is_counted_by_kind_and_the_rest_is_read(tmp_path, line, kind):
    source = opened(tmp_path, "\n".join([*LINES[:5], line, *LINES[5:]]))
    assert len(list(source)) == 12
    assert source.damage == {kind: 1}
    assert source.skipped == 1


def test_nan_infinite_and_negative_ranges_are_no_returns_and_counted(tmp_path):
    source = opened(tmp_path, flaser(0, ("nan", -1.0, 2.0, "inf", 3.0)))
    (reading,) = source
    assert source.damage == {"NaN, infinite or negative ranges": 3}
    assert reading.scan.valid.tolist() == [False, False, True, False, True]
    assert source.skipped == 0


def test_stamps_that_run_backwards_are_counted_and_nothing_is_lost(tmp_path):
    source = opened(tmp_path, "\n".join([LINES[3], LINES[1], LINES[2]]))
    assert len(source) == 3
    assert source.damage == {"timestamps that run backwards": 1}


def test_a_log_without_an_intact_line_is_refused_with_the_reason(tmp_path):
    with pytest.raises(SourceError, match="the first of 1 lost readings is in line 1"):
        opened(tmp_path, "FLASER x\n")


def test_missing_files_and_folders_are_named(tmp_path):
    with pytest.raises(SourceError, match="does not exist"):
        sources.open(tmp_path / "nothing.log")
    with pytest.raises(SourceError, match="is a folder"):
        sources.open(tmp_path)


PACKED = gzip.compress(WHOLE, mtime=0)


@settings(max_examples=150)
@given(st.integers(0, len(PACKED)))
def test_any_truncation_of_a_gzip_log_keeps_every_whole_line(tmp_path_factory, cut):
    kept = zlib.decompressobj(31).decompress(PACKED[:cut])
    whole = kept.count(b"\n")
    path = tmp_path_factory.mktemp("cut") / "log.gz"
    path.write_bytes(PACKED[:cut])
    try:
        source = sources.open(path)
    except SourceError:
        assert whole == 0
        return
    assert whole <= len(source) <= whole + 1
    assert [r.time for r in source] == [1000.25 + i for i in range(len(source))]
    assert (cut == len(PACKED)) == (not source.damage["file truncated"])


@settings(max_examples=150)
@given(st.integers(0, len(WHOLE)), st.binary(min_size=0, max_size=30))
def test_junk_anywhere_in_a_log_costs_at_most_the_lines_it_touches(tmp_path_factory, at, junk):
    path = tmp_path_factory.mktemp("junk") / "log"
    path.write_bytes(WHOLE[:at] + junk + WHOLE[at:])
    source = sources.open(path)
    times = {r.time for r in source}
    touched = WHOLE[:at].count(b"\n")
    assert times >= {1000.25 + i for i in range(12) if abs(i - touched) > 1}


def same(a, b):
    np.testing.assert_equal(asdict(a), asdict(b))


@pytest.mark.parametrize("name", ["log", "log.gz"])
def test_a_reading_log_reads_back_equal_with_its_truth(tmp_path, name):
    source = sources.open("sim:polygon-wrong", np.random.default_rng(2))
    count = sources.write(source, tmp_path / name)
    again = sources.open(tmp_path / name)
    assert count == len(again) == len(source)
    assert (again.name, again.robot, again.sensor) == (source.name, source.robot, source.sensor)
    assert np.array_equal(again.truth.poses, source.truth.poses)
    for a, b in zip(source, again, strict=True):
        same(a, b)


numbers = st.floats(-1e6, 1e6)


@settings(max_examples=40)
@given(st.lists(st.tuples(numbers, numbers, st.lists(numbers, max_size=4)), min_size=1, max_size=5))
def test_readings_of_every_kind_read_back_equal(tmp_path_factory, rows):
    readings = []
    for i, (x, y, ranges) in enumerate(rows):
        times = -0.01 * np.arange(len(ranges)) if i % 4 == 1 else None
        scan = Scan(np.arange(len(ranges)) * 0.1, np.array(ranges), times=times) if i % 2 else None
        seen = Observations(np.array([[x, y]]), np.array([i])) if i % 3 else None
        control = np.array([y, x]) if i % 2 == 0 else None
        odometry = None if i % 5 == 4 else np.array([x, y, 0.1])
        readings.append(Reading(float(i), odometry, scan, seen, control))
    path = tmp_path_factory.mktemp("log") / "log"
    sources.write(Given(readings), path)
    for a, b in zip(readings, sources.open(path), strict=True):
        same(a, b)


def logged(tmp_path, name):
    """The first line and the other ones of a log of a simulation."""
    sources.write(sources.open(name), tmp_path / "log")
    header, *rest = (tmp_path / "log").read_text().splitlines()
    return json.loads(header), rest


def headed(header, rest):
    return "\n".join([json.dumps(header), *rest])


def test_a_log_of_readings_without_odometry_has_none_when_it_is_read_back(tmp_path):
    scans = [Reading(0.1 * i, scan=Scan(np.arange(3.0), np.full(3, 2.0))) for i in range(5)]
    sources.write(Given(scans), tmp_path / "log")
    again = sources.open(tmp_path / "log")
    assert not again.has_odometry
    assert [reading.odometry for reading in again] == [None] * 5


@pytest.mark.parametrize("damage", ["{", "[]", '{"time": 1}', "\x00\xff", "null"])
def test_a_damaged_reading_is_counted_and_its_motion_is_not_lost(tmp_path, damage):
    source = sources.open("sim:room", np.random.default_rng(1))
    sources.write(source, tmp_path / "log")
    lines = (tmp_path / "log").read_text().splitlines()
    lines[10] = damage
    broken = opened(tmp_path, "\n".join(lines))
    assert broken.damage == {"lines without a valid reading": 1}
    assert len(broken) == len(source) - 1
    ends = []
    for log in (source, broken):
        pose = np.zeros(3)
        for reading in log:
            pose = compose(pose, reading.odometry)
        ends.append(pose)
    assert np.allclose(*ends, atol=1e-9)


def test_an_older_reading_log_without_a_field_of_the_sensor_is_read(tmp_path):
    older, rest = logged(tmp_path, "sim:situation-1")
    del older["sensor"]["range_curvature"]
    log = opened(tmp_path, headed(older, rest))
    assert log.sensor == sources.open("sim:situation-1").sensor


@pytest.mark.parametrize("robot", [[], "fast", None, {"slip": "much"}])
def test_a_header_whose_robot_is_none_is_refused(tmp_path, robot):
    header, rest = logged(tmp_path, "sim:polygon")
    with pytest.raises(SourceError, match="header of this reading log is damaged"):
        opened(tmp_path, headed(header | {"robot": robot}, rest))


def test_a_reading_log_of_another_version_or_with_a_broken_header_is_refused(tmp_path):
    header, rest = logged(tmp_path, "sim:polygon")
    bare = {"format": header["format"], "version": 1}
    for first, others, message in (
        (header | {"version": 9}, rest, "version 9"),
        (bare, rest, "header of this reading log is damaged"),
        (header, [], "no valid reading"),
    ):
        with pytest.raises(SourceError, match=message):
            opened(tmp_path, headed(first, others))


def test_missing_ranges_are_recognised_by_their_count_at_the_maximum_range(tmp_path):
    rng, path = np.random.default_rng(0), tmp_path / "log"
    far = [np.where(np.arange(180) < 30, 51.15, rng.uniform(1, 30, 180)) for _ in range(5)]
    path.write_text("\n".join(flaser(i, ranges) for i, ranges in enumerate(far)) + "\n")
    with sources.open(path) as log:
        assert [int(r.scan.valid.sum()) for r in log] == [150] * 5
        assert log.sensor.range_max < 51.15


def test_a_wall_far_away_is_no_end_of_the_range(tmp_path):
    path = tmp_path / "log"
    path.write_text("\n".join(flaser(i, np.full(180, 20.0)) for i in range(5)) + "\n")
    with sources.open(path) as log:
        assert all(r.scan.valid.all() for r in log)
