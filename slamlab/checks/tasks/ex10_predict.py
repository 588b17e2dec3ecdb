"""Exercise 10, prediction: no drive leaves the box, and no box is wider than the drives need."""

import numpy as np

from slamlab.checks.drives.ex10 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.filters.bor.predict import moved

ROWS = 24
ROUND = slice(12, 16)  # rows whose extremes lie a whole turn off
LOOSE = 1e-4  # what a box may be wider than need be [m]
ROUNDING = 1e-9  # [m]
FINE = 1001  # directions tried where a mistake is computed


def around(middle, half):
    """Intervals (n, 2) from middles and half-widths (n,)."""
    return np.column_stack([middle - half, middle + half])


def boxes(rng, n, centre=3.0, low=0.05, high=0.5):
    """(n, 4) boxes of generic sizes."""
    x, y = rng.uniform(-centre, centre, (2, n))
    half_x, half_y = rng.uniform(low, high, (2, n))
    return np.hstack([around(x, half_x), around(y, half_y)])


def inputs(rng):
    """Every direction of the compass is met inside some interval, whole turns off for some."""
    # thrice round the four directions, the other rows anywhere
    of = np.where(np.arange(ROWS) < 12, np.arange(ROWS) % 4 * np.pi / 2, rng.uniform(-3, 3, ROWS))
    half = rng.uniform(0.25, 0.6, ROWS)
    aside, half_aside = rng.uniform(-2.5, 2.5, ROWS), rng.uniform(0.05, 0.2, ROWS)
    of[ROUND] = [2 * np.pi, 3 / 2 * np.pi, -2 * np.pi, -3 / 2 * np.pi]
    aside[ROUND] = np.array([1, 1, -1, -1]) * rng.uniform(3.9, 4.2, 4)
    course = of + rng.uniform(-0.2, 0.2, ROWS)
    right = np.angle(np.exp(1j * (course - aside - half)))
    back = np.where(np.arange(ROWS) % 3 == 0, -1.0, 1.0)
    way = np.sort(np.column_stack([rng.uniform(0.3, 2, ROWS) * back, rng.uniform(0.3, 2, ROWS)]))
    return {
        "box": boxes(rng, ROWS),
        "heading": np.column_stack([right, right + 2 * half]),
        "way": way,
        "direction": around(aside, half_aside),
    }


def hull(given):
    """(n, 4) the box of all ends: no quantity stands twice in x' or y', so intervals are exact."""
    rows = zip(
        *(given[name].tolist() for name in ("box", "heading", "way", "direction")), strict=True
    )
    return np.array([moved(*row, (0.0, 0.0))[0] for row in rows])


def _beyond(given, out):
    """(n, 4) how far each side lies beyond the hull: positive outwards."""
    return (out["result"] - hull(given)) * [-1, 1, -1, 1]


# ---- mistakes: the wrong formula, computed on the same inputs --------------------------------


def _spanned(given, cosines, sines, way=None, box=None):
    """Boxes from ranges of cosine and sine, (n, 2) each, by all four products."""
    way = given["way"] if way is None else way
    box = given["box"] if box is None else box
    sides = []
    for of in (cosines, sines):
        products = way[:, :, None] * of[:, None]
        sides += [products.min(axis=(1, 2)), products.max(axis=(1, 2))]
    return box + np.column_stack(sides)


def _course(given):
    return given["heading"] + given["direction"]


def _ends(of, course):
    return np.sort(of(course), axis=1)


def _fine(of, course):
    tried = of(np.linspace(*course.T, FINE, axis=-1))
    return np.column_stack([tried.min(axis=1), tried.max(axis=1)])


def corners_only(given):
    course = _course(given)
    return _spanned(given, _ends(np.cos, course), _ends(np.sin, course))


def once_round(given):
    """Extremes looked for at −π/2, 0, π/2 and π only, not whole turns off."""
    low, high = _course(given).T
    found = []
    for of, least, most in ((np.cos, (np.pi,), (0.0,)), (np.sin, (-np.pi / 2,), (np.pi / 2,))):
        ends = _ends(of, _course(given))
        for angle in least:
            ends[(low <= angle) & (angle <= high), 0] = -1
        for angle in most:
            ends[(low <= angle) & (angle <= high), 1] = 1
        found.append(ends)
    return _spanned(given, *found)


def any_direction(given):
    whole = np.broadcast_to([-1.0, 1.0], (len(given["way"]), 2))
    return _spanned(given, whole, whole)


