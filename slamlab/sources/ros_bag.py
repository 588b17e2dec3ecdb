"""ROS bag (ROS 1, ROS 2, rosbag) as a source: laser scans, and odometry from a topic or from tf."""

from dataclasses import replace
from itertools import repeat

import numpy as np

from slamlab.deskewing import deskew
from slamlab.files import SourceError
from slamlab.geometry import between
from slamlab.models.parameters import SensorModel
from slamlab.readings import Reading
from slamlab.sources.base import Source
from slamlab.sources.ros_beam_order import (
    FORWARD,
    SIMULTANEOUS,
    Sweep,
    detect_beam_order,
    in_order,
    windows,
)
from slamlab.sources.ros_messages import read
from slamlab.sources.ros_odometry import LaserMotion

MAX_SWEEP = 1.1  # largest duration of a sweep, relative to the median period of the scans [1]


class RosBag(Source):
    """Deskewed laser scans of a ROS bag in the laser's frame, with the laser's motion.

    ``topics`` are those that the user chose among several; ``notes`` are sentences about missing
    data. Raises SourceError, ExtraMissing.
    """

    def __init__(self, path, topics=()):
        super().__init__()
        self.name = str(path)
        messages = read(path, topics)
        self.damage.update(messages.damage)
        self.skipped, self.notes = messages.skipped, list(messages.notes)
        self._scans, self._stamps = messages.scans, np.array(messages.stamps)
        find = LaserMotion(messages)
        try:
            motion = find.of_scans()
            self._usable = self._usable_scans(motion, messages)
        except SourceError as error:
            raise SourceError(f"{self.name}: {error}") from None
        self.damage.update(find.damage)
        self.notes += find.notes
        self._poses, self._upside_down = motion.poses, motion.upside_down
        self.has_odometry = motion.poses is not None
        backwards = np.diff(self._stamps[self._usable]) < 0
        if backwards.any():
            self.damage["timestamps that run backwards"] += int(backwards.sum())
        self._order, self._ends = SIMULTANEOUS, self._poses
        self._durations = np.zeros(len(self._stamps))
        self._find_sweeps(find, np.array(messages.durations))
        scan = next(iter(self)).scan
        view = float(np.ptp(scan.angles))
        self.sensor = SensorModel(
            scan.range_min, scan.range_max, view, range_error=0.0, range_sigma=0.01
        )

    def __len__(self):
        return int(np.count_nonzero(self._usable))

    def __iter__(self):
        before = None
        for sweep, end in self._sweeps():
            scan, odometry = in_order(sweep.scan, self._order), None
            times = np.linspace(-sweep.duration, 0, len(scan.ranges))
            if end is not None:
                odometry = np.zeros(3) if before is None else between(before, end)
            if sweep.duration > 0 and end is not None:
                scan = deskew(scan, times, sweep.pose, end)
            elif sweep.duration > 0:
                scan = replace(scan, times=times)
            yield Reading(sweep.begin + sweep.duration, odometry, scan)
            before = end

    def _sweeps(self):
        """Yield each usable Sweep with the laser's pose at its end, or None."""
        none = repeat(None)
        poses, ends = (none, none) if self._poses is None else (self._poses, self._ends)
        rows = self._scans, self._stamps, self._durations, self._usable, self._upside_down
        for row, begin, duration, usable, turned, pose, end in zip(
            *rows, poses, ends, strict=False
        ):
            if usable:
                yield Sweep(row.scan(turned), float(begin), float(duration), pose), end

    def _find_sweeps(self, find, durations):
        """Detect the order of the beams and find the laser's poses at the ends of the sweeps."""
        periods = np.diff(self._stamps[self._usable])
        longest = MAX_SWEEP * np.median(periods) if len(periods) else 0.0
        too_long = durations > longest
        if too_long.any():
            what = f"time_increment exceeds the period of the scans in {too_long.sum()} scans"
            self.notes.append(f"{what}, so their beams are treated as simultaneous")
        durations = np.where(too_long, 0.0, durations)
        if not durations[self._usable].any():
            return
        self._durations = durations
        wanted, kept = windows(len(self)), {}
        numbers = {number for row in wanted for number in row}
        for number, (sweep, _) in enumerate(self._sweeps()):
            if number in numbers and sweep.duration > 0:
                kept[number] = sweep
        rows = [[kept[number] for number in row if number in kept] for row in wanted]
        self._order = detect_beam_order(rows)
        if self._order == SIMULTANEOUS:
            self._durations = np.zeros_like(durations)
            return
        order = "in" if self._order == FORWARD else "against"
        sweep = np.median(durations[durations > 0])
        self.notes.append(f"the beams were measured {order} the order of ranges, in {sweep:.3g} s")
        if self.has_odometry:
            after = find.of_scans(durations)
            # the last sweep may end after the odometry
            self._durations = np.where(after.covered, durations, 0.0)
            self._ends = np.where(after.covered[:, None], after.poses, self._poses)

    def _usable_scans(self, motion, messages):
        """Return a mask (n,) of horizontal scans at times with odometry. Raises SourceError."""
        outside = ~motion.covered
        usable = ~(outside | motion.tilted)
        if motion.tilted.all() or (not usable.any() and not outside.all()):
            what = f"{messages.frames[0]} is tilted, so its scans are not horizontal"
            raise SourceError(f"{what}. Correct the transforms to this frame, or use another lidar")
        if not usable.any():
            first, last = self._stamps.min(), self._stamps.max()
            begin, end = motion.interval
            what = f"the scans ({first:.3f} to {last:.3f} s) and the odometry ({begin:.3f} to "
            what += f"{end:.3f} s) do not overlap in time, so there is no usable scan"
            raise SourceError(f"{what}. Record both together, with one clock (use_sim_time)")
        for kind, mask in (
            ("scans outside the odometry's time", outside),
            ("scans of a tilted robot", motion.tilted & ~outside),
        ):
            if mask.any():
                self.damage[kind] += int(mask.sum())
                self.skipped += int(mask.sum())
        return usable
