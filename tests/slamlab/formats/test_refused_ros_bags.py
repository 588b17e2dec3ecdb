"""ROS bags without usable odometry or scans: read without it, or refused with the reason."""

import numpy as np
import pytest

from slamlab import sources
from slamlab.geometry import compose
from slamlab.sources import SourceError

pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")

from tests.slamlab.formats.bag_writing import MOUNT, SCAN, rotation
from tests.slamlab.formats.recorded_robot import (
    BEGIN,
    COUNT,
    FULL,
    Recording,
    errors_by_truth,
    map_errors,
    pose,
    ranges_from,
)
from tests.slamlab.formats.ros_bag_faults import (
    MOUNTED,
    NONE,
    UPSIDE_DOWN,
    WIDE,
    both,
    from_the_side,
    moving,
    put,
    static,
    with_kind,
)

# what is read rightly without odometry, and why there is none
WITHOUT_ODOMETRY = {
    "scans alone": Recording(mount=None, note="no topic of nav_msgs/Odometry, and no transform"),
    "a lidar upside down": Recording(
        mount_turn=UPSIDE_DOWN,
        on_scan=put(ranges=lambda k, m: ranges_from(compose(pose(m["stamp"]), MOUNT), -FULL)),
        note="no transform gives the motion",
    ),
    "odom → base_link by a static transform": Recording(
        extra=static(("odom", "base_link", [0, 0], NONE)),
        note="the transform odom → base_link never changes",
    ),
    "odom → base_link again and again": Recording(
        extra=moving("odom", "base_link", lambda t: [1, 2], lambda t: -NONE),
        note="the transform odom → base_link never changes",
    ),
    "laser → odom → base_link, as a frequent mistake": Recording(
        mount=None,
        extra=static(("laser", "odom", [0, 0, 0.15], NONE), ("odom", "base_link", [0, 0], NONE)),
        note="no transform gives the motion",
    ),
    "map → base_link by a SLAM": Recording(
        extra=moving("map", "base_link"),
        note="the transform map → base_link is a correction, not odometry",
    ),
    "a lidar on a servo": Recording(
        mount=None,
        extra=both(moving("base_link", "servo"), static(("servo", "laser", *MOUNTED))),
        note="no topic of nav_msgs/Odometry",
    ),
    "odom → base_link of two nodes that disagree": Recording(
        extra=moving(
            "odom", "base_link", lambda t: [t - BEGIN, 0.3 * (round(10 * t) % 2)], lambda t: NONE
        ),
        note="odometry odom → base_link is not used: its poses jump back and forth",
    ),
    "odometry whose quaternions are all 0": Recording(
        odometry="topic",
        on_odometry=put(turn=[0, 0, 0, 0]),
        note="161 messages have quaternions of norm 0 in pose.pose.orientation; correct the driver",
    ),
    "odometry with the yaw for a quaternion's z": Recording(
        odometry="topic",
        on_odometry=put(turn=lambda k, m: [0, 0, m["pose"][2] + 2, 1]),
        note="161 messages have quaternions whose norm is not 1",
    ),
    "odometry that never changes": Recording(
        odometry="topic",
        on_odometry=put(pose=np.array([1.0, 2.0, 0.5])),
        note="odometry /odom is not used: its pose never changes",
    ),
    "odometry that is not a number": Recording(
        odometry="topic",
        on_odometry=put(pose=np.array([np.nan, np.nan, 0])),
        note="161 messages have poses that are not finite or beyond 1e8 m in pose.pose.position",
    ),
}


@pytest.mark.parametrize("name", WITHOUT_ODOMETRY)
def test_without_odometry_there_is_none_and_that_is_reported(tmp_path, name):
    recording = with_kind(WITHOUT_ODOMETRY, name)
    if recording.odometry == "topic" and "odometry" not in name:
        recording.odometry = None
    source = sources.open(recording.write(tmp_path))
    assert not source.has_odometry and len(source) == COUNT
    assert all(reading.odometry is None for reading in source)
    assert errors_by_truth(source).max() < 1e-5
    assert recording.note in " ".join(source.notes)


def of(note, **changes):
    return Recording(on_scan=put(**changes), note=note)