def two_products(given):
    course = _course(given)
    sides = [np.sort(given["way"] * _fine(of, course), axis=1) for of in (np.cos, np.sin)]
    return given["box"] + np.hstack(sides)


def box_forgotten(given):
    course = _course(given)
    return _spanned(
        given, _fine(np.cos, course), _fine(np.sin, course), box=np.zeros_like(given["box"])
    )


def direction_forgotten(given):
    course = given["heading"]
    return _spanned(given, _fine(np.cos, course), _fine(np.sin, course))


def heading_narrow(given):
    middle = given["heading"].mean(axis=1, keepdims=True)
    course = middle + given["direction"]
    return _spanned(given, _fine(np.cos, course), _fine(np.sin, course))


def exchanged(given):
    course = _course(given)
    return _spanned(given, _fine(np.sin, course), _fine(np.cos, course))


def in_degrees(given):
    course = np.radians(_course(given))
    return _spanned(given, _fine(np.cos, course), _fine(np.sin, course))


def in_degrees_there(given):
    """np.degrees put before a cosine; by the ends, as a range of degrees is wider than a turn."""
    course = np.degrees(_course(given))
    return _spanned(given, _ends(np.cos, course), _ends(np.sin, course))


def other_order(given):
    return hull(given)[:, [0, 2, 1, 3]]


def sampled(given, out):
    """Whether boxes are a little too small all round, as the best of many tries are."""
    beyond = _beyond(given, out)
    return (beyond > -0.3).all() and (beyond < ROUNDING).all() and (beyond < -ROUNDING).sum() > 4


def answers_with(*formulas):
    """Whether the result is what one of these formulas gives."""

    def matches(given, out):
        return any(np.allclose(out["result"], wrong(given), atol=1e-4) for wrong in formulas)

    return matches


PREDICT = Task(
    id="10-predict",
    title="The box after a drive",
    drive=DRIVES["10-predict"],
    inputs=inputs,
    shapes={"result": (4,)},
    laws=(
        Law(
            "holds",
            2,
            "no drive within the bounds ends outside of the box",
            lambda given, out: (_beyond(given, out) >= -ROUNDING).all(axis=1),
        ),
        Law(
            "tight",
            2,
            "every side of the box is reached by some drive within the bounds",
            lambda given, out: (np.abs(_beyond(given, out)) <= LOOSE).all(axis=1),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "corners-only",
            "The box is that of the ends of the intervals: unsound. A heading of −0.5 to 0.5 rad "
            "has cos 0.88 at both ends and 1 between them. Ask whether a multiple of π/2 lies "
            "inside.",
            answers_with(corners_only),
        ),
        Diagnosis(
            "once-round",
            "Extremes are found at 0, ±π/2 and π, and not a whole turn off. heading + direction "
            "may go beyond π: ask (angle − low) % (2π) ≤ high − low.",
            answers_with(once_round),
        ),
        Diagnosis(
            "any-direction",
            "The box holds every drive, and many more: sine and cosine are taken from −1 to 1 "
            "always. Which of their values are met between the two ends?",
            answers_with(any_direction),
        ),
        Diagnosis(
            "two-products",
            "Low · low and high · high are not always the extremes: the robot may back, and a "
            "cosine may be negative. Take the least and the largest of all four products.",
            answers_with(two_products),
        ),
        Diagnosis(
            "box-forgotten",
            "This is the box of the displacement. The robot started somewhere in its own box: add "
            "low to low, high to high.",
            answers_with(box_forgotten),
        ),
        Diagnosis(
            "direction-forgotten",
            "The robot does not drive along its heading: the direction δ has to be added to it, "
            "low to right and high to left.",
            answers_with(direction_forgotten),
        ),
        Diagnosis(
            "heading-narrow",
            "Only the middle of the heading is used. Any heading from right to left may be true.",
            answers_with(heading_narrow),
        ),
        Diagnosis(
            "exchanged",
            "Sine and cosine have changed places: x grows with the cosine.",
            answers_with(exchanged),
        ),
        Diagnosis(
            "degrees",
            "The angles are in radians already, and np.cos wants radians.",
            answers_with(in_degrees, in_degrees_there),
        ),
        Diagnosis(
            "order",
            "The numbers are right, their order is not: x_min, x_max, y_min, y_max.",
            answers_with(other_order),
        ),
        Diagnosis(
            "sampled",
            "The box is a hair too small: the best of many drives that were tried. Between two of "
            "them the cosine may be larger still. Find the extremes themselves.",
            sampled,
        ),
    ),
)
