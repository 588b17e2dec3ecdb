"""Messages of ROS 1 and ROS 2 bags, read through the library ``rosbags``: scans, odometry, tf.

Of each message only the numbers are kept that a planar SLAM needs. The types are those of the
standard, so that a bag with messages of its own kinds can be read too.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.files.text_files import reason

# first bytes of a ROS 1 bag, a ROS 2 bag (SQLite, MCAP)
MAGIC_BYTES = (b"#ROSBAG V", b"SQLite format 3\0", b"\x89MCAP0\r\n")
# message types of ROS
SCAN, ODOMETRY = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry"
TF, OLD_TF = "tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"
TF_FIELDS = "geometry_msgs/TransformStamped[] transforms"  # definition of a tf message
NAMES = {SCAN: "sensor_msgs/LaserScan", ODOMETRY: "nav_msgs/Odometry"}  # for error messages


@dataclass
class Messages:
    """Messages of a ROS bag: laser scans, odometry, tf transforms.

    Parameters
    ----------
    scans : list of (stamp [s], LaserScan)
    odometry : list of (stamp [s], frame, child frame, position (3,) [m], quaternion xyzw (4,))
    transforms : list of (stamp [s], frame, child frame, position, quaternion)
    damage : list of str, the kind of each message that could not be read; ``torn`` where the bag
        broke off
    """

    scans: list = field(default_factory=list)
    odometry: list = field(default_factory=list)
    transforms: list = field(default_factory=list)
    damage: list = field(default_factory=list)
    torn: bool = False


def is_bag(path):
    """Recognise a ROS bag: a ROS 1 file, a ROS 2 folder, or one of the files in such a folder.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    bool
    """
    path = Path(path)
    try:
        if path.is_dir():
            return (path / "metadata.yaml").is_file()
        with path.open("rb") as file:
            return file.read(32).startswith(MAGIC_BYTES)
    except (OSError, ValueError):
        return False  # whoever reads it as a log will say why


def read(path, topics=()):
    """Read a bag: scans of one topic, odometry of one topic if there is any, all tf transforms.

    Parameters
    ----------
    path : str or Path
    topics : names of topics to take where there are several

    Returns
    -------
    Messages

    Raises
    ------
    SourceError : ``rosbags`` is not installed; the bag cannot be read, holds no scans, or does not
        say which
    """
    try:
        from rosbags import rosbag1, rosbag2
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    except ImportError:
        raise SourceError(
            f"{path} is a ROS bag, and reading it needs rosbags: pip install 'slamlab[ros]'"
        ) from None
    path = Path(path)
    first = path.is_file() and path.open("rb").read(9) == MAGIC_BYTES[0]
    store = get_typestore(Stores.ROS1_NOETIC if first else Stores.LATEST)
    if first:  # whose store lacks this type
        store.register(get_types_from_msg(TF_FIELDS, TF))
    deserialise = store.deserialize_ros1 if first else store.deserialize_cdr
    messages = Messages()
    try:
        with (rosbag1 if first else rosbag2).Reader(path) as reader:
            chosen = _choose_connections(reader.connections, topics, path)
            for connection, stamp, data in reader.messages(chosen):
                _add_message(messages, connection.msgtype, stamp, data, deserialise)
    except SourceError:
        raise
    except Exception as error:  # a damaged bag makes the library raise whatever it stumbles over
        if not messages.scans:
            raise SourceError(
                f"{path} cannot be read as a ROS bag, it may be cut short: {_error_line(error)}"
            ) from None
        messages.torn = True
    if not messages.scans:
        raise SourceError(f"{path} is damaged: none of its scans can be read")
    return messages


def _choose_connections(connections, topics, path):
    """Choose the connections to read: one topic of scans, at most one of odometry, tf."""
    there = {each.topic for each in connections}
    unknown = [topic for topic in topics if topic not in there]
    if unknown:
        raise SourceError(f"{path} has no topic {unknown[0]}; there are: {_joined(there)}")
    wanted = [each for each in connections if each.msgtype in (TF, OLD_TF)]
    for kind in (SCAN, ODOMETRY):
        of_kind = [each for each in connections if each.msgtype == kind and each.msgcount]
        names = {each.topic for each in of_kind}
        if len(names) > 1:
            names &= set(topics)
        if len(names) > 1 or (of_kind and not names):
            several = _joined({each.topic for each in of_kind})
            raise SourceError(
                f"{path} has {NAMES[kind]} on several topics: {several}; say which, as in "
                f"{path}#{of_kind[0].topic}"
            )
        if kind is SCAN and not names:
            raise SourceError(
                f"{path} holds no scan: no {NAMES[SCAN]} message; its topics: {_joined(there)}"
            )
        wanted += [each for each in of_kind if each.topic in names]
    return wanted


def _add_message(messages, kind, received, data, deserialise):
    """Deserialise and add one message; one that cannot be read is counted as damage."""
    try:
        message = deserialise(data, TF if kind == OLD_TF else kind)
        if kind == SCAN:
            messages.scans.append((_stamp(message.header, received), message))
        elif kind == ODOMETRY:
            frame, child = message.header.frame_id, message.child_frame_id
            pose = message.pose.pose
            where = pose.position, pose.orientation
            row = _transform_row(_stamp(message.header, received), frame, child, *where)
            messages.odometry.append(row)
        else:
            messages.transforms += [
                _transform_row(
                    _stamp(each.header, received),
                    each.header.frame_id,
                    each.child_frame_id,
                    each.transform.translation,
                    each.transform.rotation,
                )
                for each in message.transforms
            ]
    except Exception:  # as above
        messages.damage.append("messages that cannot be read")


def _transform_row(stamp, frame, child, t, q):
    place, turn = np.array([t.x, t.y, t.z]), np.array([q.x, q.y, q.z, q.w])
    if not (np.isfinite(place).all() and np.isfinite(turn).all() and turn.any()):
        raise ValueError
    # ROS 1 wrote frames with a slash, ROS 2 does not
    return stamp, frame.strip("/"), child.strip("/"), place, turn


def _stamp(header, received):
    """Time stamp of the measurement; where it is 0, of its reception [s]."""
    stamp = header.stamp.sec + header.stamp.nanosec * 1e-9
    return stamp if stamp else received * 1e-9


def _joined(names):
    return ", ".join(sorted(names)) or "none"


def _error_line(error):
    """Error message of the library, in one line."""
    return " ".join(reason(error).split()) or type(error).__name__
