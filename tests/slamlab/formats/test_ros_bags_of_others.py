"""ROS bags after the kinds of faults that are reported in public: read rightly, or refused."""

import numpy as np
import pytest

from slamlab import sources
from slamlab.geometry import compose
from slamlab.sources import SourceError

pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from tests.slamlab.formats.bag_writing import KINDS, MOUNT, SCAN, Bag, rotation
from tests.slamlab.formats.recorded_robot import (
    BEGIN,
    COUNT,
    FULL,
    PERIOD,
    ROOM,
    Recording,
    errors_by_truth,
    map_errors,
    pose,
    ranges_from,
)
from tests.slamlab.formats.room_runs import distances_to_walls

WIDE = np.linspace(-2.0, 2.0, 161)  # beams of a lidar that does not see all around [rad]
NONE = rotation()
LARGEST = float(np.finfo(np.float32).max)


def put(**changes):
    """An ``on_scan`` or ``on_odometry`` that sets arguments; functions of (k, message) are
    called."""

    def change(k, message):
        new = {name: v(k, message) if callable(v) else v for name, v in changes.items()}
        message.update(new)

    return change


def later(seconds):
    """Put timestamps later, but not the times of reception."""
    return put(stamp=lambda k, message: message["stamp"] + seconds)


def static(*transforms, topic="/tf_static", stamp=BEGIN):
    """An ``extra`` that writes transforms: parent, child, place, quaternion."""

    def write(bag):
        for parent, child, place, turn in transforms:
            bag.transform(stamp, parent, child, place, turn, topic=topic)

    return write


def moving(parent, child, place=lambda t: [t, -t], turn=lambda t: rotation(t), topic="/tf"):
    """An ``extra`` that writes a transform that moves, every 0.1 s."""

    def write(bag):
        for t in np.arange(BEGIN - 0.1, BEGIN + 3.1, 0.1):
            bag.transform(t, parent, child, place(t), turn(t), topic=topic)

    return write


def both(*functions):
    def call(*arguments):
        for function in functions:
            function(*arguments)

    return call


def with_kind(recordings, name):
    """The recording of this name; the kinds of bags take turns."""
    recording = recordings[name]
    recording.kind = KINDS[list(recordings).index(name) % 3]
    return recording


def no_returns(k, message):
    """In every scan another few beams have no return, written in all ways."""
    ranges = np.array(message["ranges"])
    for i, code in enumerate((np.inf, np.nan, -np.inf, 0, -1, 20.0, 25.0, LARGEST, 0.05)):
        ranges[(7 * k + 11 * i) % len(ranges)] = code
    message["ranges"] = ranges


def clockwise(k):
    return FULL[::-1]


def of_other_lengths(k):
    return np.linspace(-np.pi, np.pi, 180 + 3 * (k * 7 % 20), endpoint=False)


def from_the_side(k, message):
    """Every second scan is of a second lidar, which looks elsewhere."""
    if k % 2:
        laser = compose(pose(message["stamp"]), SIDE)
        message |= {"frame": "side", "ranges": ranges_from(laser, FULL)}


SIDE = np.array([-0.3, 0.2, -2.0])  # of the second lidar on the robot [m, m, rad]
UPSIDE_DOWN = rotation(MOUNT[2], roll=np.pi)
OTHER_WAY = rotation(MOUNT[2] + np.pi)
AT_ONCE = put(received=lambda k, m: m["stamp"] + 0.003)
RIGHT_ODOMETRY = moving("odom", "base_link", lambda t: pose(t)[:2], lambda t: rotation(pose(t)[2]))
MOUNTED = MOUNT[:2], rotation(MOUNT[2])  # place and quaternion of the laser

