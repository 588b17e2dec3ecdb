"""The task of exercise 07 about SLAM in one dimension: correlations kept, judged by NEES."""

import numpy as np

from slamlab.evaluation import band
from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Law, equals, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex07.beliefs import EXACT, T, covariances, expected_nees

RUNS, STEPS = 60, 24
PRIOR = 2.0  # standard deviation of what is known of the doors at first [m]


def walks(rng, runs=RUNS, steps=STEPS, doors=3):
    """Walks to and fro along a corridor whose doors are hardly known, one door seen each step."""
    q = rng.uniform(0.02, 0.15, (runs, steps)) ** 2
    r = rng.uniform(0.03, 0.1, (runs, steps)) ** 2
    places = np.sort(rng.uniform(0, 3 * doors, (runs, doors)), axis=1)
    way = 4 + 4 * np.sin(np.arange(1, steps + 1) * 0.7 - 0.9)
    d = np.diff(way, prepend=0) + np.sqrt(q) * rng.standard_normal((runs, steps))
    i = rng.integers(1, doors + 1, (runs, steps))
    first = min(doors, steps)
    i[:, :first] = rng.permuted(np.tile(np.arange(1, doors + 1), (runs, 1)), axis=1)[:, :first]
    z = np.take_along_axis(places, i - 1, axis=1) - way
    z += np.sqrt(r) * rng.standard_normal((runs, steps))
    x = np.column_stack([np.zeros(runs), places + PRIOR * rng.standard_normal((runs, doors))])
    P = np.tile(np.diag([0, *doors * [PRIOR**2]]), (runs, 1, 1))
    return {"x": x, "P": P, "d": d, "q": q, "i": i.astype(float), "z": z, "r": r}


def _at_rest(rng):
    """Nobody drives: the way is 0, and surely so."""
    inputs = walks(rng, 3, 5)
    return inputs | {"d": 0 * inputs["d"], "q": 0 * inputs["q"]}


def _slipping(rng):
    """The way is 0 by the wheels, which may err."""
    inputs = walks(rng, 3, 5)
    return inputs | {"d": 0 * inputs["d"]}


def _shared(rng):
    """Robot and doors share errors from the start."""
    return walks(rng, 4, 6) | {"P": covariances(rng, rng.uniform(0.5, 2, (4, 4)))}


def _one_step(rng):
    return walks(rng, 4, 1) | {"P": covariances(rng, rng.uniform(0.5, 2, (4, 4)))}


@once
def batch(inputs):
    """Robot's end and doors from all drives and sights at once, not step by step.

    Every sight is a sum of what was unknown at first, the drives' errors, and its own error: so all
    sights together are one vector, known in advance with a mean and a covariance.

    Returns
    -------
    x (runs, n), P (runs, n, n)
    """
    x, P, q = inputs["x"], inputs["P"], inputs["q"]
    (runs, n), steps = x.shape, q.shape[1]
    doors = inputs["i"].astype(int)
    start = np.zeros((runs, steps, n))  # a sight by the state at the start
    start[:, :, 0] = -1
    start[np.arange(runs)[:, None], np.arange(steps), doors] = 1
    drives = -np.tri(steps)  # and by the drives so far
    end = np.zeros((n, steps))
    end[0] = 1  # the robot's end by all drives
    C = P @ T(start) + (end * q[:, None]) @ drives.T  # what end and sights share
    S = start @ P @ T(start) + (drives * q[:, None]) @ drives.T + _diagonal(inputs["r"])
    v = inputs["z"] - (start @ x[:, :, None])[:, :, 0] - inputs["d"] @ drives.T
    K = T(np.linalg.solve(S, T(C)))
    before = P + (end * q[:, None]) @ end.T
    return x + inputs["d"] @ end.T + (K @ v[:, :, None])[:, :, 0], before - K @ T(C)


def _diagonal(rows):
    return rows[:, :, None] * np.eye(rows.shape[1])


def _nees(inputs, outputs):
    """Mean NEES of the walks."""
    return expected_nees(outputs["x"], outputs["P"], *batch(inputs)).mean()


def _honest(inputs, outputs):
    low, high = band(inputs["x"].shape[1], len(inputs["x"]))
    return low <= _nees(inputs, outputs) <= high


def _dishonest(inputs, outputs):
    n, found = inputs["x"].shape[1], _nees(inputs, outputs)
    much = "surer than it may be" if found > n else "less sure than it could be"
    return f"the mean NEES is {found:.3g}, an honest filter's is {n}: this one is {much}"


def _first_step(inputs):
    """S of the first sight of each walk, and what it shares with the state."""
    x, P = inputs["x"], inputs["P"].copy()
    P[:, 0, 0] += inputs["q"][:, 0]
    i = inputs["i"][:, 0].astype(int)
    shared = P[np.arange(len(x)), :, i] - P[:, :, 0]
    S = shared[np.arange(len(x)), i] - shared[:, 0] + inputs["r"][:, 0]
    return {"P Hᵀ of the first step": shared, "its S": S}


EXACTLY = ("mean", "covariance")


def _promised(inputs):
    """(n,) whether all r are positive."""
    return (inputs["r"] > 0).all(axis=1)


CORRIDOR = Task(
    id="07-corridor",
    title="SLAM in a corridor",
    drive=DRIVES["07-corridor"],
    inputs=walks,
    shapes=lambda inputs: {
        "x": (None, inputs["x"].shape[1]),
        "P": (None, *inputs["P"].shape[1:]),
    },
    probes=(
        Probe("a single step", _one_step, EXACTLY),
        Probe("one door", lambda rng: walks(rng, 3, 4, doors=1), EXACTLY),
        Probe("seven doors", lambda rng: walks(rng, 3, 9, doors=7), EXACTLY),
        Probe("a drive of 0 m with the variance 0", _at_rest, EXACTLY),
        Probe("a drive of 0 m that errs", _slipping, EXACTLY),
        Probe("errors shared from the start", _shared, EXACTLY),
    ),
    laws=(
        equals(
            "mean",
            1,
            "x is what least squares makes of all drives and sights at once",
            lambda inputs: {"x": batch(inputs)[0]},
            tolerance=EXACT,
            asks="Which entries of x does K change, and by how much for a door out of sight?",
            step=_first_step,
        ),
        equals(
            "covariance",
            1.5,
            "P is the covariance of that least-squares solution",
            lambda inputs: {"P": batch(inputs)[1]},
            tolerance=EXACT,
            asks="Which entries of P does a drive change, and which does a sight?",
            step=_first_step,
        ),
        Law(
            "nees",
            1,
            f"over {RUNS} walks the mean NEES of the end lies in its band",
            _honest,
            why=_dishonest,
            asks="Has anything been counted twice, or been forgotten that P should remember?",
            after=("mean", "covariance"),
        ),
    ),
    rounds=_promised,
)
