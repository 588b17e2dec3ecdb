"""Marginal covariances of the poses of a pose graph: blocks of H⁻¹, by solving for its columns.

Each block is the inverse of a Schur complement of H, which marginalises out all other poses.
"""

import numpy as np

from slamlab.posegraph import edge_error, spanning_tree
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
    return edge_error.squared_distances(v, S)


def leave_one_out(problem, poses, edges):
    """Return how much the least χ² decreases (c,) if one edge is left out, for each edge number in
    ``edges`` (c,): eᵀ(Λ⁻¹ − J H⁻¹ Jᵀ)⁻¹e, at the optimum, poses (n, 3)."""
    ends = np.vstack([poses, np.zeros(3)])[problem.pairs[edges].T]
    at = *ends, problem.measured[edges]
    J = np.concatenate([J_i(*at), J_j(*at)], axis=-1)
    columns = problem.equations.to_columns(J, problem.pairs[edges])
    solved = _solved(_factorised(problem, poses), columns)
    k = len(columns), len(edges), 3
    P = np.einsum("kca,kcb->cab", columns.reshape(k), solved.reshape(k))
    v, S = edge_error.error(*at), spanning_tree.covariances(problem.information[edges]) - P
    return edge_error.squared_distances(v, S)


def _factorised(problem, poses):
    e = problem.errors(poses)[0]
    return factorise(problem.linearise(poses, e, np.ones(len(e)))[0])


def _columns(problem, factors, some):
    """Return the columns of H⁻¹ of some poses (k,): (n, 3, k, 3)."""
    pick = np.zeros((len(some), 3, 6))
    pick[:, :, :3] = np.eye(3)
    columns = problem.equations.to_columns(pick, np.column_stack([some, some]))
    return problem.equations.to_poses(_solved(factors, columns)).reshape(-1, 3, len(some), 3)


def _solved(factors, columns):
    strips = np.array_split(columns, max(1, -(-columns.shape[1] // STRIP)), axis=1)
    return np.hstack([factors.solve(strip) for strip in strips])
