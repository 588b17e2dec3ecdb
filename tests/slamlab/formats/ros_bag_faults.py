"""Changes of a recorded ROS bag, as other recorders and drivers make them."""

import numpy as np
import pytest

from slamlab.geometry import compose

pytest.importorskip("rosbags", reason="rosbags, the extra 'ros', is not installed")

from tests.slamlab.formats.bag_writing import KINDS, MOUNT, rotation
from tests.slamlab.formats.recorded_robot import BEGIN, FULL, pose, ranges_from

WIDE = np.linspace(-2.0, 2.0, 161)  # beams of a lidar that does not see all around [rad]
NONE = rotation()


def put(**changes):
    """An ``on_scan`` or ``on_odometry`` that sets arguments; functions of (k, message) are
    called."""

    def change(k, message):
        new = {name: v(k, message) if callable(v) else v for name, v in changes.items()}
        message.update(new)

    return change


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


def from_the_side(k, message):
    """Every second scan is of a second lidar, which looks elsewhere."""
    if k % 2:
        laser = compose(pose(message["stamp"]), SIDE)
        message |= {"frame": "side", "ranges": ranges_from(laser, FULL)}


SIDE = np.array([-0.3, 0.2, -2.0])  # of the second lidar on the robot [m, m, rad]
UPSIDE_DOWN = rotation(MOUNT[2], roll=np.pi)
MOUNTED = MOUNT[:2], rotation(MOUNT[2])  # place and quaternion of the laser
