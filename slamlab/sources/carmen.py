"""CARMEN log files, the format of classic public data sets (Intel Lab), with one message per line.

If a log has several lasers, the laser with the most scans is used. The laser's odometry comes from
its own messages or, if they contain no poses, from separate ODOM messages.
"""

from array import array
from itertools import islice

import numpy as np

from slamlab.files import SourceError
from slamlab.geometry import between, compose
from slamlab.models.parameters import SensorModel
from slamlab.readings import Reading, Scan, Trajectory
from slamlab.sources import carmen_lasers
from slamlab.sources.base import LogFile
from slamlab.sources.carmen_beam_angles import runs_clockwise
from slamlab.sources.carmen_geometry import LaserGeometry
from slamlab.sources.carmen_messages import LASERS, OTHERS, POSES, parse_pose, parse_scan
from slamlab.sources.log_units import TIME_UNITS, headings_in_degrees, time_unit

KNOWN = {*LASERS, *POSES, b"PARAM", b"SYNC"}
SWITCHES = {b"on": 1.0, b"yes": 1.0, b"true": 1.0}  # values of PARAM lines that are words
MAX_PAIRS = 500  # scans by which the direction of rotation is determined
MAX_PERIOD = 10.0  # of scans; longer ones are in another unit [s]
STAMPS = np.array([1, 1, 0, 0, 0])  # the timestamps of a row of poses


