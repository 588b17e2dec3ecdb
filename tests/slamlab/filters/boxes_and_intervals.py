"""Strategies of boxes and intervals, and random members of them."""

import numpy as np
from hypothesis import strategies as st

from slamlab.filters.set_membership.angle_intervals import angle_interval

numbers = st.floats(-20, 20)
seeds = st.integers(0, 2**32 - 1)


def ordered(low, high, within=numbers):
    return st.tuples(within, within).map(sorted).map(tuple)


some = ordered(-20, 20)
boxes = st.tuples(some, some).map(lambda sides: (*sides[0], *sides[1]))
arcs = st.tuples(st.floats(-10, 10), st.floats(0, 7)).map(
    lambda a: angle_interval(a[0], a[0] + a[1])
)


def within(interval, n, rng):
    """Samples of an interval, both ends among them."""
    low, high = interval  # rng.uniform refuses 0 to −0
    return np.concatenate([interval, low + (high - low) * rng.random(n)])


def in_box(box, n, rng):
    """Points of a box, its corners among them."""
    corners = [(x, y) for x in box[:2] for y in box[2:]]
    inner = [within(side, n, rng)[2:] for side in (box[:2], box[2:])]
    return np.concatenate([corners, np.column_stack(inner)])
