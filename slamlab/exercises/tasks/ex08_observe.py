"""Exercise 08, a wall from a pose: its points say where it is, differences how it moves."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex04_laws import close, differences
from slamlab.exercises.tasks.ex08_lines import direction
from slamlab.exercises.tasks.ex08_observe_mistakes import DIAGNOSES

ROWS, BEHIND = 24, 8
THROUGH = slice(0, BEHIND)  # of these rows the robot has gone through the wall


def poses_and_lines(rng):
    """Poses and walls; at first those seen from behind. Half of the directions need wrapping."""
    theta = rng.choice([-1.0, 1.0], ROWS) * rng.uniform(1.8, 3, ROWS)
    x = np.column_stack([rng.uniform(-5, 5, (ROWS, 2)), theta])
    # against the heading's sign, so that the difference leaves (−π, π]; the others stay inside
    alpha = -np.sign(theta) * rng.uniform(1.6, 3, ROWS)
    alpha[1::2] *= -0.6
    side = rng.uniform(0.5, 4, ROWS)
    side[THROUGH] *= -1
    rho = side + np.einsum("ni,ni->n", x[:, :2], direction(alpha))
    return {"x": x, "line": np.column_stack([rho, alpha])}


def _on_wall(inputs, outputs):
    """Points of the wall, in the robot's frame, lie on the line that is seen."""
    x, (rho, alpha) = inputs["x"], inputs["line"].T
    off = []
    for t in (-1.0, 2.0):
        point = rho[:, None] * direction(alpha) + t * direction(alpha + np.pi / 2) - x[:, :2]
        ahead, aside = direction(x[:, 2]), direction(x[:, 2] + np.pi / 2)
        seen = np.stack([(point * ahead).sum(axis=1), (point * aside).sum(axis=1)], axis=-1)
        off.append((seen * direction(outputs["z"][:, 1])).sum(axis=1) - outputs["z"][:, 0])
    return np.abs(off).max(axis=0) < 1e-6


def _keeps_side(inputs, outputs):
    ahead = inputs["line"][:, 1] - inputs["x"][:, 2]
    return np.cos(outputs["z"][:, 1] - ahead) > 0


def _wrapped(inputs, outputs):
    return np.abs(outputs["z"][:, 1]) <= np.pi + 1e-9


def _by(which, inputs):
    """Slopes of the observation by the pose or by the line, by differences."""
    found = []
    for x, line in zip(inputs["x"], inputs["line"], strict=True):
        if which == "x":
            found.append(differences(lambda v, line=line: _unwrapped(v, line), x))
        else:
            found.append(differences(lambda v, x=x: _unwrapped(x, v), line))
    return np.array(found)


def _unwrapped(x, line):
    """(k, 2) of many poses and a line, or of a pose and many lines."""
    return np.stack([models.h_line(x.T, line)[..., 0], line[..., 1] - x[..., 2]], axis=-1)


H_LINE = Task(
    id="08-h-line",
    title="How a wall looks from a pose",
    drive=DRIVES["08-h-line"],
    inputs=poses_and_lines,
    shapes={"z": (ROWS, 2), "H_r": (ROWS, 2, 3), "H_p": (ROWS, 2, 2)},
    laws=(
        Law("on-wall", 1, "points of the wall, in the robot's frame, lie on the line", _on_wall),
        Law(
            "keeps-side",
            1,
            "the normal points as it did when the line was placed, also beyond the wall",
            _keeps_side,
        ),
        Law("wrapped", 1, "α′ lies in (−π, π]", _wrapped),
        Law(
            "H_r",
            1,
            "H_r is how ρ′, α′ change with x, y, θ",
            lambda i, o: close(o["H_r"], _by("x", i)),
        ),
        Law(
            "H_p",
            1,
            "H_p is how ρ′, α′ change with the line's ρ, α",
            lambda i, o: close(o["H_p"], _by("line", i)),
        ),
    ),
    diagnoses=DIAGNOSES,
)
