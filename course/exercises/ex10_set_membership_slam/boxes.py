"""Random boxes and intervals."""

import numpy as np


def around(middle, half):
    """Intervals (n, 2) from middles and half-widths (n,)."""
    return np.column_stack([middle - half, middle + half])


def boxes_around(middle, half):
    """Boxes (n, 4) from middles and half-widths (n, 2) or numbers."""
    half = np.broadcast_to(half, np.shape(middle))
    return np.hstack([around(middle[:, k], half[:, k]) for k in (0, 1)])


def boxes(rng, n, centre=3.0, low=0.05, high=0.5):
    """(n, 4) boxes of generic sizes."""
    return boxes_around(rng.uniform(-centre, centre, (n, 2)), rng.uniform(low, high, (n, 2)))


def wrapped(right, width):
    """Headings (n, 2) [right, left] with right in (−π, π]."""
    right = np.pi - np.mod(np.pi - right, 2 * np.pi)
    return np.column_stack([right, right + width])


def off(angle):
    """Angles in [−π, π]."""
    return angle - 2 * np.pi * np.round(angle / (2 * np.pi))


def turned(heading):
    """(n, 2) to compare headings by: right without a jump at π, and the width."""
    right, left = np.moveaxis(heading, -1, 0)
    return np.column_stack([np.cos(right), np.sin(right), left - right])
