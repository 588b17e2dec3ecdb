"""Figures with sliders: drawn when a control moves, and stored as a picture with its text."""

import ipywidgets
import pytest

from slamlab import views
from slamlab.views import sliders
from tests.slamlab.views.outputs import ALT


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
