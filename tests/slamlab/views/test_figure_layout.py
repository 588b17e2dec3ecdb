"""Arrangement of figures: legends leave the data free, titles stay inside, whatever is drawn."""

import numpy as np
import pytest

from slamlab import views
from slamlab.layers import Points, Segments
from slamlab.views import figure_display
from slamlab.views.figure_checks import faults
from slamlab.views.figure_layout import arrange


def wall(x=4.0):
    return Segments("walls", np.array([[0, 0, x, 0.0], [x, 0, x, 3]]))


def test_a_legend_over_data_moves_to_a_free_corner():
    fig, ax = views.chart("x", "y")
    ax.plot([0, 1], [0, 1], label="a line")
    views.legend(ax, loc="center")
    assert faults(fig)
    arrange(fig)
    assert faults(fig) == []
    assert ax.get_legend() is not None and not fig.legends


def test_without_a_free_position_all_legends_go_below():
    fig, both = views.panels(["left", "right"], size=(9, 4))
    everywhere = np.random.default_rng(0).uniform(-1, 6, (5000, 2))
    views.draw(both[0], Points("scan", everywhere))
    views.draw(both[1], wall())
    for ax in both:
        views.legend(ax, title="what")
    arrange(fig)
    (below,) = fig.legends
    assert [text.get_text() for text in below.get_texts()] == ["scan", "walls"]
    assert below.get_title().get_text() == "what"
    assert all(ax.get_legend() is None for ax in both)
    assert faults(fig) == []


def test_a_legend_wider_than_its_axes_goes_below():
    fig, ax = views.chart("x", "y", size=(5, 3))
    for k in range(4):
        ax.plot([0, 1], [0, 0], label=f"a name that is rather long, {k}")
    views.legend(ax, ncols=4, loc="upper center")
    arrange(fig)
    assert fig.legends and faults(fig) == []


def test_a_legend_that_covers_no_data_stays():
    fig, ax = views.chart("x", "y")
    ax.plot([0, 1], [0, 1], label="a line")
    views.legend(ax, loc="lower right")
    arrange(fig)
    where = ax.get_legend().get_window_extent()
    assert where.x0 > fig.bbox.width / 2 and where.y1 < fig.bbox.height / 2


@pytest.mark.parametrize("size", [(5, 4), (8, 3), (11, 5)])
def test_titles_are_wrapped_to_what_their_panel_has_room_for(size):
    long = "The same sighting from anywhere in the box of the robot, and a word more"
    fig, _ = views.panels([long, long], size)
    assert faults(fig)
    arrange(fig)
    assert faults(fig) == []
    assert (
        len({tuple(text.get_window_extent().bounds) for text in (ax.title for ax in fig.axes)}) == 2
    )
    left, right = (ax.title.get_window_extent() for ax in fig.axes)
    assert left.x1 <= right.x0


@pytest.mark.parametrize("high", [2, 3, 4, 6])
def test_titles_above_maps_and_a_legend_below_them_are_all_inside(high):
    fig, _ = views.side_by_side({"truth": [wall()], "odometry": [wall(3.0)]}, size=(8, high))
    arrange(fig)
    assert faults(fig) == []


def test_arranging_again_changes_nothing():
    fig, ax = views.axes("a map")
    views.draw(ax, wall())
    views.legend(ax)
    arrange(fig)
    places = [each.get_position().bounds for each in fig.axes]
    arrange(fig)
    again = [each.get_position().bounds for each in fig.axes]
    assert np.allclose(places, again, atol=2e-3)


def test_a_shown_figure_is_checked_with_its_final_layout(monkeypatch):
    judged = []
    monkeypatch.setattr(figure_display, "report", lambda fig, alt: judged.append(fig.dpi))
    fig, _ = views.chart("x", "y")
    figure_display.bundle(fig, "Empty axes.")
    # letters of another size in pixels are a little wider or higher: they would cover other data
    assert judged == [figure_display.SHARPNESS * fig.dpi]
