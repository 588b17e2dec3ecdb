"""Checks of a figure: covered curves, small, faint or clipped letters, wrong colours."""

import numpy as np
from matplotlib.patches import Rectangle

from slamlab import views
from slamlab.layers import Segments
from slamlab.views import figure_checks
from tests.slamlab.views.outputs import ALT


def test_checks_find_covered_data_small_text_and_clipping():
    fig, ax = views.chart("x [m]", "y [m]", "Far too long to stand above so small a figure", (3, 3))
    ax.plot([0, 1], [0, 1], label="a line")
    ax.plot([0.5], [0.5], ".", label="a dot")
    ax.legend(loc="center", fontsize=8)
    found = " ".join(figure_checks.faults(fig))
    for fault in ("covers a line", "covers a dot", "smaller than 9 pt", "cut off"):
        assert fault in found


def test_checks_find_overlapping_texts_wrong_colours_and_equal_entries():
    fig, ax = views.chart("x [m]", "38% of y", size=(8, 5))
    for message in ("one", "other"):
        ax.text(0.5, 0.2, message)
        ax.plot([0, 1], [0, 1], color=views.COLOURS["predicted"], label=message)
    ax.plot([0], [1], ".", color=views.COLOURS["scan"], label="samples")
    ax.legend(loc="lower right")
    assert figure_checks.faults(fig) == [
        "no space before %: '38% of y'",
        "letters over letters: 'one' and 'other'",
        "'one' is solid: predictions must be dashed",
        "'other' is solid: predictions must be dashed",
        f"'samples' does not have the colour of its meaning, {views.COLOURS['sample']}",
        "'one' and 'other' look the same in the legend",
    ]


def test_a_marker_partly_under_a_legend_is_covered():
    fig, ax = views.chart("x", "y", size=(5, 4))
    ax.plot([0, 1], [0, 1], linestyle="none", marker="s", markersize=1, label="small")
    ax.legend(loc="lower left")
    fig.draw_without_rendering()
    box = ax.get_legend().get_window_extent()
    beside = ax.transData.inverted().transform([box.x1 + 8, (box.y0 + box.y1) / 2])
    for size, covered in ((4, False), (30, True)):
        ax.plot(*beside, linestyle="none", marker="s", markersize=size, label=f"of {size} pt")
        messages = [fault for fault in figure_checks.faults(fig) if f"of {size} pt" in fault]
        assert bool(messages) == covered


def test_checks_find_no_fault_in_a_correct_figure():
    walls = Segments("walls", np.array([[0, 0, 4, 0.0]]))
    fig, _ = views.side_by_side({"naive": [walls], "corrected": [walls]})
    assert figure_checks.faults(fig) == []


def test_faults_are_reported_where_they_are_asked_for(stored, tmp_path, monkeypatch):
    monkeypatch.setenv(figure_checks.REPORT, str(tmp_path / "faults.txt"))
    fig, ax = views.chart("x [m]", "y [m]")
    ax.plot([0, 1], [0, 1])
    ax.text(0.5, 0.2, "faint", color=views.COLOURS["guide"])
    views.show(fig, ALT)
    reported = (tmp_path / "faults.txt").read_text().splitlines()
    assert reported == [f"{ALT} → letters too faint: 'faint'"]


def test_text_contrast_is_measured_against_the_patch_below():
    fig, ax = views.chart("x", "y")
    for x, colour in ((0, "black"), (2, "lightgrey")):
        ax.add_patch(Rectangle((x, 0), 1, 1, color=colour))
        ax.text(x + 0.5, 0.5, f"on {colour}", color="white")
    ax.set(xlim=(0, 3), ylim=(0, 1))
    assert [fault for fault in figure_checks.faults(fig) if "faint" in fault] == [
        "letters too faint: 'on lightgrey'"
    ]
