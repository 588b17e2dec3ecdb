"""Exercise 01, the task of one step: where it leads."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex01_inputs as make
from slamlab.exercises.tasks.ex01_laws import (
    DEGREES,
    SWAPPED,
    place_of,
    same_angle,
    same_direction,
    small,
    towards,
    wrapped,
)


def _from_step(position):
    """Diagnosis of a next_pose whose position follows a wrong formula of (z, s, θ, turn)."""

    def matches(i, o):
        formula = position(
            place_of(i["pose"]), place_of(i["step"]), i["pose"][:, 2], i["step"][:, 2]
        )
        return small(place_of(o["result"]) - formula).all()

    return matches


def _from_heading(heading):
    """Diagnosis of a next_pose whose heading follows a wrong formula of (θ, turn)."""
    return lambda i, o: same_angle(
        o["result"][:, 2], heading(i["pose"][:, 2], i["step"][:, 2])
    ).all()


def _moved(i, o):
    return place_of(o["result"]) - place_of(i["pose"])


NEXT_POSE = Task(
    id="01-next-pose",
    title="Where one step leads",
    drive=DRIVES["01-next-pose"],
    inputs=make.pose_and_step,
    shapes={"result": (3,)},
    laws=(
        Law(
            "distance",
            1,
            "the robot moves as far as its step is long",
            lambda i, o: small(np.abs(_moved(i, o)) - np.abs(place_of(i["step"]))),
        ),
        Law(
            "direction",
            2,
            "as seen along the old heading, it moves forward and left as the step says",
            lambda i, o: same_direction(
                _moved(i, o) * towards(-i["pose"][:, 2]), place_of(i["step"])
            ),
        ),
        Law(
            "heading",
            1,
            "the heading grows by the turn (up to full turns)",
            lambda i, o: same_angle(o["result"][:, 2], i["pose"][:, 2] + i["step"][:, 2]),
        ),
        Law(
            "wrapped",
            1,
            "the heading lies between -π and π",
            lambda i, o: wrapped(o["result"][:, 2]),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "added without turning",
            "You add forward and left to x and y as they are. They are measured in the robot's "
            "frame: turn them by the heading first.",
            _from_step(lambda z, s, theta, turn: z + s),
        ),
        Diagnosis(
            "turned before moving",
            "You move along the new heading. The step was measured in the frame of the pose before "
            "it: use the old heading, then turn.",
            _from_step(lambda z, s, theta, turn: z + s * towards(theta + turn)),
        ),
        Diagnosis(
            "turned the wrong way",
            "The step is turned clockwise: a sign of the sines is wrong, or the rotation matrix is "
            "transposed. Try heading π/2: forward must lead along +y.",
            _from_step(lambda z, s, theta, turn: z + s * towards(-theta)),
        ),
        Diagnosis(
            "degrees",
            DEGREES,
            lambda i, o: any(
                _from_step(lambda z, s, theta, turn, unit=unit: z + s * towards(unit(theta)))(i, o)
                for unit in (np.degrees, np.radians)
            ),
        ),
        Diagnosis(
            "sine and cosine swapped",
            SWAPPED,
            _from_step(lambda z, s, theta, turn: z + 1j * s * towards(-theta)),
        ),
        Diagnosis(
            "left forgotten",
            "Only the forward part of the step is used. A step has a part to the left as well: a "
            "wheel that slips pushes the robot sideways.",
            _from_step(lambda z, s, theta, turn: z + s.real * towards(theta)),
        ),
        Diagnosis(
            "left taken for right",
            "The part to the left goes to the right. Left of the heading is a quarter turn "
            "counter-clockwise from it.",
            _from_step(lambda z, s, theta, turn: z + s.conj() * towards(theta)),
        ),
        Diagnosis(
            "the wrong way round",
            "You place the pose in the frame of the step. Which of the two is given in the frame "
            "of the other?",
            _from_step(lambda z, s, theta, turn: s + z * towards(turn)),
        ),
        Diagnosis(
            "turn forgotten",
            "The heading stays as it was: add the turn.",
            _from_heading(lambda theta, turn: theta),
        ),
        Diagnosis(
            "turn subtracted",
            "The turn is subtracted. A positive turn is counter-clockwise, as the heading is.",
            _from_heading(lambda theta, turn: theta - turn),
        ),
        Diagnosis(
            "not wrapped",
            "The heading leaves the range from -π to π. The same direction has many angles: bring "
            "it back, for instance by np.arctan2 of its sine and cosine.",
            lambda i, o: not wrapped(o["result"][:, 2]).all(),
        ),
    ),
)
