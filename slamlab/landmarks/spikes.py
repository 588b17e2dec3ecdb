"""Spike extraction: narrow landmarks, such as table legs, before a background (Smolec §2.4)."""

import numpy as np

from slamlab.geometry import wrap
from slamlab.landmarks.line_fitting import usable_beams
from slamlab.readings import Observations


def spikes(scan, jump=0.5, widest=0.25):
    """Find landmarks at most ``widest`` [m] wide, nearer than both sides by over ``jump`` [m]."""
    valid = np.zeros(len(scan.angles), dtype=bool)
    valid[usable_beams(scan)] = True
    if not valid.any():
        return Observations(np.empty((0, 2)), np.empty(0, dtype=int))
    # a single beam without a return is ignored; several in a row are free space
    open_view = ~(valid | np.roll(valid, 1) | np.roll(valid, -1))
    beams = np.flatnonzero(valid | open_view)
    far = np.where(valid, scan.ranges, np.inf)[beams]
    step = abs(np.diff(scan.angles).mean())
    full_circle = np.isclose(step * len(valid), 2 * np.pi, rtol=1e-3)
    falls = np.roll(far, 1) > far + jump
    found = []
    for start in np.flatnonzero(falls):
        rows = _spike(far, start, jump, full_circle)
        if rows is None or (start == 0 and not full_circle):
            continue
        r, first, last = far[rows].mean(), beams[rows[0]], beams[rows[-1]]
        # by the number of beams: correct across the last and the first beam, too
        across = step * ((last - first) % len(valid) + 1)
        if r * across <= widest:
            turn = wrap(scan.angles[last] - scan.angles[first])
            found.append((r, wrap(scan.angles[first] + turn / 2)))
    z = np.array(found).reshape(-1, 2)
    return Observations(z, np.full(len(z), -1))


def _spike(far, start, jump, full_circle):
    """Return the rows from a drop of the range to its next rise, or None at the edge of a wall."""
    rows, n = [start], len(far)
    for step in range(1, n):
        here = start + step
        if here >= n and not full_circle:
            return None
        change = far[here % n] - far[rows[-1]]
        if change > jump:
            return np.array(rows)
        if change < -jump:
            return None  # something nearer follows, which may be a spike of its own
        rows.append(here % n)
    return None
