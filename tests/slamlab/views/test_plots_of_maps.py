"""Plots of maps: boxes and edges, linked correlations, scan overlays, named layers."""

import numpy as np
import pytest
from matplotlib.colors import to_hex

from slamlab import views
from slamlab.evaluation import correlation


def test_a_sector_is_drawn_between_its_ranges_and_angles():
    _, ax = views.axes()
    wedge = views.boxes.sector(ax, (1, 2), (0.5, 2), (0.1, 0.7), "seen")
    assert (wedge.theta1, wedge.theta2) == tuple(np.degrees((0.1, 0.7)))
    assert (wedge.r, wedge.width, wedge.center) == (2, 1.5, (1, 2))
    x, y = np.array([1, 2]) + 2 * np.array([np.cos(0.4), np.sin(0.4)])
    assert ax.get_xlim()[1] >= x - 1e-9
    assert ax.get_ylim()[1] >= y - 1e-9


def test_edges_pass_through_their_foot_points_and_leave_the_view_as_it_was():
    _, ax = views.boxes.scene("edges", (-3, 3, -2, 2))
    half_planes = [(1, 0, 2.0), (0, -1, 1.0), (0.6, 0.8, -1.0)]
    lines = views.boxes.edges(ax, half_planes, ["far", "near", "left"])
    assert len({(to_hex(line.get_color()), line.get_linestyle()) for line in lines}) == 3
    for line, (a, b, c) in zip(lines, half_planes, strict=True):
        for x, y in (line.get_xy1(), line.get_xy2()):
            assert np.isclose(a * x + b * y, c)
    assert (*ax.get_xlim(), *ax.get_ylim()) == (-3, 3, -2, 2)
    assert [text.get_text() for text in ax.legend().get_texts()] == ["far", "near", "left"]


def test_the_infeasible_side_of_an_edge_is_shaded():
    _, ax = views.axes()
    views.boxes.edges(ax, [(0.6, 0.8, 1.0)], ["far"])
    (shade,) = ax.patches
    assert (shade.get_xy() @ [0.6, 0.8]).min() >= 1 - 1e-9
    assert (shade.get_xy() @ [0.6, 0.8]).max() > 1


def test_intervals_stand_from_the_top_down_and_the_result_is_set_off():
    rows = {"first": (0, 2), "second": (1, 3), "both": (1, 2)}
    _, ax = views.boxes.intervals(rows, 1.5, "x [m]", "measurement")
    bars = [line for line in ax.lines if len(line.get_xdata()) == 2 and line.get_linewidth() >= 3]
    assert [tuple(bar.get_xdata()) for bar in bars] == list(rows.values())
    assert bars[0].get_ydata()[0] > bars[1].get_ydata()[0]
    assert bars[0].get_color() == bars[1].get_color() != bars[2].get_color()


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


FIRST = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.5]])
SECOND = np.array([[0.1, 0.2], [1.9, 0.4]])


def entries(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_each_pair_is_a_line_from_the_second_scan_to_the_first():
    _, ax = views.overlay(FIRST, SECOND, np.array([[0, 1], [1, 2]]))
    (lines,) = ax.collections
    drawn = [segment.tolist() for segment in lines.get_segments()]
    assert drawn == [[[0.1, 0.2], [1.0, 0.0]], [[1.9, 0.4], [2.0, 0.5]]]
    assert entries(ax) == ["correspondences", "first scan", "second scan"]


def test_without_pairs_only_the_two_scans_are_drawn():
    _, ax = views.overlay(FIRST, SECOND, title="two scans")
    assert not ax.collections
    first, second = (line.get_xydata() for line in ax.lines)
    assert np.array_equal(first, FIRST) and np.array_equal(second, SECOND)
    assert ax.get_title() == "two scans"
