"""Figures as data: what was drawn, where, in which colour; never pixels."""

import base64
import io
import re
import subprocess
import sys
from html.parser import HTMLParser

import ipywidgets
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.patches import Rectangle
from PIL import Image

from slamlab import models, views
from slamlab.layers import Boxes, Ellipses, Particles, Points, Poses, Segments
from slamlab.views import alt_text, figure_checks, figure_display, sliders
from tests.slamlab.views.outputs import Displays

ALT = "two walls that meet"


def html_elements(text, tag):
    """Attributes of each element of a kind in HTML."""
    found = []

    class Reader(HTMLParser):
        def handle_starttag(self, name, attributes):
            if name == tag:
                found.append(dict(attributes))

    Reader().feed(text)
    return found


@pytest.fixture
def stored(monkeypatch):
    """What the cells of a notebook store."""
    return Displays(monkeypatch, sliders)


def test_a_map_has_equal_scales_and_metres_on_both_axes():
    _, ax = views.axes("A room")
    assert ax.get_aspect() == 1.0
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_title()) == ("x [m]", "y [m]", "A room")


@pytest.mark.parametrize("shared", [True, False])
def test_panels_share_one_scale_if_they_are_to(shared):
    _, (left, right) = views.panels(["naive", "corrected"], shared=shared)
    right.set_xlim(0, 1)
    left.set_xlim(-300, 700)
    assert right.get_xlim() == ((-300, 700) if shared else (0, 1))


def test_points_stand_where_they_are_and_carry_label_and_colour_of_their_layer_or_given_ones():
    _, ax = views.axes()
    xy = np.array([[1.0, 2.0], [3.0, -1.0]])
    (line,) = views.draw(ax, Points("corrected", xy))
    assert np.array_equal(line.get_xydata(), xy)
    assert line.get_label() == "estimate"
    assert line.get_color() == views.COLOURS["corrected"]
    (line,) = views.draw(ax, Points("map", xy), color="k", label="seen")
    assert (line.get_color(), line.get_label()) == ("k", "seen")


def test_segments_run_from_end_to_end():
    _, ax = views.axes()
    (walls,) = views.draw(ax, Segments("walls", np.array([[0, 1, 2, 3.0]])))
    assert np.array_equal(walls.get_segments()[0], [[0, 1], [2, 3]])


def test_a_track_ends_in_a_robot_that_points_along_its_heading():
    _, ax = views.axes()
    track, robot = views.draw(ax, Poses("truth", np.array([[0, 0, 0], [1, 2, 0.7]])))
    assert np.array_equal(track.get_xydata(), [[0, 0], [1, 2]])
    marker = robot._marker  # the public one has lost its rotation
    tip = marker.get_transform().transform(marker.get_path().vertices[0])
    assert np.arctan2(tip[1], tip[0]) == pytest.approx(0.7)
    assert views.draw(ax, Poses("truth", np.empty((0, 3)))) == []


def test_an_ellipse_holds_95_percent_of_its_gaussian():
    _, ax = views.axes()
    centre, P = np.array([1.0, -2.0]), np.array([[0.3, 0.2], [0.2, 0.5]])
    outline, _ = views.draw(ax, Ellipses("landmark", centre[None], P[None]))
    (path,) = outline.get_paths()
    rng = np.random.default_rng(5)
    inside = path.contains_points(rng.multivariate_normal(centre, P, size=20_000))
    assert inside.mean() == pytest.approx(0.95, abs=0.01)


def test_a_box_spans_its_bounds():
    _, ax = views.axes()
    outline, _ = views.draw(ax, Boxes("box", np.array([[1, 3, -2, 5.0]])))
    (path,) = outline.get_paths()
    assert path.get_extents().extents == pytest.approx([1, -2, 3, 5])


def test_a_particle_of_larger_weight_is_drawn_larger():
    _, ax = views.axes()
    rows = np.array([[0, 0.0], [1, 1], [2, 2]])
    (dots,) = views.draw(ax, Particles("sample", rows, np.array([0.7, 0.2, 0.1])))
    assert np.array_equal(dots.get_offsets(), rows)
    assert np.all(np.diff(dots.get_sizes()) < 0)


def test_an_object_that_is_not_a_layer_is_refused():
    _, ax = views.axes()
    with pytest.raises(TypeError, match="ndarray"):
        views.draw(ax, np.zeros((3, 2)))


