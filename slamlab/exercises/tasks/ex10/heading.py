"""Exercise 10, the heading: all that a sighting leaves of it, over the seam and when boxes meet."""

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex10.bearings import (
    across_pi,
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
from slamlab.exercises.tasks.ex10.boxes import off, turned

CLOSE = 1e-7
"""What angles may be off [rad]: differences of boxes some metres away round to 1e-15."""


def _ends(given, out):
    """(n,) each: whether right, and left counted on from right, are what they should be."""
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
    return {"what the sighting alone says, [right, left]": told(given)}


def _law(name, points, says, holds, asks, step=_on_the_way):
    return Law(name, points, says, holds, want=sharpened, asks=asks, step=step)


def _promised(given):
    """(n,) whether boxes overlap or are apart, and one piece of the heading agrees."""
    r, o = given["robot"], given["box"]
    gaps = [np.maximum(o[:, k] - r[:, k + 1], r[:, k] - o[:, k + 1]) for k in (0, 2)]
    right, left = sharpened(given)["result"].T
    wide = np.ptp(given["heading"], axis=1) + np.ptp(told(given), axis=1)
    one_piece = (left >= right - 1e-9) & (wide < 2 * np.pi - 0.01)
    return (np.abs(np.max(gaps, axis=0)) > 0.005) & (overlap(given) | one_piece)


HEADING = Task(
    id="10-heading",
    title="The heading after a sighting",
    drive=DRIVES["10-heading"],
    inputs=inputs,
    shapes={"result": (2,)},
    laws=(
        _law(
            "right",
            1.5,
            "right is the first heading, going counter-clockwise, that agrees with the sighting",
            _right,
            "From which corner to which is the bearing least, and which heading follows from it?",
        ),
        _law(
            "left",
            1.5,
            "left is the last one, counted on from right, even beyond π",
            _left,
            "Which is the last heading that agrees, and on which turn do you count it?",
        ),
        _law(
            "overlap",
            1,
            "where the boxes overlap the heading stays as it is",
            _overlap,
            "In which directions may the object stand if both may be at the same place?",
            step=None,  # there is nothing on the way: the sighting alone says nothing
        ),
    ),
    probes=(
        Probe("places, bearings and headings that are known exactly", exact),
        Probe("bearings and headings on both sides of π", across_pi),
        Probe("an object due east, north, west or south", side_by_side),
        Probe("a wide heading", far_round),
        Probe("a sighting far from the origin that narrows the heading at both ends", narrowed),
        Probe("a sighting that tells nothing new", inside),
        Probe("boxes that overlap in other ways", meeting),
    ),
    parts=lambda given, out: {
        "apart": turned(out["result"])[~overlap(given)],
        "overlapping": turned(out["result"])[overlap(given)],
    },
    rounds=_promised,
)
