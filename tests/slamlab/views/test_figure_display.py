"""Figures in a notebook: picture, alternative text, table of the data."""

import base64
import io
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from PIL import Image

from slamlab import views
from slamlab.layers import Points
from slamlab.views import alt_text, figure_display
from tests.slamlab.views.outputs import ALT


def html_elements(text, tag):
    """Attributes of each element of a kind in HTML."""
    found = []

    class Reader(HTMLParser):
        def handle_starttag(self, name, attributes):
            if name == tag:
                found.append(dict(attributes))

    Reader().feed(text)
    return found


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