def test_side_by_side_draws_each_layer_in_its_panel():
    walls = Segments("walls", np.array([[0, 0, 4, 0.0]]))
    fig, (left, right) = views.side_by_side(
        {"naive": [walls, Points("naive", np.ones((2, 2)))], "corrected": [walls]}
    )
    assert [ax.get_title() for ax in fig.axes] == ["naive", "corrected"]
    assert [len(left.lines), len(right.lines)] == [1, 0]
    assert left.get_legend() is None
    (legend,) = fig.legends
    assert [text.get_text() for text in legend.get_texts()] == ["walls", "odometry alone"]


def test_a_figure_is_shown_as_a_picture_with_alt_text_and_twice_the_resolution_of_the_page(stored):
    fig, _ = views.axes(size=(5, 3))
    views.show(fig, 'a <b> & "c"')
    (data,) = stored.bundles
    assert set(data) == {"text/html", "text/plain"}
    assert data["text/plain"] == 'Map: x [m] across, y [m] up. a <b> & "c"'
    (picture,) = html_elements(data["text/html"], "img")
    assert picture["alt"] == data["text/plain"]
    assert picture["src"].startswith("data:image/webp;base64,") and picture["width"] == "400"
    assert Image.open(io.BytesIO(views.png(fig))).size == (800, 480)


def test_a_table_of_the_data_unfolds_below_a_figure(stored):
    fig, _ = views.axes()
    views.show(fig, ALT, data={"n <1>": [1, 2], "error [m]": [0.123456, "none"]})
    found = re.findall("<(t[hd])\\b[^>]*>([^<]*)<", stored.bundles[0]["text/html"])
    assert found == [
        ("th", "n &lt;1&gt;"), ("th", "error [m]"),
        ("td", "1"), ("td", "0.1235"), ("td", "2"), ("td", "none"),
    ]  # fmt: skip
    with pytest.raises(ValueError):
        views.show(fig, ALT, data={"n": [1, 2], "error [m]": [1]})


def test_the_alternative_text_of_a_figure_distinguishes_its_panels():
    fig, _ = views.panels(["naive", "corrected"])
    assert alt_text.describe(fig) == "Two maps (naive, corrected): x [m] across, y [m] up."
    fig, ax = views.chart("n", "error [m]", "growth")
    ax.set_xscale("log")
    assert alt_text.describe(fig) == "Chart (growth): n (logarithmic) across, error [m] up."
    fig = views.correlation(np.eye(5), ["robot", "a"], "left")[0]
    assert alt_text.describe(fig).startswith("Matrix (left)")
    fig, _ = views.correlations({"before": np.eye(3), "after": np.eye(5)}, ["robot", "a"])
    assert alt_text.describe(fig).startswith("Two matrices (before, after)")


def test_the_alternative_text_reads_formulas_and_names_bar_charts():
    fig, ax = views.chart("$d_{abs}$ [rad]", "cut off [%]", r"$\alpha$ over $x$")
    ax.errorbar([0, 1], [0, 1], xerr=0.1)
    message = "Chart (alpha over x): d_abs [rad] across, cut off [%] up."
    assert alt_text.describe(fig) == message
    ax.bar([0, 1], [1, 2])
    assert alt_text.describe(fig).startswith("Bar chart")


def test_a_figure_without_alt_text_is_refused():
    fig, _ = views.axes()
    with pytest.raises(ValueError, match="alt text"):
        views.show(fig, " ")


def test_landmarks_stand_out_among_the_points_of_scans():
    _, ax = views.axes()
    (points,) = views.draw(ax, Points("scan", [[0, 0]]))
    (landmark,) = views.draw(ax, Points("landmark", [[0, 0]]))
    (own,) = views.draw(ax, Points("landmark", [[0, 0]]), markersize=4)
    assert landmark.get_markersize() > 2 * points.get_markersize()
    assert own.get_markersize() == 4


def test_the_same_figure_is_the_same_bytes():
    def drawn():
        fig, ax = views.axes("map")
        views.draw(ax, Points("map", np.arange(8.0).reshape(4, 2)))
        return views.png(fig)

    assert drawn() == drawn()


