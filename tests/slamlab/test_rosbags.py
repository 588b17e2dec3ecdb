"""ROS bags, written here with rosbags as a robot would write them, of both versions."""

import re
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import sources
from slamlab.cli import main
from slamlab.extras import DISTRIBUTION
from slamlab.geometry import between, compose
from slamlab.sources import SourceError
from tests.property_testing import assert_same_pose

rosbags = pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")
from tests.slamlab.formats.bag_writing import KINDS, MOUNT, Bag, rotation  # noqa: E402

BEAMS = 90


def way(count=12):
    """Stamps, and a robot's poses in its odometry's frame at them; it turns more than once."""
    rng = np.random.default_rng(3)
    poses = [np.array([1.0, -2.0, 2.5])]
    for step in rng.normal([0.3, 0.0, 0.8], 0.1, size=(count - 1, 3)):
        poses.append(compose(poses[-1], step))
    return 100.0 + 0.25 * np.arange(count), np.array(poses)


def ranges_at(k):
    """Ranges of the k-th scan."""
    return np.random.default_rng([4, k]).uniform(0.5, 15, BEAMS).astype(np.float32)


def written(path, kind, how="topic"):
    """A bag of a robot on its way, a scan with each odometry."""
    path = path / ("run.bag" if kind == "ros1" else "run")
    with Bag(path, kind) as bag:
        bag.mount()
        for k, (stamp, pose) in enumerate(zip(*way(), strict=True)):
            if how == "topic":
                bag.odometry(stamp, pose)
            else:
                turn = rotation(pose[2])
                bag.transform(stamp, "odom", "base_link", pose[:2], turn)
                bag.transform(stamp, "map", "odom", [k, k], turn)  # somebody's corrections
            bag.scan(stamp, ranges_at(k))
    return path


def assert_is_the_way(source):
    stamps, poses = way()
    laser = compose(poses, MOUNT)
    readings = list(source)
    assert len(source) == len(readings) == len(stamps)
    np.testing.assert_allclose([r.time for r in readings], stamps)
    assert not readings[0].odometry.any()
    measured = np.array([r.odometry for r in readings[1:]])
    assert_same_pose(measured, between(laser[:-1], laser[1:]), 1e-6)
    for k, reading in enumerate(readings):
        np.testing.assert_array_equal(reading.scan.ranges, ranges_at(k))
        np.testing.assert_allclose(reading.scan.angles, np.linspace(-1.5, 1.5, BEAMS), atol=1e-6)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("how", ["topic", "tf"])
def test_a_bag_reports_scans_and_the_lasers_motion(tmp_path, kind, how):
    source = sources.open(written(tmp_path, kind, how))
    assert_is_the_way(source)
    assert not source.damage and source.skipped == 0
    assert source.sensor.range_max == 20 and source.sensor.field_of_view == pytest.approx(3)


@given(st.lists(st.floats(100, 102.75), min_size=2, max_size=8, unique=True))
@settings(max_examples=15)
def test_between_odometry_messages_the_motion_is_interpolated(tmp_path_factory, at):
    path = tmp_path_factory.mktemp("bag") / "run.bag"
    stamps, poses = way()
    at = np.round(at, 6)
    with Bag(path, "ros1") as bag:
        for stamp, pose in zip(stamps, poses, strict=True):
            bag.odometry(stamp, pose, child="laser")
        for stamp in at:
            bag.scan(stamp, ranges_at(0), received=103)
    heading = np.unwrap(poses[:, 2])
    expected = np.column_stack([np.interp(at, stamps, c) for c in (*poses[:, :2].T, heading)])
    measured = np.array([reading.odometry for reading in sources.open(path)])
    assert_same_pose(measured[1:], between(expected[:-1], expected[1:]), 1e-6)


