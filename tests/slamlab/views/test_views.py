"""Figures as data: what was drawn, where, in which colour; never pixels."""

import subprocess
import sys

import numpy as np
import pytest

from slamlab import models, views
from slamlab.layers import Boxes, Ellipses, Particles, Points, Poses, Segments


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


def test_landmarks_stand_out_among_the_points_of_scans():
    _, ax = views.axes()
    (points,) = views.draw(ax, Points("scan", [[0, 0]]))
    (landmark,) = views.draw(ax, Points("landmark", [[0, 0]]))
    (own,) = views.draw(ax, Points("landmark", [[0, 0]]), markersize=4)
    assert landmark.get_markersize() > 2 * points.get_markersize()
    assert own.get_markersize() == 4


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


def test_curves_against_a_band_stand_on_a_logarithmic_axis_with_the_band_in_the_legend():
    values = {"a": np.array([2.0, 3.0, 200.0])}
    _, ax = views.against_band(np.arange(3), values, (2.4, 3.7), "step", "mean NEES [1]")
    assert ax.get_yscale() == "log" and ax.get_ylim()[1] > 200
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["a", "95 % χ² interval"]
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
