"""Rotation-first initialisation of the poses from the edges (Carlone et al. 2014, LAGO).

With headings as complex numbers r = exp(iθ), the model r_j = r_i exp(i z_θ) of an edge is linear,
and so is that of the positions once the headings are known: two linear least-squares problems.
"""

import numpy as np
from scipy import sparse

from slamlab.geometry import compose
from slamlab.posegraph.normal_equations import factorise


def initial_poses(count, pairs, measured, information, roots):
    """Compute the poses (count, 3) of the nodes that edges connect to a root.

    pairs (m, 2), measured (m, 3), information (m, 3, 3) : edges; roots : node to pose (3,), of one
    node or more of each component.
    """
    x = np.zeros((count, 3))
    x[list(roots)] = np.array(list(roots.values())).reshape(-1, 3)
    free = np.isin(np.arange(count), pairs) & ~np.isin(np.arange(count), list(roots))
    turns, logs = np.exp(1j * measured[:, 2]), np.log(information[:, 2, 2]) / 2
    x[:, 2] = np.angle(_solve(pairs, turns, 0 * turns, logs, np.exp(1j * x[:, 2]), free))
    steps = (measured[:, 0] + 1j * measured[:, 1]) * np.exp(1j * x[pairs[:, 0], 2])
    logs = np.linalg.slogdet(information[:, :2, :2])[1] / 4  # the mean of both directions
    places = _solve(pairs, np.ones(len(pairs)), steps, logs, x[:, 0] + 1j * x[:, 1], free)
    return np.column_stack([places.real, places.imag, x[:, 2]])


def place_landmarks(poses, pairs, measured, landmark):
    """Set the positions of the landmarks, mask (n,), in poses (n, 3) by their first edge."""
    for k in np.flatnonzero(landmark[pairs[:, 1]])[::-1].tolist():
        i, j = pairs[k].tolist()
        seen_from = np.zeros(3) if i < 0 else poses[i]  # −1: a prior, in the world frame
        poses[j, :2] = compose(seen_from, measured[k])[:2]


def _solve(pairs, factors, steps, logs, x, free):
    """Minimise Σ w²|x_j − a x_i − b|² over the free entries of complex numbers x (n,), given log w.

    Weights are at least a millionth of the largest, so that the problem is not singular.
    """
    if not free.any():
        return x
    weights = np.exp(np.maximum(logs - logs.max(), np.log(1e-6)))
    rows, (i, j) = np.arange(len(pairs)), pairs.T
    entries = np.concatenate([weights, -weights * factors])
    at = np.concatenate([rows, rows]), np.concatenate([j, i])
    A = sparse.coo_array((entries, at), shape=(len(pairs), len(x))).tocsc()
    b, A = weights * steps - A[:, ~free] @ x[~free], A[:, free]
    H, g = (A.conj().T @ A).tocsc(), A.conj().T @ b
    lu = factorise(H, "MMD_AT_PLUS_A")
    x = x.astype(complex)
    x[free] = lu.solve(g) if np.iscomplexobj(H) else lu.solve(g.real) + 1j * lu.solve(g.imag)
    return x
