"""The task of exercise 07 about two observations: how landmarks come to share an error.

The example of the MAK thesis, 4.3.3.
"""

import numpy as np

from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex07_errata import ERRATA, FIRST, ROBOT, SECOND, uncorrelated
from slamlab.exercises.tasks.ex07_laws import T, close, covariances
from slamlab.models import jacobians

ROWS = 12
SEPARATE = slice(0, 6)


def observations(rng):
    """Block-diagonal covariances, as in the thesis, and full ones; H of two landmarks; R."""
    low = np.array([0.1, 0.1, 0.03, 0.2, 0.2, 0.2, 0.2])
    P = covariances(rng, low * rng.uniform(1, 3, (ROWS, 7)))
    P[SEPARATE] = uncorrelated(P[SEPARATE])
    H = np.zeros((2, ROWS, 2, 7))
    for which, block in enumerate((FIRST, SECOND)):
        direction, r = rng.uniform(-np.pi, np.pi, ROWS), rng.uniform(0.8, 4, ROWS)
        landmarks = r[:, None] * np.column_stack([np.cos(direction), np.sin(direction)])
        for row, p in enumerate(landmarks):
            H_r = jacobians.H_robot(np.zeros(3), p)
            H[which, row, :, ROBOT], H[which, row, :, block] = H_r, -H_r[:, :2]
    sigmas = np.column_stack([rng.uniform(0.05, 0.15, ROWS), rng.uniform(0.02, 0.06, ROWS)])
    return {"P": P, "H_1": H[0], "H_2": H[1], "R": covariances(rng, sigmas)}


def _informed(inputs, seen):
    """(P⁻¹ + Σ Hᵀ R⁻¹ H)⁻¹: what least squares makes of everything at once."""
    weight = np.linalg.inv(inputs["R"])
    information = np.linalg.inv(inputs["P"])
    return np.linalg.inv(information + sum(T(inputs[H]) @ weight @ inputs[H] for H in seen))


def _first(inputs, outputs):
    return close(outputs["P_first"], _informed(inputs, ["H_1"]))


def _both(inputs, outputs):
    return close(outputs["P_both"], _informed(inputs, ["H_1", "H_2"]))


def _never_grows(inputs, outputs):
    chain = np.stack([inputs["P"], outputs["P_first"], outputs["P_both"], np.zeros((ROWS, 7, 7))])
    size = 1e-8 * np.abs(inputs["P"]).max()
    symmetric = np.abs(chain - T(chain)).max(axis=(0, 2, 3)) <= size
    lost = np.linalg.eigvalsh((chain[:-1] - chain[1:] + T(chain[:-1] - chain[1:])) / 2)
    return symmetric & (lost.min(axis=(0, 2)) >= -size)


TWO_UPDATES = Task(
    id="07-two-updates",
    title="Two observations",
    drive=DRIVES["07-two-updates"],
    inputs=observations,
    shapes={"P_first": (ROWS, 7, 7), "P_both": (ROWS, 7, 7)},
    laws=(
        Law("first", 2, "P_first⁻¹ = P⁻¹ + H_1ᵀ R⁻¹ H_1: information adds up", _first),
        Law("both", 2, "P_both⁻¹ = P⁻¹ + H_1ᵀ R⁻¹ H_1 + H_2ᵀ R⁻¹ H_2", _both),
        Law(
            "never-grows",
            1,
            "P, P_first, P_both are symmetric, and seeing never makes less certain",
            _never_grows,
        ),
    ),
    diagnoses=ERRATA,
)
