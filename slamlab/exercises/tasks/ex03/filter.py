"""Task 03-filter: after each measurement, what all measurements so far say together."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import equals, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex03.beliefs import (
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

DRIVEN, STEPS = 4, 8


def drives(rng, states=STATES, measured=MEASURED, steps=STEPS, rows=DRIVEN):
    """Drives of different systems: the belief before, and what was measured after each step."""
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
    """What all measurements up to each step say of the state then, all of them taken at once.

    States and measurements of a whole drive are one Gaussian; of that the states are the mean and
    the covariance, given the measurements. Nothing is done step by step.

    Returns
    -------
    "xs" (drives, steps, n), "Ps" (drives, steps, n, n)
    """
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


def _after_one(i):
    first = everything(i | {"zs": i["zs"][:, :1]})
    return {"x after the first measurement": first["xs"][0, 0]}


FILTER = Task(
    id="03-filter",
    title="The whole filter",
    drive=DRIVES["03-filter"],
    inputs=drives,
    shapes=lambda i: {
        "xs": (*i["zs"].shape[:2], i["x"].shape[1]),
        "Ps": (*i["zs"].shape[:2], *i["P"].shape[1:]),
    },
    laws=(
        equals(
            "estimates",
            2,
            "after each measurement x is what all measurements so far say, taken at once",
            lambda i: {"xs": everything(i)["xs"]},
            asks="Follow the first measurement on paper: how many steps has the cart driven when "
            "it is made, and which belief do you go on with afterwards?",
            step=_after_one,
        ),
        equals(
            "covariances",
            2,
            "after each measurement P is the covariance of that estimate's error",
            lambda i: {"Ps": everything(i)["Ps"]},
            asks="Print the variances of your Ps: they should settle after a few steps. Which line "
            "makes them grow, and which makes them shrink?",
        ),
    ),
    needs=("03-update",),
    probes=(
        Probe("one step", lambda rng: drives(rng, steps=1)),
        Probe("two states and one measured number", lambda rng: drives(rng, 2, 1)),
        Probe("one state and one measured number", lambda rng: drives(rng, 1, 1, steps=3)),
        Probe("more measured numbers than states", lambda rng: drives(rng, 2, 3, steps=3)),
        Probe("a long drive", lambda rng: drives(rng, 2, 1, steps=30, rows=1)),
    ),
)
