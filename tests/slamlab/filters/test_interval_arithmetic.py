"""Interval arithmetic of numbers and angles: results contain all values, and are tight."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.filters.set_membership import intervals
from slamlab.filters.set_membership.angle_intervals import (
    FULL_CIRCLE,
    angle_interval,
    angle_sum,
    bearing_interval,
    contains,
    hull,
    intersection,
    midpoint,
)
from slamlab.filters.set_membership.intervals import cosine, product, sine, widened, width
from tests.slamlab.filters.boxes_and_intervals import (
    arcs,
    boxes,
    in_box,
    ordered,
    seeds,
    some,
    within,
)


@given(some, some, seeds)
def test_a_product_holds_all_products_and_its_ends_are_some(a, b, seed):
    rng = np.random.default_rng(seed)
    low, high = product(a, b)
    found = np.outer(within(a, 20, rng), within(b, 20, rng))
    assert low == found.min()
    assert high == found.max()


@pytest.mark.parametrize(("of", "function"), [(cosine, np.cos), (sine, np.sin)])
@given(start=st.floats(-20, 20), wide=st.floats(0, 8), seed=seeds)
def test_sine_and_cosine_hold_all_values_and_are_as_tight_as_a_fine_grid(
    of, function, start, wide, seed
):
    low, high = of((start, start + wide))
    found = function(np.linspace(start, start + wide, 2001))
    assert low <= found.min() + 1e-12
    assert high >= found.max() - 1e-12
    assert found.min() - low < 1e-5
    assert high - found.max() < 1e-5


@given(ordered(0, 0, st.floats(-6.28, 6.28) | st.floats(-40, 40)), seeds)
def test_chord_over_arc_holds_all_values(turn, seed):
    low, high = intervals.chord(turn)
    found = np.sinc(within(turn, 50, np.random.default_rng(seed)) / 2 / np.pi)
    assert low - 1e-12 <= found.min() <= found.max() <= high + 1e-12


@given(arcs)
def test_angles_have_one_form(a):
    assert -np.pi < a[0] <= np.pi
    assert 0 <= width(a) <= 2 * np.pi
    assert contains(a, midpoint(a)) or a == FULL_CIRCLE


@given(arcs, arcs, seeds)
def test_an_intersection_holds_just_what_both_hold(a, b, seed):
    pieces = intersection(a, b)
    assert len(pieces) <= 2
    for angle in np.random.default_rng(seed).uniform(-4, 4, 60):
        both = contains(a, angle) and contains(b, angle)
        near = any(contains(widened(p, 1e-9), angle) for p in pieces)
        assert near or not both
        if any(contains(widened(p, -1e-9), angle) for p in pieces if width(p) > 1e-8):
            assert both


def test_intersections_over_the_seam_may_be_empty_one_piece_or_two():
    behind, ahead = angle_interval(3.0, 3.3), angle_interval(-0.2, 0.2)
    assert intersection(behind, ahead) == []
    (piece,) = intersection(behind, angle_interval(-3.1, -2.5))
    np.testing.assert_allclose(piece, angle_interval(2 * np.pi - 3.1, 3.3))
    nearly_all = angle_interval(-3.0, 3.0)
    assert len(intersection(nearly_all, angle_interval(2.5, 3.9))) == 2
    assert len(intersection(angle_interval(2.5, 3.9), nearly_all)) == 2


@given(arcs, arcs, seeds)
def test_the_hull_of_pieces_contains_them_and_is_no_wider_than_either(a, b, seed):
    pieces = intersection(a, b)
    if not pieces:
        return
    around = hull(pieces)
    assert width(around) <= min(width(a), width(b)) + 1e-9
    rng = np.random.default_rng(seed)
    for piece in pieces:
        assert all(contains(widened(around), angle) for angle in within(piece, 20, rng))


@given(arcs, arcs, seeds)
def test_a_sum_of_angles_holds_all_sums(a, b, seed):
    rng = np.random.default_rng(seed)
    total = widened(angle_sum(a, b))
    sums = within(a, 20, rng) + within(b, 20, rng)
    assert total[1] - total[0] >= 2 * np.pi or all(contains(total, angle) for angle in sums)


@given(boxes, boxes, seeds)
def test_bearings_hold_every_direction_from_box_to_box(a, b, seed):
    rng = np.random.default_rng(seed)
    found = bearing_interval(a, b)
    d = in_box(b, 40, rng)[:, None] - in_box(a, 40, rng)[None]
    seen = np.arctan2(d[..., 1], d[..., 0])[np.hypot(d[..., 0], d[..., 1]) > 0]
    assert found == FULL_CIRCLE or all(contains(found, angle) for angle in seen.ravel())
    apart = a[1] < b[0] - 1e-9 or b[1] < a[0] - 1e-9 or a[3] < b[2] - 1e-9 or b[3] < a[2] - 1e-9
    assert (found == FULL_CIRCLE) == (not apart)
    if apart:
        assert width(found) <= np.pi + 1e-9
        ends = np.array(found)
        corners = d[:4, :4].reshape(-1, 2)
        off = np.abs(np.angle(np.exp(1j * (ends[:, None] - np.arctan2(*corners.T[::-1])))))
        far = np.hypot(*corners.T).min() > 1e-3  # the widening turns what is next to it
        assert not far or (off.min(axis=1) < 1e-6).all()
