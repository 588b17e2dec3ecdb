"""Exercise 10, the heading: all that a sighting leaves of it, over the seam and when boxes meet."""

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex10_bearings import both, inputs, overlap, pairs, sharpened, told
from slamlab.geometry import wrap

CLOSE = 1e-4  # [rad]


def _beyond(given, out, rows):
    """(k, 2) how far right and left lie outside of what is known to be the tightest."""
    want, got = sharpened(given)[rows], out["result"][rows]
    right = wrap(want[:, 0] - got[:, 0])
    return np.column_stack([right, got[:, 1] - got[:, 0] - np.ptp(want, axis=1) - right])


def _holds(given, out):
    return (_beyond(given, out, ~overlap(given)) >= -CLOSE).all(axis=1)


def _tight(given, out):
    return (np.abs(_beyond(given, out, ~overlap(given))) <= CLOSE).all(axis=1)


def _unchanged(given, out):
    return (np.abs(_beyond(given, out, overlap(given))) <= CLOSE).all(axis=1)


# ---- mistakes: the wrong formula, computed on the same inputs --------------------------------


def _by_size(given):
    """Bearings from the least to the largest number, wrapped ones."""
    seen = pairs(given)
    ends = np.column_stack([seen.min(axis=1), seen.max(axis=1)]) - given["bearing"][:, None]
    return both(given["heading"], ends + np.column_stack([-given["bound"], given["bound"]]))


def _numbers_compared(given):
    """Right, then the larger and the smaller number, whole turns left as they are."""
    want = told(given)
    wrapped = np.column_stack([wrap(want[:, 0]), wrap(want[:, 0]) + np.ptp(want, axis=1)])
    h = given["heading"]
    return np.column_stack([np.maximum(h[:, 0], wrapped[:, 0]), np.minimum(h[:, 1], wrapped[:, 1])])


def _all_wrapped(given):
    """The same with both ends wrapped."""
    h, want = given["heading"], wrap(told(given))
    return np.column_stack([np.maximum(h[:, 0], want[:, 0]), np.minimum(h[:, 1], want[:, 1])])


def _middles(given):
    r, o = given["robot"], given["box"]
    d = [o[:, s].mean(axis=1) - r[:, s].mean(axis=1) for s in (slice(0, 2), slice(2, 4))]
    return np.arctan2(d[1], d[0])[:, None]


def answers_with(*formulas):
    """Whether what came back for boxes apart is what one of these formulas gives."""

    def matches(given, out):
        rows = ~overlap(given)
        got = out["result"][rows]
        for formula in formulas:
            off = wrap(got - formula(given)[rows])
            if (np.abs(off) < CLOSE).all():
                return True
        return False

    return matches


def _with(**changes):
    return lambda given: both(given["heading"], told(given, **changes))


HEADING = Task(
    id="10-heading",
    title="The heading after a sighting",
    drive=DRIVES["10-heading"],
    inputs=inputs,
    shapes={"result": (2,)},
    laws=(
        Law("holds", 2, "no heading that agrees with the sighting is given up", _holds),
        Law("tight", 1, "right and left are headings that agree with the sighting", _tight),
        Law("overlap", 1, "where the boxes overlap the heading stays as it is", _unchanged),
    ),
    diagnoses=(
        Diagnosis(
            "bound-forgotten",
            "The interval is not widened by d_β: the bearing may be off by as much, either way.",
            answers_with(_with(widened=0.0)),
        ),
        Diagnosis(
            "bound-inwards",
            "The interval is narrowed by d_β: take it off at right, add it at left.",
            answers_with(_with(widened=-1.0)),
        ),
        Diagnosis(
            "bearing-added",
            "The bearing has the wrong sign. It counts from the heading: direction = heading + "
            "bearing, so heading = direction − bearing.",
            answers_with(_with(sign=1.0)),
        ),
        Diagnosis(
            "from-the-object",
            "These are the directions from the object to the robot, π off. The robot looks the "
            "other way.",
            answers_with(_with(offset=np.pi)),
        ),
        Diagnosis(
            "middles-only",
            "The bearing from middle to middle is used. Robot and object may be anywhere in their "
            "boxes: find the extreme bearings.",
            answers_with(_with(bearings=_middles)),
        ),
        Diagnosis(
            "seam-bearings",
            "Where bearings lie on both sides of ±π, the least and the largest number are not the "
            "extremes: count all of them from one, with wrap.",
            answers_with(_by_size),
        ),
        Diagnosis(
            "seam-intersection",
            "Right and left are compared as numbers. −3.1 and 3.1 are close to each other: bring "
            "both intervals to the same turn before max and min.",
            answers_with(_numbers_compared, _all_wrapped),
        ),
        Diagnosis(
            "not-intersected",
            "This is what the sighting says alone. What was known before still holds: intersect.",
            answers_with(lambda g: told(g)),
        ),
        Diagnosis(
            "unchanged",
            "The heading comes back as it was, though most sightings say more.",
            answers_with(lambda g: g["heading"]),
        ),
        Diagnosis(
            "exchanged",
            "Right and left have changed places: going counter-clockwise right comes first.",
            answers_with(lambda g: sharpened(g)[:, ::-1]),
        ),
        Diagnosis(
            "overlap",
            "Where the boxes overlap, object and robot may stand in any direction of each other: "
            "the sighting says nothing about the heading. Return it unchanged.",
            lambda given, out: bool(_tight(given, out).all()),
        ),
        Diagnosis(
            "left-wrapped",
            "left comes back less than right: it is wrapped. Keep it as right + width, even beyond "
            "π: only so left − right says how wide the interval is.",
            answers_with(sharpened),
        ),
    ),
)
