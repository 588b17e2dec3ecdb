"""Exercise 02, the task of a scan: the nearest of many walls for every beam."""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES, FINITE, INFINITE, NOTHING
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

TOLERANCE = 1e-6  # [m]
SCENES, BEAMS = 3, 16
HALF = 0.6  # half a wall's width, seen from the sensor [rad]


def inputs(rng):
    """Sensors with a sector in which two walls stand behind each other, the near one listed first,
    one with the far one first, one with a wall beyond the range, and one that is open.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"p": (n, 2), "directions": (n, k), "walls": (n, 5, 4), "range_max": (n,)}
    """
    scenes = [_scene(rng) for _ in range(SCENES)]
    names = ("p", "directions", "walls", "range_max")
    return {
        name: np.array(part) for name, part in zip(names, zip(*scenes, strict=True), strict=True)
    }


def _scene(rng):
    p, range_max = rng.uniform(-3, 3, 2), rng.uniform(4, 5)
    # the first sector holds the direction 0, so that who takes radians for degrees sees something
    quarters = np.append(0, rng.permutation([1, 2, 3]))
    sectors = rng.uniform(-0.5, 0.5) + np.pi / 2 * quarters
    near, far = rng.uniform(0.8, 1.8, (2, 2)), rng.uniform(2.3, 3.3, (2, 2))
    beyond = range_max * rng.uniform(1.3, 1.6, 2)
    ends = [(0, near[0]), (0, far[0]), (2, beyond), (1, far[1]), (1, near[1])]
    walls = [_wall(p, sectors[k], two) for k, two in ends]
    directions = np.repeat(sectors, BEAMS // 4) + rng.uniform(-0.5, 0.5, BEAMS)
    return p, rng.permutation(directions), np.array(walls), range_max


def _wall(p, middle, two):
    """A wall across a sector, its ends at these two distances."""
    sides = middle + np.array([-HALF, HALF])
    return (p + two[:, None] * np.column_stack([np.cos(sides), np.sin(sides)])).ravel()


def _all_ranges(i):
    """(n, k, w) distance of every beam to every wall, inf where they do not meet."""
    u = np.stack([np.cos(i["directions"]), np.sin(i["directions"])], axis=-1)[:, :, None]
    a, b = (i["walls"][:, None, :, part] - i["p"][:, None, None] for part in (np.s_[:2], np.s_[2:]))

    def cross(a, b):
        return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

    # a beam passes between the ends when they lie on its two sides, and ahead when the crossing is
    sides = cross(u, a) * cross(u, b) < 0
    t = cross(a, b - a) / cross(u, b - a)
    return np.where(sides & (t > 0), t, np.inf)


def _within(i):
    """(n, k) whether something is to be seen within the range."""
    return _all_ranges(i).min(axis=2) <= i["range_max"][:, None]


def _on_some_wall(i, o):
    off = abs(_all_ranges(i) - o["ranges"][:, :, None]).min(axis=2)
    return ((o["state"] == FINITE) & (off < TOLERANCE))[_within(i)]


def _sight_free(i, o):
    """No wall stands between the sensor and the place reported."""
    nearer = _all_ranges(i) < o["ranges"][:, :, None] - TOLERANCE
    return ((o["state"] == FINITE) & ~nearer.any(axis=2))[_within(i)]


def _reports(choice):
    """Diagnosis of a scan that reports another wall of those met: choice of (k,) distances."""

    def matches(i, o):
        ranges, seen = _all_ranges(i), _within(i)
        want = np.array([choice(row[np.isfinite(row)]) for row in ranges[seen]])
        return bool((abs(o["ranges"][seen] - want) < TOLERANCE).all())

    return matches


def _right_within(i, o):
    nearest = _all_ranges(i).min(axis=2)
    return bool((abs(o["ranges"] - nearest)[_within(i)] < TOLERANCE).all())


def _elsewhere(condition):
    """Diagnosis of a scan that is right within the range and something else where it should be NaN:
    condition of (states, ranges, distances to the nearest wall, range_max) there."""

    def matches(i, o):
        empty = ~_within(i)
        nearest = _all_ranges(i).min(axis=2)[empty]
        most = np.broadcast_to(i["range_max"][:, None], empty.shape)[empty]
        got = condition(o["state"][empty], o["ranges"][empty], nearest, most)
        return _right_within(i, o) and bool(got)

    return matches


def _beyond_seen(state, ranges, nearest, most):
    some = np.isfinite(nearest)
    return (state[some] == FINITE).all() and (abs(ranges - nearest)[some] < TOLERANCE).all()


SCAN = Task(
    id="02-scan",
    title="A scan",
    drive=DRIVES["02-scan"],
    inputs=inputs,
    shapes={"state": (SCENES, BEAMS), "ranges": (SCENES, BEAMS)},
    laws=(
        Law("on a wall", 1, "each range leads to a point on one of the walls", _on_some_wall),
        Law("free sight", 2, "no wall stands between the sensor and that point", _sight_free),
        Law(
            "nothing",
            2,
            "a beam that meets nothing within range_max is NaN",
            lambda i, o: (o["state"] == NOTHING)[~_within(i)],
        ),
    ),
    diagnoses=(
        Diagnosis(
            "nothing seen",
            "All is NaN: look at the comparison with range_max, and at what becomes of a NaN in a "
            "minimum.",
            lambda i, o: not (o["state"] == FINITE).any(),
        ),
        Diagnosis(
            "farthest wall",
            "You report the farthest wall: a beam ends at the nearest one.",
            _reports(max),
        ),
        Diagnosis(
            "first in the list",
            "You report the first wall met in the list, not the nearest: the walls stand in no "
            "particular order.",
            _reports(lambda met: met[0]),
        ),
        Diagnosis(
            "last in the list",
            "You report the last wall met in the list: each one overwrites those before, also "
            "nearer ones.",
            _reports(lambda met: met[-1]),
        ),
        Diagnosis(
            "infinity left",
            "The ranges are right, but where nothing is met you report infinity: a device says "
            "nothing there, NaN.",
            _elsewhere(lambda state, ranges, nearest, most: (state == INFINITE).all()),
        ),
        Diagnosis(
            "range_max reported",
            "Where nothing is met you report range_max: a map would get a wall there. NaN says "
            "that nothing came back.",
            _elsewhere(
                lambda state, ranges, nearest, most: (
                    (state == FINITE).all() and (abs(ranges - most) < TOLERANCE).all()
                )
            ),
        ),
        Diagnosis(
            "zero reported",
            "Where nothing is met you report 0: a wall right at the sensor. NaN says that nothing "
            "came back.",
            _elsewhere(
                lambda state, ranges, nearest, most: (state == FINITE).all() and (ranges == 0).all()
            ),
        ),
        Diagnosis(
            "seen beyond the range",
            "Walls beyond range_max are reported: the sensor cannot see so far.",
            _elsewhere(_beyond_seen),
        ),
        Diagnosis(
            "degrees",
            "Directions are in radians: nothing is converted.",
            lambda i, o: any(
                _right_within(turned, o)
                for turned in (
                    {**i, "directions": unit(i["directions"])} for unit in (np.degrees, np.radians)
                )
            ),
        ),
    ),
    needs=("02-ray-wall",),
)
