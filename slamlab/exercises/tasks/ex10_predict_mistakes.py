"""Exercise 10, prediction: the boxes that classic mistakes give, on the same inputs."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex10_motions import beyond, hull

FINE = 1001  # directions tried
ROUNDING = 1e-9  # [m]


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
    off = beyond(given, out)
    return (off > -0.3).all() and (off < ROUNDING).all() and (off < -ROUNDING).sum() > 4


def answers_with(*formulas):
    """Whether the result is what one of these formulas gives."""

    def matches(given, out):
        return any(np.allclose(out["result"], wrong(given), atol=1e-4) for wrong in formulas)

    return matches


MISTAKES = (
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
)
