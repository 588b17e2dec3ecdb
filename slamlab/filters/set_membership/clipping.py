"""Clipping of a box by half-planes: bounding box (outer approximation) of the result (MAK 5.3)."""

import numpy as np


def clip(box, edge):
    """Return the smallest box around a box's part with a x + b y ≤ c, or None. Equation (10.9).

    The bound of x is (c − b y)/a with the y in the box that minimises b y; y is bounded likewise.
    """
    x_min, x_max, y_min, y_max = box
    a, b, c = edge
    least_ax, least_by = a * (x_min if a > 0 else x_max), b * (y_min if b > 0 else y_max)
    if least_ax + least_by > c:
        return None
    # the outer max and min keep the order of the sides despite rounding
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
    """Clip a box by several half-planes in turn; return None if it becomes empty."""
    for edge in edges:
        if box is None:
            return None
        box = clip(box, edge)
    return box


def overlapping_boxes(boxes, region, edges):
    """Return columns (k,) of boxes (4, N) that overlap a region, given as box and half-planes."""
    meet = boxes[0] <= region[1]
    for met in (boxes[1] >= region[0], boxes[2] <= region[3], boxes[3] >= region[2]):
        meet &= met
    found = np.flatnonzero(meet)
    for a, b, c in edges:
        near = boxes[:, found]
        found = found[a * near[int(a < 0)] + b * near[2 + int(b < 0)] <= c]
    return found
