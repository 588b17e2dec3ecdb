"""Marginal covariances of the poses of a pose graph: blocks of H⁻¹, by solving for its columns.

Each block is the inverse of a Schur complement of H, which marginalises out all other poses.
"""

import numpy as np

from slamlab.posegraph import edge_error
from slamlab.posegraph.edge_jacobians import J_i, J_j
from slamlab.posegraph.normal_equations import factorise

CHUNK = 256  # poses at a time, which limits the memory
STRIP = 16  # columns solved at a time; more start threads, which is slower


def covariances(problem, poses, nodes):
    """Return marginal covariances of some nodes (k, 3, 3), diagonal blocks of H⁻¹; those of fixed
    poses are 0."""
    factors, blocks = _factorised(problem, poses), [np.empty((0, 3, 3))]
    for some in np.array_split(nodes, -(-len(nodes) // CHUNK)) if len(nodes) else ():
        blocks.append(_columns(problem, factors, some)[some, :, np.arange(len(some))])
    blocks = np.concatenate(blocks)
    return (blocks + blocks.transpose(0, 2, 1)) / 2


def squared_mahalanobis(problem, poses, pairs, measured, R):
    """Squared Mahalanobis distances (c,) vᵀ(J H⁻¹ Jᵀ + R)⁻¹v of candidate edges. Equation (15.8).

    v = e(x_i, x_j, z); pairs : (c, 2); R : covariance of e; poses : (n, 3), the optimum.
    """
    at = poses[pairs[:, 0]], poses[pairs[:, 1]], measured
    J = np.concatenate([J_i(*at), J_j(*at)], axis=-1)
    factors = _factorised(problem, poses)
    ends, index = np.unique(pairs, return_inverse=True)  # candidates may share poses
    blocks = _columns(problem, factors, ends)[ends].transpose(0, 2, 1, 3)  # of H⁻¹
    index = index.reshape(-1, 2)
    P = blocks[index[:, :, None], index[:, None, :]].transpose(0, 1, 3, 2, 4).reshape(-1, 6, 6)
    v, S = edge_error.error(*at), J @ P @ J.transpose(0, 2, 1) + R
    return np.einsum("ca,ca->c", v, np.linalg.solve(S, v[..., None])[..., 0])


def _factorised(problem, poses):
    e = problem.errors(poses)[0]
    return factorise(problem.linearise(poses, e, np.ones(len(e)))[0])


def _columns(problem, factors, some):
    """Return the columns of H⁻¹ of some poses (k,): (n, 3, k, 3)."""
    pick = np.zeros((len(some), 3, 6))
    pick[:, :, :3] = np.eye(3)
    columns = problem.equations.to_columns(pick, np.column_stack([some, some]))
    strips = np.array_split(columns, max(1, -(-columns.shape[1] // STRIP)), axis=1)
    solved = np.hstack([factors.solve(strip) for strip in strips])
    return problem.equations.to_poses(solved).reshape(-1, 3, len(some), 3)
