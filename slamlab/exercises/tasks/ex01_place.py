"""Exercise 01, the task of placing a scan's points in the world."""

import numpy as np

from slamlab.exercises.drives.ex01 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex01_inputs as make
from slamlab.exercises.tasks.ex01_laws import (
    DEGREES,
    SWAPPED,
    all_distances,
    on_one_line,
    place_of,
    same_direction,
    small,
    towards,
)


def _placed(position):
    """Diagnosis of a place that follows a wrong formula of (z, p, θ)."""

    def matches(i, o):
        z, theta = place_of(i["pose"])[:, None], i["pose"][:, 2:]
        return small(place_of(o["result"]) - position(z, place_of(i["points"]), theta)).all()

    return matches


def _from_robot(i, o):
    return place_of(o["result"]) - place_of(i["pose"])[:, None]


PLACE = Task(
    id="01-place",
    title="A scan's points in the world",
    drive=DRIVES["01-place"],
    inputs=make.pose_and_points,
    shapes={"result": (make.ON_WALL + make.ELSEWHERE, 2)},
    laws=(
        Law(
            "rigid",
            1,
            "points are as far from each other as they were in the scan",
            lambda i, o: small(
                all_distances(place_of(o["result"])) - all_distances(place_of(i["points"]))
            ),
        ),
        Law(
            "range",
            1,
            "each point is as far from the robot as the lidar measured",
            lambda i, o: small(np.abs(_from_robot(i, o)) - np.abs(place_of(i["points"]))),
        ),
        Law(
            "bearing",
            2,
            "each point lies in the direction in which the robot saw it",
            lambda i, o: same_direction(
                _from_robot(i, o) * towards(-i["pose"][:, 2:]), place_of(i["points"])
            ),
        ),
        Law(
            "one wall",
            1,
            f"a straight wall seen from {make.SCANS} poses is one straight wall in the map",
            lambda i, o: on_one_line(o["result"][:, : make.ON_WALL].reshape(-1, 2)),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "not turned",
            "The points are moved to the robot but not turned by its heading.",
            _placed(lambda z, p, theta: z + p),
        ),
        Diagnosis(
            "not moved",
            "The points are turned but not moved: add the robot's position.",
            _placed(lambda z, p, theta: p * towards(theta)),
        ),
        Diagnosis(
            "turned the wrong way",
            "The points turn clockwise with the heading: a sign of the sines is wrong, or the "
            "rotation matrix is transposed (points in rows: points @ R.T).",
            _placed(lambda z, p, theta: z + p * towards(-theta)),
        ),
        Diagnosis(
            "moved before turning",
            "You move first and turn then, so that the robot's position is turned as well. Turn "
            "first: the points turn about the robot.",
            _placed(lambda z, p, theta: (z + p) * towards(theta)),
        ),
        Diagnosis(
            "into the robot's frame",
            "That is the way back, from the world into the robot's frame. The lidar's points are "
            "in the robot's frame already.",
            _placed(lambda z, p, theta: (p - z) * towards(-theta)),
        ),
        Diagnosis(
            "degrees",
            DEGREES,
            lambda i, o: any(
                _placed(lambda z, p, theta, unit=unit: z + p * towards(unit(theta)))(i, o)
                for unit in (np.degrees, np.radians)
            ),
        ),
        Diagnosis(
            "sine and cosine swapped",
            SWAPPED,
            _placed(lambda z, p, theta: z + 1j * p * towards(-theta)),
        ),
        Diagnosis(
            "mirrored",
            "The map is mirrored: left and right of the robot have changed places.",
            _placed(lambda z, p, theta: z + p.conj() * towards(theta)),
        ),
    ),
)
