"""Exercise 10, motions: boxes, headings, ways, and the exact box of all that may come of them."""

import numpy as np

from slamlab.filters.bor.prediction import predict_box

ROWS = 24
ROUND = slice(12, 16)  # rows whose extremes lie a whole turn off


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
    return np.array([predict_box(*row, (0.0, 0.0))[0] for row in rows])


def beyond(given, out):
    """(n, 4) how far each side lies beyond the hull: positive outwards."""
    return (out["result"] - hull(given)) * [-1, 1, -1, 1]
