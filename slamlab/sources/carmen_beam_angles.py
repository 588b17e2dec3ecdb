"""Beam angles of a CARMEN log's laser, from its field of view or from the number of beams."""

from functools import lru_cache
from itertools import pairwise

import numpy as np

from slamlab.geometry import between

# resolution by number of beams, as CARMEN assumes for a SICK [degree]
RESOLUTIONS = {
    **dict.fromkeys((180, 181), 1.0),
    **dict.fromkeys((360, 361), 0.5),
    **dict.fromkeys((400, 401), 0.25),
}
# first angle and resolution that gfs-carmen assumes for its own messages [rad]
GFS_BEAMS = {
    **dict.fromkeys((540, 541), (-2.351831, 0.008727)),
    **dict.fromkeys((682, 683), (-2.094395, 2 * np.pi / 1024)),
}
RADIANS = 2 * np.pi + 0.01  # angles beyond are degrees, fields of view below are not [rad]


@lru_cache(maxsize=64)
def angles_by_settings(start, view, step, count):
    """Compute beam angles (count,) [rad] from start angle, field of view and resolution.

    Raises ValueError with the kind of damage.
    """
    if not np.isfinite([start, view, step]).all() or (step == 0 and view <= 0):
        raise ValueError("scans without a field of view")
    if max(abs(start), abs(view)) > RADIANS:
        start, view, step = np.radians([start, view, step])
    gaps = max(1, count - 1)
    if step == 0:
        step = view / gaps
    off = abs(step) * gaps - (abs(view) or abs(step) * gaps)
    if abs(off) > 1.5 * abs(step) or abs(step) * gaps > RADIANS or abs(start) > RADIANS:
        raise ValueError("scans with inconsistent field of view, resolution and number of ranges")
    # the field of view is rounded less than the resolution
    if view and abs(off) < 0.25 * abs(step):
        step = np.copysign(view / gaps, step)
    return start + step * np.arange(count)


def angles_by_count(count, view=None, step=None):
    """Compute beam angles (count,) [rad] from field of view and resolution of PARAM lines.

    PARAM lines may be in degrees or radians. Without them, the beam count decides, as in CARMEN:
    181, 361 and 401 beams of a SICK are 1°, 0.5° and 0.25° apart, 401 beams over 100°; with one
    beam fewer, the last beam is missing. Other numbers of beams cover 180°. Raises ValueError.
    """
    usual, gaps = RESOLUTIONS.get(count), max(1, count - 1)
    if (view or gaps * (step or np.inf)) < RADIANS:
        view, step = (value and float(np.degrees(value)) for value in (view, step))
    as_usual = usual and abs(usual * gaps - (view or usual * gaps)) < 1.5 * usual
    if (view is None and step is None) or (as_usual and step in (None, usual)):
        first = -50.0 if usual == 0.25 else -90.0
        return np.radians(first + (usual or 180.0 / gaps) * np.arange(count))
    given = f"field of view {view or 0:g}°, resolution {step or 0:g}°, {count} ranges per scan"
    view = step * gaps if view is None else view
    # a full circle lacks the last beam, which would repeat the first
    step = view / (count if view > 359.9 else gaps) if step is None else step
    if min(abs(step * gaps - view), abs(step * count - view)) > 0.5 * step or view > 361:
        raise ValueError(f"the PARAM lines contradict the scans: {given}")
    if abs(step * gaps - view) < 0.25 * step:
        step = view / gaps
    return np.radians(step * np.arange(count) - view / 2)


def runs_clockwise(scans, angles):
    """Return whether ranges run clockwise, given successive ranges (n,) and robot poses (3,).

    If a scan is shifted by the robot's rotation, it fits the previous scan only in the right order.
    """
    step = np.median(np.diff(angles)) if len(angles) > 1 else np.inf
    misfits = np.zeros(2)
    for (before, pose), (after, next_pose) in pairwise(scans):
        shift = round(between(pose, next_pose)[2] / step)
        if len(before) == len(after) == len(angles) and 2 <= abs(shift) < len(angles) // 2:
            for which, by in enumerate((shift, -shift)):
                a, b = (before[by:], after[:-by]) if by > 0 else (before[:by], after[-by:])
                both = np.isfinite(a) & np.isfinite(b)
                misfits[which] += np.median(np.abs(a - b)[both]) if both.any() else 0.0
    return bool(misfits[1] < misfits[0])
