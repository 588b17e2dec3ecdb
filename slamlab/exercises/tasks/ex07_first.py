"""The task of exercise 07 about first estimates: Jacobians that invent no knowledge.

Huang, Mourikis, Roumeliotis 2010: whatever is seen, nobody learns where the whole map lies in the
world. H_k A_{k−1} … A_0 sends a shift along x, along y, and a turn about the origin to zero.
"""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex07_laws import close, mistake
from slamlab.geometry import wrap
from slamlab.models import jacobians

RUNS, STEPS = 8, 6
STEP = 1e-6  # [m] or [rad]
COARSE = 1e-4
"""Share of H's largest entry: one-sided differences pass, no mistake does."""

FIRST, LAST = np.zeros(STEPS, dtype=int), np.full(STEPS, STEPS - 1)
NOW = np.arange(STEPS)


def histories(rng):
    """What a filter believed: poses predicted and updated, a landmark as it came to be placed."""
    turns = rng.uniform(0.1, 0.4, (RUNS, STEPS))
    heading = rng.uniform(-3, 3, (RUNS, 1)) + np.cumsum(turns, axis=1)
    drives = np.stack([np.cos(heading), np.sin(heading)], axis=2)
    places = rng.uniform(-3, 3, (RUNS, 1, 2)) + np.cumsum(
        rng.uniform(0.4, 0.9, (RUNS, STEPS, 1)) * drives, axis=1
    )
    predicted = np.concatenate([places, heading[:, :, None]], axis=2)
    predicted += [0.05, 0.05, 0.03] * rng.standard_normal((RUNS, STEPS, 3))
    corrected = rng.uniform(0.05, 0.2, (RUNS, STEPS, 3)) * rng.choice([-1, 1], (RUNS, STEPS, 3))
    angle = rng.uniform(-np.pi, np.pi, (RUNS, 1))
    landmark = places.mean(axis=1) + 5 * np.hstack([np.cos(angle), np.sin(angle)])
    moves = rng.uniform(0.05, 0.2, (RUNS, STEPS, 2)) * rng.choice([-1, 1], (RUNS, STEPS, 2))
    return {
        "predicted": predicted,
        "updated": predicted + corrected * [1, 1, 0.3],
        "landmarks": landmark[:, None] + moves,
    }


def _differences(x, p):
    """∂h/∂(x, p) by central differences, (2, 5)."""
    at, steps = np.concatenate([x, p]), STEP * np.eye(5)
    # wrapped: a bearing may lie at ±π
    return np.column_stack([wrap(_h(at + e) - _h(at - e)) / (2 * STEP) for e in steps])


def _h(state):
    return models.h(state[:3], state[3:])


def _derivative(inputs, outputs):
    want = [
        [_differences(x, landmarks[0]) for x in run]
        for run, landmarks in zip(inputs["predicted"], inputs["landmarks"], strict=True)
    ]
    return close(outputs["H"], np.array(want), COARSE)


def unseen(inputs):
    """(runs, 5, 3) what no sight can tell: shifts along x and y, a turn about the origin."""
    start, p = inputs["predicted"][:, 0], inputs["landmarks"][:, 0]
    N = np.zeros((RUNS, 5, 3))
    N[:, 0, 0] = N[:, 3, 0] = N[:, 1, 1] = N[:, 4, 1] = N[:, 2, 2] = 1
    N[:, [0, 1], 2] = np.column_stack([-start[:, 1], start[:, 0]])
    N[:, [3, 4], 2] = np.column_stack([-p[:, 1], p[:, 0]])
    return N


def _directions(inputs, outputs):
    N, A, H = unseen(inputs), outputs["A"], outputs["H"]
    worst = np.zeros(RUNS)
    for k in range(STEPS):
        worst = np.maximum(worst, np.abs(H[:, k] @ N).max(axis=(1, 2)))
        if k + 1 < STEPS:
            N = np.concatenate([A[:, k] @ N[:, :3], N[:, 3:]], axis=1)
    return (worst < COARSE) & _sees(outputs)


