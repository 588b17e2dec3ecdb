"""Deskewing (correction of motion distortion, motion compensation) and merging of scans."""

from dataclasses import replace

import numpy as np

from slamlab.geometry import between, compose, wrap

MIN_MOTION = 1e-4  # a scan with less motion needs no deskewing [m, rad]


def deskew(scan, times, begin, end):
    """Deskew a scan to the pose ``end``: undo the motion since each point's measurement.

    The pose at t is begin ⊕ s (end ⊖ begin) with s = (t − t₁) / (tₙ − t₁). times : (n,) [s]; begin,
    end : (3,) [m, m, rad].
    """
    if len(times) < 2:
        return scan
    return _straightened(scan, between(begin, end), (times - times[0]) / (times[-1] - times[0]))


def deskew_by_velocity(scan, motion, period):
    """Deskew a scan to the time of its reading, given a constant velocity: ``motion`` (3,) [m, m,
    rad] in ``period`` [s]."""
    if scan.times is None:
        return scan
    still = replace(scan, times=None)
    return still if period <= 0 else _straightened(still, motion, 1 + scan.times / period)


def merge_scans(scans, poses):
    """Merge scans at poses (3,) [m, m, rad] into one scan at the last pose."""
    *earlier, last = scans
    if not earlier:
        return last
    moved = [
        _seen_from(scan, between(poses[-1], pose))
        for scan, pose in zip(earlier, poses, strict=False)
    ]
    whole = concatenate_scans([*moved, last])
    # in the order of one revolution: clockwise, from the first beam of the last scan
    order = np.argsort(np.mod(last.angles[0] - whole.angles, 2 * np.pi), kind="stable")
    return replace(whole, angles=whole.angles[order], ranges=whole.ranges[order])


def concatenate_scans(scans):
    """Concatenate the beams of scans, in the order of the scans."""
    angles, ranges = (
        np.concatenate([getattr(scan, name) for scan in scans]) for name in ("angles", "ranges")
    )
    return replace(scans[-1], angles=angles, ranges=ranges)


def _straightened(scan, motion, share):
    """Return the scan at the end of a motion (3,), of which a ``share`` (n,) preceded each beam."""
    if np.abs(motion).max() < MIN_MOTION:
        return scan
    return _seen_from(scan, between(motion, share[:, None] * motion))


def _seen_from(scan, poses):
    """Return a scan in another frame, given the scan's pose (3,) or its points' poses (n, 3)."""
    # compose broadcasts: the points are poses without a heading
    points = np.column_stack(
        [scan.ranges * np.cos(scan.angles), scan.ranges * np.sin(scan.angles), 0 * scan.angles]
    )
    x, y, _ = compose(poses, points).T
    turned = wrap(np.arctan2(y, x) - scan.angles)  # angles keep their order: no jump at ±π
    angles = np.where(np.isnan(turned), scan.angles, scan.angles + turned)
    return replace(scan, angles=angles, ranges=np.hypot(x, y))
