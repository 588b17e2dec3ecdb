"""Corner extraction: point landmarks where two walls of a scan meet (MAK thesis, chapter 8)."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np


@dataclass(frozen=True)
class Corner:
    """A corner: z (range, bearing), its R, ``bisector`` of the walls [rad], whether ``convex``."""

    z: np.ndarray
    R: np.ndarray
    bisector: float
    convex: bool


def corners(lines, reach=0.4, min_angle=0.5):
    """Find intersections of a scan's lines n_1·p = ρ_1, n_2·p = ρ_2 at most ``reach`` [m] from the
    observed end of each wall, with at least ``min_angle`` [rad] between walls. Equation (08.9)."""
    found = []
    for first, second in combinations(lines, 2):
        if abs(np.sin(first.z[1] - second.z[1])) < np.sin(min_angle):
            continue
        p, P = _intersection(first, second)
        if all(np.hypot(*(line.ends - p).T).min() <= reach for line in (first, second)):
            found.append(Corner(*_polar(p, P), *_opening(p, first, second)))
    return found


def _intersection(first, second):
    """Return the intersection (2,) [m] and its covariance (2, 2) [m²]."""
    (rho1, a1), (rho2, a2) = first.z, second.z
    N = np.array([[np.cos(a1), np.sin(a1)], [np.cos(a2), np.sin(a2)]])
    p = np.linalg.solve(N, [rho1, rho2])
    # n·p = ρ, so n·dp = dρ − (t·p) dα with t = dn/dα
    back = np.linalg.inv(N)
    P = np.zeros((2, 2))
    for k, line in enumerate((first, second)):
        t = np.array([-N[k, 1], N[k, 0]])
        J = np.outer(back[:, k], [1.0, -(t @ p)])
        P += J @ line.R @ J.T
    return p, P


def _opening(p, *walls):
    """Return the bisector [rad] of walls that meet at p, and whether the corner is convex."""
    along = [line.ends.mean(axis=0) - p for line in walls]
    middle = np.sum([direction / np.hypot(*direction) for direction in along], axis=0)
    return float(np.arctan2(middle[1], middle[0])), bool(middle @ p > 0)


def _polar(p, P):
    r2, r = p @ p, np.hypot(*p)
    J = np.array([[p[0] / r, p[1] / r], [-p[1] / r2, p[0] / r2]])
    R = J @ P @ J.T
    return np.array([r, np.arctan2(p[1], p[0])]), (R + R.T) / 2
