"""Small ROS bags, written with rosbags as a robot would write them, of both versions."""

from functools import cache

import numpy as np
from rosbags import rosbag1, rosbag2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from scipy.spatial.transform import Rotation

MOUNT = np.array([0.2, -0.1, 0.3])  # of the laser on the robot [m, m, rad]
KINDS = ("ros1", "sqlite3", "mcap")
SCAN, ODOMETRY, TF = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"
MULTI_ECHO, ECHO = "sensor_msgs/msg/MultiEchoLaserScan", "sensor_msgs/msg/LaserEcho"


def rotation(yaw=0.0, pitch=0.0, roll=0.0):
    return Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_quat()


@cache  # the encoders of a store are compiled once
def type_store(first):
    """The message types of ROS 1, if ``first``, or of ROS 2."""
    store = get_typestore(Stores.ROS1_NOETIC if first else Stores.ROS2_HUMBLE)
    if first:
        fields = "geometry_msgs/TransformStamped[] transforms"
        store.register(get_types_from_msg(fields, TF))
    return store


class Bag:
    """A small bag to write messages into; ``compress`` is called with its writer."""

    def __init__(self, path, kind, compress=None):
        self.first = kind == "ros1"
        self.store = type_store(self.first)
        if self.first:
            self._writer = rosbag1.Writer(path)
        else:
            plugin = rosbag2.StoragePlugin[kind.upper()]
            self._writer = rosbag2.Writer(path, version=9, storage_plugin=plugin)
        if compress:
            compress(self._writer)
        self._topics = {}

    def __enter__(self):
        self._writer.open()
        return self

    def __exit__(self, *exc):
        self._writer.close()

    def make(self, kind, **fields):
        return self.store.types[kind](**fields)

    def geometry(self, kind, **fields):
        return self.make(f"geometry_msgs/msg/{kind}", **fields)

    def header(self, stamp, frame):
        nanoseconds = round((stamp % 1) * 1e9)
        time = self.make("builtin_interfaces/msg/Time", sec=int(stamp), nanosec=nanoseconds)
        extra = {"seq": 0} if self.first else {}
        return self.make("std_msgs/msg/Header", stamp=time, frame_id=frame, **extra)

    def numbers(self, kind, values):
        """A message of numbers x, y, z and, of a quaternion, w."""
        return self.geometry(kind, **dict(zip("xyzw", map(float, values), strict=False)))

    def topic(self, topic, kind, store=None):
        if topic not in self._topics:
            store = store or self.store
            self._topics[topic] = self._writer.add_connection(topic, kind, typestore=store)
        return self._topics[topic]

    def write(self, topic, kind, message, stamp, store=None):
        store = store or self.store
        serialise = store.serialize_ros1 if self.first else store.serialize_cdr
        data = serialise(message, kind)
        self._writer.write(self.topic(topic, kind, store), round(stamp * 1e9), data)

    def scan(
        self, stamp, ranges, topic="/scan", frame="laser", received=None, several=False, **fields
    ):
        ranges = np.asarray(ranges, dtype=np.float32)
        usual = dict(
            angle_min=-1.5,
            angle_max=1.5,
            angle_increment=3 / max(1, len(ranges) - 1),
            time_increment=0.0,
            scan_time=0.1,
            range_min=0.1,
            range_max=20.0,
            ranges=ranges,
            intensities=np.empty(0, np.float32),
        )
        kind = MULTI_ECHO if several else SCAN
        if several:
            echo = [np.array([r, r + 1], np.float32) for r in ranges]
            echo = [each if np.isfinite(each[0]) else each[:0] for each in echo]
            usual |= dict(ranges=[self.make(ECHO, echoes=each) for each in echo], intensities=[])
        message = self.make(kind, header=self.header(stamp, frame), **(usual | fields))
        self.write(topic, kind, message, stamp if received is None else received)

    def odometry(
        self,
        stamp,
        pose,
        topic="/odom",
        child="base_link",
        frame="odom",
        turn=None,
        received=None,
        z=0,
    ):
        covariance = np.zeros(36)
        zero = self.numbers("Vector3", np.zeros(3))
        twist = self.geometry("Twist", linear=zero, angular=zero)
        orientation = self.numbers("Quaternion", rotation(pose[2]) if turn is None else turn)
        position = self.numbers("Point", [*pose[:2], z])
        at = self.geometry("Pose", position=position, orientation=orientation)
        message = self.make(
            ODOMETRY,
            header=self.header(stamp, frame),
            child_frame_id=child,
            pose=self.geometry("PoseWithCovariance", pose=at, covariance=covariance),
            twist=self.geometry("TwistWithCovariance", twist=twist, covariance=covariance),
        )
        self.write(topic, ODOMETRY, message, stamp if received is None else received)

    def transform(self, stamp, parent, child, place, turn, topic="/tf", received=None):
        """A transform; ``turn`` is a quaternion."""
        translation = self.numbers("Vector3", [*place, 0.0][:3])
        transform = self.geometry(
            "Transform", translation=translation, rotation=self.numbers("Quaternion", turn)
        )
        header, kind = self.header(stamp, parent), "TransformStamped"
        stamped = self.geometry(kind, header=header, child_frame_id=child, transform=transform)
        message = self.make(TF, transforms=[stamped])
        self.write(topic, TF, message, stamp if received is None else received)

    def mount(self, stamp=100.0, parent="base_link", child="laser", topic="/tf_static", turn=None):
        turn = rotation(MOUNT[2]) if turn is None else turn
        self.transform(stamp, parent, child, MOUNT[:2], turn, topic=topic)
