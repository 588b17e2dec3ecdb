"""Data association: nearest neighbour by Mahalanobis distance, in a chi-square (χ²) gate.

One observation of landmark i touches the robot and p_i only: its innovation covariance needs the
5 × 5 block of P over both, so that gating tries all N landmarks in O(N).
"""

from math import log

import numpy as np

from slamlab.filters.argument_checks import observations
from slamlab.geometry import wrap

BISECTOR_GATE = np.radians(30)  # corners of one map that might be confused differ by 90° or 180°


def squared_distances(mak, z, R):
    """Squared Mahalanobis distance vᵀ S⁻¹ v of every observation to every landmark.

    The square of equation (08.11).

    S_i = H_r P_rr H_rᵀ + H_r P_ri H_pᵀ + (H_r P_ri H_pᵀ)ᵀ + H_p P_ii H_pᵀ + R

    Parameters
    ----------
    mak : MAK of N landmarks
    z : (m, 2) range [m], bearing [rad]
    R : (2, 2) measurement noise of each, or (m, 2, 2)

    Returns
    -------
    (m, N), columns in the order of ``mak.ids``

    Raises
    ------
    ValueError
    """
    z, R = observations(z, R)
    P_rr, P_ir, P_ii = mak.blocks()
    p = mak.landmarks()
    H_r, H_p = mak.kind.H(mak.pose, p)
    cross = H_p @ P_ir @ H_r.transpose(0, 2, 1)
    HPHt = H_r @ P_rr @ H_r.transpose(0, 2, 1) + H_p @ P_ii @ H_p.transpose(0, 2, 1)
    HPHt += cross + cross.transpose(0, 2, 1)
    v = z[:, None] - mak.kind.h(mak.pose, p)
    v[..., 1] = wrap(v[..., 1])
    S = HPHt + np.broadcast_to(R, (len(z), 2, 2))[:, None]
    a, b, d = S[..., 0, 0], S[..., 0, 1], S[..., 1, 1]
    r, beta = v[..., 0], v[..., 1]
    return (d * r * r - 2 * b * r * beta + a * beta * beta) / (a * d - b * b)


def compatible_corners(bisectors, convex, known_bisectors, known_convex, gate=BISECTOR_GATE):
    """Which corners may be one and the same: they open in one direction, and both out or both in.

    A landmark's bisector is compared, not measured: a heading corrected by it, too, would be held
    for surer than it is, as bisector and place come from the same two lines.

    Parameters
    ----------
    bisectors, known_bisectors : (m,) and (N,) directions in one frame [rad], NaN where no corner is
    convex, known_convex : (m,) and (N,) bool
    gate : float, most that bisectors of one corner differ [rad]

    Returns
    -------
    (m, N) bool
    """
    apart = np.abs(wrap(np.subtract.outer(bisectors, known_bisectors)))
    return (apart <= gate) & np.equal.outer(convex, known_convex)


def gated_nearest_neighbours(d2, gate=13.8, new_landmark_gate=4 * 13.8):
    """Greedy nearest-neighbour data association: closest pair first, each landmark at most once.

    Inside the gate of a landmark it is that landmark, beyond the wider gate of all it is new;
    between the two it is ambiguous, neither paired nor new.

    Parameters
    ----------
    d2 : (m, N) squared Mahalanobis distances, see :func:`squared_distances`
    gate : float; chi-square gate, χ² of 2 degrees: a true pairing fails 13.8 once in a thousand
    new_landmark_gate : float, squared distance beyond which an observation is a new landmark

    Returns
    -------
    {row: column}, observation to landmark
    list of rows that are new landmarks
    """
    pairs, left = {}, np.array(d2, dtype=float)
    new = np.flatnonzero(left.min(axis=1, initial=np.inf) > new_landmark_gate).tolist()
    while left.size and left.min() <= gate:
        row, column = (int(k) for k in np.unravel_index(left.argmin(), left.shape))
        pairs[row] = column
        left[row], left[:, column] = np.inf, np.inf
    return pairs, new


def nearest_neighbours(mak, z, R, probability=0.99):
    """Nearest-neighbour association: the id of the nearest landmark within the gate, or None.

    Two observations of one scan may name the same landmark; the caller decides between them.

    Parameters
    ----------
    mak : MAK
    z : (m, 2) range [m], bearing [rad]
    R : (2, 2) measurement noise of each, or (m, 2, 2)
    probability : float, of a true pairing to pass the gate: χ² with 2 degrees of freedom

    Returns
    -------
    list of m ids or None

    Raises
    ------
    ValueError
    """
    if not 0 < probability < 1:
        raise ValueError(f"probability must lie between 0 and 1, got {probability}")
    d2 = squared_distances(mak, z, R)
    ids = mak.ids
    if not ids:
        return [None] * len(d2)
    best, gate = d2.argmin(axis=1), -2 * log(1 - probability)  # χ² of 2 degrees: exponential
    return [ids[i] if row[i] <= gate else None for row, i in zip(d2, best, strict=True)]


nearest = nearest_neighbours  # name in the first edition
