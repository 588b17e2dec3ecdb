"""Exercise 10, clipping: every allowed place is kept, in the smallest box that does so."""

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex10_motions import boxes

ROWS = 32
EMPTY, WHOLE = slice(0, 4), slice(4, 8)  # rows of which nothing is left, and all
ALONG = slice(8, 12)  # rows whose edges run along an axis
CLOSE = 1e-6  # [m]


def inputs(rng):
    """Edges in every direction, at most of which a side of the box is moved."""
    box = boxes(rng, ROWS, low=0.3, high=1.0)
    angle = np.arange(ROWS) % 4 * np.pi / 2 + rng.uniform(0.2, 1.37, ROWS)
    angle[ALONG] = np.arange(4) * np.pi / 2
    a, b = np.cos(angle), np.sin(angle)
    a[ALONG], b[ALONG] = [1, 0, -1, 0], [0, 1, 0, -1]
    least, most = _extremes(box, a, b)
    share = rng.uniform(0.1, 0.4, ROWS)
    share[EMPTY], share[WHOLE] = -0.3, 1.3
    return {"box": box, "edge": np.column_stack([a, b, least + share * (most - least)])}


def _extremes(box, a, b):
    """Least and most of a x + b y over boxes (n, 4)."""
    corners = _corners(box) @ np.stack([a, b], axis=1)[..., None]
    return corners.min(axis=(1, 2)), corners.max(axis=(1, 2))


def _corners(box):
    """(n, 4, 2) corners, one after the other round the box."""
    return np.stack([box[:, [0, 1, 1, 0]], box[:, [2, 2, 3, 3]]], axis=-1)


def left_over(given):
    """(n, 4) the box round what is left, by cutting the outline; NaN where nothing is.

    What is left of a convex outline has as corners those that are allowed, and where a side meets
    the edge.
    """
    corners = _corners(given["box"])
    n, c = given["edge"][:, None, :2], given["edge"][:, None, 2]
    ahead = np.roll(corners, -1, axis=1)
    here, there = (c - (n * p).sum(axis=2) for p in (corners, ahead))  # positive: allowed
    share = np.divide(here, here - there, out=np.full_like(here, np.nan), where=here != there)
    meets = np.where(((here > 0) != (there > 0))[..., None], share[..., None], np.nan)
    kept = np.where((here >= 0)[..., None], corners, np.nan)
    points = np.concatenate([kept, corners + meets * (ahead - corners)], axis=1)
    lows = np.where(np.isnan(points), np.inf, points).min(axis=1)
    highs = np.where(np.isnan(points), -np.inf, points).max(axis=1)
    found = np.column_stack([lows[:, 0], highs[:, 0], lows[:, 1], highs[:, 1]])
    return np.where(np.isfinite(found), found, np.nan)


def _something(given):
    return np.isfinite(left_over(given)).all(axis=1)


def _beyond(given, out):
    """(k, 4) how far each side lies beyond the smallest box, of rows where something is left."""
    some = _something(given)
    return ((out["box"] - left_over(given)) * [-1, 1, -1, 1])[some], out["left"][some] > 0


def _keeps(given, out):
    beyond, left = _beyond(given, out)
    return left & (beyond >= -CLOSE).all(axis=1)


def _smallest(given, out):
    beyond, left = _beyond(given, out)
    return left & (beyond <= CLOSE).all(axis=1)


def _empty(given, out):
    return (out["left"] > 0) == _something(given)


# ---- mistakes: the wrong formula, computed on the same inputs --------------------------------


