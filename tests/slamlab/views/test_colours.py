"""Colours: contrast to white, and distinguishable with any kind of colour vision."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from slamlab import views
from slamlab.layers import Boxes, Poses
from slamlab.views.colours import COLOURS, MEANINGS, SERIES, contrast

MARK, LETTERS = 3.0, 4.5  # least contrasts of WCAG 2.2, criteria 1.4.11 and 1.4.3
WRITTEN = ("truth", "corrected", "naive")  # colours in which letters are set, too
APART = 15.0  # least distance ΔE*ab of two colours that nothing else distinguishes

# deuteranopia, on linear RGB: Machado, Oliveira, Fernandes, A physiologically-based model for
# simulation of color vision deficiency, IEEE TVCG 15 (2009), severity 1.0
DEUTERANOPIA = np.array(
    [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ]
)
# linear sRGB to CIE XYZ, IEC 61966-2-1, and its white, D65
XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def linear(colour):
    encoded = np.array(to_rgb(colour))
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    """CIE L*a*b* of linear RGB."""
    t = XYZ @ np.clip(rgb, 0, 1) / XYZ.sum(axis=1)
    f = np.where(t > (6 / 29) ** 3, np.cbrt(t), t / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def distance(first, second, vision):
    return np.linalg.norm(lab(vision @ linear(first)) - lab(vision @ linear(second)))


def test_the_simulation_leaves_greys_and_takes_red_from_green():
    for grey in ("#000000", "#7F7F7F", "#FFFFFF"):
        assert DEUTERANOPIA @ linear(grey) == pytest.approx(linear(grey), abs=1e-5)
    full = distance("#C04040", "#40A040", np.eye(3))
    assert distance("#C04040", "#40A040", DEUTERANOPIA) < full / 2


def test_contrast_agrees_with_wcag():
    assert contrast("#000000") == pytest.approx(21)
    assert contrast("#FFFFFF") == pytest.approx(1)
    assert contrast("#767676") == pytest.approx(4.54, abs=0.01)  # the lightest grey for letters


@pytest.mark.parametrize("name", sorted(set(MEANINGS) - {"guide"}))
def test_colours_with_a_meaning_contrast_with_white(name):
    assert contrast(COLOURS[name]) >= (LETTERS if name in WRITTEN else MARK)


@pytest.mark.parametrize("vision", [np.eye(3), DEUTERANOPIA], ids=["all", "deuteranopia"])
def test_two_meanings_differ_in_colour_or_in_their_mark(vision):
    for (a, one), (b, other) in combinations(MEANINGS.items(), 2):
        if "guide" not in (a, b) and distance(one.colour, other.colour, vision) < APART:
            assert one.mark != other.mark, (a, b)


@pytest.mark.parametrize("vision", [np.eye(3), DEUTERANOPIA], ids=["all", "deuteranopia"])
def test_series_differ_in_colour_dash_and_marker(vision):
    for one, other in combinations(SERIES, 2):
        assert distance(one[0], other[0], vision) >= APART
        assert one[1] != other[1] and one[2] != other[2]


def test_a_meaning_has_its_line_style_in_drawing_and_legend():
    _, ax = views.axes()
    views.draw(ax, Poses("predicted", [[0, 0, 0], [1, 0, 0]]))
    outline, entry = views.draw(ax, Boxes("before", [[0, 1, 0, 1]]))
    assert ax.lines[0].get_linestyle() == "--"
    assert entry.get_linestyle() == "--"
    assert outline.get_linestyle()[0][1] is not None


@pytest.mark.parametrize("make", [views.axes, lambda: views.chart("x", "y")], ids=["map", "chart"])
def test_default_colours_are_those_of_the_series(make):
    _, ax = make()
    drawn = [ax.plot([0, 1], [k, k])[0].get_color() for k in range(len(SERIES))]
    assert drawn == [colour for colour, *_ in SERIES]
