"""Scans, odometry and transforms (tf) of a ROS bag, read message by message in bounded memory."""

import math
import sys
from array import array
from collections import Counter, defaultdict
from dataclasses import dataclass, field

from slamlab.files import SourceError
from slamlab.sources.disk_buffer import DiskBuffer
from slamlab.sources.ros_bag_reader import BagFiles
from slamlab.sources.ros_scans import ScanReader
from slamlab.sources.ros_topics import ODOMETRY, SCANS, choose

MAX_NORM_ERROR = 0.01  # of a quaternion's squared norm, as in tf2 [1]
MAX_POSITION = 1e8  # of a plausible coordinate [m]
NOT_FINITE = "poses that are not finite or beyond 1e8 m"


@dataclass
class Messages:
    """Messages of a ROS bag; ``damage`` counts unusable data by kind.

    ``scans`` is a DiskBuffer of RosScan, with ``stamps``, ``received``, ``durations`` [s] and
    ``frames`` (n,). ``odometry`` and ``moving`` (transforms) are {(frame, child frame): (k, 9)},
    rows as in ROW; ``fixed``: {(frame, child frame): row} of static transforms; ``changed``: static
    transforms with several values; ``unusable``: Counters of faults by child frame, None: odometry.
    """

    topic: str
    odometry_topic: str | None
    scans: DiskBuffer = field(default_factory=DiskBuffer)
    stamps: array = field(default_factory=lambda: array("d"))
    received: array = field(default_factory=lambda: array("d"))
    durations: array = field(default_factory=lambda: array("d"))
    frames: list = field(default_factory=list)
    odometry: dict = field(default_factory=dict)
    moving: dict = field(default_factory=dict)
    fixed: dict = field(default_factory=dict)
    changed: set = field(default_factory=set)
    unusable: dict = field(default_factory=lambda: defaultdict(Counter))
    unstamped: int = 0  # scans
    notes: list = field(default_factory=list)
    damage: Counter = field(default_factory=Counter)
    skipped: int = 0  # scans

    def add_scan(self, scan, frame, stamp, received):
        if scan is None:
            self.skipped += 1
            return
        self.scans.append(scan)
        self.stamps.append(stamp or received)
        self.received.append(received)
        self.durations.append(scan.duration)
        self.frames.append(sys.intern(frame))
        self.unstamped += not stamp

    def add_pose(self, topic, frame, child, row):
        """Add a row of a transform (tf), or of odometry if ``topic`` is None."""
        key, fault = (frame, child), _fault(row)
        if fault:
            self.unusable[topic and child][fault] += 1
        elif topic and topic.endswith("tf_static"):
            if key in self.fixed and self.fixed[key][2:] != row[2:]:
                self.changed.add(key)
            self.fixed[key] = row
        else:
            rows = self.moving if topic else self.odometry
            rows.setdefault(key, array("d")).extend(row)


def read(path, topics=()):
    """Read the scans of one topic, the odometry of at most one topic, and all transforms (tf).

    ``topics`` are those that the user chose among several. Raises SourceError, ExtraMissing.
    """
    read_scan = ScanReader()
    with BagFiles(path) as files:
        topic, odometry, wanted = choose(path, files.counts, topics)
        messages = Messages(topic, odometry)
        for name, kind, received, message in files.messages(wanted):
            try:
                parts = _parts(kind, received, message, read_scan)
            except (AttributeError, TypeError):  # undecodable, or another definition
                messages.damage["unreadable messages"] += 1
                messages.skipped += kind in SCANS
                continue
            for part in parts:
                if kind in SCANS:
                    messages.add_scan(*part, received)
                else:
                    messages.add_pose(None if kind == ODOMETRY else name, *part)
    if messages.unstamped:
        what = f"the timestamp is 0 in {messages.unstamped} scans"
        messages.notes.append(f"{what}, so the time of reception is used")
    if read_scan.odd_times:
        what = f"time_increment contradicts scan_time in {read_scan.odd_times} scans"
        messages.notes.append(f"{what}, so their beams are treated as simultaneous")
    messages.damage.update(files.damage)
    messages.damage.update(read_scan.refused)
    _check_scans(path, messages, read_scan)
    return messages


def _check_scans(path, messages, read_scan):
    """Raise SourceError for a bag without a usable scan."""
    refused, count = sum(read_scan.refused.values()), len(messages.scans)
    if not count and refused:
        what = f"none of the {refused} scans of {messages.topic} can be used"
        raise SourceError(f"{path}: {what}, because {read_scan.usual_refusal()}")
    if not count:
        what = f"none of the scans of {messages.topic} can be read"
        raise SourceError(f"{path} is damaged: {what}")
    if not read_scan.returns:
        what = f"no range of the {count} scans of {messages.topic} is between range_min and"
        raise SourceError(f"{path}: {what} range_max. Check these limits and the lidar")


def _parts(kind, received, message, read_scan):
    """Return the contents of a message: arguments of ``add_scan``, or of each ``add_pose``.

    Raises AttributeError or TypeError if the message is None or has other fields.
    """
    if kind in SCANS:
        header = message.header
        return [(read_scan(message), _frame(header.frame_id), _stamp(header))]
    if kind == ODOMETRY:
        pose = message.pose.pose
        return [_pose(message, received, pose.position, pose.orientation)]
    return [
        _pose(each, received, each.transform.translation, each.transform.rotation)
        for each in message.transforms
    ]


def _pose(message, received, t, q):
    """Return frame, child frame, and row (see ROW) of a pose."""
    stamp = _stamp(message.header) or received
    row = stamp, received, t.x, t.y, t.z, q.x, q.y, q.z, q.w
    return _frame(message.header.frame_id), _frame(message.child_frame_id), row


def _fault(row):
    """Return the fault of a pose, or ""."""
    squared = sum(each * each for each in row[5:])
    if not (sum(map(abs, row[2:5])) < MAX_POSITION and math.isfinite(squared)):
        return NOT_FINITE
    if squared == 0:
        return "quaternions of norm 0"
    return "" if abs(squared - 1) < MAX_NORM_ERROR else "quaternions whose norm is not 1"


def _frame(name):
    return name.strip("/")  # frames of ROS 1 may begin with a slash


def _stamp(header):
    """Return the timestamp of the measurement [s], 0 if the driver does not set it."""
    return header.stamp.sec + header.stamp.nanosec * 1e-9
