"""Rasterisation without JavaScript: pixels are where the numbers state."""

import asyncio
import io

import numpy as np
import pytest
from PIL import Image

from slamlab.layers import Boxes, Ellipses, Particles, Points, Poses, Segments
from slamlab.live.frame_packing import Scene
from slamlab.live.raster_screen import FRAME_PERIOD, RasterScreen, png, rasterise
from slamlab.views import COLOURS

SIZE = (200, 100)


def coloured(picture, name):
    """(n, 2) column and row of all pixels in a colour."""
    rgb = [int(COLOURS[name][i : i + 2], 16) for i in (1, 3, 5)]
    return np.argwhere((picture == rgb).all(axis=2))[:, ::-1]


def test_scales_are_equal_and_y_points_up():
    dots = [Points("map", [[0.0, 0.0]]), Points("scan", [[4.0, 0.0]]), Points("truth", [[0.0, 4]])]
    picture = rasterise(Scene(dots), SIZE)
    origin, right, up = (coloured(picture, name).mean(axis=0) for name in ("map", "scan", "truth"))
    assert right[0] - origin[0] == pytest.approx(origin[1] - up[1], abs=1)
    assert right[1] == pytest.approx(origin[1], abs=1)
    assert up[0] == pytest.approx(origin[0], abs=1)


def test_all_points_are_within_the_picture():
    picture = rasterise(Scene([Points("map", [[-50.0, 3.0], [70.0, -9.0]])]), SIZE)
    assert len(coloured(picture, "map")) == 2 * 5 * 5


@pytest.mark.parametrize(
    "layer",
    [
        Segments("map", [[0.0, 0, 3, 1]]),
        Poses("map", [[0.0, 0, 0], [3, 1, 0.5]]),
        Ellipses("map", [[1.0, 2]], [np.diag([0.3, 0.1])]),
        Boxes("map", [[0.0, 3, 1, 2]]),
        Particles("map", np.array([[0.0, 1], [2, 2]]), np.array([0.5, 0.5])),
    ],
)
def test_every_kind_of_layer_leaves_its_mark(layer):
    assert len(coloured(rasterise(Scene([layer]), SIZE), "map")) > 20


def test_a_line_has_no_gaps():
    at = coloured(rasterise(Scene([Segments("map", [[0.0, 0, 3, 1]])]), SIZE), "map")
    assert set(np.diff(np.unique(at[:, 0]))) == {1}


@pytest.mark.parametrize("layers", [[], [Points("map", np.empty((0, 2)))], [Poses("map", [])]])
def test_nothing_is_an_empty_picture(layers):
    assert rasterise(Scene(layers), SIZE).shape == (100, 200, 3)


def test_non_finite_values_are_omitted():
    rows = [[np.nan, 0, 1, 1], [0.0, 0, 1, 1]]
    picture = rasterise(Scene([Segments("map", rows), Points("scan", [[np.inf, 1.0]])]), SIZE)
    assert len(coloured(picture, "map")) and not len(coloured(picture, "scan"))


def test_the_pixels_survive_packing():
    picture = np.random.default_rng(1).integers(0, 256, (30, 40, 3), dtype=np.uint8)
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(png(picture)))), picture)


def test_the_screen_shows_picture_legend_and_status():
    screen = RasterScreen("a map", "A room", SIZE)
    screen.offer(Scene([Points("map", np.zeros((1, 2)))], status="1 < 2"))
    image, words = screen.widget.children
    assert 'alt="a map"' in image.value and "data:image/png;base64,iVBORw0KGgo" in image.value
    assert all(text in words.value for text in ("A room", "map", "1 &lt; 2"))


def test_the_screen_is_free_again_after_a_while():
    screen = RasterScreen(size=SIZE)
    screen.offer(Scene([]))
    assert not screen.free
    asyncio.run(screen.wait_until_drawn())
    assert screen.free
    assert FRAME_PERIOD <= 0.2
