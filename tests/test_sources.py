"""Logs in, readings out, whatever the damage."""

import gzip
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import sources
from slamlab.geometry import compose
from slamlab.readings import Observations, Reading, Scan
from slamlab.sources import SourceError
from slamlab.sources.base import Source
from slamlab.sources.carmen import beam_angles


def flaser(i, ranges=(1.0, 1.5, 2.0, 81.83), odometry=None, tail="host 0.5"):
    x, y, theta = (0.1 * i, 0.02 * i, 0.05 * i) if odometry is None else odometry
    numbers = " ".join(map(str, ranges))
    line = f"FLASER {len(ranges)} {numbers} 9 9 9 {x:.6f} {y:.6f} {theta:.6f} {1000 + i}.25 {tail}"
    return line.strip()


LINES = [flaser(i) for i in range(12)]
WHOLE = ("\n".join(LINES) + "\n").encode()


def opened(tmp_path, content, name="log"):
    path = tmp_path / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return sources.open(path)


def test_a_carmen_line_is_read_as_the_format_says(tmp_path):
    source = opened(tmp_path, WHOLE)
    first, second = list(source)[:2]
    assert len(source) == 12
    assert (first.time, second.time) == (1000.25, 1001.25)
    assert np.array_equal(first.odometry, np.zeros(3))
    assert np.allclose(second.odometry, [0.1, 0.02, 0.05])
    assert first.scan.valid.tolist() == [True, True, True, False]
    assert np.allclose(first.scan.angles, np.radians([-90, -30, 30, 90]))


@pytest.mark.parametrize(
    ("count", "first", "last"),
    [(180, -90, 89), (181, -90, 90), (360, -90, 89.5), (361, -90, 90), (401, -50, 50)],
)
def test_beams_run_from_right_to_left_by_their_number(count, first, last):
    angles = np.degrees(beam_angles(count))
    assert angles[0] == pytest.approx(first)
    assert angles[-1] == pytest.approx(last)
    assert np.ptp(np.diff(angles)) < 1e-9


def test_increments_sum_to_the_absolute_odometry(tmp_path):
    rng = np.random.default_rng(3)
    absolute = np.cumsum(rng.normal(size=(20, 3)), axis=0)
    source = opened(tmp_path, "\n".join(flaser(i, odometry=o) for i, o in enumerate(absolute)))
    pose = absolute[0]
    for reading, true in zip(source, absolute, strict=True):
        pose = compose(pose, reading.odometry)
        assert np.allclose(pose[:2], true[:2], atol=1e-5)
        assert np.exp(1j * pose[2]) == pytest.approx(np.exp(1j * true[2]), abs=1e-5)


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
        ("FLASER", "lines without a count of ranges"),
        ("FLASER many 1 2", "lines without a count of ranges"),
        ("FLASER 5 1 2 3 4 9 9 9 0 0 0 1 host 2", "lines with a word where a number belongs"),
        ("FLASER 3 1 2 3 4 5 9 9 9 0 0 0 1 host 2", "lines whose count of ranges is wrong"),
        ("FLASER 9999999999 1 2", "lines whose count of ranges is wrong"),
        ("FLASER 2 1 zwei 9 9 9 0 0 0 1 host 2", "lines with a word where a number belongs"),
        ("FLASER 2 1 2 9 9 9 0 nan 0 1 host 2", "lines without a finite odometry and stamp"),
        ("FLASER 2 1 2 9 9 9 0 0 0 inf host 2", "lines without a finite odometry and stamp"),
        ("FLASER 2 1 2 9 9 9 1e99 0 0 1 host 2", "lines without a finite odometry and stamp"),
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
    assert source.damage == {"ranges NaN, infinite or negative": 3}
    assert reading.scan.valid.tolist() == [False, False, True, False, True]
    assert source.skipped == 0


def test_stamps_that_run_backwards_are_counted_and_nothing_is_lost(tmp_path):
    source = opened(tmp_path, "\n".join([LINES[3], LINES[1], LINES[2]]))
    assert len(source) == 3
    assert source.damage == {"stamps that run backwards": 1}


@pytest.mark.parametrize("content", [b"", b"\n \n", b"# only a comment\n", bytes(range(256)) * 9])
def test_a_file_without_readings_is_refused_in_one_line(tmp_path, content):
    with pytest.raises(SourceError) as refused:
        opened(tmp_path, content)
    assert "\n" not in str(refused.value)
    assert "log" in str(refused.value)


def test_a_log_of_nothing_but_damage_is_refused_and_says_so(tmp_path):
    with pytest.raises(SourceError, match="1 were unreadable"):
        opened(tmp_path, "FLASER x\n")


def test_missing_files_and_folders_are_named(tmp_path):
    with pytest.raises(SourceError, match="no such file"):
        sources.open(tmp_path / "nothing.log")
    with pytest.raises(SourceError, match="is a folder"):
        sources.open(tmp_path)


PACKED = gzip.compress(WHOLE, mtime=0)


@settings(max_examples=150)
@given(st.integers(0, len(PACKED)))
def test_any_truncation_of_a_gzip_log_keeps_every_whole_line(tmp_path_factory, cut):
    import zlib

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
    assert (cut == len(PACKED)) == (not source.damage["file torn"])