def test_a_shown_figure_keeps_its_colours_and_takes_a_third_of_the_bytes():
    rng, whole = np.random.default_rng(0), io.BytesIO()
    fig, all_axes = views.panels(["map", "shades"], shared=False)
    for name in views.COLOURS:
        views.draw(all_axes[0], Points(name, rng.normal(size=(60, 2))))
    all_axes[0].legend()
    all_axes[1].imshow(np.arange(144).reshape(12, 12), cmap="RdBu")
    shown = figure_display.bundle(fig, ALT)["text/html"]
    (picture,) = html_elements(shown, "img")
    bytes_shown = base64.b64decode(picture["src"].partition(",")[2])
    found = np.asarray(Image.open(io.BytesIO(bytes_shown)).convert("RGB"), dtype=float)
    fig.set_layout_engine("none")  # it was arranged when it was shown
    fig.savefig(whole, format="png", dpi=2 * fig.dpi)
    exact = np.asarray(Image.open(whole).convert("RGB"), dtype=float)
    off = np.abs(found - exact).max(axis=2)
    assert off.max() <= 18  # half a shade, on edges of letters and lines
    area = (exact[1:-1, 1:-1] == exact[1:-1, 2:]).all(axis=2)
    assert not off[1:-1, 1:-1][area].any()
    assert len(bytes_shown) < whole.tell() / 3


@pytest.mark.parametrize("letters", [5, 24, 31])
def test_no_text_beside_axes_is_clipped(letters):
    fig, ax = views.chart("lost runs of 80", "y [m]")
    ax.plot([0.0, 1.0], [0.0, 1.0])
    for name in ("it" * letters)[:letters], "Monte Carlo, never frozen":
        ax.set_yticks([0.0, 1.0], [name, name])
        picture = np.asarray(Image.open(io.BytesIO(views.png(fig))).convert("L"))
        for edge in (picture[:, :4], picture[:, -4:], picture[:4], picture[-4:]):
            assert (edge > 250).all()
    assert fig.dpi == views.chart("x", "y")[0].dpi


class Recorder:
    """A function to explore that remembers what it was asked to draw."""

    def __init__(self):
        self.calls = []

    def __call__(self, **values):
        self.calls.append(values)
        if values.get("error", 0) > 8:
            raise ZeroDivisionError("too <much>")
        return views.chart("t [s]", "x [m]")[0]


def test_exploring_keeps_the_view_last_shown_as_a_picture_with_its_text(stored):
    recorder, slider = Recorder(), ipywidgets.IntSlider(3, 0, 10)
    views.explore(recorder, alt=lambda error: f"error {error}", error=slider)
    assert recorder.calls == [{"error": 3}]
    (controls,) = stored.widgets
    assert slider in controls.children
    for value in (3, 5):
        slider.value = value
        (data,) = stored.bundles
        assert data["text/plain"] == f"Chart: t [s] across, x [m] up. error {value}"
        assert "<img" in data["text/html"]


def test_moving_a_slider_draws_once_and_only_when_let_go(stored):
    recorder, slider = Recorder(), ipywidgets.IntSlider(3, 0, 10)
    views.explore(recorder, alt=ALT, error=slider)
    assert not slider.continuous_update
    slider.value = 7
    assert recorder.calls == [{"error": 3}, {"error": 7}]


def test_an_error_in_the_first_drawing_is_raised():
    with pytest.raises(ZeroDivisionError):
        views.explore(Recorder(), alt=ALT, error=(0, 10, 9))


def test_an_error_after_a_slider_moved_replaces_the_figure(stored):
    slider = ipywidgets.IntSlider(3, 0, 10)
    views.explore(Recorder(), alt=ALT, error=slider)
    assert ALT in stored.bundles[0]["text/html"]
    slider.value = 9
    (data,) = stored.bundles
    assert "ZeroDivisionError: too &lt;much&gt;" in data["text/html"]
    slider.value = 2
    assert ALT in stored.bundles[0]["text/html"]


@pytest.mark.parametrize(
    ("given", "kind"),
    [
        ((0, 10, 3), ipywidgets.IntSlider),
        ((0.0, 1.0, 0.5), ipywidgets.FloatSlider),
        (["icp", "odometry"], ipywidgets.Dropdown),
        (True, ipywidgets.Checkbox),
    ],
)
def test_the_type_of_a_control_follows_from_its_values(given, kind):
    assert type(sliders._control("heading_error", given)) is kind


def test_a_control_that_starts_outside_its_range_is_refused_by_name():
    with pytest.raises(ValueError, match="error"):
        views.explore(Recorder(), alt=ALT, error=(0, 10, 12))


