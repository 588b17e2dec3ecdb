"""Exercise 02, the task of one beam and one wall."""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

TOLERANCE = 1e-6  # [m]

# so many that one who mistakes an argument for another meets some wall, too
AHEAD, BEHIND, BESIDE, PARALLEL = (slice(0, 60), slice(60, 70), slice(70, 86), slice(86, 90))
BEFORE_BEGIN, BEYOND_END = slice(70, 78), slice(78, 86)
ROWS = 90


def inputs(rng):
    """Beams and walls: most of which meet, and three ways of not meeting.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"p": (ROWS, 2), "phi": (ROWS,), "wall": (ROWS, 4)}
    """
    # where on the wall's line the beam's line crosses it, and how far along
    s, t = rng.uniform(0.1, 0.9, ROWS), rng.uniform(0.7, 5, ROWS)
    t[BEHIND] *= -1
    s[BEFORE_BEGIN], s[BEYOND_END] = rng.uniform(-1.2, -0.2, 8), rng.uniform(1.2, 2.2, 8)
    p, phi = rng.uniform(-2, 2, (ROWS, 2)), rng.uniform(-np.pi, np.pi, ROWS)
    length = rng.uniform(1, 4, ROWS)
    across = phi + rng.uniform(0.3, 1.2, ROWS) * rng.choice([-1, 1], ROWS)
    across += np.pi * rng.integers(0, 2, ROWS)  # walls are drawn from either side

    u, w = _unit(phi), length[:, None] * _unit(across)
    begin = p + t[:, None] * u - s[:, None] * w
    wall = np.hstack([begin, begin + w])
    # parallel to the beam, to its left; the last two to the last bit
    phi[-1] = phi[-2] = 0.0
    u = _unit(phi[PARALLEL])
    left = np.column_stack([-u[:, 1], u[:, 0]])
    begin = p[PARALLEL] + rng.uniform(0.5, 2, (4, 1)) * left + rng.uniform(0.3, 2, (4, 1)) * u
    wall[PARALLEL] = np.hstack([begin, begin + length[PARALLEL, None] * u])
    wall[-2:, 3] = wall[-2:, 1]
    return {"p": p, "phi": phi, "wall": wall}


def _unit(angle):
    return np.column_stack([np.cos(angle), np.sin(angle)])


def _reached(i, o):
    """The point a distance leads to lies ahead and between the wall's ends."""
    q = i["p"] + o["distance"][:, None] * _unit(i["phi"])
    by_way_of_q = np.hypot(*(q - i["wall"][:, :2]).T) + np.hypot(*(q - i["wall"][:, 2:]).T)
    on_wall = by_way_of_q - np.hypot(*(i["wall"][:, 2:] - i["wall"][:, :2]).T) < TOLERANCE
    return (o["met"] > 0) & on_wall & (o["distance"] >= 0)


def _crossing(p, phi, wall):
    """(n,) way along the beam and (n,) share of the wall where the lines cross."""
    u, w, d = _unit(phi), wall[:, 2:] - wall[:, :2], wall[:, :2] - p

    def cross(a, b):
        return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]

    return cross(d, w) / cross(u, w), cross(d, u) / cross(u, w)


def _lines(i):
    return _crossing(i["p"], i["phi"], i["wall"])


def _same(o, value, met, rows=slice(None)):
    """Whether just these rows gave a number, and this one."""
    got = o["met"][rows] > 0
    met = np.broadcast_to(met, value.shape)[rows]
    return bool((got == met).all() and (abs(o["distance"] - value)[rows][met] < TOLERANCE).all())


def _misread(change):
    """Diagnosis of a ray_wall that works, but on arguments mistaken for others."""

    def matches(i, o):
        t, s = _crossing(*change(i["p"], i["phi"], i["wall"]))
        met = (t >= 0) & (s >= 0) & (s <= 1)
        return bool(o["met"].any()) and _same(o, t, met, slice(0, PARALLEL.start))

    return matches


