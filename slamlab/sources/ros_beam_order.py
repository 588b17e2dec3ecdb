"""Detection of the beam order (direction of rotation) of a lidar: many headers are wrong about it.

Some drivers sort the beams of a clockwise lidar by increasing angle but leave ``time_increment``
positive. Some simulators set ``time_increment`` although their beams are simultaneous. Two scans
with different rotations match best if both are deskewed in the right beam order.
"""

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from slamlab.deskewing import deskew_by_velocity
from slamlab.geometry import between
from slamlab.readings import Scan
from slamlab.scanmatching import match

SIMULTANEOUS, FORWARD, BACKWARD = 0, 1, -1  # beam orders
WINDOW, MAX_WINDOWS = 24, 6  # successive scans, and number of windows in a long recording
REACH, PAIRS = 8, 6  # largest interval of a pair of scans, and pairs per window
MIN_TURN = 0.01  # least difference of the rotations during two sweeps [rad]
MIN_POINTS = 20  # of a scan for matching
MIN_PAIRS, MIN_AGREEING = 3, 0.66  # least number of pairs, and share that must agree [1]
MAX_RESIDUAL = 0.9  # of the right order relative to the others, geometric mean [1]


class Sweep(NamedTuple):
    """Scan, time of its first beam [s], duration of its revolution [s], and the laser's odometry
    pose (3,) or None."""

    scan: Scan
    begin: float
    duration: float
    pose: np.ndarray | None


def windows(count):
    """Choose windows of scans for the detection; return their indices."""
    starts = np.linspace(0, max(0, count - WINDOW), min(MAX_WINDOWS, max(1, count // WINDOW)))
    return [range(int(start), min(count, int(start) + WINDOW)) for start in starts]


def detect_beam_order(rows):
    """Detect the beam order from windows of successive Sweeps: SIMULTANEOUS, FORWARD, BACKWARD."""
    residuals = [found for row in rows for found in _residuals(row)]
    if len(residuals) < MIN_PAIRS:
        return SIMULTANEOUS
    residuals = np.array(residuals)
    for order in (FORWARD, BACKWARD):
        others = [other for other in (SIMULTANEOUS, FORWARD, BACKWARD) if other != order]
        ratios = residuals[:, order] / residuals[:, others].min(axis=1)
        if np.mean(ratios < 1) >= MIN_AGREEING and np.exp(np.log(ratios).mean()) < MAX_RESIDUAL:
            return order
    return SIMULTANEOUS


def in_order(scan, order):
    """Return a scan with its beams in the order of their times."""
    if order != BACKWARD:
        return scan
    return replace(scan, angles=scan.angles[::-1], ranges=scan.ranges[::-1])


def _residuals(row):
    """Return the residuals of pairs with different rotations as lists indexed by beam order."""
    velocities = _velocities(row)
    turns = velocities[:, 2] * [sweep.duration for sweep in row]
    pairs = [
        (abs(turns[i] - turns[j]), i, j)
        for i in range(len(row))
        for j in range(i + 1, min(len(row), i + REACH))
        if abs(turns[i] - turns[j]) > MIN_TURN  # false for an unknown rotation
    ]
    found = []
    for _, i, j in sorted(pairs, reverse=True)[:PAIRS]:
        guess = np.sum(velocities[i + 1 : j + 1], axis=0)
        guess = guess * (row[j].begin - row[i].begin) / (j - i)
        if row[i].pose is not None:
            guess = between(row[i].pose, row[j].pose)
        by_order = [
            _residual(row[i], row[j], velocities[[i, j]], guess, order)
            for order in (SIMULTANEOUS, FORWARD, BACKWARD)
        ]
        if np.isfinite(by_order).all() and min(by_order) > 0:
            found.append(by_order)
    return found


def _residual(first, second, velocities, guess, order):
    """Match two Sweeps, deskewed in one beam order; return the residual [m], inf if it fails."""
    clouds = []
    for sweep, velocity in zip((first, second), velocities, strict=True):
        scan = in_order(sweep.scan, order)
        if order != SIMULTANEOUS:
            scan = replace(scan, times=np.linspace(0, sweep.duration, len(scan.ranges)))
        clouds.append(deskew_by_velocity(scan, velocity * sweep.duration, sweep.duration).points())
    found = match(clouds[1], clouds[0], guess, search=0)
    return found.error / found.inlier_ratio if found.inlier_ratio > 0 else np.inf


def _velocities(row):
    """Return velocities (n, 3) at successive Sweeps [m/s, m/s, rad/s]; NaN means unknown."""
    found, last = np.full((len(row), 3), np.nan), np.zeros(3)
    for k, (before, after) in enumerate(pairwise(row)):
        period = after.begin - before.begin
        if not 0 < period < 1:
            continue
        if before.pose is not None:
            found[k + 1] = between(before.pose, after.pose) / period
            continue
        clouds = after.scan.points(), before.scan.points()
        if min(map(len, clouds)) >= MIN_POINTS:
            fit = match(*clouds, last * period)
            if fit.good:
                found[k + 1] = last = fit.pose / period
    return found
