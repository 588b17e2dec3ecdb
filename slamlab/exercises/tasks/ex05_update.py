"""Exercise 05, the two updates: a pose by a known landmark, a landmark from a known pose."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex05 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex04_laws import by_landmark, by_robot
from slamlab.exercises.tasks.ex05_batch import (
    covariances,
    deviations,
    each,
    gain,
    innovation,
    placed,
    same_covariance,
    same_mean,
    sandwich,
    times,
    turned,
    variances,
)
from slamlab.exercises.tasks.ex05_mistakes import covariance_of, diagnoses, mean_of
from slamlab.geometry import wrap
from slamlab.models import jacobians

ROWS, BEHIND = 18, 6
SEEN_AHEAD, SEEN_BEHIND = slice(BEHIND, None), slice(0, BEHIND)


def _sightings(rng):
    """Poses, landmarks and measurements; of the first rows the bearing crosses ±π."""
    x = np.column_stack([rng.uniform(-5, 5, (ROWS, 2)), rng.uniform(-3, 3, ROWS)])
    r, side = rng.uniform(1.5, 5, ROWS), (-1.0) ** (np.arange(ROWS) + rng.integers(2))
    bearing = side * rng.uniform(0.4, 2.4, ROWS)
    bearing[SEEN_BEHIND] = side[SEEN_BEHIND] * (np.pi - rng.uniform(0.01, 0.03, BEHIND))
    p = each(models.g, x, np.column_stack([r, bearing]))
    sigma = np.column_stack([rng.uniform(0.05, 0.15, ROWS), rng.uniform(0.02, 0.05, ROWS)])
    off = rng.choice([-1.0, 1.0], (ROWS, 2)) * rng.uniform(0.06, 0.15, (ROWS, 2))
    off[SEEN_BEHIND, 1] = side[SEEN_BEHIND] * np.abs(off[SEEN_BEHIND, 1])
    z = np.column_stack([r, bearing]) + off
    z[:, 1] = wrap(z[:, 1])
    return x, p, z, variances(sigma)


def located(rng):
    """A pose in doubt, a landmark that is known."""
    x, p, z, R = _sightings(rng)
    sigma = np.column_stack([rng.uniform(0.08, 0.2, (ROWS, 2)), rng.uniform(0.04, 0.1, ROWS)])
    return {"x": x, "P": covariances(rng, sigma), "z": z, "p": p, "R": R}


def landmarks(rng):
    """A landmark in doubt, a pose that is known."""
    x, p, z, R = _sightings(rng)
    P = covariances(rng, rng.uniform(0.08, 0.3, (ROWS, 2)))
    return {"p": p, "P": P, "x": x, "z": z, "R": R}


# ---- laws: the least squares of what was believed and what was seen --------------------------


def least_squares(inputs, H):
    """Correction and covariance that the stacked problem has: belief above, measurement below.

    minimise δᵀ P⁻¹ δ + (v − H δ)ᵀ R⁻¹ (v − H δ) over the correction δ

    Parameters
    ----------
    inputs : x, p, z, P, R
    H : (n, 2, k), by differences of h

    Returns
    -------
    (n, k), (n, k, k)
    """
    weight = turned(H) @ np.linalg.inv(inputs["R"])
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + weight @ H)
    v = innovation(inputs["x"], inputs["p"], inputs["z"])
    return times(P, times(weight, v)), P


def _laws(state, what, by_differences):
    def mean(rows):
        def holds(inputs, outputs):
            step, P = least_squares(inputs, by_differences(inputs))
            want, sigma = inputs[state] + step, deviations(P)
            return same_mean(outputs[state], want, sigma, heading=state == "x")[rows]

        return holds

    def covariance(inputs, outputs):
        return same_covariance(outputs["P"], least_squares(inputs, by_differences(inputs))[1])

    return (
        Law(
            "mean",
            2,
            f"the new {what} weighs belief and measurement as least squares does",
            mean(SEEN_AHEAD),
        ),
        Law(
            "behind", 1, "so it does when the landmark is right behind the robot", mean(SEEN_BEHIND)
        ),
        Law("covariance", 2, "P is the covariance of that least squares estimate", covariance),
    )


# ---- mistakes -------------------------------------------------------------------------------


def _H_robot(inputs):
    return each(jacobians.H_robot, inputs["x"], inputs["p"])


def _H_landmark(inputs):
    return each(jacobians.H_landmark, inputs["x"], inputs["p"])


def _with_H(inputs, H):
    """The updated P of another H."""
    K, S = gain(inputs["P"], H, inputs["R"])
    return inputs["P"] - sandwich(K, S)


def _overwritten(inputs):
    return placed(inputs["x"], inputs["z"], inputs["R"])


LOCATE = Task(
    id="05-locate",
    title="Where am I: one known landmark",
    drive=DRIVES["05-locate"],
    inputs=located,
    shapes={"x": (ROWS, 3), "P": (ROWS, 3, 3)},
    laws=_laws("x", "pose", by_robot),
    diagnoses=diagnoses("x", _H_robot, SEEN_BEHIND),
)

LANDMARK = Task(
    id="05-landmark",
    title="Where is it: one landmark from a known pose",
    drive=DRIVES["05-landmark"],
    inputs=landmarks,
    shapes={"p": (ROWS, 2), "P": (ROWS, 2, 2)},
    laws=_laws("p", "landmark", by_landmark),
    diagnoses=(
        mean_of(
            "p",
            "overwritten",
            "The landmark was placed anew by g: what was believed before is lost. A second "
            "sighting corrects the first one, weighed by P and R.",
            lambda i: _overwritten(i)[0],
        ),
        covariance_of(
            "first-sight",
            "P is what one sighting gives, as if nothing had been known before: it must be smaller "
            "than that, and smaller than the old P.",
            lambda i: _overwritten(i)[1],
        ),
        covariance_of(
            "H-transposed",
            "H stands transposed somewhere. It is square here, so no shape complains: S = H P Hᵀ "
            "+ R and K = P Hᵀ S⁻¹.",
            lambda i: _with_H(i, turned(_H_landmark(i))),
        ),
        covariance_of(
            "J_z-for-H",
            "J_z stands where H belongs. J_z goes from the measurement to the place, H from the "
            "place to the measurement: they are inverse to each other.",
            lambda i: _with_H(i, each(jacobians.J_z, i["x"], i["z"])),
            lambda i: _with_H(i, each(jacobians.J_z, i["x"], each(models.h, i["x"], i["p"]))),
        ),
        *diagnoses("p", _H_landmark, SEEN_BEHIND),
    ),
)
