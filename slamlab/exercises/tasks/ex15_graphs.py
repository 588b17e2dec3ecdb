"""Small pose graphs, and the step that lowers their linearised cost most, without normal equations.

The law needs no H: it solves the same least squares by an orthogonal decomposition.
"""

import numpy as np

from slamlab.geometry import between, compose, wrap
from slamlab.posegraph.edge_error import error
from slamlab.posegraph.edge_jacobians import J_i, J_j

GRAPHS, POSES = 3, 5
PAIRS = np.array([[0, 1], [1, 2], [2, 3], [3, 4], [4, 0], [1, 3]])


def graphs(rng):
    """Graphs of a chain, a loop and a shortcut; in each a heading crosses π in the first step.

    Returns
    -------
    dict of poses (g, n, 3), pairs (g, m, 2), measured (g, m, 3) and information (g, m, 3, 3)
    """
    made = [_one(rng) for _ in range(GRAPHS)]
    return {name: np.array([graph[name] for graph in made]) for name in made[0]}


def _one(rng):
    steps = np.column_stack([rng.uniform(0.8, 2, POSES - 1), rng.uniform(-0.6, 0.6, POSES - 1)])
    steps = np.column_stack([steps, rng.choice([-1, 1]) * rng.uniform(0.4, 1.1, POSES - 1)])
    truth = [np.append(rng.uniform(1, 3, 2), rng.uniform(-2, 2))]
    for step in steps:
        truth.append(compose(truth[-1], step))
    truth = np.array(truth)
    i, j = PAIRS.T
    noise = rng.uniform(0.03, 0.15, (len(PAIRS), 3)) * rng.choice([-1, 1], (len(PAIRS), 3))
    measured = compose(between(truth[i], truth[j]), noise)
    guess = rng.uniform(0.1, 0.3, truth.shape) * rng.choice([-1, 1], truth.shape)
    graph = {
        "poses": compose(truth, guess),
        "pairs": PAIRS,
        "measured": measured,
        "information": np.array([_information(rng) for _ in PAIRS]),
    }
    return graph | {"poses": _across(rng, graph)}


def _information(rng):
    """The inverse of a covariance, no diagonal one [1/m², 1/rad²]."""
    sigma = rng.uniform(0.3, 1.6, 3)
    mixed = np.eye(3) + rng.uniform(0.2, 0.5, (3, 3)) * rng.choice([-1, 1], (3, 3))
    return np.linalg.inv(mixed @ np.diag(sigma**2) @ mixed.T)


def _across(rng, graph):
    """The poses, turned as a whole such that one of their headings will step over π."""
    poses = graph["poses"]
    steps = best(**graph)[:, 2]
    k = 1 + int(np.argmax(np.abs(steps[1:])))
    edge = np.pi if steps[k] > 0 else -np.pi
    share = rng.uniform(0.3, 0.7)
    turn = np.array([0, 0, wrap(float(edge - share * steps[k] - poses[k, 2]))])
    return compose(turn, poses)


def whitened(poses, pairs, measured, information):
    """J and r of one graph such that the linearised cost is |J δ + r|².

    Parameters
    ----------
    poses : (n, 3)
    pairs : (m, 2) int
    measured : (m, 3)
    information : (m, 3, 3)

    Returns
    -------
    (3m, 3n), (3m,)
    """
    i, j = np.asarray(pairs, dtype=int).T
    at, edge = (poses[i], poses[j], measured), np.arange(len(i))
    U = np.linalg.cholesky(information).swapaxes(1, 2)
    J = np.zeros((len(i), len(poses), 3, 3))
    J[edge, i], J[edge, j] = U @ J_i(*at), U @ J_j(*at)
    r = U @ error(*at)[..., None]
    return J.swapaxes(1, 2).reshape(-1, 3 * len(poses)), r.ravel()


def best(poses, pairs, measured, information):
    """(n, 3) the step of least linearised cost that leaves pose 0 where it is."""
    J, r = whitened(poses, pairs, measured, information)
    delta = np.linalg.lstsq(J[:, 3:], -r, rcond=None)[0]
    return np.vstack([np.zeros(3), delta.reshape(-1, 3)])


def each(function, inputs):
    """A function of one graph, for all of them."""
    return np.array([function(*row) for row in zip(*inputs.values(), strict=True)])
