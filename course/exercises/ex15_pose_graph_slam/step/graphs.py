"""Small pose graphs and their Gauss–Newton step, by an orthogonal decomposition without H."""

import numpy as np

from classroom.exercises.task import Probe
from course.exercises.ex15_pose_graph_slam.edges import sized
from slamlab.geometry import between, compose, wrap
from slamlab.posegraph.edge_error import error
from slamlab.posegraph.edge_jacobians import J_i, J_j

STILL = 1e-6  # [rad]; less of a turn is rounding
RING = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (1, 3)]


def graphs(rng, count=3, pairs=RING, noise=1.0, off=1.0):
    """Graphs over the same pairs; in each a heading crosses π in the first step. poses
    (count, n, 3), pairs (count, m, 2), measured (count, m, 3), information (count, m, 3, 3).
    """
    made = [_one(rng, np.array(pairs), noise, off) for _ in range(count)]
    return {name: np.array([graph[name] for graph in made]) for name in made[0]}


def _one(rng, pairs, noise, off):
    n, m = pairs.max() + 1, len(pairs)
    steps = np.column_stack([rng.uniform(0.8, 2, n - 1), rng.uniform(-0.6, 0.6, n - 1)])
    steps = np.column_stack([steps, rng.choice([-1, 1]) * rng.uniform(0.4, 1.1, n - 1)])
    truth = [np.append(rng.uniform(1, 3, 2), rng.uniform(-2, 2))]
    for step in steps:
        truth.append(compose(truth[-1], step))
    truth = np.array(truth)
    i, j = pairs.T
    graph = {
        "poses": compose(truth, off * sized(rng, 0.1, 0.3, truth.shape)),
        "pairs": pairs,
        "measured": compose(between(truth[i], truth[j]), noise * sized(rng, 0.03, 0.15, (m, 3))),
        "information": np.array([drawn_information(rng) for _ in pairs]),
    }
    return graph | {"poses": _across(rng, graph)}


def drawn_information(rng):
    sigma = rng.uniform(0.3, 1.6, 3)
    mixed = np.eye(3) + np.triu(sized(rng, 0.2, 0.5, (3, 3)), 1)  # never singular
    return np.linalg.inv(mixed @ np.diag(sigma**2) @ mixed.T)


def _across(rng, graph):
    """The poses, turned such that one of their headings will step over π."""
    poses = graph["poses"]
    steps = best(**graph)[:, 2]
    k = 1 + int(np.argmax(np.abs(steps[1:])))
    if np.abs(steps[k]) < STILL:
        return poses
    edge = np.pi if steps[k] > 0 else -np.pi
    share = rng.uniform(0.3, 0.7)
    turn = np.array([0, 0, wrap(float(edge - share * steps[k] - poses[k, 2]))])
    return compose(turn, poses)


def whitened(poses, pairs, measured, information):
    """J (3m, 3n) and r (3m,): the linearised cost is |J δ + r|²."""
    i, j = np.asarray(pairs, dtype=int).T
    at, edge = (poses[i], poses[j], measured), np.arange(len(i))
    U = np.linalg.cholesky(information).swapaxes(1, 2)
    J = np.zeros((len(i), len(poses), 3, 3))
    J[edge, i], J[edge, j] = U @ J_i(*at), U @ J_j(*at)
    r = U @ error(*at)[..., None]
    return J.swapaxes(1, 2).reshape(-1, 3 * len(poses)), r.ravel()


def split(edges):
    """The three arrays of edges (i, j, z, Λ), each of which is one row of 14 numbers."""
    information = edges[..., 5:].reshape(*edges.shape[:-1], 3, 3)
    return {"pairs": edges[..., :2], "measured": edges[..., 2:5], "information": information}


def best(poses, pairs, measured, information):
    """(n, 3) the step of least linearised cost, pose 0 held."""
    J, r = whitened(poses, pairs, measured, information)
    delta = np.linalg.lstsq(J[:, 3:], -r, rcond=None)[0]
    return np.vstack([np.zeros(3), delta.reshape(-1, 3)])


def each(function, inputs):
    """A function of one graph, for all of them."""
    return np.array([function(*row) for row in zip(*inputs.values(), strict=True)])


BACK = [(1, 0), (2, 1), (3, 2), (3, 0)]
TWICE = [(0, 1), (0, 1), (1, 2), (2, 1), (0, 2)]
LONG = [(k, k + 1) for k in range(8)] + [(8, 0), (7, 1), (2, 6), (5, 3)]

PROBES = (
    Probe("two poses and one edge", lambda rng: graphs(rng, 2, [(0, 1)])),
    Probe("edges that point backwards", lambda rng: graphs(rng, 2, BACK)),
    Probe("several edges between two poses", lambda rng: graphs(rng, 2, TWICE)),
    Probe("nine poses, edges in any order", lambda rng: graphs(rng, 1, rng.permutation(LONG))),
    Probe("a chain without a loop", lambda rng: graphs(rng, 1, RING[:4])),
    Probe("poses of least cost", lambda rng: graphs(rng, 1, noise=0.0, off=0.0)),
)
