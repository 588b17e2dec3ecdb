"""Marginal covariances of a pose graph's poses: blocks of H⁻¹, never all of it."""

import numpy as np

from slamlab.posegraph import edge_error
from slamlab.posegraph.edge_jacobians import J_i, J_j
from slamlab.posegraph.normal_equations import factorise

CHUNK = 256  # poses at a time: bounds the memory
STRIP = 16  # columns solved at a time: with more, threads that do little cost many times as much


def covariances(problem, poses, phi):
    """Marginal covariance of each pose: the 3 × 3 blocks on the diagonal of H⁻¹.

    Parameters
    ----------
    problem : Problem
    poses : (n, 3) the optimum [m, m, rad]
    phi : float, Φ of the robust edges [1]

    Returns
    -------
    (n, 3, 3) zero for a fixed pose
    """
    factors, count = _factorised(problem, poses, phi), len(poses)
    blocks = np.empty((count, 3, 3))
    for some in np.array_split(np.arange(count), -(-count // CHUNK)):
        blocks[some] = _columns(problem, factors, some)[some, :, np.arange(len(some))]
    return (blocks + blocks.transpose(0, 2, 1)) / 2


def squared_mahalanobis(problem, poses, pairs, measured, R, phi):
    """Squared Mahalanobis distance vᵀ(J H⁻¹ Jᵀ + R)⁻¹v of candidate edges, v = e(x_i, x_j, z).

    Innovation v and its covariance J H⁻¹ Jᵀ + R: the chi-square test of a loop-closure candidate.
    Equation (15.8).

    Parameters
    ----------
    problem : Problem
    poses : (n, 3) the optimum [m, m, rad]
    pairs : (c, 2) int
    measured : (c, 3) [m, m, rad]
    R : (c, 3, 3) or (3, 3) measurement noise: covariance of e, in the frame that z leads to
    phi : float, Φ of the robust edges [1]

    Returns
    -------
    (c,) [1]
    """
    at = poses[pairs[:, 0]], poses[pairs[:, 1]], measured
    J = np.concatenate([J_i(*at), J_j(*at)], axis=-1)
    factors = _factorised(problem, poses, phi)
    ends, place = np.unique(pairs, return_inverse=True)  # a pose may end many candidates
    blocks = _columns(problem, factors, ends)[ends].transpose(0, 2, 1, 3)  # of H⁻¹
    place = place.reshape(-1, 2)
    P = blocks[place[:, :, None], place[:, None, :]].transpose(0, 1, 3, 2, 4).reshape(-1, 6, 6)
    v, S = edge_error.error(*at), J @ P @ J.transpose(0, 2, 1) + R
    return np.einsum("ca,ca->c", v, np.linalg.solve(S, v[..., None])[..., 0])


def _factorised(problem, poses, phi):
    """Factorise H at these poses."""
    e, chi2 = problem.errors(poses)
    return factorise(problem.linearise(poses, e, problem.weights(chi2, phi))[0])


def _columns(problem, factors, some):
    """Columns of H⁻¹ of some poses (k,): (n, 3, k, 3)."""
    pick = np.zeros((len(some), 3, 6))
    pick[:, :, :3] = np.eye(3)
    columns = problem.equations.to_columns(pick, np.column_stack([some, some]))
    strips = np.array_split(columns, max(1, -(-columns.shape[1] // STRIP)), axis=1)
    solved = np.hstack([factors.solve(strip) for strip in strips])
    return problem.equations.to_poses(solved).reshape(-1, 3, len(some), 3)
