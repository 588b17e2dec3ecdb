"""A pose graph of a robot that goes round a square, for the tests of pose graphs."""

import numpy as np

from slamlab.geometry import between, compose, wrap
from slamlab.posegraph import PoseGraph, edge_error

SIGMA = np.array([0.05, 0.03, 0.02])  # of a measured motion, in the frame it starts from
INFORMATION = np.diag(SIGMA**-2)  # of an edge that does not turn
SIDE = 6


def square_tour(rng, laps=2, noise=1.0, drift=1.0, robust=False):
    """A graph of a robot that goes round a square, and the true poses.

    Each pose is tied to the one before, and by a loop's closure to the one a round ago; the guesses
    are reckoned from motions with their noise.
    """
    turn = np.array([*[0.0] * (SIDE - 1), np.pi / 2])
    motions = np.column_stack([np.ones(4 * SIDE), np.zeros(4 * SIDE), np.tile(turn, 4)])
    true = [np.zeros(3)]
    for motion in np.tile(motions, (laps, 1)):
        true.append(compose(true[-1], motion))
    true = np.array(true)
    graph, guess = PoseGraph(), true[0]
    graph.add_pose(guess)
    for k in range(1, len(true)):
        motion = between(true[k - 1], true[k])
        guess = compose(guess, motion + drift * SIGMA * rng.standard_normal(3))
        graph.add_pose(guess)
        measured = motion + noise * SIGMA * rng.standard_normal(3)
        graph.add_edge(k - 1, k, measured, turned(measured))
        if k >= 4 * SIDE:
            seen = between(true[k], true[k - 4 * SIDE]) + noise * SIGMA * rng.standard_normal(3)
            graph.add_edge(k, k - 4 * SIDE, seen, turned(seen), robust=robust)
    return graph, true


def turned(measured):
    """The information of the residual of an edge so measured."""
    return edge_error.information(measured, np.diag(SIGMA**2))


def whitened(graph, free):
    """What least_squares takes: residuals of all edges over the poses but the first."""
    at = np.concatenate([graph.poses[:1], free.reshape(-1, 3)])
    i, j, measured, information, _ = map(np.array, zip(*graph.edges, strict=True))
    e = edge_error.error(at[i], at[j], measured)
    return np.einsum("mba,mb->ma", np.linalg.cholesky(information), e).ravel()


def largest_deviation(graph, a, b):
    """The largest difference between two sets of poses, in standard deviations of the graph."""
    difference = a - b
    difference[:, 2] = wrap(difference[:, 2])
    deviations = np.sqrt(np.diagonal(graph.covariances(), axis1=1, axis2=2))
    return np.abs(difference[1:] / deviations[1:]).max()