# what is read rightly by odometry
RIGHT = {
    "negative increments": Recording(angles=clockwise),
    "a field of view of 230 degrees": Recording(angles=lambda k: WIDE),
    "another number of beams in each scan": Recording(angles=of_other_lengths),
    "angle_max one beam too far": Recording(on_scan=put(angle_max=np.pi)),
    "angle_max one beam short": Recording(on_scan=put(angle_max=FULL[-2])),
    "a count cut to a whole number, as of velodyne_laserscan": Recording(
        angles=lambda k: -np.pi + 0.007 * np.arange(897), on_scan=put(angle_max=np.pi)
    ),
    "a first message without beams": Recording(
        on_scan=lambda k, m: m.update(ranges=[] if k == 0 else m["ranges"]),
        damage={"scans without beams": 1},
    ),
    "no returns in all ways": Recording(on_scan=no_returns),
    "range_max 0": Recording(on_scan=put(range_max=0.0, range_min=0.0)),
    "a lidar upside down": Recording(
        mount_turn=UPSIDE_DOWN,
        angles=lambda k: FULL,
        on_scan=put(ranges=lambda k, m: ranges_from(compose(pose(m["stamp"]), MOUNT), -FULL)),
    ),
    "a frame upside down, and the lidar in it again": Recording(
        mount=None,
        extra=static(
            ("base_link", "plate", [0.2, -0.1], UPSIDE_DOWN),
            ("plate", "laser", [0, 0], rotation(roll=np.pi)),
        ),
    ),
    "quaternions a little too short": Recording(
        mount_turn=0.998 * rotation(MOUNT[2]),
        on_odometry=put(turn=lambda k, m: 1.003 * rotation(m["pose"][2])),
    ),
    "some messages of odometry are not finite": Recording(
        on_odometry=lambda k, m: m.update(turn=[np.nan] * 4) if k % 9 == 4 else None,
        damage={"odometry with poses that are not finite or beyond 1e8 m": 18},
    ),
    "the odometry's orientation is never set, but tf is right": Recording(
        on_odometry=put(turn=[0, 0, 0, 0]),
        extra=RIGHT_ODOMETRY,
        damage={"odometry with quaternions of norm 0": 161},
        note="odometry /odom is not used: 161 messages have quaternions of norm 0 in pose.pose",
    ),
    "slashes before the frames": Recording(
        mount=None, extra=static(("/base_link", "/laser", *MOUNTED)), on_scan=put(frame="/laser")
    ),
    "no child frame of odometry": Recording(on_odometry=put(child="")),
    "odometry's frame for its child frame": Recording(on_odometry=put(child="odom")),
    "odometry of a frame beside the lidar's": Recording(
        on_odometry=put(child="base_footprint"),
        extra=static(("base_link", "base_footprint", [0, 0, -0.1], NONE)),
    ),
    "odometry's child frame is unknown to tf, which has odometry as well": Recording(
        on_odometry=put(child="base"),
        extra=RIGHT_ODOMETRY,
        note="odometry /odom is not used: no transform leads from base to laser",
    ),
    "odometry of base_footprint, and a lidar on a base_link that nothing leads to": Recording(
        odometry="tf",
        on_odometry=put(child="base_footprint"),
        damage={"no transform to the laser, which is assumed at the robot's centre": 1},
        note="no transform leads from base_footprint to laser",
    ),
    "static transforms that come after the scans": Recording(
        mount=None, extra=lambda bag: bag.mount(BEGIN + 60)
    ),
    "the mount again and again on /tf": Recording(
        mount=None,
        extra=moving("base_link", "laser", lambda t: MOUNT[:2], lambda t: rotation(MOUNT[2])),
    ),
    "two static mounts, the last of which is right": Recording(
        mount=None,
        extra=static(("base_link", "laser", [0.3, 0], OTHER_WAY), ("base_link", "laser", *MOUNTED)),
        note="base_link → laser has several static transforms; the last is used",
    ),
    "another odometry on tf, whose topic is preferred": Recording(
        extra=moving("odom", "base_link")
    ),
    "two parents of the robot": Recording(
        odometry="tf",
        extra=moving("map", "base_link"),
        note="base_link has the parents map and odom; odom is used",
    ),
    "a transform of a frame to itself": Recording(
        odometry="tf", extra=moving("base_link", "base_link")
    ),
    "a broken transform of another sensor": Recording(
        extra=static(("base_link", "camera", [np.nan, 0], [0, 0, 0, 0]))
    ),
    "frames of odometry in a namespace": Recording(
        odometry="tf",
        mount=None,
        on_odometry=put(parent="robot1/odom", child="robot1/base_link"),
        on_scan=put(frame="robot1/laser"),
        extra=static(("robot1/base_link", "robot1/laser", *MOUNTED)),
    ),
    "two robots, each with topics in its namespace": Recording(
        mount="/robot1/tf_static",
        on_odometry=put(topic="/robot1/odom"),
        on_scan=put(topic="/robot1/scan"),
        extra=both(
            static(("base_link", "laser", [0, 0], OTHER_WAY), topic="/robot2/tf_static"),
            lambda bag: [bag.odometry(BEGIN + k, [k, 0, 0], "/robot2/odom") for k in range(4)],
        ),
    ),
    "two lidars on one topic": Recording(
        on_scan=from_the_side, extra=static(("base_link", "side", SIDE[:2], rotation(SIDE[2])))
    ),
    "several echoes of each beam": Recording(on_scan=put(several=True)),
    "scans without timestamps": Recording(
        on_scan=put(stamp=0.0, received=lambda k, m: m["stamp"]),
        note="the timestamp is 0 in 30 scans",
    ),
    "a clock of the lidar's computer that is behind by 3 s": Recording(
        on_scan=later(-3.0),
        on_odometry=AT_ONCE,
        note="of the scans and of /odom differ: the scans are 3 s behind",
    ),
    "scans by the time since the computer's start, tf by the date": Recording(
        odometry="tf",
        on_odometry=both(AT_ONCE, later(1.7e9)),
        note="of the scans and of odom → base_link differ: the scans are 1.7e+09 s behind",
    ),
    "scans by a simulation's clock, at half the speed, odometry by the date": Recording(
        on_scan=put(stamp=lambda k, m: 5 + 0.5 * (m["stamp"] - BEGIN)),
        on_odometry=AT_ONCE,
        note="are from clocks that drift apart, so the times of reception are used",
    ),
    "one scan with a wild timestamp": Recording(
        on_scan=lambda k, m: m.update(stamp=m["stamp"] + 1e6 * (k == 7)),
        damage={"scans outside the odometry's time": 1},
    ),
    "a message of odometry with a wild timestamp, and some late ones": Recording(
        on_odometry=lambda k, m: m.update(
            stamp=m["stamp"] + 1e5 * (k == 61), received=m["received"] + 2 * (k in (5, 25, 45))
        )
    ),
    "a driver that never renews its timestamp": Recording(
        on_scan=put(stamp=BEGIN), on_odometry=AT_ONCE, note="stop or are set back"
    ),
    "a simulation that is reset": Recording(
        on_scan=lambda k, m: m.update(stamp=m["stamp"] - 50 * (k > 14)),
        on_odometry=lambda k, m: m.update(
            received=m["stamp"] + 0.003, stamp=m["stamp"] - 50 * (m["stamp"] > BEGIN + 1.45)
        ),
        damage={"timestamps that run backwards": 1},
        note="stop or are set back",
    ),
    "a clock that is set when the network comes": Recording(
        on_scan=lambda k, m: m.update(stamp=m["stamp"] + 1e6 * (k > 14)),
        on_odometry=lambda k, m: m.update(
            received=m["stamp"] + 0.003, stamp=m["stamp"] + 1e6 * (m["stamp"] > BEGIN + 1.45)
        ),
    ),
    "odometry with a gap": Recording(
        on_odometry=lambda k, m: not BEGIN + 0.76 < m["stamp"] < BEGIN + 1.98,
        damage={"scans outside the odometry's time": 12},
    ),
    "a robot that tips over for a while": Recording(
        on_odometry=put(
            turn=lambda k, m: rotation(m["pose"][2], 0.6 * (BEGIN + 1 < m["stamp"] < BEGIN + 2))
        ),
        damage={"scans of a tilted robot": 9},
    ),
    "time_increment is a twentieth, as of an LDS-01": Recording(
        on_scan=put(time_increment=2.99e-5, scan_time=0.0),
        note="time_increment contradicts scan_time in 30 scans",
    ),
    "time_increment in milliseconds": Recording(
        on_scan=put(time_increment=0.4, scan_time=100.0),
        note="time_increment exceeds the period of the scans in 30 scans",
    ),
}


