"""Drawings of sectors, edges and intervals show what they are given."""

import numpy as np
from matplotlib.colors import to_hex

from slamlab import views


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