def _sees(outputs):
    """Whether range and bearing are told at all: an H of zeros tells nothing, of a turn either."""
    return np.linalg.matrix_rank(outputs["H"], tol=1e-6).min(axis=1) == 2


# ---- mistakes -------------------------------------------------------------------------------


def A(before, after, signs=(1, 1), exchanged=False):
    """A with the displacement between two histories' poses; signs of Δx and Δy."""

    def matrices(inputs):
        moved = (inputs[after][:, 1:] - inputs[before][:, :-1])[..., :2] * signs
        dx, dy = moved[..., 0], moved[..., 1]
        found = np.tile(np.eye(3), (RUNS, STEPS - 1, 1, 1))
        found[..., 0, 2], found[..., 1, 2] = (dx, dy) if exchanged else (-dy, dx)
        return found

    return matrices


def H(poses, landmarks, signs=(1, 1)):
    """H at the poses of a history and at the landmark estimates of these steps."""

    def matrices(inputs):
        found = np.zeros((RUNS, STEPS, 2, 5))
        for run in range(RUNS):
            for k, which in enumerate(landmarks):
                H_r = jacobians.H_robot(inputs[poses][run, k], inputs["landmarks"][run, which])
                found[run, k] = np.hstack([signs[0] * H_r, -signs[1] * H_r[:, :2]])
        return found

    return matrices


_in_A = {"output": "A"}
_in_H = {"output": "H"}

FIRST_ESTIMATES = Task(
    id="07-first-estimates",
    title="Jacobians at the first estimates",
    drive=DRIVES["07-first-estimates"],
    inputs=histories,
    shapes={"A": (RUNS, STEPS - 1, 3, 3), "H": (RUNS, STEPS, 2, 5)},
    laws=(
        Law(
            "derivative",
            1,
            "H[k] is the derivative of h at the predicted pose and the first landmark",
            _derivative,
        ),
        Law(
            "directions",
            3,
            "H_k A_{k−1} … A_0 tells nothing of a shift or a turn of the whole map",
            _directions,
        ),
    ),
    diagnoses=(
        mistake(
            "landmark-as-now",
            "H is taken where the landmark is believed to be now. Then each step looks at another "
            "landmark, and from between them the filter reads off a heading it never saw. Take "
            "landmarks[0] in every step.",
            H("predicted", NOW),
            H("predicted", LAST),
            H("updated", NOW),
            **_in_H,
        ),
        mistake(
            "pose-as-updated",
            "H is taken at the updated pose, which is known only after the update that needs H. "
            "Its first estimate is the predicted one.",
            H("updated", FIRST),
            **_in_H,
        ),
        mistake(
            "signs-of-H",
            "Where the robot steps one way, it is as if the landmark stepped the other way: the "
            "columns of p are minus those of the robot's x and y.",
            H("predicted", FIRST, (1, -1)),
            H("predicted", FIRST, (-1, 1)),
            H("predicted", FIRST, (-1, -1)),
            **_in_H,
        ),
        mistake(
            "from-updated",
            "A starts from the updated pose, as a usual EKF does. The end of the last step and the "
            "start of this one must be the same point, or a turn of the map does not stay a turn: "
            "both predicted.",
            A("updated", "predicted"),
            **_in_A,
        ),
        mistake(
            "to-updated",
            "A ends at an updated pose, which nobody knows when A is needed. Take predicted[k + 1] "
            "− predicted[k].",
            A("updated", "updated"),
            A("predicted", "updated"),
            **_in_A,
        ),
        mistake(
            "signs-of-A",
            "The heading column of A: a turn by a little swings the step (Δx, Δy) to its left, "
            "that is by (−Δy, Δx).",
            *(A("predicted", "predicted", signs) for signs in [(-1, -1), (-1, 1), (1, -1)]),
            *(A("predicted", "predicted", signs, True) for signs in [(1, 1), (-1, -1), (1, -1)]),
            **_in_A,
        ),
        mistake(
            "identity",
            "A = I says that a heading error does not displace the robot while it drives.",
            lambda i: np.tile(np.eye(3), (RUNS, STEPS - 1, 1, 1)),
            **_in_A,
        ),
    ),
)
