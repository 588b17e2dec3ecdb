"""Exercise 10, the heading: its interval after a measurement."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex10_set_membership_slam.boxes import off, turned
from course.exercises.ex10_set_membership_slam.calls import CALLS
from course.exercises.ex10_set_membership_slam.heading.bearings import (
    across_pi,
    close_together,
    exact,
    far_round,
    inputs,
    inside,
    meeting,
    narrowed,
    overlap,
    sharpened,
    side_by_side,
    told,
)

CLOSE = 1e-7
"""What angles may be off [rad]: differences of boxes some metres away round to 1e-15."""


def _ends(given, out):
    """(n,) each: whether right, and left counted from right, are correct."""
    want, got = sharpened(given)["result"], out["result"]
    right = np.abs(off(got[:, 0] - want[:, 0])) <= CLOSE
    left = np.abs(off(got[:, 1] - want[:, 1])) <= CLOSE
    return right, left & (got[:, 1] >= got[:, 0] - CLOSE)


def _right(given, out):
    return _ends(given, out)[0] | overlap(given)


def _left(given, out):
    return _ends(given, out)[1] | overlap(given)


def _overlap(given, out):
    return np.logical_and(*_ends(given, out)) | ~overlap(given)


def _on_the_way(given):
    return {"heading by the measurement alone, right and left [rad]": told(given)}


def _law(name, points, says, holds, asks, step=_on_the_way):
    return Law(name, points, says, holds, want=sharpened, asks=asks, step=step)


def _promised(given):
    """Boxes clearly overlap or not; one piece of the heading agrees."""
    r, o = given["robot"], given["box"]
    gaps = [np.maximum(o[:, k] - r[:, k + 1], r[:, k] - o[:, k + 1]) for k in (0, 2)]
    right, left = sharpened(given)["result"].T
    wide = np.ptp(given["heading"], axis=1) + np.ptp(told(given), axis=1)
    one_piece = (left >= right - 1e-9) & (wide < 2 * np.pi - 0.01)
    return (np.abs(np.max(gaps, axis=0)) > 0.005) & (overlap(given) | one_piece)


HEADING = Task(
    id="10-heading",
    title="Contraction of the heading",
    call=CALLS["10-heading"],
    inputs=inputs,
    shapes={"result": (2,)},
    laws=(
        _law(
            "right",
            1.5,
            "right is the first heading, in counter-clockwise order, that agrees with the "
            "measurement",
            _right,
            "Which direction from corner to corner is smallest? Which heading follows from it?",
        ),
        _law(
            "left",
            1.5,
            "left is the last such heading; it is at least right, even if it is larger than π",
            _left,
            "Which heading is the last that agrees? Must you add a whole turn, so that left is at "
            "least right?",
        ),
        _law(
            "overlap",
            1,
            "if the boxes overlap, the heading is unchanged",
            _overlap,
            "Which directions are possible if robot and landmark can be at the same position?",
            step="Take two boxes that share one point, and choose this point for both robot and "
            "landmark. The direction between them can then be any angle.",
        ),
    ),
    probes=(
        Probe("positions, bearings and headings that are known exactly", exact),
        Probe("bearings and headings on both sides of π", across_pi),
        Probe("a landmark due east, north, west or south", side_by_side),
        Probe("a wide heading", far_round),
        Probe("a measurement far from the origin that contracts both ends", narrowed),
        Probe("a measurement that contracts nothing", inside),
        Probe("boxes that overlap in other ways", meeting),
        Probe("boxes close together, so that the measurement allows most headings", close_together),
    ),
    parts=lambda given, out: {
        "apart": turned(out["result"])[~overlap(given)],
        "overlapping": turned(out["result"])[overlap(given)],
    },
    may_round=_promised,
    references=(Reference("sharpen", "heading robot box bearing bound", sharpened),),
    begins=(
        "The direction from the robot to the landmark depends on two points. Which points of the "
        "two boxes give the smallest and the largest direction?",
        "How does the heading follow from the direction and the bearing?",
        "Which interval remains if the old heading and the new one are intersected?",
    ),
)