def clipped(given, pick=np.min, side=1, bounded=True, sign=True, across=True):
    """The smallest box by the formula, or by it with a piece changed; also where nothing is left.

    Parameters
    ----------
    given : box (n, 4), edge (n, 3)
    pick : np.min or np.max, of b y over the box
    side : 1, or −1 for the other side of the edge
    bounded : bool, whether a side may only move inwards
    sign : bool, whether the sign of a and b says which side moves
    across : bool, whether b y is taken off c at all
    """
    box, (a, b, c) = given["box"].copy(), given["edge"].T
    products = [n[:, None] * given["box"][:, s] for n, s in ((a, slice(0, 2)), (b, slice(2, 4)))]
    for k, (n, other) in enumerate(((a, products[1]), (b, products[0]))):
        with np.errstate(divide="ignore", invalid="ignore"):
            limit = (c - (pick(other, axis=1) if across else 0.0)) / n
        upper = np.where(sign, side * n > 0, True) & (n != 0)
        lower = ~upper & (n != 0)
        new_low, new_high = limit, limit
        if bounded:
            new_low, new_high = (
                np.maximum(box[:, 2 * k], limit),
                np.minimum(box[:, 2 * k + 1], limit),
            )
        box[lower, 2 * k] = new_low[lower]
        box[upper, 2 * k + 1] = new_high[upper]
    return box


def corners_only(given):
    """The box round the allowed corners of the old one."""
    corners = _corners(given["box"])
    allowed = np.einsum("nki,ni->nk", corners, given["edge"][:, :2]) <= given["edge"][:, 2:]
    low = np.where(allowed[..., None], corners, np.inf).min(axis=1)
    high = np.where(allowed[..., None], corners, -np.inf).max(axis=1)
    return np.column_stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]])


def answers_with(*formulas):
    """Whether the boxes are what a formula gives, wherever a box came out and should have."""

    def matches(given, out):
        rows = _something(given) & (out["left"] > 0)
        cut = rows & (np.abs(left_over(given) - given["box"]) > CLOSE).any(axis=1)
        got = out["box"]
        return cut.any() and any(
            np.allclose(got[rows], wrong(given)[rows], atol=1e-6) for wrong in formulas
        )

    return matches


def _with(**changes):
    return lambda given: clipped(given, **changes)


def _never_none(given, out):
    return (out["left"] > 0).all()


def _always_some_none(given, out):
    return (out["left"][_something(given)] == 0).any()


CLIP = Task(
    id="10-clip",
    title="Clip a box and enclose it",
    drive=DRIVES["10-clip"],
    inputs=inputs,
    shapes={"left": (ROWS,), "box": (ROWS, 4)},
    laws=(
        Law("keeps", 2, "every allowed place of the old box is in the new one", _keeps),
        Law("smallest", 1, "each side of the new box touches an allowed place", _smallest),
        Law("empty", 1, "None comes back just where no place of the box is allowed", _empty),
    ),
    diagnoses=(
        Diagnosis(
            "wrong-side",
            "The box is clipped on the wrong side: a x + b y ≤ c is allowed. Where a > 0, that "
            "limits x from above.",
            answers_with(_with(side=-1), _with(side=-1, pick=np.max)),
        ),
        Diagnosis(
            "most-for-least",
            "Allowed places are cut off: x may reach (c − b y)/a for the y of the box that makes "
            "b y least, not most.",
            answers_with(_with(pick=np.max)),
        ),
        Diagnosis(
            "y-forgotten",
            "x is limited by c / a, as if y were 0. Of c there is only c − b y left for a x.",
            answers_with(_with(across=False)),
        ),
        Diagnosis(
            "grows",
            "A side is moved outwards: an edge may lie far outside of the box, and says nothing: "
            "take the min or max with the old side.",
            answers_with(_with(bounded=False)),
        ),
        Diagnosis(
            "always-upper",
            "It is always x_max and y_max that move. Dividing a x ≤ … by a negative a turns ≤ to "
            "≥: then the lower side moves.",
            answers_with(_with(sign=False), _with(sign=False, bounded=False)),
        ),
        Diagnosis(
            "corners-only",
            "This is the box round the corners that are allowed. Where the edge crosses a side of "
            "the box, places between corners are allowed, too.",
            answers_with(corners_only),
        ),
        Diagnosis(
            "never-none",
            "Nothing is left of some boxes, and a box comes back all the same. Even the best "
            "corner may be forbidden: then return None.",
            _never_none,
        ),
        Diagnosis(
            "none-too-often",
            "None comes back although some of the box is allowed: one allowed corner is enough.",
            _always_some_none,
        ),
    ),
)