@settings(max_examples=150)
@given(st.integers(0, len(WHOLE)), st.binary(min_size=0, max_size=30))
def test_junk_anywhere_in_a_log_costs_at_most_the_lines_it_touches(tmp_path_factory, at, junk):
    path = tmp_path_factory.mktemp("junk") / "log"
    path.write_bytes(WHOLE[:at] + junk + WHOLE[at:])
    source = sources.open(path)
    times = {r.time for r in source}
    touched = WHOLE[:at].count(b"\n")
    assert times >= {1000.25 + i for i in range(12) if abs(i - touched) > 1}


@settings(max_examples=60)
@given(st.data())
def test_flipped_bytes_of_a_gzip_log_raise_nothing_but_a_source_error(tmp_path_factory, data):
    at = data.draw(st.integers(2, len(PACKED) - 1))
    packed = bytearray(PACKED)
    packed[at] ^= data.draw(st.integers(1, 255))
    path = tmp_path_factory.mktemp("flip") / "log.gz"
    path.write_bytes(packed)
    try:
        list(sources.open(path))
    except SourceError as refused:
        assert "\n" not in str(refused)


class Given(Source):
    """A source of given readings."""

    def __init__(self, readings):
        super().__init__()
        self.name, self._readings = "given", readings

    def __iter__(self):
        return iter(self._readings)


def same(a, b):
    assert a.time == b.time
    assert np.array_equal(a.odometry, b.odometry)
    assert (a.scan is None) == (b.scan is None)
    if a.scan is not None:
        assert np.array_equal(a.scan.angles, b.scan.angles)
        assert np.array_equal(a.scan.ranges, b.scan.ranges, equal_nan=True)
        assert (a.scan.range_max, a.scan.range_min) == (b.scan.range_max, b.scan.range_min)
    assert (a.control is None) == (b.control is None)
    if a.control is not None:
        assert np.array_equal(a.control, b.control)
    assert (a.observations is None) == (b.observations is None)
    if a.observations is not None:
        assert np.array_equal(a.observations.z, b.observations.z)
        assert np.array_equal(a.observations.ids, b.observations.ids)


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
        scan = Scan(np.arange(len(ranges)) * 0.1, np.array(ranges)) if i % 2 else None
        seen = Observations(np.array([[x, y]]), np.array([i])) if i % 3 else None
        control = np.array([y, x]) if i % 2 == 0 else None
        readings.append(Reading(float(i), np.array([x, y, 0.1]), scan, seen, control))
    path = tmp_path_factory.mktemp("log") / "log"
    sources.write(Given(readings), path)
    for a, b in zip(readings, sources.open(path), strict=True):
        same(a, b)


@pytest.mark.parametrize("damage", ["{", "[]", '{"time": 1}', "\x00\xff", "null"])
def test_a_damaged_reading_is_counted_and_its_motion_is_not_lost(tmp_path, damage):
    source = sources.open("sim:room", np.random.default_rng(1))
    sources.write(source, tmp_path / "log")
    lines = (tmp_path / "log").read_text().splitlines()
    lines[10] = damage
    broken = opened(tmp_path, "\n".join(lines))
    assert broken.damage == {"lines that are no reading": 1}
    assert len(broken) == len(source) - 1
    ends = []
    for log in (source, broken):
        pose = np.zeros(3)
        for reading in log:
            pose = compose(pose, reading.odometry)
        ends.append(pose)
    assert np.allclose(*ends, atol=1e-9)


def test_an_older_reading_log_that_does_not_know_a_figure_of_the_sensor_is_read(tmp_path):
    sources.write(sources.open("sim:situation-1"), tmp_path / "log")
    header, *rest = (tmp_path / "log").read_text().splitlines()
    older = json.loads(header)
    del older["sensor"]["range_curvature"]
    log = opened(tmp_path, "\n".join([json.dumps(older), *rest]))
    assert log.sensor == sources.open("sim:situation-1").sensor


@pytest.mark.parametrize("robot", [[], "fast", None, {"slip": "much"}])
def test_a_header_whose_robot_is_none_is_refused(tmp_path, robot):
    sources.write(sources.open("sim:polygon"), tmp_path / "log")
    header, *rest = (tmp_path / "log").read_text().splitlines()
    odd = json.loads(header) | {"robot": robot}
    with pytest.raises(SourceError, match="header of this reading log is damaged"):
        opened(tmp_path, "\n".join([json.dumps(odd), *rest]))


def test_a_reading_log_of_another_version_or_with_a_broken_header_is_refused(tmp_path):
    sources.write(sources.open("sim:polygon"), tmp_path / "log")
    header, *rest = (tmp_path / "log").read_text().splitlines()
    newer = json.loads(header) | {"version": 9}
    with pytest.raises(SourceError, match="version 9"):
        opened(tmp_path, "\n".join([json.dumps(newer), *rest]))
    bare = {"format": newer["format"], "version": 1}
    with pytest.raises(SourceError, match="header of this reading log is damaged"):
        opened(tmp_path, "\n".join([json.dumps(bare), *rest]))
    with pytest.raises(SourceError, match="no readable reading"):
        opened(tmp_path, header + "\n")


def test_a_recording_that_is_not_here_says_what_it_is(tmp_path, monkeypatch):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    with pytest.raises(SourceError, match="SLAMLAB_DATA"):
        sources.recording("intel")
    with pytest.raises(SourceError, match="there are: intel"):
        sources.recording("atlantis")


def test_an_unknown_simulation_is_named_with_those_there_are():
    with pytest.raises(SourceError, match="polygon-wrong"):
        sources.open("sim:atlantis")


def test_ranges_where_nothing_came_back_are_told_by_their_number_at_the_end_of_the_range(tmp_path):
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
