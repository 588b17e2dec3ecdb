"""Task 13-line-step: what walls across and odometry say together of a small correction."""

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex13.motions import carried, either_sign, motion

TURN = np.array([[0.0, -1.0], [1.0, 0.0]])  # by a quarter to the left


def pairs(rng, rows=6, n=14, spread=np.pi, off=1.0, tie=(0.3, 0.7)):
    """Points beside walls, and a guess of odometry with a full covariance.

    Parameters
    ----------
    rng : numpy.random.Generator
    rows, n : int
    spread : float, how far walls may be turned from one direction [rad]; 0: a corridor
    off : float, by how much 10 cm and 4 degrees the guess is off
    tie : (low, high) of the correlations of the guess's errors

    Returns
    -------
    dict of source, target and normals (k, n, 2), sigma (k, n), T (k, 3, 3) and Q (k, 3, 3)
    """
    T = motion(*either_sign(rng, 0.5, 3, (2, rows)), either_sign(rng, 0.5, 2.7, rows))
    x, y, turn = off * either_sign(rng, 0.05, 0.1, (3, rows))
    true = T @ motion(x, y, 0.7 * turn)
    way = rng.uniform(-np.pi, np.pi, (rows, 1)) + rng.uniform(-spread, spread, (rows, n))
    normals = either_sign(rng, 1, 1, (rows, n, 1)) * np.stack([np.cos(way), np.sin(way)], axis=-1)
    sigma = rng.uniform(0.005, 0.03, (rows, n))
    target = true[:, None, :2, 2] + either_sign(rng, 0.5, 3, (rows, n, 2))
    seen = target + off * normals @ TURN * rng.uniform(-0.1, 0.1, (rows, n, 1))
    seen = seen + off * (sigma * rng.normal(size=(rows, n)))[..., None] * normals
    one, two, three = either_sign(rng, *tie, (3, rows))
    L = np.zeros((rows, 3, 3))
    L[:, range(3), range(3)], L[:, 1, 0], L[:, 2, 0], L[:, 2, 1] = 1, one, two, three
    L *= rng.uniform(0.6, 1.4, (rows, 3, 1)) * np.array([0.1, 0.08, 0.06])[:, None]
    return {
        "source": carried(np.linalg.inv(true), seen),
        "target": target,
        "normals": normals,
        "sigma": sigma,
        "T": T,
        "Q": L @ L.mT,
    }


def _whole(rng):
    """Walls along x and y, whole metres; the first guess is without any motion."""
    inputs = pairs(rng, 3, 8)
    source = rng.integers(-4, 5, (3, 8, 2))
    normals = np.resize([[1, 0], [0, 1], [-1, 0], [0, -1]], (3, 8, 2))
    target = source + rng.integers(-1, 2, (3, 8, 2))
    inputs["T"][0] = np.eye(3)
    return inputs | {"source": source, "target": target, "normals": normals}


def linearised(inputs):
    """How far each point is off across its wall e (k, n), and its slopes J (k, n, 3)."""
    T, a, n = inputs["T"], inputs["source"], inputs["normals"]
    e = np.sum(n * (carried(T, a) - inputs["target"]), axis=-1)
    seen = n @ T[:, :2, :2]  # the normals as the robot sees them
    lever = a[..., 0] * seen[..., 1] - a[..., 1] * seen[..., 0]
    return e, np.concatenate([seen, lever[..., None]], axis=-1)


def want(inputs):
    """The least squares of walls and odometry together, stacked and solved without a JᵀJ."""
    e, J = linearised(inputs)
    whitening = np.linalg.inv(np.linalg.cholesky(inputs["Q"]))  # of the guess's error
    rows = np.concatenate([J / inputs["sigma"][..., None], whitening], axis=1)
    wanted = np.concatenate([-e / inputs["sigma"], np.zeros((len(e), 3))], axis=1)
    q, upper = np.linalg.qr(rows)
    back = np.linalg.inv(upper)
    return {"delta": (back @ (q.mT @ wanted[..., None]))[..., 0], "P": back @ back.mT}


def _on_the_way(inputs):
    e, J = linearised(inputs)
    return {"e": e, "J": J}


LINE_STEP = Task(
    id="13-line-step",
    title="A step across walls, and how sure it is",
    drive=DRIVES["13-line-step"],
    inputs=pairs,
    shapes=lambda i: {"delta": (len(i["T"]), 3), "P": (len(i["T"]), 3, 3)},
    laws=(
        equals(
            "step",
            2.5,
            "no other δ makes the sum of squares of walls and odometry smaller",
            lambda inputs: {"delta": want(inputs)["delta"]},
            asks="The robot turns by dθ about itself. Which way does a point go that it sees at "
            "a, in its own frame? And how does n look from there?",
            step=_on_the_way,
        ),
        equals(
            "covariance",
            2.5,
            "P is the inverse of what walls and odometry know together",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="Without a single pair, what is P? And what does each pair add to its inverse?",
            step=_on_the_way,
        ),
    ),
    probes=(
        Probe("a corridor", lambda rng: pairs(rng, 3, 10, spread=0)),
        Probe("no pairs", lambda rng: pairs(rng, 2, 0)),
        Probe("one pair", lambda rng: pairs(rng, 2, 1)),
        Probe("forty pairs", lambda rng: pairs(rng, 1, 40)),
        Probe("points that lie on their walls", lambda rng: pairs(rng, 2, 6, off=0)),
        Probe("Q diagonal", lambda rng: pairs(rng, 2, 5, tie=(0, 0))),
        Probe("walls along x and y, whole numbers", _whole),
    ),
    parts=lambda inputs, outputs: {name: outputs[name] for name in ("delta", "P")},
    rounds=False,
)
