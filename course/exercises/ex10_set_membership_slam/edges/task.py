"""Exercise 10, edges: each edge touches the feasible set and excludes no part of it."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex10_set_membership_slam.boxes import boxes, wrapped
from course.exercises.ex10_set_membership_slam.calls import CALLS

ROWS = 24
CLOSE = 1e-6
"""What normals may be off, and c by the length of the numbers it is made of: rounding moves them by
1e-15, and lines through two points, some metres apart, by 1e-9."""


def inputs(rng, n=ROWS, width=(0.3, 0.9), size=(0.1, 0.4)):
    """Measurements in every direction, d_abs well below a right angle."""
    return {
        "z": np.column_stack([rng.uniform(1.5, 4, n), rng.uniform(-2.5, 2.5, n)]),
        "bounds": np.column_stack([rng.uniform(0.1, 0.4, n), rng.uniform(0.05, 0.2, n)]),
        "heading": wrapped(rng.uniform(-np.pi, np.pi, n), rng.uniform(*width, n)),
        "box": boxes(rng, n, low=size[0], high=size[1]),
    }


def _exact(rng):
    return inputs(rng, 12, width=(0, 0), size=(0, 0))


def _measured_exactly(rng):
    given = inputs(rng, 12)
    return given | {"bounds": given["bounds"] * (np.arange(12) % 4)[:, None] * [0, 0.5]}


def _along_axes(rng):
    given = inputs(rng, 12)
    course = np.arange(12) % 4 * np.pi / 2 - np.pi
    width = np.ptp(given["heading"], axis=1)
    return given | {"heading": wrapped(course - given["z"][:, 1] - width / 2, width)}


def _seam(rng):
    given = inputs(rng, 12)
    width = np.ptp(given["heading"], axis=1)
    return given | {"heading": wrapped(np.pi - width * rng.uniform(0.1, 0.9, 12), width)}


def _far_away(rng):
    given = inputs(rng, 12, size=(5, 20))
    return given | {"box": given["box"] + np.repeat(rng.uniform(-500, 500, (12, 2)), 2, axis=1)}


def _near(rng):
    given = inputs(rng, 12)
    return given | {"z": np.column_stack([given["bounds"][:, 0], given["z"][:, 1]])}


def direction_and_d_abs(given):
    """Direction and d_abs, (n,) each [rad]."""
    right, left = given["heading"].T
    return (right + left) / 2 + given["z"][:, 1], (left - right) / 2 + given["bounds"][:, 1]


def lines(given):
    """The four edges, moved out by the box's outermost corner."""
    direction, d_abs = direction_and_d_abs(given)
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
    def holds(given, out):
        got, want = unit(out["result"])[:, which], lines(given)["result"][:, which]
        size = 1 + np.abs(given["box"]).max(axis=1) + given["z"][:, 0]
        off = np.abs(got - want) / np.where([0, 0, 1], size[:, None, None], 1)
        return (off <= CLOSE).all(axis=(1, 2))

    return holds


def _on_the_way(given):
    direction, d_abs = direction_and_d_abs(given)
    return {"direction [rad]": direction, "d_abs [rad]": d_abs}


def _law(name, points, says, which, asks):
    return Law(name, points, says, _are(*which), want=lines, asks=asks, step=_on_the_way)


def _promised(given):
    """r is at least its bound, d_abs well below a right angle."""
    return (given["z"][:, 0] >= given["bounds"][:, 0]) & (direction_and_d_abs(given)[1] < 1.3)


EDGES = Task(
    id="10-edges",
    title="The edges of a measurement",
    call=CALLS["10-edges"],
    inputs=inputs,
    shapes={"result": (4, 3)},
    laws=(
        _law(
            "far",
            1,
            "the far edge points along direction and touches the farthest possible position",
            [0],
            "Which possible position of the landmark is farthest along the middle direction? From "
            "which point of the robot's box do you reach it?",
        ),
        _law(
            "near",
            2,
            "the near edge points back, touches the inner corners of the sector, and excludes none",
            [1],
            "How far are the inner corners of the sector, measured along the middle direction?",
        ),
        _law(
            "sides",
            2,
            "the left and the right edge point out of the sector, and touch it",
            [2, 3],
            "If a x + b y ≤ c holds on the inner side of a ray, to which side does (a, b) point?",
        ),
    ),
    probes=(
        Probe("a position and a heading that are known exactly", _exact),
        Probe("exact ranges or bearings", _measured_exactly),
        Probe("a direction along an axis", _along_axes),
        Probe("a heading across π", _seam),
        Probe("a large box far away", _far_away),
        Probe("a range as small as its bound", _near),
    ),
    parts=lambda given, out: {
        name: unit(out["result"])[:, k] for k, name in enumerate(("far", "near", "left", "right"))
    },
    may_round=_promised,
    begins=(
        "Draw the sector of all possible positions for a robot at one point. Which direction is "
        "its middle, and how wide is it?",
        "Which line touches the sector on its far side? Write its normal, of length 1, and its c.",
        "The robot can be anywhere in its box. By how much must each line move outwards?",
    ),
    references=(Reference("edges", "z bounds heading box", lines),),
)
