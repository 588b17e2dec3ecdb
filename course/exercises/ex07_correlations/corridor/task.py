"""Task of exercise 07: SLAM in one dimension, judged by NEES."""

import numpy as np

from classroom.exercises.correctness_laws import Law, equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex07_correlations.beliefs import EXACT, T, covariances, expected_nees
from course.exercises.ex07_correlations.calls import CALLS
from slamlab.evaluation import band

RUNS, STEPS = 60, 24
PRIOR = 2.0  # standard deviation of what is known of the doors at first [m]


def walks(rng, runs=RUNS, steps=STEPS, doors=3):
    """Runs to and fro along a corridor, one poorly known door measured per step."""
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
    # the motion is exactly 0
    inputs = walks(rng, 3, 5)
    return inputs | {"d": 0 * inputs["d"], "q": 0 * inputs["q"]}


def _slipping(rng):
    # the odometry is 0, but uncertain
    inputs = walks(rng, 3, 5)
    return inputs | {"d": 0 * inputs["d"]}


def _shared(rng):
    # robot and doors are correlated from the start
    return walks(rng, 4, 6) | {"P": covariances(rng, rng.uniform(0.5, 2, (4, 4)))}


def _one_step(rng):
    return walks(rng, 4, 1) | {"P": covariances(rng, rng.uniform(0.5, 2, (4, 4)))}


@once
def batch(inputs):
    """Robot's end and doors x (runs, n), P (runs, n, n) given all motions and measurements at
    once."""
    # Every measurement is a sum of the initial unknowns, the motions' errors and its own error: all
    # of them are one Gaussian vector of known mean and covariance.
    x, P, q = inputs["x"], inputs["P"], inputs["q"]
    (runs, n), steps = x.shape, q.shape[1]
    doors = inputs["i"].astype(int)
    start = np.zeros((runs, steps, n))  # a measurement by the state at the start
    start[:, :, 0] = -1
    start[np.arange(runs)[:, None], np.arange(steps), doors] = 1
    drives = -np.tri(steps)  # and by the drives so far
    end = np.zeros((n, steps))
    end[0] = 1  # the robot's end by all drives
    C = P @ T(start) + (end * q[:, None]) @ drives.T  # cross-covariance of end and measurements
    S = start @ P @ T(start) + (drives * q[:, None]) @ drives.T + _diagonal(inputs["r"])
    v = inputs["z"] - (start @ x[:, :, None])[:, :, 0] - inputs["d"] @ drives.T
    K = T(np.linalg.solve(S, T(C)))
    before = P + (end * q[:, None]) @ end.T
    return x + inputs["d"] @ end.T + (K @ v[:, :, None])[:, :, 0], before - K @ T(C)


def _diagonal(rows):
    return rows[:, :, None] * np.eye(rows.shape[1])


def _nees(inputs, outputs):
    return expected_nees(outputs["x"], outputs["P"], *batch(inputs)).mean()


def _honest(inputs, outputs):
    low, high = band(inputs["x"].shape[1], len(inputs["x"]))
    return low <= _nees(inputs, outputs) <= high


def _dishonest(inputs, outputs):
    n, found = inputs["x"].shape[1], _nees(inputs, outputs)
    much = "overconfident" if found > n else "too conservative"
    return f"the mean NEES is {found:.3g}, and {n} for a consistent filter: yours is {much}"


def _first_step(inputs):
    x, P = inputs["x"], inputs["P"].copy()
    P[:, 0, 0] += inputs["q"][:, 0]
    i = inputs["i"][:, 0].astype(int)
    shared = P[np.arange(len(x)), :, i] - P[:, :, 0]
    S = shared[np.arange(len(x)), i] - shared[:, 0] + inputs["r"][:, 0]
    return {"P Hᵀ of the first step": shared, "its S": S}


EXACTLY = ("mean", "covariance")


def _promised(inputs):
    return (inputs["r"] > 0).all(axis=1)


CORRIDOR = Task(
    id="07-corridor",
    title="SLAM in a corridor",
    call=CALLS["07-corridor"],
    inputs=walks,
    shapes=lambda inputs: {
        "x": (None, inputs["x"].shape[1]),
        "P": (None, *inputs["P"].shape[1:]),
    },
    probes=(
        Probe("a single step", _one_step, EXACTLY),
        Probe("one door", lambda rng: walks(rng, 3, 4, doors=1), EXACTLY),
        Probe("seven doors", lambda rng: walks(rng, 3, 9, doors=7), EXACTLY),
        Probe("a motion of 0 m with the variance 0", _at_rest, EXACTLY),
        Probe("a motion of 0 m with a variance above 0", _slipping, EXACTLY),
        Probe("robot and doors correlated from the start", _shared, EXACTLY),
    ),
    laws=(
        equals(
            "mean",
            1,
            "x is the least squares estimate from all motions and measurements",
            lambda inputs: {"x": batch(inputs)[0]},
            tolerance=EXACT,
            asks="Which entries of x does K change? By how much does it change a door that is not "
            "measured?",
            step=_first_step,
        ),
        equals(
            "covariance",
            1.5,
            "P is the covariance of this least squares estimate",
            lambda inputs: {"P": batch(inputs)[1]},
            tolerance=EXACT,
            asks="Which entries of P does a motion change, and which entries does a measurement "
            "change?",
            step=_first_step,
        ),
        Law(
            "nees",
            1,
            f"over {RUNS} runs, the mean NEES at the end lies in its χ² band",
            _honest,
            why=_dishonest,
            asks="Do you use any information twice? Do you set a correlation in P to zero?",
            after=("mean", "covariance"),
            step=_first_step,
        ),
    ),
    may_round=_promised,
    begins=(
        "Which entries of x and P change if the robot moves by d?",
        "How does the distance from the robot to door i depend on x?",
    ),
)