class CarmenLog(LogFile):
    kind = "a CARMEN log (FLASER, ROBOTLASER1, RAWLASER1 …)"

    @staticmethod
    def recognises(head):
        first = (line[:40].split(None, 1) for line in head.splitlines())
        return head.startswith(b"# CARMEN") or any(words and words[0] in KNOWN for words in first)

    def _parse(self, file):
        self._params, lasers = {}, {}
        poses = {name: array("d") for name in POSES}  # rows: timestamp, logging time, x, y, θ
        for number, line, complete in file.lines():
            words = line.split()
            name = words[0] if words else b"#"
            try:
                if name in LASERS:
                    message = self._checked(parse_scan(words, complete))
                    if name not in lasers:
                        lasers[name] = carmen_lasers.LaserMessages()
                    lasers[name].append(message)
                elif name in POSES:
                    poses[name].extend(parse_pose(words))
                elif name == b"PARAM":
                    self._add_param(*words[1:3])
                elif name not in OTHERS and not name.startswith(b"#"):
                    self.damage["lines without a CARMEN message"] += 1
            except ValueError as kind:
                if name in LASERS:
                    self._count_lost(str(kind), number)
                else:
                    self.damage[str(kind)] += 1
        if not lasers:
            raise self._nothing_usable("readable scan of a laser (FLASER, ROBOTLASER1 …)")
        odom, *truth = (np.array(poses[name]).reshape(-1, 5) for name in POSES)
        if not np.any(odom[:, 2:] != odom[:1, 2:]):
            odom = odom[:0]
        self._choose(lasers, odom)
        self._merge(odom)
        self._find_geometry()
        self._find_truth(np.concatenate(truth))

    def __len__(self):
        return int(np.count_nonzero(self._used))

    def __iter__(self):
        before, sensor, mounted = None, self.sensor, self._geometry.mount.any()
        for row, message in self._messages():
            odometry = None
            if self.has_odometry:
                pose = self._robot_pose(row, message)
                if mounted:
                    pose = compose(pose, self._geometry.mount)
                odometry = np.zeros(3) if before is None else between(before, pose)
                before = pose
            ranges = message.ranges * self._geometry.unit
            scan = Scan(self._geometry.angles(message), ranges, sensor.range_max)
            yield Reading(float(self._times[row]), odometry, scan)

    def _messages(self):
        """Yield the index and ScanMessage of each used scan."""
        messages = [iter(laser.spool) for laser in self._lasers]
        for row, (which, used) in enumerate(zip(self._order, self._used, strict=True)):
            message = next(messages[which])
            if used:
                yield row, message

    def _robot_pose(self, row, message):
        return getattr(message, self._whose) if self._own_poses else self._poses[row]

    def _add_param(self, name=b"", value=b""):
        try:
            self._params[name.decode("utf-8", "replace")] = SWITCHES.get(value) or float(value)
        except ValueError:
            return  # only numbers describe the geometry

    def _checked(self, message):
        ranges = message.ranges
        if len(ranges) and not (ranges.min() >= 0 and ranges.max() < np.inf):
            unusable = ~(ranges >= 0) | np.isinf(ranges)
            self.damage["NaN, infinite or negative ranges"] += int(unusable.sum())
            ranges[unusable] = np.nan
        return message

    def _discard(self, rows, kind):
        """Discard the messages in a mask (n,) and count them as lost."""
        lost = int(np.count_nonzero(rows & self._used))
        if lost:
            self.damage[kind] += lost
            self.skipped += lost
            self._used = self._used & ~rows
        if not self._used.any():
            raise SourceError(f"{self.name} contains no usable scan: {lost} are {kind}")

    def _choose(self, lasers, odom):
        """Choose the laser and the source of its odometry."""
        self._names, self._own_poses = carmen_lasers.choose(lasers, len(odom) > 1)
        self._lasers = [lasers[name] for name in self._names]
        self.has_odometry = self._own_poses or len(odom) > 1
        for name in sorted(set(lasers) - set(self._names)):
            unused = f"unused scans of {name.decode()}, in addition to {self._names[0].decode()}"
            self.damage[unused] += len(lasers[name])
        moved = any(laser.moved["robot"] for laser in self._lasers)
        one = sum(map(len, self._lasers)) == 1  # its pose may be zero
        self._whose = "robot" if moved or one else "laser"
        if self._whose == "laser" and LASERS[self._names[0]].poses:
            used = "the poses of the laser are used" if self._own_poses else "it is ignored"
            self.notes.append(f"the odometry in the scan messages never changes, so {used}")

    def _merge(self, odom):
        """Merge the laser's messages by time and interpolate separate odometry."""
        odom = odom[:0] if self._own_poses else odom
        own = [getattr(each, self._whose) for laser in self._lasers for each in laser.sample]
        if headings_in_degrees(np.array(own) if self._own_poses else odom[:, 2:]):
            raise SourceError(
                f"{self.name}, read as a CARMEN log: the headings match the path in degrees, not "
                "in radians; multiply them by π/180"
            )
        self._clock = carmen_lasers.choose_clock(self._lasers, odom)
        self._times, self._order, self._used = carmen_lasers.merge(self._lasers, self._clock)
        self._tick = time_unit(self._times, 0.0, MAX_PERIOD) or 1.0
        if self._tick != 1.0:
            self.notes.append(f"the timestamps are read as {TIME_UNITS[self._tick]}")
            self._times, odom = self._times * self._tick, odom * self._tick**STAMPS
        if self.has_odometry and not self._own_poses:
            rows, times = carmen_lasers.remove_clock_jumps(odom, self._clock, self._times)
            stamps, poses = carmen_lasers.sort_by_time(rows, self._clock)
            self._poses = carmen_lasers.pose_at(stamps, poses, times)
            outside = (times < stamps[0]) | (times > stamps[-1])
            self._discard(outside, "scans before or after all ODOM messages")
        backwards = np.diff(self._times[self._used]) < 0
        if backwards.any():
            self.damage["timestamps that run backwards"] += int(backwards.sum())

    def _find_geometry(self):
        """Find the field of view, mounting and maximum range of the log's laser."""
        first = LASERS[self._names[0]]
        self._geometry = LaserGeometry(
            self._params,
            first.laser,
            first.laser == 2 or any(LASERS[name].settings for name in self._names),
            [message for laser in self._lasers for message in laser.sample],
            self.notes,
        )
        if self._own_poses and self._whose == "laser":
            self._geometry.mount = np.zeros(3)
        lengths = np.empty(len(self._order), dtype=int)
        for k, laser in enumerate(self._lasers):
            lengths[self._order == k] = laser.lengths
        unspecified = self._used & (lengths >= 0)
        if unspecified.any():
            try:
                usable = self._geometry.lengths(
                    lengths[unspecified], self._names[0] == b"LASER_READING"
                )
            except ValueError as error:
                raise SourceError(f"{self.name}: {error}. Correct the PARAM lines") from None
            self._discard(unspecified & ~np.isin(lengths, usable), "scans of another length")
        flipped = self._geometry.declared_upside_down
        rows = list(islice(self._messages(), MAX_PAIRS if flipped else 1))
        angles = self._geometry.angles(rows[0][1])
        if flipped and self.has_odometry:
            # CARMEN reverses the ranges of such a laser before logging
            scans = [(m.ranges, self._robot_pose(row, m)) for row, m in rows]
            self._geometry.clockwise = runs_clockwise(scans, angles)
            if self._geometry.clockwise:
                self.notes.append("the laser is mounted upside down, so the ranges are reversed")
        view = np.ptp(angles) * len(angles) / max(1, len(angles) - 1)
        self.sensor = SensorModel(
            range_max=self._geometry.range_max,
            field_of_view=float(min(2 * np.pi, view)),
            range_sigma=0.01,
            range_error=0.0,
        )

    def _find_truth(self, truth):
        if len(truth) < 2:
            return
        times, poses = carmen_lasers.sort_by_time(truth * self._tick**STAMPS, self._clock)
        known = (self._times >= times[0]) & (self._times <= times[-1]) & self._used
        at = np.unique(self._times[known])
        if len(at):
            true = carmen_lasers.pose_at(times, poses, at)
            self.truth = Trajectory(at, compose(true, self._geometry.mount))
