"""Exercise 14, the task of points from a clockwise lidar; the plane is read as x + iy."""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex02_turns import back, points, turns

TURNS, READINGS, EMPTY = 6, 18, 4
TOLERANCE = 1e-6  # [m]


def inputs(rng):
    """Turns of which some readings did not come back, lidars mounted any way round.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"degrees", "millimetres": (n, k), "front": (n,)}
    """
    degrees, millimetres = turns(rng, TURNS, READINGS, EMPTY)
    front = rng.uniform(20, 70, TURNS) + rng.choice([0, 90, 180, 270], TURNS)
    return {"degrees": degrees, "millimetres": millimetres, "front": front}


def _readings(i):
    """Clockwise angles and distances (n, k - EMPTY), fronts (n, 1) [degree, m, degree]."""
    degrees, millimetres = (back(i, i[name]) for name in ("degrees", "millimetres"))
    return degrees, millimetres / 1000, i["front"][:, None]


def at(degrees, r):
    """Points in a direction counter-clockwise from +x [degree]."""
    return r * np.exp(1j * np.radians(degrees))


def _came_out(formula):
    def holds(i, o):
        return (np.abs(points(i, o) - formula(*_readings(i))) < TOLERANCE).all(axis=1)

    return holds


def _range(i, o):
    return (np.abs(np.abs(points(i, o)) - _readings(i)[1]) < TOLERANCE).all(axis=1)


def _mistake(name, hint, *formulas):
    return Diagnosis(name, hint, lambda i, o: any(_came_out(f)(i, o).all() for f in formulas))


POINTS = Task(
    id="14-points",
    title="Points from a clockwise lidar",
    drive=DRIVES["14-points"],
    inputs=inputs,
    shapes={"points": (TURNS, READINGS, 2), "count": (TURNS,)},
    laws=(
        Law(
            "nothing left out",
            1,
            "there is a point for each reading that came back, and none for the others",
            lambda i, o: o["count"] == READINGS - EMPTY,
        ),
        Law("range", 1, "each point is as far away as measured", _range),
        Law(
            "direction",
            2,
            "each point lies where it was seen: clockwise from the robot's front",
            _came_out(lambda degrees, r, front: at(front - degrees, r)),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "zeros kept",
            "Readings of 0 mm are among your points, all at the lidar's own place. 0 says that "
            "nothing came back: leave them out.",
            lambda i, o: bool((o["count"] == READINGS).all()),
        ),
        _mistake(
            "counter-clockwise",
            "Your map is mirrored: the lidar counts its degrees clockwise, so the angle for cosine "
            "and sine has a minus.",
            lambda degrees, r, front: at(degrees - front, r),
        ),
        _mistake(
            "front forgotten",
            "The points are in the lidar's frame: its 0° is not the robot's front. A reading at "
            "`front` degrees lies on the robot's +x.",
            lambda degrees, r, front: at(-degrees, r),
            lambda degrees, r, front: at(degrees, r),
        ),
        _mistake(
            "front's sign",
            "The front is taken off the wrong way: a reading at exactly `front` degrees must come "
            "out at angle 0, on +x.",
            lambda degrees, r, front: at(-front - degrees, r),
            lambda degrees, r, front: at(front + degrees, r),
        ),
        _mistake(
            "front along +y",
            "Your robot looks along +y, as Tuček's. Here its front is +x: cosine for x, sine for "
            "y.",
            lambda degrees, r, front: at(90 + front - degrees, r),
            lambda degrees, r, front: at(90 - front + degrees, r),
        ),
        _mistake(
            "degrees",
            "np.cos and np.sin take radians: convert the degrees first.",
            lambda degrees, r, front: r * np.exp(1j * (front - degrees)),
            lambda degrees, r, front: r * np.exp(1j * (degrees - front)),
        ),
        _mistake(
            "millimetres",
            "The points are a thousand times too far away: the lidar speaks in millimetres.",
            lambda degrees, r, front: 1000 * at(front - degrees, r),
            lambda degrees, r, front: 1000 * at(degrees - front, r),
        ),
    ),
)
