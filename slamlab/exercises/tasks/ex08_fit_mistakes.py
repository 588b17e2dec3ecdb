"""Exercise 08, classic mistakes of fitting a line, computed on the same points."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex08_lines import best_direction, is_least, outward, same, scatter, through_centroid, total
from slamlab.geometry import wrap

OTHERS = slice(4, None)  # all but the vertical walls


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


DIAGNOSES = (
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
)