@pytest.mark.parametrize("name", RIGHT)
def test_bags_of_other_recorders_are_read_correctly(tmp_path, name):
    recording = with_kind(RIGHT, name)
    source = sources.open(recording.write(tmp_path))
    begin = compose(pose(BEGIN + PERIOD * ("first message" in name)), MOUNT)
    assert map_errors(source, begin).max() < 0.02
    assert source.has_odometry
    assert source.damage == recording.damage
    lost = sum(n for what, n in recording.damage.items() if what.startswith("scans"))
    assert source.skipped == lost
    assert len(source) == len(list(source)) == COUNT - lost
    assert bool(source.notes) == bool(recording.note)
    assert recording.note in " ".join(source.notes)


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


def test_a_topic_that_is_named_must_be_there_and_be_of_scans_or_odometry(tmp_path):
    path = Recording(extra=lambda bag: other(bag, "/points", "PointCloud2")).write(tmp_path)
    with pytest.raises(
        SourceError, match="topic /points has the type sensor_msgs/PointCloud2, not"
    ):
        sources.open(f"{path}#/points")
    for topics in ("/scan", "scan", "/scan,/odom,/tf_static"):
        assert map_errors(sources.open(f"{path}#{topics}")).max() < 0.02


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


def test_scans_that_are_partly_outside_and_partly_tilted_are_refused_too(tmp_path):
    recording = Recording(
        on_odometry=lambda k, m: m.update(turn=rotation(0, 1.0)) or bool(m["stamp"] < BEGIN + 1.5)
    )
    with pytest.raises(SourceError, match="laser is tilted"):
        sources.open(recording.write(tmp_path))
