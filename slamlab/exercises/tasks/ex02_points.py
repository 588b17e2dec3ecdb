"""Exercise 02, the task of a device's readings in the world; the plane is read as x + iy."""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex02_turns import back, points, turns

TOLERANCE = 1e-6  # [m]
SCANS, READINGS, EMPTY = 6, 20, 4


def inputs(rng):
    """Readings of which some did not come back, mounts with an offset and a turn, any poses.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"degrees", "millimetres": (n, k), "mount", "pose": (n, 3)}
    """
    degrees, millimetres = turns(rng, SCANS, READINGS, EMPTY)

    def frames(reach):
        turn = rng.uniform(0.3, 2.8, SCANS) * rng.choice([-1, 1], SCANS)
        return np.column_stack([rng.uniform(0.3 * reach, reach, (SCANS, 2)), turn])

    return {
        "degrees": degrees,
        "millimetres": millimetres,
        "mount": frames(0.4) * rng.choice([-1, 1], (SCANS, 3)),
        "pose": frames(4.0) * rng.choice([-1, 1], (SCANS, 3)),
    }


def _readings(i):
    """(n, k - EMPTY) ranges [m] and bearings, counter-clockwise [rad]."""
    r, beta = i["millimetres"] / 1000, -np.radians(i["degrees"])
    return back(i, r), back(i, beta)


def _frame(rows):
    """(n, 1) place as x + iy and heading of poses."""
    return (rows[:, :1] + 1j * rows[:, 1:2]), rows[:, 2:]


def _sensor(i):
    """(n, 1) place and heading of the sensor in the world."""
    (z, theta), (offset, turn) = _frame(i["pose"]), _frame(i["mount"])
    return z + offset * np.exp(1j * theta), theta + turn


def _small(difference):
    return (abs(difference) < TOLERANCE).reshape(SCANS, -1).all(axis=1)


def _distances(z):
    return abs(z[:, :, None] - z[:, None])


def _range(i, o):
    return _small(abs(points(i, o) - _sensor(i)[0]) - _readings(i)[0])


def _bearing(i, o):
    (place, heading), (_, beta) = _sensor(i), _readings(i)
    way = points(i, o) - place
    return _small(way / abs(way) - np.exp(1j * (heading + beta)))


def _rigid(i, o):
    r, beta = _readings(i)
    return _small(_distances(points(i, o)) - _distances(r * np.exp(1j * beta)))


def _came_out(formula):
    """Diagnosis of points that follow a wrong formula of (r, β, mount, pose), the last two each a
    place and a heading."""

    def matches(i, o):
        want = formula(*_readings(i), _frame(i["mount"]), _frame(i["pose"]))
        return bool(_small(points(i, o) - want).all())

    return matches


def _carry(frame, z):
    return frame[0] + z * np.exp(1j * frame[1])


def _seen(r, beta):
    return r * np.exp(1j * beta)


def _mistake(name, hint, *formulas):
    return Diagnosis(name, hint, lambda i, o: any(_came_out(f)(i, o) for f in formulas))


TO_POINTS = Task(
    id="02-to-points",
    title="What the device says",
    drive=DRIVES["02-to-points"],
    inputs=inputs,
    shapes={"points": (SCANS, READINGS, 2), "count": (SCANS,)},
    laws=(
        Law(
            "nothing left out",
            1,
            "there is a point for each reading that came back, and none for the others",
            lambda i, o: o["count"] == READINGS - EMPTY,
        ),
        Law("rigid", 1, "the points are as far from each other as the readings say", _rigid),
        Law("range", 1, "each point is as far from the sensor's place as measured", _range),
        Law("bearing", 2, "from the sensor's place each point lies where it was seen", _bearing),
    ),
    diagnoses=(
        _mistake(
            "counter-clockwise",
            "Your map is mirrored: the device counts its degrees clockwise, everything else here "
            "is counter-clockwise.",
            lambda r, beta, mount, pose: _carry(pose, _carry(mount, _seen(r, -beta))),
        ),
        _mistake(
            "millimetres",
            "The points are a thousand times too far away: the device speaks in millimetres.",
            lambda r, beta, mount, pose: _carry(pose, _carry(mount, _seen(1000 * r, beta))),
        ),
        _mistake(
            "degrees",
            "np.cos and np.sin take radians: the device's degrees must be converted.",
            *(
                lambda r, beta, mount, pose, sign=sign: _carry(
                    pose, _carry(mount, _seen(r, sign * np.degrees(beta)))
                )
                for sign in (1, -1)
            ),
        ),
        _mistake(
            "front along +y",
            "You take the device's front for +y (as Tuček does). Here it looks along its +x: at 0° "
            "a point lies at (r, 0).",
            lambda r, beta, mount, pose: _carry(pose, _carry(mount, _seen(r, np.pi / 2 + beta))),
            lambda r, beta, mount, pose: _carry(pose, _carry(mount, _seen(r, np.pi / 2 - beta))),
        ),
        _mistake(
            "mount forgotten",
            "The sensor does not sit in the robot's middle: first carry the points into the "
            "robot's frame by the mount.",
            lambda r, beta, mount, pose: _carry(pose, _seen(r, beta)),
        ),
        _mistake(
            "pose forgotten",
            "The points are in the robot's frame: the robot's pose in the world is missing.",
            lambda r, beta, mount, pose: _carry(mount, _seen(r, beta)),
        ),
        _mistake(
            "wrong order",
            "Mount and pose have changed places. From the inside out: the mount brings sensor to "
            "robot, then the pose brings robot to world.",
            lambda r, beta, mount, pose: _carry(mount, _carry(pose, _seen(r, beta))),
        ),
        _mistake(
            "mount added as it is",
            "The mount's offset is added along the world's axes. It is given in the robot's frame: "
            "it turns with the robot.",
            lambda r, beta, mount, pose: pose[0] + mount[0] + _seen(r, beta + mount[1] + pose[1]),
        ),
        _mistake(
            "mount not turned",
            "The sensor's offset is there, its direction on the robot is not: the mount's angle is "
            "missing.",
            lambda r, beta, mount, pose: _carry(pose, mount[0] + _seen(r, beta)),
        ),
        _mistake(
            "turned the wrong way",
            "Frames turn clockwise with their angles: a sign of the sines is wrong, or the "
            "rotation matrix is transposed (points in rows: points @ R.T).",
            lambda r, beta, mount, pose: _carry(
                (pose[0], -pose[1]), _carry((mount[0], -mount[1]), _seen(r, beta))
            ),
        ),
        Diagnosis(
            "empties kept",
            "Readings of 0 mm are in your map, as points at the sensor's own place: they did not "
            "come back and are no points.",
            lambda i, o: bool((o["count"] == READINGS).all()),
        ),
    ),
)
