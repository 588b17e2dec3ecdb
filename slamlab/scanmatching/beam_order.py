"""Order of the beams of a scan by bearing, and the angles between beams (angular resolution)."""

from typing import NamedTuple

import numpy as np

from slamlab.geometry import wrap

FULL_TURN = 2 * np.pi  # [rad]
MIN_SCAN_POINTS = 5  # least number of points of a scan
MIN_SWEEP = 0.05  # least field of view of a scan; a distant point cloud has less [rad]
MAX_BACKWARD = 0.1  # largest share of backward angles in a deskewed scan [1]
# Beams are in clusters if the mean angle is CLUSTERED median angles, and at least MIN_CLUSTERS
# angles above the mean are SIMILAR: they differ by this factor at most. Gaps of a scan differ more.
CLUSTERED, MIN_CLUSTERS, SIMILAR = 2.5, 32, 2.0


class Beams(NamedTuple):
    """Beams in order: ``rows`` (n,) sort the bearings (None: sorted already), ``step`` is the mean
    angle between beams, except at gaps of the scan, and ``gap`` the usual angle between directions
    with beams [rad]. The angles differ if merged revolutions have beams in the same directions."""

    rows: np.ndarray | None
    step: float
    gap: float


def ordered_beams(bearings):
    """Return the Beams of bearings (n,); None if the bearings do not run around the origin in one
    direction, once or several times: the point cloud is not a scan."""
    if len(bearings) < MIN_SCAN_POINTS:
        return None
    rows, steps = None, bearings[1:] - bearings[:-1]
    ordered = np.sort(steps)
    if ordered[0] < 0:
        if not _in_one_sense(steps):
            return None
        rows = np.argsort(bearings, kind="stable")
        bearings = bearings[rows]
        ordered = np.sort(bearings[1:] - bearings[:-1])
    span = float(bearings[-1] - bearings[0])
    hole = max(float(ordered[-1]), FULL_TURN - span)
    return Beams(rows, *_steps(ordered, span)) if FULL_TURN - hole > MIN_SWEEP else None


def _in_one_sense(steps):
    """Whether bearings run in one direction, except for a share MAX_BACKWARD: deskewing can swap
    near and far points. The step from one end of the field of view to the other is ignored."""
    onward = wrap(steps)
    largest = onward[np.abs(onward).argmax()]
    if onward.sum() < largest:
        onward = -onward
    back = np.minimum(onward, 0)
    return back.min() - back.sum() < MAX_BACKWARD * np.maximum(onward, 0).sum()


def _steps(ordered, span):
    """Return the step and gap of Beams from the sorted angles (n,) between beams."""
    n = len(ordered)
    usual, mean = float(ordered[n // 2]), span / n
    if mean < CLUSTERED * usual:
        return usual, usual
    between = ordered[ordered.searchsorted(mean, side="right") :]
    m = len(between)
    similar = m >= MIN_CLUSTERS and between[3 * m // 4] <= SIMILAR * between[m // 4]
    if usual > 0 and not similar:
        return usual, usual
    gap = float(between[m // 2])
    return gap * m / n, gap
