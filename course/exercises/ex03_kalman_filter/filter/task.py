"""Task 03-filter: after each step, the posterior given all measurements so far."""

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex03_kalman_filter.beliefs import (
    MEASURED,
    STATES,
    covariances,
    either_sign,
    motions,
    noises,
    sensors,
    times,
    turned,
)
from course.exercises.ex03_kalman_filter.calls import CALLS

DRIVEN, STEPS = 4, 8


def drives(rng, states=STATES, measured=MEASURED, steps=STEPS, rows=DRIVEN):
    """Runs of different systems: prior, and measurements after each step."""
    x, P = either_sign(rng, 1, 4, (rows, states)), covariances(rng, rows, states, 0.6)
    F, Q = motions(rng, rows, states), noises(rng, rows, states)
    H, R = sensors(rng, rows, measured, states), noises(rng, rows, measured)
    truth, z = x + _drawn(rng, P), []
    for _ in range(steps):
        truth = times(F, truth) + _drawn(rng, Q)
        z.append(times(H, truth) + _drawn(rng, R))
    return {"x": x, "P": P, "zs": np.stack(z, axis=1), "F": F, "Q": Q, "H": H, "R": R}


def _drawn(rng, covariance):
    return times(np.linalg.cholesky(covariance), rng.standard_normal(covariance.shape[:2]))


@once
def everything(i):
    """Posteriors "xs" (drives, steps, n), "Ps" after each step, from one joint Gaussian of the
    whole run."""
    (rows, steps, m), n = i["zs"].shape, i["x"].shape[1]
    F, H, x, P = i["F"], i["H"], i["x"], i["P"]
    mean, joint = np.zeros((rows, steps, n)), np.zeros((rows, steps, steps, n, n))
    for k in range(steps):
        x, P = times(F, x), F @ P @ turned(F) + i["Q"]
        mean[:, k], joint[:, k, k] = x, P
        joint[:, k, :k] = F[:, None] @ joint[:, k - 1, :k]  # with each of the states before
        joint[:, :k, k] = turned(joint[:, k, :k])
    shared = joint @ turned(H)[:, None, None]
    S = H[:, None, None] @ shared + np.eye(steps)[:, :, None, None] * i["R"][:, None, None]
    S = S.swapaxes(2, 3).reshape(rows, steps * m, steps * m)
    off = (i["zs"] - times(H[:, None], mean)).reshape(rows, steps * m, 1)
    xs, Ps = np.zeros((rows, steps, n)), np.zeros((rows, steps, n, n))
    for k in range(steps):
        last = (k + 1) * m
        C = shared[:, k, : k + 1].swapaxes(1, 2).reshape(rows, n, last)
        K = turned(np.linalg.solve(S[:, :last, :last], turned(C)))
        xs[:, k] = mean[:, k] + (K @ off[:, :last])[..., 0]
        Ps[:, k] = joint[:, k, k] - K @ turned(C)
    return {"xs": xs, "Ps": Ps}


def _before_one(i):
    x, P = times(i["F"], i["x"]), i["F"] @ i["P"] @ turned(i["F"]) + i["Q"]
    return {"x before the first measurement": x[0], "P before it": P[0]}


FILTER = Task(
    id="03-filter",
    title="The Kalman filter on a run",
    call=CALLS["03-filter"],
    inputs=drives,
    shapes=lambda i: {
        "xs": (*i["zs"].shape[:2], i["x"].shape[1]),
        "Ps": (*i["zs"].shape[:2], *i["P"].shape[1:]),
    },
    laws=(
        equals(
            "estimates",
            2,
            "after each measurement x is the least-squares estimate from all measurements so far",
            lambda i: {"xs": everything(i)["xs"]},
            asks="How many steps has the system made before the first measurement? Which x and P "
            "do you have before the update, and with which x and P do you continue after it? Is "
            "everything in the later steps as in the first one?",
            step=_before_one,
        ),
        equals(
            "covariances",
            2,
            "after each measurement P is the covariance of that estimate's error",
            lambda i: {"Ps": everything(i)["Ps"]},
            asks="Print the variances in your Ps: they should become constant after a few steps. "
            "Which line of your code increases them, and which line decreases them?",
            step=_before_one,
        ),
    ),
    needs=("03-update",),
    probes=(
        Probe("one step", lambda rng: drives(rng, steps=1)),
        Probe("two states and one measured number", lambda rng: drives(rng, 2, 1)),
        Probe("one state and one measured number", lambda rng: drives(rng, 1, 1, steps=3)),
        Probe("more measured numbers than states", lambda rng: drives(rng, 2, 3, steps=3)),
        Probe("a long run", lambda rng: drives(rng, 2, 1, steps=30, rows=1)),
    ),
    begins=(
        "Which two functions of this exercise make one step of the filter, and in which order?",
        "What must your loop keep from one step for the next step?",
    ),
)
