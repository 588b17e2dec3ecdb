"""ROS bags after the kinds of faults that are reported in public: read rightly by odometry."""

import numpy as np
import pytest

from slamlab import sources
from slamlab.geometry import compose

pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")

from tests.slamlab.formats.bag_writing import MOUNT, rotation
from tests.slamlab.formats.recorded_robot import (
    BEGIN,
    COUNT,
    FULL,
    PERIOD,
    Recording,
    map_errors,
    pose,
    ranges_from,
)
from tests.slamlab.formats.ros_bag_faults import (
    MOUNTED,
    NONE,
    SIDE,
    UPSIDE_DOWN,
    WIDE,
    both,
    from_the_side,
    moving,
    put,
    static,
    with_kind,
)

LARGEST = float(np.finfo(np.float32).max)


def later(seconds):
    """Put timestamps later, but not the times of reception."""
    return put(stamp=lambda k, message: message["stamp"] + seconds)


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


OTHER_WAY = rotation(MOUNT[2] + np.pi)
AT_ONCE = put(received=lambda k, m: m["stamp"] + 0.003)
RIGHT_ODOMETRY = moving("odom", "base_link", lambda t: pose(t)[:2], lambda t: rotation(pose(t)[2]))
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