def test_scans_outside_the_odometrys_time_are_left_out_and_counted(tmp_path):
    stamps, poses = way()
    with Bag(tmp_path / "run.bag", "ros1") as bag:
        bag.mount()
        for stamp, pose in zip(stamps, poses, strict=True):
            bag.odometry(stamp, pose)
        for stamp in (90.0, 101.0, 102.0, 101.5, 200.0):
            bag.scan(stamp, ranges_at(0), received=101)
    source = sources.open(tmp_path / "run.bag")
    assert [reading.time for reading in source] == [101, 102, 101.5]
    assert source.skipped == 2
    assert source.damage == {
        "scans outside the odometry's time": 2,
        "timestamps that run backwards": 1,
    }


def test_one_of_several_topics_is_appended_to_the_path(tmp_path):
    path = tmp_path / "C# bags" / "run.bag"
    path.parent.mkdir()
    with Bag(path, "ros1") as bag:
        for stamp, x in ((100, 0.0), (102, 2.0)):
            bag.odometry(stamp, [x, 0, 0], topic="/odom", child="laser")
            bag.odometry(stamp, [3 * x, 0, 0], topic="/wheels", child="laser")
        for stamp in (100.5, 101.5):
            bag.scan(stamp, [1, 2], topic="/front")
            bag.scan(stamp, [3, 4], topic="/rear")
    front, rear = (f"/{name} (sensor_msgs/LaserScan, 2)" for name in ("front", "rear"))
    odom, wheels = (f"/{name} (nav_msgs/Odometry, 2)" for name in ("odom", "wheels"))
    for topics, message in (
        (
            "",
            f"sensor_msgs/LaserScan on several topics: {front}, {rear}; choose one, as in {path}#",
        ),
        ("#/rear", f"nav_msgs/Odometry on several topics: {odom}, {wheels}; choose one, as in "),
        ("#/side", f"has no topic /side; available: {front}, {odom}, {rear}, {wheels}"),
    ):
        with pytest.raises(SourceError, match=re.escape(message)):
            sources.open(f"{path}{topics}")
    _, second = sources.open(f"{path}#/rear,/wheels")
    np.testing.assert_array_equal(second.scan.ranges, [3, 4])
    np.testing.assert_allclose(second.odometry, [3, 0, 0])


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=40)
@given(share=st.floats(0, 1, exclude_max=True))
def test_a_bag_truncated_is_refused_in_one_line_or_read_in_part(tmp_path_factory, kind, share):
    folder = tmp_path_factory.mktemp("cut")
    path = written(folder, kind)
    (file,) = [path] if path.is_file() else (p for p in path.iterdir() if p.suffix != ".yaml")
    cut = folder / f"cut{file.suffix}"
    content = file.read_bytes()
    cut.write_bytes(content[: int(share * len(content))])
    try:
        source = sources.open(cut)
    except SourceError as refused:
        assert "\n" not in str(refused)
        return
    assert len(list(source)) <= 12
    assert source.damage or len(source) == 12


def test_without_rosbags_the_message_states_what_to_install(tmp_path, monkeypatch, capsys):
    path = written(tmp_path, "ros1")
    monkeypatch.setitem(sys.modules, "rosbags", None)
    assert main(["run", str(path)]) == 2
    output = capsys.readouterr().err
    assert f'rosbags is not installed: pip install "{DISTRIBUTION}[ros]"' in output
    assert output.count("\n") == 1


def test_a_folder_without_metadata_and_other_databases_are_no_bags(tmp_path):
    with pytest.raises(SourceError, match="is a folder"):
        sources.open(tmp_path)
    (tmp_path / "metadata.yaml").write_text("other: 1\n")
    with pytest.raises(SourceError, match="cannot be read as a ROS bag"):
        sources.open(tmp_path)
    (tmp_path / "x.db3").write_bytes(b"SQLite format 3\0" + bytes(100))
    with pytest.raises(SourceError, match="cannot be read as a ROS bag"):
        sources.open(tmp_path / "x.db3")
