"""Linked plots, map and correlation matrix: one colour means one number in both."""

import numpy as np
import pytest

from slamlab import views
from slamlab.evaluation import correlation

LANDMARKS = np.array([[1.0, 2.0], [3.0, -1.0], [-2.0, 0.5]])


@pytest.fixture
def rho():
    root = np.random.default_rng(3).normal(size=(9, 9))
    return correlation(root @ root.T)


def test_a_landmark_has_the_colour_of_its_correlation_with_the_marked_one(rho):
    _, (map_, matrix) = views.linked(LANDMARKS, rho, "abc", marked=1)
    dots, square = map_.collections
    expected = [(rho[5, k] + rho[6, k + 1]) / 2 for k in (3, 5, 7)]
    assert np.asarray(dots.get_array()) == pytest.approx(expected)
    assert np.array_equal(square.get_offsets(), LANDMARKS[1:2])
    (picture,) = matrix.images
    assert dots.get_cmap().name == picture.get_cmap().name
    assert (dots.norm.vmin, dots.norm.vmax) == (picture.norm.vmin, picture.norm.vmax)


def test_the_marked_landmarks_rows_and_columns_are_framed(rho):
    _, (_, matrix) = views.linked(LANDMARKS, rho, "abc", marked=2)
    row, column = (patch.get_bbox().bounds for patch in matrix.patches)
    assert row == (-0.5, 6.5, 9, 2)
    assert column == (6.5, -0.5, 2, 9)


def test_a_growing_matrix_keeps_its_memory(rho):
    _, (_, few) = views.linked(LANDMARKS[:2], rho[:7, :7], "ab", room=3)
    _, (_, all_) = views.linked(LANDMARKS, rho, "abc", room=3)
    assert few.get_xlim() == all_.get_xlim() == (-0.5, 8.5)
    assert few.get_ylim() == all_.get_ylim() == (8.5, -0.5)


def test_the_map_shows_the_part_asked_for(rho):
    _, (map_, _) = views.linked(LANDMARKS, rho, "abc", view=(-9, 9, -3, 3))
    assert (*map_.get_xlim(), *map_.get_ylim()) == (-9, 9, -3, 3)
