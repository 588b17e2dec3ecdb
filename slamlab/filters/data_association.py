"""Data association: nearest neighbour (Mahalanobis distance) in a chi-squared validation gate."""

from math import log

import numpy as np

from slamlab.filters.argument_checks import observations
from slamlab.filters.landmark_models import difference
from slamlab.geometry import wrap

BISECTOR_GATE = np.radians(30)  # similar corners of one map differ by 90° or 180°


def squared_distances(mak, z, R):
    """Squared Mahalanobis distances (m, N) vᵀ S⁻¹ v, the squares of equation (08.11), in O(N).

    S_i = H_r P_rr H_rᵀ + H_r P_ri H_pᵀ + (H_r P_ri H_pᵀ)ᵀ + H_p P_ii H_pᵀ + R
    """
    z, R = observations(z, R)
    P_rr, P_ir, P_ii = mak.blocks()
    p = mak.landmarks()
    H_r, H_p = mak.kind.H(mak.pose, p)
    cross = H_p @ P_ir @ H_r.transpose(0, 2, 1)
    HPHt = H_r @ P_rr @ H_r.transpose(0, 2, 1) + H_p @ P_ii @ H_p.transpose(0, 2, 1)
    HPHt += cross + cross.transpose(0, 2, 1)
    v = difference(z[:, None], mak.kind.h(mak.pose, p))
    S = HPHt + np.broadcast_to(R, (len(z), 2, 2))[:, None]
    a, b, d = S[..., 0, 0], S[..., 0, 1], S[..., 1, 1]
    r, beta = v[..., 0], v[..., 1]
    return (d * r * r - 2 * b * r * beta + a * beta * beta) / (a * d - b * b)


def compatible_corners(bisectors, convex, known_bisectors, known_convex, gate=BISECTOR_GATE):
    """Find compatible corners: mask (m, N), bisectors [rad] within the gate, equal convexity."""
    # not used as a measurement: bisector and position come from the same lines, so the heading
    # would become overconfident
    apart = np.abs(wrap(np.subtract.outer(bisectors, known_bisectors)))
    return (apart <= gate) & np.equal.outer(convex, known_convex)


def gated_nearest_neighbours(d2, gate=13.8, new_landmark_gate=4 * 13.8):
    """Associate each row greedily with its nearest neighbour in a gate, the closest pair first.

    ``d2`` : (m, N); each column is used at most once. Returns the pairs {row: column} inside the
    gate (13.8: 99.9 % of the true pairs pass), and the rows outside all gates for new landmarks.
    """
    pairs, left = {}, np.array(d2, dtype=float)
    new = np.flatnonzero(left.min(axis=1, initial=np.inf) > new_landmark_gate).tolist()
    while left.size and left.min() <= gate:
        row, column = (int(k) for k in np.unravel_index(left.argmin(), left.shape))
        pairs[row] = column
        left[row], left[:, column] = np.inf, np.inf
    return pairs, new


def nearest_neighbours(mak, z, R, probability=0.99):
    """Return the id of the landmark nearest to each of z (m, 2), or None outside the χ² gate."""
    if not 0 < probability < 1:
        raise ValueError(f"probability must be between 0 and 1, got {probability}")
    d2 = squared_distances(mak, z, R)
    ids = mak.ids
    if not ids:
        return [None] * len(d2)
    best, gate = d2.argmin(axis=1), -2 * log(1 - probability)  # χ² of 2 degrees: exponential
    return [ids[i] if row[i] <= gate else None for row, i in zip(d2, best, strict=True)]
