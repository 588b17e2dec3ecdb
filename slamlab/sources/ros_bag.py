"""ROS bag (ROS 1, ROS 2, rosbag): laser scans with odometry, from its topic or from tf.

A scan keeps the laser's own directions, so its motion is the laser's: the odometry at the scan's
time stamp (:mod:`slamlab.sources.ros_frames` synchronises the two), transformed by the laser's
mount (extrinsic calibration, ``/tf_static``).
"""

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.geometry import between
from slamlab.models.parameters import SensorModel
from slamlab.readings import Reading, Scan
from slamlab.sources.base import Source
from slamlab.sources.ros_frames import TransformTree
from slamlab.sources.ros_messages import read

# kind of damage: tf lacks the laser's mount
NO_TRANSFORM = "no transform to the laser, which is taken to be at the robot's centre"


class RosBag(Source):
    """ROS bag as a source of laser scans and odometry increments.

    Parameters
    ----------
    path : str or Path: a ROS 1 file, a ROS 2 folder or one of its files
    topics : names of topics to take where there are several of scans or odometry

    Raises
    ------
    SourceError : ``rosbags`` is missing; the bag cannot be read or has no scans or no odometry
    """

    def __init__(self, path, topics=()):
        super().__init__()
        self.name = str(path)
        messages = read(path, topics)
        self.damage.update(messages.damage)
        if messages.torn:
            self.damage["bag torn"] += 1
        times = np.array([stamp for stamp, _ in messages.scans])
        try:
            self._poses, known, turned = _laser_poses(messages, times, self.damage)
        except ValueError as error:
            raise SourceError(f"{self.name}: {error}") from None
        self._scans = []
        for (stamp, message), pose, usable in zip(messages.scans, self._poses, known, strict=True):
            scan = _to_scan(message, turned)
            if not usable or scan is None:
                what = "scans without directions" if usable else "scans outside the odometry's time"
                self.damage[what] += 1
                self.skipped += 1
            else:
                self._scans.append((stamp, pose, scan))
        if not self._scans:
            raise SourceError(f"{self.name} holds no usable scan: {dict(self.damage)}")
        backwards = np.diff([stamp for stamp, *_ in self._scans]) < 0
        if backwards.any():
            self.damage["stamps that run backwards"] += int(backwards.sum())
        scan = self._scans[0][2]
        self.sensor = SensorModel(
            scan.range_min,
            scan.range_max,
            float(np.ptp(scan.angles)),
            range_error=0.0,
            range_sigma=0.01,
        )

    def __len__(self):
        return len(self._scans)

    def __iter__(self):
        before = None
        for stamp, pose, scan in self._scans:
            motion = np.zeros(3) if before is None else between(before, pose)
            yield Reading(time=stamp, odometry=motion, scan=scan)
            before = pose


def _laser_poses(messages, times, damage):
    """Odometry poses of the laser at the scans' times; see ``TransformTree.poses``."""
    laser = messages.scans[0][1].header.frame_id.strip("/")
    if not messages.odometry:
        frames = TransformTree(messages.transforms)
        odom = frames.odometry_frame(laser)
        if odom is None:
            raise ValueError(
                "it has no odometry: neither a nav_msgs/Odometry topic nor transforms that move "
                f"above the laser's frame {laser!r}"
            )
        return frames.poses(laser, odom, times)
    frame, child = messages.odometry[0][1] or "odom", messages.odometry[0][2]
    chain = TransformTree(messages.transforms).ancestors(laser)
    if not child:  # some drivers leave it empty
        child = next((name for name in ("base_footprint", "base_link") if name in chain), "robot")
    # the odometry topic takes precedence over tf
    rest = [each for each in messages.transforms if each[2] != child]
    odometry = [(stamp, frame, child, *where) for stamp, _, _, *where in messages.odometry]
    frames = TransformTree([*rest, *odometry])
    if child not in frames.ancestors(laser):
        damage[NO_TRANSFORM] += 1
        return frames.poses(child, frame, times)
    return frames.poses(laser, frame, times)


def _to_scan(message, turned):
    """Convert a LaserScan message to a Scan, or None where it has no directions."""
    ranges = np.array(message.ranges, dtype=float)
    angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
    if not np.isfinite(angles).all():
        return None
    ranges[~np.isfinite(ranges) | (ranges < 0)] = np.nan
    least = message.range_min if message.range_min > 0 else 0.0
    most = message.range_max if message.range_max > 0 else np.inf
    # seen from above, a laser upside down turns the other way
    return Scan(-angles if turned else angles, ranges, float(most), float(least))
