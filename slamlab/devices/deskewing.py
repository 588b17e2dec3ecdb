"""Deskewing (motion compensation): a scan taken on the move, as if taken from its last pose."""

from dataclasses import replace

import numpy as np

from slamlab.geometry import between, compose, wrap

MIN_MOTION = 1e-4  # below this a scan needs no deskewing [m, rad]


def deskew(scan, times, begin, end):
    """Deskew a scan: move every point by the robot's motion since it was measured.

    Pose at t: begin ⊕ s (end ⊖ begin) with s = (t − t₁) / (tₙ − t₁)

    Parameters
    ----------
    scan : Scan, each point as seen from where the robot was just then
    times : (n,) when each was measured [s]
    begin, end : (3,) where the robot was at the first and the last [m, m, rad]

    Returns
    -------
    Scan, as seen from ``end``
    """
    motion = between(begin, end)
    if len(times) < 2 or np.abs(motion).max() < MIN_MOTION:
        return scan
    fraction = (times - times[0]) / (times[-1] - times[0])
    # compose broadcasts: the points are poses without a heading
    points = np.column_stack(
        [scan.ranges * np.cos(scan.angles), scan.ranges * np.sin(scan.angles), 0 * scan.angles]
    )
    x, y, _ = compose(between(motion, fraction[:, None] * motion), points).T
    turned = wrap(np.arctan2(y, x) - scan.angles)  # angles keep their order: no jump at ±π
    angles = np.where(np.isnan(turned), scan.angles, scan.angles + turned)
    return replace(scan, angles=angles, ranges=np.hypot(x, y))
