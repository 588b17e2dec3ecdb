"""Task 06-h: where the robot's and a landmark's part stand in H over the whole state."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex06_beliefs import beliefs
from slamlab.geometry import wrap
from slamlab.models import jacobians

STEP = 1e-6  # [m] or [rad]
CLOSE = 1e-4  # of an entry of H, whose entries are of order 1

ROWS, LANDMARKS = 8, 4


def states(rng):
    """States, and which landmark is seen: one with neighbours on both sides."""
    x, _ = beliefs(rng, ROWS, LANDMARKS)
    return {"x": x, "j": 1 + np.arange(ROWS) % 2}


def by_differences(inputs):
    """(k, 2, n) ∂h/∂x of the landmark that is seen, by differences of the model itself."""
    return np.array([_differences(x, j) for x, j in zip(inputs["x"], inputs["j"], strict=True)])


def _differences(x, j):
    steps = STEP * np.eye(len(x))
    off = np.array([seen(x + e, j) - seen(x - e, j) for e in steps])
    off[:, 1] = wrap(off[:, 1])
    return off.T / (2 * STEP)


def seen(x, j):
    """(2,) the range and bearing at which landmark j of a state is seen."""
    return models.h(x[:3], x[3 + 2 * j : 5 + 2 * j])


def columns(inputs, which):
    """(k, n) bool: the columns of the robot, of the landmark seen, or of all others."""
    n = inputs["x"].shape[1]
    owner = np.concatenate([[-1, -1, -1], np.arange(n - 3) // 2])
    robot, seen = owner < 0, owner == inputs["j"][:, None]
    return {"robot": robot | (seen & False), "seen": seen, "others": ~robot & ~seen}[which]


def _part(which):
    def holds(inputs, outputs):
        off = np.abs(outputs["H"] - by_differences(inputs)).max(axis=1)
        return (np.where(columns(inputs, which), off, 0) <= CLOSE).all(axis=1)

    return holds


def _placed(robot=lambda j: 0, landmark=lambda j: 3 + 2 * j, of=0, H_r=1, H_p=1, place=None):
    """A formula for H with its parts put somewhere.

    Parameters
    ----------
    robot, landmark : j -> first column of the part
    of : the Jacobians are those of landmark j + of
    H_r, H_p : factors of the two parts
    place : j -> where the landmark is read in x, or None for that of landmark j + of
    """

    def formula(inputs):
        H = np.zeros((ROWS, 2, inputs["x"].shape[1]))
        for k, (x, j) in enumerate(zip(inputs["x"], inputs["j"], strict=True)):
            first = 3 + 2 * (j + of) if place is None else place(j)
            p = x[first : first + 2]
            at, to = robot(j), landmark(j)
            H[k, :, at : at + 3] = H_r * jacobians.H_robot(x, p)
            H[k, :, to : to + 2] = H_p * jacobians.H_landmark(x, p)
        return H

    return formula


def _looks(*formulas):
    def matches(inputs, outputs):
        return any((np.abs(outputs["H"] - formula(inputs)) <= CLOSE).all() for formula in formulas)

    return matches


def _other_than(which, *formulas):
    """Whether only some columns equal a formula's."""

    def matches(inputs, outputs):
        there = columns(inputs, which)[:, None]
        return any(
            (np.abs(np.where(there, outputs["H"] - formula(inputs), 0)) <= CLOSE).all()
            for formula in formulas
        )

    return matches


TOO_NEAR = (lambda j: 2 * j, lambda j: 2 + 2 * j, lambda j: 3 + j)

H_FULL = Task(
    id="06-h",
    title="H over the whole state",
    drive=DRIVES["06-h"],
    inputs=states,
    shapes={"H": (ROWS, 2, 3 + 2 * LANDMARKS)},
    laws=(
        Law("robot", 1, "the first three columns are how h changes with the pose", _part("robot")),
        Law("seen", 1, "the seen landmark's two columns are how h changes with it", _part("seen")),
        Law("others", 1, "all other columns are zero: h does not know them", _part("others")),
    ),
    diagnoses=(
        Diagnosis(
            "printed-4-9",
            "H_r stands right before the landmark's part, as the MAK thesis prints it in (4.9): "
            "[0 0 H_r H_p 0 …]. The state begins with the robot, whichever landmark is seen.",
            _looks(_placed(robot=lambda j: 2 * j)),
        ),
        Diagnosis(
            "off-by-one",
            "The landmark's part is not where it belongs. Landmarks are counted from 0, and "
            "the robot takes three columns: where does landmark j begin?",
            _looks(
                *(_placed(landmark=lambda j: 5 + 2 * j, of=of) for of in (0, 1)),
                *(_placed(landmark=lambda j: 1 + 2 * j, of=of) for of in (0, -1)),
            ),
        ),
        Diagnosis(
            "robot-not-counted",
            "The landmark's part begins too far to the left: the robot's three columns come first, "
            "and each landmark takes two.",
            _looks(
                *(_placed(landmark=first) for first in TOO_NEAR),
                *(_placed(landmark=first, place=first) for first in TOO_NEAR),
            ),
        ),
        Diagnosis(
            "sign",
            "The landmark's part has the sign of the robot's. When the landmark moves away, does "
            "the range grow? And when the robot moves that way?",
            _looks(_placed(H_p=-1)),
        ),
        Diagnosis(
            "landmark-missing",
            "Only the robot's part is there: this is H of a known map (lesson 05). In SLAM the "
            "landmark's own error is in the innovation as well.",
            _looks(_placed(H_p=0)),
        ),
        Diagnosis(
            "robot-missing",
            "Only the landmark's part is there: this is H of a known pose (lesson 05). In SLAM the "
            "robot's error is in the innovation as well.",
            _looks(_placed(H_r=0)),
        ),
        Diagnosis(
            "wrong-landmark",
            "Another landmark's place is in the Jacobians: which two numbers of x are those of "
            "landmark j?",
            _other_than("robot", _placed(of=1), _placed(of=-1)),
        ),
    ),
)
