"""Spike extraction: narrow landmarks before the background, such as a table's leg (Smolec §2.4)."""

import numpy as np

from slamlab.geometry import wrap
from slamlab.readings import Observations


def spikes(scan, jump=0.5, widest=0.25):
    """Extract spikes, narrow point landmarks: the range jumps down, and soon up again.

    Their place is the middle of the readings in between: the side that faces the sensor. Good for
    legs of tables; between smooth walls there are none.

    Parameters
    ----------
    scan : Scan
    jump : float, least step of the range on both sides [m]
    widest : float, of an object [m]

    Returns
    -------
    Observations without ids: range [m] and bearing [rad] of each
    """
    valid = scan.valid
    # one empty beam is chance and says nothing; one among empty ones looks into the open
    open_view = ~(valid | np.roll(valid, 1) | np.roll(valid, -1))
    beams = np.flatnonzero(valid | open_view)
    far = np.where(valid, scan.ranges, np.inf)[beams]
    step = abs(np.diff(scan.angles).mean())
    whole_turn = np.isclose(step * len(valid), 2 * np.pi, rtol=1e-3)
    falls = np.roll(far, 1) > far + jump
    found = []
    for start in np.flatnonzero(falls):
        rows = _object(far, start, jump, whole_turn)
        if rows is None or (start == 0 and not whole_turn):
            continue
        r, first, last = far[rows].mean(), beams[rows[0]], beams[rows[-1]]
        # as many steps apart as beams: safe where the object lies across the seam of a turn
        across = step * ((last - first) % len(valid) + 1)
        if r * across <= widest:
            turn = wrap(scan.angles[last] - scan.angles[first])
            found.append((r, wrap(scan.angles[first] + turn / 2)))
    z = np.array(found).reshape(-1, 2)
    return Observations(z, np.full(len(z), -1))


def _object(far, start, jump, whole_turn):
    """Rows from a fall of the range until it rises again, or None: a wall's edge."""
    rows, n = [start], len(far)
    for step in range(1, n):
        here = start + step
        if here >= n and not whole_turn:
            return None
        change = far[here % n] - far[rows[-1]]
        if change > jump:
            return np.array(rows)
        if change < -jump:
            return None  # something stands before it: its own spike, perhaps
        rows.append(here % n)
    return None