def _behind_accepted(i, o):
    t, _ = _lines(i)
    return any(_same(o, value, True, BEHIND) for value in (t, -t))


def _endless(i, o):
    return _same(o, _lines(i)[0], True, BESIDE)


def _one_end(i, o):
    t, _ = _lines(i)
    open_begin = _same(o, t, True, BEFORE_BEGIN) and not o["met"][BEYOND_END].any()
    open_end = _same(o, t, True, BEYOND_END) and not o["met"][BEFORE_BEGIN].any()
    return open_begin or open_end


RAY_WALL = Task(
    id="02-ray-wall",
    title="A beam and a wall",
    drive=DRIVES["02-ray-wall"],
    inputs=inputs,
    shapes={"met": (ROWS,), "distance": (ROWS,)},
    laws=(
        Law(
            "reached",
            2,
            "where a wall stands in the way, the point at that distance lies on the beam and "
            "between the wall's ends",
            lambda i, o: _reached(i, o)[AHEAD],
        ),
        Law(
            "behind",
            1,
            "a wall behind the sensor is not met: inf",
            lambda i, o: o["met"][BEHIND] == 0,
        ),
        Law(
            "beside",
            1,
            "a beam that passes beside the wall does not meet it: inf",
            lambda i, o: o["met"][BESIDE] == 0,
        ),
        Law(
            "parallel",
            1,
            "a wall parallel to the beam is not met: inf",
            lambda i, o: o["met"][PARALLEL] == 0,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "never met",
            "You return inf even for walls that stand right before the sensor. Look at the signs: "
            "the way to the wall's beginning leads from p to (x1, y1).",
            lambda i, o: not o["met"].any(),
        ),
        Diagnosis(
            "looks backwards",
            "You meet the walls behind the sensor and miss those before it: the distance along "
            "the beam has the wrong sign.",
            lambda i, o: bool(o["met"][BEHIND].all()) and not o["met"][AHEAD].any(),
        ),
        Diagnosis(
            "share returned",
            "You return where on the wall the beam meets it (a share from 0 to 1), not how far it "
            "flew to get there.",
            lambda i, o: _same(o, _lines(i)[1], True, AHEAD),
        ),
        Diagnosis(
            "degrees",
            "Angles are in radians: np.cos and np.sin take phi as it is.",
            lambda i, o: any(
                _misread(lambda p, phi, wall, unit=unit: (p, unit(phi), wall))(i, o)
                for unit in (np.degrees, np.radians)
            ),
        ),
        Diagnosis(
            "sine and cosine swapped",
            "Sine and cosine have changed places: a beam with phi = 0 flies along +x.",
            _misread(lambda p, phi, wall: (p, np.pi / 2 - phi, wall)),
        ),
        Diagnosis(
            "clockwise",
            "Your beam turns clockwise with phi: look at the sign of its y.",
            _misread(lambda p, phi, wall: (p, -phi, wall)),
        ),
        Diagnosis(
            "columns mistaken",
            "A wall is x1, y1, x2, y2: first one end, then the other. You read it as x1, x2, y1, "
            "y2.",
            _misread(lambda p, phi, wall: (p, phi, wall[:, [0, 2, 1, 3]])),
        ),
        Diagnosis(
            "from the origin",
            "Your beam starts at the origin: where is p?",
            _misread(lambda p, phi, wall: (0 * p, phi, wall)),
        ),
        Diagnosis(
            "behind accepted",
            "A wall behind the sensor is reported: the lines cross there, but the beam flies "
            "forward only. Which of your numbers says on which side of the sensor the crossing is?",
            _behind_accepted,
        ),
        Diagnosis(
            "endless wall",
            "You meet the wall's line even where the wall has ended long before. Which of your "
            "numbers says where on the wall the crossing is, and between what must it lie?",
            _endless,
        ),
        Diagnosis(
            "one end open",
            "The wall ends at one side only: it has a beginning and an end, and the beam must "
            "pass between them.",
            _one_end,
        ),
    ),
)
