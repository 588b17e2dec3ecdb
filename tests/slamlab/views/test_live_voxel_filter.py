"""However long a robot drives in the same rooms, what is drawn of them does not grow on and on."""

import numpy as np
import pytest

from slamlab.layers import Points, Poses
from slamlab.live.voxel_filter import CELL, MANY, CloudDownsampling, DownsampledCloud

LAP = 8_000  # points of a lap


def lap(rng):
    """Points along the walls of a room of 4 by 3 m, some millimetres off."""
    at = rng.uniform(0, 14, LAP)
    x = np.interp(at, [0, 4, 7, 11, 14], [0, 4, 4, 0, 0])
    y = np.interp(at, [0, 4, 7, 11, 14], [0, 0, 3, 3, 0])
    return np.column_stack([x, y]) + rng.normal(0, 0.004, (LAP, 2))


def cells(xy):
    row, column = np.floor(xy / CELL).astype(int).T
    return np.unique(10_000 * row + column)


@pytest.fixture
def laps():
    rng = np.random.default_rng(0)
    pieces = [lap(rng) for _ in range(15)]
    return [np.concatenate(pieces[: n + 1]) for n in range(15)]


def test_a_small_point_cloud_is_drawn_unchanged():
    layers = [Points("map", np.zeros((MANY, 2))), Poses("corrected", np.zeros((MANY + 1, 3)))]
    assert all(a is b for a, b in zip(CloudDownsampling()(layers), layers, strict=True))


def test_a_large_point_cloud_keeps_one_point_a_cell_and_what_was_drawn_stays(laps):
    thinned, before = CloudDownsampling(), np.empty((0, 2))
    for xy in laps[3:]:
        (layer,) = thinned([Points("map", xy)])
        assert np.array_equal(cells(layer.xy), cells(xy)) and len(layer.xy) == len(cells(xy))
        assert np.array_equal(layer.xy[: len(before)], before)
        before = layer.xy
    assert len(before) < MANY / 2 < MANY * 5 < len(laps[-1])


def test_a_replaced_point_cloud_is_downsampled_from_the_start(laps):
    """One that is moved as a whole, as when a loop is closed; and a shorter one, after a reset."""
    cloud = DownsampledCloud()
    cloud.of(laps[9])
    for xy in (laps[9] + [3.0, 0.0], laps[4], laps[9][::-1]):
        assert np.array_equal(cells(cloud.of(xy)), cells(xy))


def test_non_finite_points_are_not_drawn(laps):
    xy = np.vstack([laps[4], [[np.nan, 1.0], [np.inf, 0.0]]])
    assert np.isfinite(DownsampledCloud().of(xy)).all()
