"""Deskewing (motion compensation): scans taken on the move, as if taken from the last pose."""

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
    return _seen_from(scan, between(motion, fraction[:, None] * motion))


def merge(scans, poses):
    """Merge scans into one, as if taken from the last pose.

    Parameters
    ----------
    scans : list of Scan, one or more
    poses : list of (3,), where the robot was at each [m, m, rad]

    Returns
    -------
    Scan : all their points, in the order of their directions
    """
    *earlier, last = scans
    if not earlier:
        return last
    moved = [
        _seen_from(scan, between(poses[-1], pose))
        for scan, pose in zip(earlier, poses, strict=False)
    ]
    angles, ranges = (
        np.concatenate([getattr(scan, name) for scan in (*moved, last)])
        for name in ("angles", "ranges")
    )
    # as one turn goes: clockwise, from where the last began
    order = np.argsort(np.mod(last.angles[0] - angles, 2 * np.pi), kind="stable")
    return replace(last, angles=angles[order], ranges=ranges[order])


def _seen_from(scan, poses):
    """Scan as seen from elsewhere; (3,) or (n, 3) poses from there where each point was taken."""
    # compose broadcasts: the points are poses without a heading
    points = np.column_stack(
        [scan.ranges * np.cos(scan.angles), scan.ranges * np.sin(scan.angles), 0 * scan.angles]
    )
    x, y, _ = compose(poses, points).T
    turned = wrap(np.arctan2(y, x) - scan.angles)  # angles keep their order: no jump at ±π
    angles = np.where(np.isnan(turned), scan.angles, scan.angles + turned)
    return replace(scan, angles=angles, ranges=np.hypot(x, y))
