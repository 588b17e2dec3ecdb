"""Exercise 08, a wall's line by total least squares: no other line has a smaller sum of squares."""

import numpy as np

from slamlab.checks.drives.ex08 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.geometry import wrap

POINTS, VERTICAL, OTHERS = 12, slice(0, 4), slice(4, None)
SLACK = 1e-4  # share of the least sum of squares: whoever searches instead of solving passes


def direction(alpha):
    """(..., 2) unit vectors that point to alpha (...)."""
    return np.stack([np.cos(alpha), np.sin(alpha)], axis=-1)


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


def distances(points, line):
    """(n, k) signed distances of points (n, k, 2) from lines (n, 2)."""
    normal = direction(line[:, 1])
    return np.einsum("nki,ni->nk", points, normal) - line[:, :1]


def scatter(points):
    """(n, 2, 2) sums of squares and products about the centroid."""
    off = points - points.mean(axis=1, keepdims=True)
    return np.einsum("nki,nkj->nij", off, off)


def is_least(points, line):
    """(n,) whether the sum of squares is the least of all lines: the least eigenvalue."""
    least = np.linalg.eigvalsh(scatter(points))[:, 0]
    return np.square(distances(points, line)).sum(axis=1) <= (1 + SLACK) * least + 1e-10


def outward(rho, alpha):
    """(n, 2) the same lines with ρ ≥ 0."""
    back = rho < 0
    return np.column_stack([np.abs(rho), wrap(alpha + np.pi * back)])


def same(got, want, tolerance=1e-4):
    """(n,) whether lines are the same numbers, but for whole turns."""
    off = np.abs([got[:, 0] - want[:, 0], wrap(got[:, 1] - want[:, 1])])
    return off.max(axis=0) < tolerance


def through_centroid(points, alpha):
    """(n, 2) lines of those directions through the centroids."""
    return outward(np.einsum("ni,ni->n", points.mean(axis=1), direction(alpha)), alpha)


def best_direction(S):
    """(n,) direction of the normal, from sums of squares and products."""
    return 0.5 * np.arctan2(-2 * S[:, 0, 1], S[:, 1, 1] - S[:, 0, 0])


def total(points):
    """(n, 2) lines of total least squares."""
    return through_centroid(points, best_direction(scatter(points)))


# ---- mistakes -------------------------------------------------------------------------------


def school(points):
    S = scatter(points)
    return through_centroid(points, np.arctan2(1, -S[:, 0, 1] / S[:, 0, 0]))


def school_of_x(points):
    S = scatter(points)
    return through_centroid(points, np.arctan2(-S[:, 0, 1] / S[:, 1, 1], 1))


def steeper_of_both(points):
    S = scatter(points)
    flat = (S[:, 0, 0] > S[:, 1, 1])[:, None]
    return np.where(flat, school(points), school_of_x(points))


def not_centred(points):
    return through_centroid(points, best_direction(np.einsum("nki,nkj->nij", points, points)))


def along(points):
    return through_centroid(points, best_direction(scatter(points)) + np.pi / 2)


def half_forgotten(points):
    return through_centroid(points, 2 * best_direction(scatter(points)))


def half_of_arctan(points):
    S = scatter(points)
    return through_centroid(points, 0.5 * np.arctan(2 * S[:, 0, 1] / (S[:, 0, 0] - S[:, 1, 1])))


def is_answer(*wrongs, rows=OTHERS):
    """Whether the lines are what one of these formulas gives, whichever way the normal points."""

    def matches(inputs, outputs):
        got = outputs["line"]
        got = outward(got[:, 0], got[:, 1])[rows]
        return any(same(got, wrong(inputs["points"])[rows]).all() for wrong in wrongs)

    return matches


def _negative(inputs, outputs):
    line = outputs["line"]
    right = is_least(inputs["points"], line)
    return right.all() and (line[:, 0] < 0).any()


def _half_turn(inputs, outputs):
    line, want = outputs["line"], total(inputs["points"])
    opposite = np.column_stack([want[:, 0], wrap(want[:, 1] + np.pi)])
    fits = np.abs([same(line, want), same(line, opposite), same(line * [-1, 1], want)])
    return fits.any(axis=0).all() and not fits[0].all()


def _swapped(inputs, outputs):
    return is_least(inputs["points"], outputs["line"][:, ::-1]).all()


def _degrees(inputs, outputs):
    return is_least(inputs["points"], outputs["line"] * [1, np.pi / 180]).all()


# ---- laws -----------------------------------------------------------------------------------


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
    diagnoses=(
        Diagnosis(
            "school",
            "This is y = a x + b: it measures distances along y, and fails where the wall is "
            "steep. Measure them across the line.",
            is_answer(school),
        ),
        Diagnosis(
            "school-of-x",
            "This is x = a y + b: it measures distances along x, and fails for walls beside the "
            "robot. Measure them across the line.",
            is_answer(school_of_x, steeper_of_both),
        ),
        Diagnosis(
            "not-centred",
            "Take the centroid off before you sum squares and products: the line goes through the "
            "centroid, not through the origin.",
            is_answer(not_centred),
        ),
        Diagnosis(
            "along",
            "α is 90° off: this is the direction in which the points scatter most, along the wall. "
            "The normal is the eigenvector of the smallest eigenvalue (eigh sorts them upwards).",
            is_answer(along),
        ),
        Diagnosis(
            "half-forgotten",
            "atan2(−2 S_ab, S_bb − S_aa) is 2α: take half of it.",
            is_answer(half_forgotten),
        ),
        Diagnosis(
            "arctan",
            "Half of arctan of the quotient is the normal for some walls and the wall's own "
            "direction for others. Give atan2 both signs: ½ atan2(−2 S_ab, S_bb − S_aa).",
            is_answer(half_of_arctan),
        ),
        Diagnosis("swapped", "ρ and α have changed places: return rho, alpha.", _swapped),
        Diagnosis("degrees", "α is in degrees: radians, please.", _degrees),
        Diagnosis(
            "negative",
            "The line is right, but ρ is negative for some: turn the normal by π and ρ changes "
            "its sign.",
            _negative,
        ),
        Diagnosis(
            "half-turn",
            "For some walls α is off by π: where ρ came out negative, its sign was changed, but α "
            "was not turned with it (or the other way round).",
            _half_turn,
        ),
    ),
)
