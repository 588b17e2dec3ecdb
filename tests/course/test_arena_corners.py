"""Corners of lesson 12: associated once, modified, drawn; statistics as text."""

import numpy as np
import pytest

from course.studies.arena_corners import associated_by_ekf, corner_layers, modified_corners
from course.studies.filter_comparison import FILTERS, with_corners
from course.studies.filter_records import record
from course.studies.paired_statistics import cm, percent
from slamlab.layers import Ellipses, Segments
from slamlab.sources.arena_runs import ArenaRun


@pytest.fixture(scope="module")
def run():
    source = ArenaRun(np.random.default_rng(3), laps=1)
    return source, with_corners(source)


@pytest.mark.parametrize("name", ["BOR, 4.5 σ", "FastSLAM"])
def test_corners_named_once_are_those_that_a_filter_has_named_for_itself(run, name):
    source, readings = run
    records = [
        record(FILTERS[name](source), source, each)
        for each in (readings, associated_by_ekf(source, readings))
    ]
    assert records[0].landmarks == records[1].landmarks > 0
    np.testing.assert_array_equal(records[0].errors, records[1].errors)


def test_changed_corners_stand_where_they_stood(run):
    _, readings = run
    same = modified_corners(readings, opening=True, times_R=2)
    bare = modified_corners(readings, opening=False, times_R=4)
    for before, kept, left in zip(readings, same, bare, strict=True):
        seen = before.observations
        np.testing.assert_array_equal(kept.observations.R, seen.R)
        np.testing.assert_array_equal(kept.observations.bisectors, seen.bisectors)
        np.testing.assert_allclose(left.observations.R, 2 * seen.R)
        assert left.observations.bisectors is left.observations.convex is None
        np.testing.assert_array_equal(left.observations.z, seen.z)


def test_a_bisector_begins_at_its_corner(run):
    source, readings = run
    reading = next(each for each in readings if len(each.observations.z))
    layers = corner_layers(reading, source.sensor)
    (corner,) = (each.centres for each in layers.values() if isinstance(each, Ellipses))
    arrow = layers["bisector"]
    assert isinstance(arrow, Segments)
    np.testing.assert_allclose(arrow.rows[0][:2], corner[0])


def test_an_interval_as_text():
    assert percent([0.25, 0.1, 0.5]) == "25 % (10 % to 50 %)" and percent(None) == "–"
    assert cm([0.012, -0.001, 0.02], "+") == "+1.2 (-0.1 to +2.0)"
