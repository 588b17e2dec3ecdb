"""Time synchronisation of ROS messages whose clocks differ, stop or are set back.

A bag contains two times for each message: the timestamp in its header and its time of reception.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import median_filter

MAX_SET_BACK = 1.0  # larger jumps back mean that the clock was set back [s]
MEDIAN_WINDOW = 5  # timestamps of the median filter, against outliers
MAX_REPEATED = 0.9  # share of equal timestamps of a running clock [1]
MAX_OFFSET = 0.5  # larger differences are clock offsets, not latencies [s]
OUTER = 0.05, 0.95  # quantiles that must both show an offset [1]


@dataclass(frozen=True)
class Stamps:
    """Times of messages: header timestamps and times of reception (n,) [s]."""

    header: np.ndarray
    received: np.ndarray

    def __getitem__(self, part):
        return Stamps(self.header[part], self.received[part])

    def steady(self):
        """Return whether the clock of the headers advances and is never set back."""
        usual = median_filter(self.header, MEDIAN_WINDOW, mode="nearest")
        return _runs(self.header) and np.diff(usual).min(initial=0) > -MAX_SET_BACK


def synchronise(scans, others):
    """Synchronise the times of scans and other messages; return both and a note, or "".

    scans, others : Stamps
    """
    offset, drifts = _offset(scans, others)
    wrong = ""
    if drifts:
        wrong = "are from clocks that drift apart"
    elif not (scans.steady() and others.steady()):
        wrong = "stop or are set back"
    if wrong and _runs(scans.received) and _runs(others.received):
        return scans.received, others.received, f"{wrong}, so the times of reception are used"
    if offset == 0:
        return scans.header, others.header, ""
    ahead = "ahead of" if offset > 0 else "behind"
    note = f"differ: the scans are {abs(offset):.6g} s {ahead} the others; the offset is removed"
    return scans.header - offset, others.header, note


def _offset(scans, others):
    """Return the clock offset of the scans relative to the others [s], 0 if it is insignificant,
    and whether it drifts."""
    order = np.argsort(others.received, kind="stable")
    received = others.received[order]
    both = (scans.received >= received[0]) & (scans.received <= received[-1])
    if not both.any():
        return 0.0, False
    theirs = np.interp(scans.received[both], received, others.header[order])
    low, middle, high = np.quantile(scans.header[both] - theirs, (OUTER[0], 0.5, OUTER[1]))
    if not (low > MAX_OFFSET or high < -MAX_OFFSET):
        return 0.0, False
    return float(middle), bool(high - low > MAX_OFFSET)


def _runs(times):
    return len(times) < 2 or len(np.unique(times)) > max(1, (1 - MAX_REPEATED) * len(times))
