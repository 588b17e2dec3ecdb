"""Exercise 10, edges: each line touches the places that may be seen, and cuts off none of them."""

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex10.boxes import boxes, wrapped

ROWS = 24
CLOSE = 1e-6
"""What normals may be off, and c by the length of the numbers it is made of: rounding moves them by
1e-15, and lines through two points, some metres apart, by 1e-9."""


def inputs(rng, n=ROWS, width=(0.3, 0.9), size=(0.1, 0.4)):
    """Sightings of every direction, d_abs well below a right angle."""
    return {
        "z": np.column_stack([rng.uniform(1.5, 4, n), rng.uniform(-2.5, 2.5, n)]),
        "bounds": np.column_stack([rng.uniform(0.1, 0.4, n), rng.uniform(0.05, 0.2, n)]),
        "heading": wrapped(rng.uniform(-np.pi, np.pi, n), rng.uniform(*width, n)),
        "box": boxes(rng, n, low=size[0], high=size[1]),
    }


def _exact(rng):
    """Neither the place nor the heading of the robot has a width."""
    return inputs(rng, 12, width=(0, 0), size=(0, 0))


def _measured_exactly(rng):
    given = inputs(rng, 12)
    return given | {"bounds": given["bounds"] * (np.arange(12) % 4)[:, None] * [0, 0.5]}


def _along_axes(rng):
    """The direction is one of the compass, with normals that have a 0."""
    given = inputs(rng, 12)
    course = np.arange(12) % 4 * np.pi / 2 - np.pi
    width = np.ptp(given["heading"], axis=1)
    return given | {"heading": wrapped(course - given["z"][:, 1] - width / 2, width)}


def _seam(rng):
    """Headings from before π to behind it."""
    given = inputs(rng, 12)
    width = np.ptp(given["heading"], axis=1)
    return given | {"heading": wrapped(np.pi - width * rng.uniform(0.1, 0.9, 12), width)}


def _far_away(rng):
    given = inputs(rng, 12, size=(5, 20))
    return given | {"box": given["box"] + np.repeat(rng.uniform(-500, 500, (12, 2)), 2, axis=1)}


def _near(rng):
    """The range is as small as its bound: the object may be where the robot is."""
    given = inputs(rng, 12)
    return given | {"z": np.column_stack([given["bounds"][:, 0], given["z"][:, 1]])}


def sighting(given):
    """Direction and d_abs, (n,) each [rad]."""
    right, left = given["heading"].T
    return (right + left) / 2 + given["z"][:, 1], (left - right) / 2 + given["bounds"][:, 1]


def lines(given):
    """The four edges, moved out by the corner of the box that is farthest out."""
    direction, d_abs = sighting(given)
    turns = [direction, direction + np.pi]
    turns += [direction + d_abs + np.pi / 2, direction - d_abs - np.pi / 2]
    angles = np.stack(turns, axis=1)
    n = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    x, y = given["box"][:, [0, 0, 1, 1]], given["box"][:, [2, 3, 2, 3]]
    c = (n @ np.stack([x, y], axis=1)).max(axis=2)
    (r, _), (d_r, _) = given["z"].T, given["bounds"].T
    c[:, 0] += r + d_r
    c[:, 1] -= (r - d_r) * np.cos(d_abs)
    return {"result": np.concatenate([n, c[..., None]], axis=2)}


def unit(rows):
    """Half-planes (n, 4, 3) with normals of length one."""
    return rows / np.hypot(rows[..., :1], rows[..., 1:2])


def _are(*which):
    """That these edges are where they should be, of whatever length their normals are."""

    def holds(given, out):
        got, want = unit(out["result"])[:, which], lines(given)["result"][:, which]
        size = 1 + np.abs(given["box"]).max(axis=1) + given["z"][:, 0]
        off = np.abs(got - want) / np.where([0, 0, 1], size[:, None, None], 1)
        return (off <= CLOSE).all(axis=(1, 2))

    return holds


def _on_the_way(given):
    direction, d_abs = sighting(given)
    return {"direction": direction, "d_abs": d_abs}


def _law(name, points, says, which, asks):
    return Law(name, points, says, _are(*which), want=lines, asks=asks, step=_on_the_way)


def _promised(given):
    """(n,) whether r is not less than its bound, and d_abs well below a right angle."""
    return (given["z"][:, 0] >= given["bounds"][:, 0]) & (sighting(given)[1] < 1.3)


EDGES = Task(
    id="10-edges",
    title="The edges of a sighting",
    drive=DRIVES["10-edges"],
    inputs=inputs,
    shapes={"result": (4, 3)},
    laws=(
        _law(
            "far",
            1,
            "the first edge points ahead and touches the farthest place that may be seen",
            [0],
            "Which of the places that may be seen is the farthest along the middle direction, and "
            "from which point of the robot's box is it seen?",
        ),
        _law(
            "near",
            2,
            "the second edge points back, touches the nearest place, and cuts off none",
            [1],
            "How far along the middle direction do the inner corners of the piece of a ring lie?",
        ),
        _law(
            "sides",
            2,
            "the third and fourth edge point out to the left and right, and touch what may be seen",
            [2, 3],
            "Which way does (a, b) point if a x + b y ≤ c holds just on the inner side of a ray?",
        ),
    ),
    probes=(
        Probe("a place and a heading that are known exactly", _exact),
        Probe("exact ranges or bearings", _measured_exactly),
        Probe("a direction along an axis", _along_axes),
        Probe("a heading across π", _seam),
        Probe("a large box far away", _far_away),
        Probe("a range as small as its bound", _near),
    ),
    parts=lambda given, out: {
        name: unit(out["result"])[:, k] for k, name in enumerate(("far", "near", "left", "right"))
    },
    rounds=_promised,
)
