"""Exercise 08, a wall's line by total least squares: no other line has a smaller sum of squares."""

import numpy as np

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex08_fit_mistakes import DIAGNOSES, OTHERS
from slamlab.exercises.tasks.ex08_lines import direction, is_least, outward, same

POINTS, VERTICAL = 12, slice(0, 4)


def clouds(rng, count=18):
    """Walls all the way round, the first four straight ahead or behind; and each turned."""
    alpha = np.linspace(-np.pi, np.pi, count, endpoint=False) + rng.uniform(0.05, 0.25, count)
    alpha[VERTICAL] = [0, np.pi, 0, np.pi]
    along = rng.uniform(-1, 1, (count, POINTS)) + rng.choice([-1.0, 1.0], (count, 1))
    across = rng.uniform(0.8, 4, (count, 1)) + 0.04 * rng.standard_normal((count, POINTS))
    normal = direction(alpha)[:, None]
    points = across[..., None] * normal + along[..., None] * (normal[..., ::-1] * [-1, 1])
    turn = rng.uniform(0.5, 1.2, count)
    c, s = direction(turn).T[..., None]
    turned = np.stack(
        [c * points[..., 0] - s * points[..., 1], s * points[..., 0] + c * points[..., 1]], axis=-1
    )
    return {"points": points, "turned": turned}


def _turned(inputs, outputs):
    points, again = inputs["points"][:, :2], inputs["turned"][:, :2]
    ways = [np.arctan2(*(p[:, 1] - p[:, 0]).T[::-1]) for p in (points, again)]
    turn = ways[1] - ways[0]
    line, other = outputs["line"], outputs["again"]
    return same(outward(*(line + np.stack([0 * turn, turn], -1)).T), outward(*other.T), 1e-2)


FIT_LINE = Task(
    id="08-fit-line",
    title="A wall's line",
    drive=DRIVES["08-fit-line"],
    inputs=clouds,
    shapes={"line": (18, 2), "again": (18, 2)},
    laws=(
        Law(
            "least",
            1,
            "no other line has a smaller sum of squared distances",
            lambda i, o: is_least(i["points"], o["line"])[OTHERS],
        ),
        Law(
            "vertical",
            1,
            "nor for walls straight ahead or behind, whose points have nearly the same x",
            lambda i, o: is_least(i["points"], o["line"])[VERTICAL],
        ),
        Law("outward", 1, "ρ ≥ 0", lambda i, o: o["line"][:, 0] >= 0),
        Law("turned", 1, "turn the points, and the line turns with them, ρ unchanged", _turned),
    ),
    diagnoses=DIAGNOSES,
)
