"""Clipping a box by a half-plane, to the bounding box of the rest (MAK thesis, figure 5.3)."""

import numpy as np


def clip(box, edge):
    """Clip a box by a half-plane: the smallest box (hull) of the part inside.

    A point (x, y) of it has a x ≤ c − b y; the most that allows for x is with the y of the box that
    makes b y least. The same for y. Equation (10.9).

    Parameters
    ----------
    box : (x_min, x_max, y_min, y_max) [m]
    edge : (a, b, c), valid where a x + b y ≤ c

    Returns
    -------
    (x_min, x_max, y_min, y_max) [m], never larger; None where nothing is left
    """
    x_min, x_max, y_min, y_max = box
    a, b, c = edge
    least_ax, least_by = a * (x_min if a > 0 else x_max), b * (y_min if b > 0 else y_max)
    if least_ax + least_by > c:
        return None
    # the outer max and min: rounding must not turn a box of no width inside out
    if a > 0:
        x_max = max(x_min, min(x_max, (c - least_by) / a))
    elif a < 0:
        x_min = min(x_max, max(x_min, (c - least_by) / a))
    if b > 0:
        y_max = max(y_min, min(y_max, (c - least_ax) / b))
    elif b < 0:
        y_min = min(y_max, max(y_min, (c - least_ax) / b))
    return x_min, x_max, y_min, y_max


def clip_all(box, edges):
    """Clip a box by several half-planes, one after the other; None where it becomes empty."""
    for edge in edges:
        if box is None:
            return None
        box = clip(box, edge)
    return box


def overlapping_boxes(boxes, region, edges):
    """Overlap test: which of many boxes meet a region (its box, and each edge's half-plane).

    Parameters
    ----------
    boxes : (4, N) rows x_min, x_max, y_min, y_max [m]
    region : (x_min, x_max, y_min, y_max) that holds the region [m]
    edges : half-planes (a, b, c)

    Returns
    -------
    (k,) int, columns
    """
    meet = boxes[0] <= region[1]
    for met in (boxes[1] >= region[0], boxes[2] <= region[3], boxes[3] >= region[2]):
        meet &= met
    found = np.flatnonzero(meet)
    for a, b, c in edges:
        near = boxes[:, found]
        found = found[a * near[int(a < 0)] + b * near[2 + int(b < 0)] <= c]
    return found
