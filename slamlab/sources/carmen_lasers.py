"""Lasers of a CARMEN log: choice of the laser and its clock, and its messages sorted by time."""

import heapq
from array import array
from itertools import chain, repeat

import numpy as np

from slamlab.sources.carmen_messages import LASERS
from slamlab.sources.disk_buffer import DiskBuffer

MAX_SAMPLE = 2000  # scans by which a laser's geometry is determined
MAX_DISORDER = 1.0  # largest delay of the logging [s]
BY_ODOM, WITHOUT_ODOMETRY = 0.7, 0.2  # weight of a scan relative to one with its own pose


class LaserMessages:
    """Scans from messages of one name: all in a disk buffer, a sample in memory."""

    def __init__(self):
        self.spool, self.stamps, self.logged = DiskBuffer(), array("d"), array("d")
        self.lengths = array("q")  # numbers of ranges; −1: the message contains its geometry
        self.sample, self.moved = [], {"robot": False, "laser": False}  # whose poses change
        self._first, self._thinning = None, 1

    def append(self, message):
        if len(self.spool) % self._thinning == 0:
            self.sample.append(message)
            if len(self.sample) > MAX_SAMPLE:
                self.sample, self._thinning = self.sample[::2], 2 * self._thinning
        self.spool.append(message)
        self.stamps.append(message.stamp)
        self.logged.append(message.logged)
        self.lengths.append(len(message.ranges) if message.settings is None else -1)
        self._first = self._first or message
        for whose in (key for key, moved in self.moved.items() if not moved):
            change = getattr(message, whose) - getattr(self._first, whose)
            self.moved[whose] = bool(np.nan_to_num(change).any())

    def __len__(self):
        return len(self.spool)


def choose(lasers, has_odom):
    """Choose the laser; return the names of its messages, and whether they contain poses.

    Different messages of one laser belong together, because a log may switch between them.
    """
    groups = {}
    for name, messages in lasers.items():
        own = LASERS[name].poses > 0 and (any(messages.moved.values()) or len(messages) == 1)
        groups.setdefault((LASERS[name].laser, own), []).append(name)

    def weight(key):
        scans = sum(len(lasers[name]) for name in groups[key])
        return scans * (1.0 if key[1] else BY_ODOM if has_odom else WITHOUT_ODOMETRY)

    chosen = max(groups, key=weight)
    return groups[chosen], chosen[1]


def choose_clock(lasers, odom):
    """Choose the clock: "stamp", or "logged" (time of logging) if the timestamps are unusable.

    ``odom`` contains the rows of separate odometry poses, if any.
    """
    stamps, logged = (
        np.concatenate([getattr(laser, key) for laser in lasers]) for key in ("stamps", "logged")
    )
    if not np.isfinite(logged).all() or not np.isfinite(odom[:, 1]).all():
        return "stamp"
    constant = len(stamps) > 1 and np.ptp(stamps) == 0 < np.ptp(logged)
    apart = len(odom) and _covered(stamps, odom[:, 0]) < 0.5 < _covered(logged, odom[:, 1])
    return "logged" if constant or apart else "stamp"


def merge(lasers, clock):
    """Merge messages by time; return timestamps, indices of lasers, mask of new scans (n,).

    A scan that repeats the scan of another message is not new.
    """
    stamps = [laser.stamps if clock == "stamp" else laser.logged for laser in lasers]
    if len(stamps) == 1:
        times = np.array(stamps[0])
        return times, np.zeros(len(times), dtype=np.uint8), np.ones(len(times), dtype=bool)
    rows = heapq.merge(*(zip(times, repeat(k), strict=False) for k, times in enumerate(stamps)))
    times, order = np.fromiter(chain.from_iterable(rows), float).reshape(-1, 2).T
    new = (np.diff(times, prepend=np.nan) != 0) | (np.diff(order, prepend=order[0]) == 0)
    return times, order.astype(np.uint8), new


def sort_by_time(rows, clock):
    """Sort rows (m, 5); return increasing timestamps (n,), poses (n, 3) with unwrapped heading."""
    times, first = np.unique(_times(rows, clock), return_index=True)
    poses = rows[first, 2:]
    return times, np.column_stack([poses[:, :2], np.unwrap(poses[:, 2])])


def remove_clock_jumps(odom, clock, times):
    """Correct rows of odometry and timestamps of scans if the clock was set back in both."""
    increasing, rows = _increasing(_times(odom, clock)), odom.copy()
    if increasing is None or (scans := _increasing(times)) is None:
        return odom, times
    rows[:, 0 if clock == "stamp" else 1] = increasing
    return rows, scans


def _times(rows, clock):
    return rows[:, 0 if clock == "stamp" else 1]


def _increasing(times):
    """Replace backward jumps in times with median steps; return None if there is no jump."""
    steps = np.diff(times)
    jumps = steps < -MAX_DISORDER
    steps[jumps] = np.median(steps[~jumps]) if (~jumps).any() else 0.0
    return np.concatenate([times[:1], times[0] + np.cumsum(steps)]) if jumps.any() else None


def pose_at(times, poses, time):
    """Interpolate a pose (3,) at a time [s], or poses (n, 3) at times (n,)."""
    return np.stack([np.interp(time, times, column) for column in poses.T], axis=-1)


def _covered(times, range_of):
    return np.mean((times >= range_of.min()) & (times <= range_of.max()))
