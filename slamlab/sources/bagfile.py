"""Messages of ROS 1 and ROS 2 bags, read through the library ``rosbags``: scans, odometry, tf.

Of each message only the numbers are kept that a planar SLAM needs. The types are those of the
standard, so that a bag with messages of its own kinds can be read too.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from slamlab.sources.base import SourceError
from slamlab.sources.text import reason

MAGIC = (b"#ROSBAG V", b"SQLite format 3\0", b"\x89MCAP0\r\n")
SCAN, ODOMETRY = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry"
TF, OLD_TF = "tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"
TF_FIELDS = "geometry_msgs/TransformStamped[] transforms"
NAMES = {SCAN: "sensor_msgs/LaserScan", ODOMETRY: "nav_msgs/Odometry"}


@dataclass
class Messages:
    """What a bag holds.

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
    """Whether a path is a bag: a ROS 1 file, a ROS 2 folder, or one of the files in such a folder.

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
            return file.read(32).startswith(MAGIC)
    except (OSError, ValueError):
        return False  # whoever reads it as a log will say why


def read(path, topics=()):
    """The scans of one topic, the odometry of one topic if there is any, and all transforms.

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
    first = path.is_file() and path.open("rb").read(9) == MAGIC[0]
    store = get_typestore(Stores.ROS1_NOETIC if first else Stores.LATEST)
    if first:  # whose store lacks this type
        store.register(get_types_from_msg(TF_FIELDS, TF))
    deserialise = store.deserialize_ros1 if first else store.deserialize_cdr
    messages = Messages()
    try:
        with (rosbag1 if first else rosbag2).Reader(path) as reader:
            chosen = _chosen(reader.connections, topics, path)
            for connection, stamp, data in reader.messages(chosen):
                _take(messages, connection.msgtype, stamp, data, deserialise)
    except SourceError:
        raise
    except Exception as error:  # a damaged bag makes the library raise whatever it stumbles over
        if not messages.scans:
            raise SourceError(
                f"{path} cannot be read as a ROS bag, it may be cut short: {_said(error)}"
            ) from None
        messages.torn = True
    if not messages.scans:
        raise SourceError(f"{path} is damaged: none of its scans can be read")
    return messages


def _chosen(connections, topics, path):
    """The connections to read: one topic of scans, at most one of odometry, tf."""
    there = {each.topic for each in connections}
    unknown = [topic for topic in topics if topic not in there]
    if unknown:
        raise SourceError(f"{path} has no topic {unknown[0]}; there are: {_listed(there)}")
    wanted = [each for each in connections if each.msgtype in (TF, OLD_TF)]
    for kind in (SCAN, ODOMETRY):
        of_kind = [each for each in connections if each.msgtype == kind and each.msgcount]
        names = {each.topic for each in of_kind}
        if len(names) > 1:
            names &= set(topics)
        if len(names) > 1 or (of_kind and not names):
            several = _listed({each.topic for each in of_kind})
            raise SourceError(
                f"{path} has {NAMES[kind]} on several topics: {several}; say which, as in "
                f"{path}#{of_kind[0].topic}"
            )
        if kind is SCAN and not names:
            raise SourceError(
                f"{path} holds no scan: no {NAMES[SCAN]} message; its topics: {_listed(there)}"
            )
        wanted += [each for each in of_kind if each.topic in names]
    return wanted


def _take(messages, kind, received, data, deserialise):
    """Keep one message; one that cannot be read is counted."""
    try:
        message = deserialise(data, TF if kind == OLD_TF else kind)
        if kind == SCAN:
            messages.scans.append((_stamp(message.header, received), message))
        elif kind == ODOMETRY:
            frame, child = message.header.frame_id, message.child_frame_id
            pose = message.pose.pose
            where = pose.position, pose.orientation
            row = _row(_stamp(message.header, received), frame, child, *where)
            messages.odometry.append(row)
        else:
            messages.transforms += [
                _row(
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


def _row(stamp, frame, child, t, q):
    place, turn = np.array([t.x, t.y, t.z]), np.array([q.x, q.y, q.z, q.w])
    if not (np.isfinite(place).all() and np.isfinite(turn).all() and turn.any()):
        raise ValueError
    # ROS 1 wrote frames with a slash, ROS 2 does not
    return stamp, frame.strip("/"), child.strip("/"), place, turn


def _stamp(header, received):
    """When it was measured; where nobody said so, when it was received [s]."""
    stamp = header.stamp.sec + header.stamp.nanosec * 1e-9
    return stamp if stamp else received * 1e-9


def _listed(names):
    return ", ".join(sorted(names)) or "none"


def _said(error):
    """What a library's error says, in one line."""
    return " ".join(reason(error).split()) or type(error).__name__