@pytest.mark.slow
@pytest.mark.parametrize("room", ["geometry", "models", "scanmatching"])
def test_views_bring_no_answer_of_an_exercise_along(room):
    code = f"import slamlab.views, sys; sys.exit('slamlab.{room}' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_a_legend_shows_the_small_points_of_a_map_large_enough():
    _, ax = views.axes()
    views.draw(ax, Points("map", np.zeros((3000, 2))))
    (handle,) = views.legend(ax).legend_handles
    assert handle.get_markersize() > ax.lines[0].get_markersize()


def test_the_sketch_of_an_encoder_counts_whole_ticks_and_lets_light_through_its_slots():
    for slots, degrees, ticks in ((12, 0, 0), (12, 220, 7), (4, 89, 0), (4, 91, 1)):
        disc, pulses = views.encoder(slots, np.radians(degrees)).axes
        assert pulses.get_title().startswith(f"{ticks} ticks")
        lit = any(
            slot.contains_point(disc.transData.transform((0.0, 0.77))) for slot in disc.patches[1:]
        )
        assert lit == (degrees * slots / 360 % 1 < 0.5)


def test_the_sketch_of_the_frames_has_range_and_bearing_to_scale():
    pose, landmark = np.array([2.5, 1.0, 0.4]), np.array([5.0, 4.5])
    (ax,) = views.frames(pose, landmark).axes
    heading, bearing = (np.radians([arc.theta1, arc.theta2]) for arc in ax.patches)
    r, beta = models.h(pose, landmark)
    assert np.diff(heading) == pytest.approx(pose[2])
    assert np.diff(bearing) == pytest.approx(beta)
    (ray,) = [line for line in ax.lines if line.get_linestyle() == "--"]
    assert np.hypot(*np.diff(ray.get_xydata(), axis=0)[0]) == pytest.approx(r)


def test_growth_shows_measurements_as_marks_and_predictions_as_lines():
    x = np.array([1.0, 4, 16])
    _, ax = views.growth(x, {"measured": x**1.5}, {"n √n": x**1.5}, "way [m]", "error [m]")
    marks, line = ax.lines
    assert (marks.get_linestyle(), line.get_marker()) == ("None", "None")
    assert ax.get_xscale() == ax.get_yscale() == "log"
    assert [label.get_text() for label in ax.get_xticklabels()] == ["1", "4", "16"]


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


def test_curves_against_a_band_stand_on_a_logarithmic_axis_with_the_band_in_the_legend():
    values = {"a": np.array([2.0, 3.0, 200.0])}
    _, ax = views.against_band(np.arange(3), values, (2.4, 3.7), "step", "mean NEES [1]")
    assert ax.get_yscale() == "log" and ax.get_ylim()[1] > 200
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["a", "95 % band"]
    (shade,) = ax.patches
    assert np.allclose([shade.get_y(), shade.get_y() + shade.get_height()], [2.4, 3.7])


def test_the_band_of_an_estimate_reaches_two_sigma_to_either_side():
    _, ax = views.chart("x [m]", "y [m]")
    x, y, sigma = np.arange(3.0), np.array([1.0, 2.0, 4.0]), np.array([0.1, 0.2, 0.3])
    views.two_sigma(ax, x, y, sigma, "filter")
    corners = ax.collections[0].get_paths()[0].vertices
    for k in range(3):
        heights = corners[corners[:, 0] == x[k], 1]
        assert np.allclose([heights.min(), heights.max()], y[k] + 2 * sigma[k] * np.array([-1, 1]))


def test_a_figure_is_drawn_once_and_a_chart_is_laid_out_once(monkeypatch):
    done = []
    layout, draw = ConstrainedLayoutEngine.execute, Figure.draw
    monkeypatch.setattr(
        ConstrainedLayoutEngine, "execute", lambda *a: (done.append("layout"), layout(*a))
    )
    monkeypatch.setattr(Figure, "draw", lambda *a: (done.append("draw"), draw(*a)))
    fig, ax = views.chart("time [s]", "error [m]")
    ax.plot([0, 1], [0, 1])
    views.png(fig)
    assert done == ["layout", "draw"]
    # of a map the second layout may shrink what the first one made
    done.clear()
    views.png(views.side_by_side({"a": [], "b": []})[0])
    assert done.count("layout") > 1
    assert done.count("draw") == 1
