"""04-camera: the column at which a camera on the robot sees a landmark, and its derivatives."""

import numpy as np

from slamlab.exercises.drives.ex04 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex04.generic import DIFFERENCED, differences, poses

ROWS = 24


def _seen(x, mount, F, ahead, left):
    """Inputs in which each camera sees its landmark so far ahead, and so far to its left."""
    c, s = np.cos(x[:, 2]), np.sin(x[:, 2])
    forward, aside = mount[:, 0] + ahead, mount[:, 1] + left
    p = x[:, :2] + np.column_stack([c * forward - s * aside, s * forward + c * aside])
    return {"x": x, "p": p, "mount": mount, "F": F}


def _generic(rng, n):
    ahead = rng.uniform(1, 8, n)
    x, mount = poses(rng, n), rng.uniform(0.1, 0.5, (n, 2)) * rng.choice([-1, 1], (n, 2))
    return x, mount, rng.uniform(200, 800, n), ahead, ahead * rng.uniform(-0.8, 0.8, n)


def _random(rng):
    return _seen(*_generic(rng, ROWS))


def _simple(rng):
    x, mount = np.zeros((2, 3)), np.array([[0.0, 0.0], [0.5, 0.0]])
    return {"x": x, "p": np.array([[2.0, 1.0], [2.5, 1.0]]), "mount": mount, "F": np.full(2, 100.0)}


def _in_the_middle(rng):
    x, mount, F, ahead, left = _generic(rng, 3)
    return _seen(x, mount, F, ahead, 0 * left)


def _turned(rng):
    x, *rest = _generic(rng, 4)
    x[:, 2] = [np.pi, -np.pi, 3 * np.pi / 2, 7.0]
    return _seen(x, *rest)


def _at_the_side(rng):
    x, mount, F, ahead, _ = _generic(rng, 2)
    return _seen(x, mount, F, ahead, np.array([3.0, -4.0]) * ahead)


def _near_and_far(rng):
    x, mount, F, ahead, left = _generic(rng, 4)
    scale = np.array([0.5, 0.6, 15, 25]) / ahead
    return _seen(x, mount, F, scale * ahead, scale * left)


def _in_front(x, p, mount):
    """The landmark in the camera's frame: ahead and left of it; broadcast over leading axes."""
    (dx, dy), c, s = np.moveaxis(p - x[..., :2], -1, 0), np.cos(x[..., 2]), np.sin(x[..., 2])
    return c * dx + s * dy - mount[..., 0], c * dy - s * dx - mount[..., 1]


def _column(x, p, mount, F):
    ahead, left = _in_front(x, p, mount)
    return -F * left / ahead


def _u(inputs):
    return {"u": _column(**inputs)}


def _H(inputs):
    """∂u/∂(x, y, θ, p_x, p_y) by differences, (n, 5)."""
    both = np.hstack([inputs["x"], inputs["p"]])
    mount, F = inputs["mount"][:, None], inputs["F"][:, None]
    found = differences(lambda v: _column(v[..., :3], v[..., 3:], mount, F)[..., None], both)
    return {"H": found[:, 0]}


def _frame(inputs):
    ahead, left = _in_front(inputs["x"], inputs["p"], inputs["mount"])
    return {"X": ahead, "Y": left}


def _shapes(inputs):
    n = len(inputs["x"])
    return {"u": (n,), "H": (n, 5)}


def _parts(inputs, outputs):
    H = outputs["H"]
    return {"u": outputs["u"], "place": H[:, :2], "heading": H[:, 2], "landmark": H[:, 3:]}


def _entries(name, points, says, at, asks):
    return equals(
        name,
        points,
        says,
        _H,
        parts={"H": at},
        tolerance=DIFFERENCED,
        asks=asks,
        step=_frame,
    )


TASK = Task(
    id="04-camera",
    title="A camera beside the robot's centre",
    drive=DRIVES["04-camera"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        equals(
            "column",
            1,
            "u is the column at which the camera sees the landmark",
            _u,
            asks="Where is the landmark in the robot's frame, and where is the camera in it? What "
            "does that make of X and Y?",
            step=_frame,
        ),
        _entries(
            "place",
            1,
            "the first two entries of H are how u changes with the robot's x and y",
            np.s_[:2],
            "Step by 1 cm along the world's x: by how much do X and Y change? And the quotient of "
            "two things that both change?",
        ),
        _entries(
            "heading",
            1.5,
            "the third entry of H is how u changes with the heading",
            np.s_[2:3],
            "Turn the robot on the spot: the camera looks another way. Does it also move?",
        ),
        _entries(
            "landmark",
            1,
            "the last two entries of H are how u changes with the landmark's x and y",
            np.s_[3:],
            "Robot and landmark both move 1 cm to the north. What happens to the image?",
        ),
    ),
    probes=(
        Probe("a robot at the origin that looks along x", _simple),
        Probe("a landmark in the middle of the image", _in_the_middle),
        Probe("headings at π and beyond", _turned),
        Probe("landmarks at 50 cm and at 25 m", _near_and_far),
        Probe("landmarks far to the side", _at_the_side),
    ),
    parts=_parts,
    rounds=False,  # a rounded landmark may lie behind the camera
)
