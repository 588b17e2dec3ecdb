"""Scans and odometry of ROS bags: mounting, interpolation, order of the beams, choice of topics."""

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

pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from tests.slamlab.formats.bag_writing import MOUNT, SCAN, Bag
from tests.slamlab.formats.recorded_robot import (
    BEGIN,
    COUNT,
    FULL,
    ROOM,
    Recording,
    errors_by_truth,
    map_errors,
    pose,
    ranges_from,
)
from tests.slamlab.formats.room_runs import distances_to_walls


def test_without_a_mount_the_robots_motion_is_read_and_that_is_reported(tmp_path):
    for odometry in ("topic", "tf"):
        source = sources.open(Recording(odometry=odometry, mount=None).write(tmp_path / odometry))
        measured = [r.odometry for r in source]
        at = pose(BEGIN)
        for reading, odometry in zip(source, measured, strict=True):
            at = compose(at, odometry)
            np.testing.assert_allclose(at, pose(reading.time), atol=1e-3)
        assert "no transform leads from base_link to laser; record /tf and" in source.notes[0]
        assert list(source.damage) == [
            "no transform to the laser, which is assumed at the robot's centre"
        ]


def test_the_message_definition_of_the_bag_is_used(tmp_path):
    definition = """Header header
uint16 model
float32[] ranges
float32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\nfloat32 time_increment
float32 scan_time\nfloat32 range_min\nfloat32 range_max
"""
    own = get_typestore(Stores.ROS1_NOETIC)
    own.fielddefs.pop(SCAN)
    own.register(get_types_from_msg(definition, SCAN))
    angles = np.linspace(-1.5, 1.5, 200)
    with Bag(tmp_path / "run.bag", "ros1") as bag:
        for k in range(3):
            at = np.array([1.0 + 0.2 * k, 0.5, 0.1 * k])
            bag.odometry(BEGIN + k, at, child="laser")
            header = bag.header(BEGIN + k, "laser")
            scan = own.types[SCAN](
                header=header, model=7, ranges=ranges_from(at, angles).astype(np.float32),
                angle_min=-1.5, angle_max=1.5, angle_increment=3 / 199, time_increment=0.0,
                scan_time=0.1, range_min=0.1, range_max=20.0,
            )  # fmt: skip
            bag.write("/scan", SCAN, scan, BEGIN + k, own)
    source = sources.open(tmp_path / "run.bag")
    assert len(source) == 3 and not source.damage
    assert map_errors(source, np.array([1.0, 0.5, 0])).max() < 1e-4


@pytest.mark.parametrize("order", ["at once", "in order", "in reverse"])
@pytest.mark.parametrize("odometry", ["topic", "tf", None])
def test_the_order_of_the_beams_is_found_whatever_the_header(tmp_path, order, odometry):
    sweep = {"at once": 0.0, "in order": 0.1, "in reverse": -0.1}[order]
    recording = Recording(odometry=odometry, sweep=sweep, turn_time=0.1)
    source = sources.open(recording.write(tmp_path))
    assert len(source) == COUNT and source.has_odometry == (odometry is not None)
    first = next(iter(source))
    assert first.time == pytest.approx(BEGIN + (0.1 if sweep else 0))
    if odometry:
        errors = map_errors(source, compose(pose(first.time), MOUNT))
        assert errors.max() < 0.02  # 0.3 m where scans are not deskewed
        assert all(reading.scan.times is None for reading in source)
    elif sweep:
        for reading in source:
            times = reading.scan.times
            np.testing.assert_allclose(times, np.linspace(-0.1, 0, len(FULL)), atol=1e-6)
            at = compose(pose(reading.time + times), MOUNT)
            points = np.column_stack(
                [reading.scan.ranges * f(reading.scan.angles) for f in (np.cos, np.sin)]
            )
            points = compose(at, np.column_stack([points, 0 * times]))[:, :2]
            assert distances_to_walls(points, ROOM).max() < 0.02
    else:
        assert all(reading.scan.times is None for reading in source)
        assert errors_by_truth(source).max() < 1e-5
    assert ("the order of ranges, in 0.1 s" in " ".join(source.notes)) == bool(sweep)


def way(count=12):
    """Stamps, and a robot's poses in its odometry's frame at them; it turns more than once."""
    rng = np.random.default_rng(3)
    poses = [np.array([1.0, -2.0, 2.5])]
    for step in rng.normal([0.3, 0.0, 0.8], 0.1, size=(count - 1, 3)):
        poses.append(compose(poses[-1], step))
    return 100.0 + 0.25 * np.arange(count), np.array(poses)


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
            bag.scan(stamp, [1, 2], received=103)
    heading = np.unwrap(poses[:, 2])
    expected = np.column_stack([np.interp(at, stamps, c) for c in (*poses[:, :2].T, heading)])
    measured = np.array([reading.odometry for reading in sources.open(path)])
    assert_same_pose(measured[1:], between(expected[:-1], expected[1:]), 1e-6)


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


def test_without_rosbags_the_message_states_what_to_install(tmp_path, monkeypatch, capsys):
    path = Recording().write(tmp_path)
    monkeypatch.setitem(sys.modules, "rosbags", None)
    assert main(["run", str(path)]) == 2
    output = capsys.readouterr().err
    assert f'rosbags is not installed: pip install "{DISTRIBUTION}[ros]"' in output
    assert output.count("\n") == 1