# what is refused
REFUSED = {
    "angle_increment 0": of(
        angle_increment=0.0, note="/scan .* angle_increment is 0 with 240 ranges"
    ),
    "angles not a number": of(angle_min=np.nan, note="/scan .* angle_min, .* are nan"),
    "an angle_increment of the wrong sign": Recording(
        angles=lambda k: WIDE,
        on_scan=put(angle_increment=-0.025),
        note=r"angle_max, 2, is not angle_min .* = -2 \+ -0.025 × 160 = -6; correct it",
    ),
    "degrees": of(
        angle_min=-180.0,
        angle_max=178.5,
        angle_increment=1.5,
        note="more than 2π rad; if they are in degrees",
    ),
    "millimetres": of(
        ranges=lambda k, m: 1000 * m["ranges"],
        range_max=12000.0,
        note=r"ranges has a median of [0-9.]+ \(range_max 12000\); if they are in millimetres",
    ),
    "range_min above range_max": of(
        range_min=12.0, range_max=0.15, note="range_min, 12, is not below"
    ),
    "no beam with a return": of(
        ranges=lambda k, m: np.full(240, np.inf),
        note="no range of the 30 scans of /scan is between range_min and range_max",
    ),
    "no scan has a beam": of(ranges=[], note="ranges is empty; check whether the lidar turns"),
    "a lidar that looks at the floor": Recording(
        mount_turn=rotation(0, 0.6), note="laser is tilted, .* Correct the transforms to this frame"
    ),
    "odometry of a camera's optics": Recording(
        on_odometry=put(pose=np.zeros(3), z=lambda k, m: 0.1 * k, turn=NONE),
        note=r"odometry \(/odom\) moves 14.4 m along z and 0 m in the plane",
    ),
    "odometry of another day": Recording(
        on_odometry=lambda k, m: m.update(stamp=m["stamp"] - 90, received=m["stamp"] - 90),
        note=r"scans \(100.000 to 102.900 s\) and the odometry .* do not overlap .*Record both",
    ),
    "two lidars on one topic without odometry": Recording(
        odometry=None,
        on_scan=from_the_side,
        note=r"/scan has scans of several frames \(laser, side\) without odometry",
    ),
    "a point cloud": Recording(
        count=0,
        extra=lambda bag: other(bag, "/points", "PointCloud2"),
        note="no sensor_msgs/LaserScan message; its topics: .*/points has the type "
        "sensor_msgs/PointCloud2, not sensor_msgs/LaserScan: the package pointcloud_to_laserscan",
    ),
    "a sonar": Recording(
        count=0,
        extra=lambda bag: other(bag, "/sonar", "Range"),
        note="/sonar has the type sensor_msgs/Range, .*: it has a single beam",
    ),
    "odometry alone": Recording(count=0, note="contains no scan: .*its topics: /odom"),
    "a topic of scans without a message": Recording(
        count=0,
        extra=lambda bag: bag.topic("/scan", SCAN),
        note="its topic /scan has no message. Check whether .* quality of service",
    ),
}


def other(bag, topic, kind):
    """Write a message of a sensor that is no lidar of the plane."""
    fields = dict(radiation_type=0, field_of_view=0.3, min_range=0.0, max_range=3.0, range=1.0)
    if kind == "PointCloud2":
        fields = dict(
            height=1, width=0, fields=[], is_bigendian=False, point_step=1, row_step=0,
            data=np.empty(0, np.uint8), is_dense=True,
        )  # fmt: skip
    kind = f"sensor_msgs/msg/{kind}"
    bag.write(topic, kind, bag.make(kind, header=bag.header(BEGIN, "top"), **fields), BEGIN)


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_read_is_refused_with_topic_field_and_remedy(tmp_path, name):
    recording = with_kind(REFUSED, name)
    path = recording.write(tmp_path)
    with pytest.raises(SourceError, match=recording.note) as refused:
        sources.open(path)
    assert str(refused.value).startswith(str(path))
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 500


@pytest.mark.parametrize("name", ["angle_increment 0", "millimetres", "no scan has a beam"])
def test_a_bad_scan_costs_that_scan_alone(tmp_path, name):
    change = REFUSED[name].on_scan
    recording = Recording(on_scan=lambda k, m: change(k, m) if k in (3, 11, 12) else None)
    source = sources.open(recording.write(tmp_path))
    assert len(source) == COUNT - 3 and source.skipped == 3
    assert sum(source.damage.values()) == 3
    assert map_errors(source).max() < 0.02


def test_a_topic_that_is_named_must_be_there_and_be_of_scans_or_odometry(tmp_path):
    path = Recording(extra=lambda bag: other(bag, "/points", "PointCloud2")).write(tmp_path)
    with pytest.raises(
        SourceError, match="topic /points has the type sensor_msgs/PointCloud2, not"
    ):
        sources.open(f"{path}#/points")
    for topics in ("/scan", "scan", "/scan,/odom,/tf_static"):
        assert map_errors(sources.open(f"{path}#{topics}")).max() < 0.02


def test_scans_that_are_partly_outside_and_partly_tilted_are_refused_too(tmp_path):
    recording = Recording(
        on_odometry=lambda k, m: m.update(turn=rotation(0, 1.0)) or bool(m["stamp"] < BEGIN + 1.5)
    )
    with pytest.raises(SourceError, match="laser is tilted"):
        sources.open(recording.write(tmp_path))
