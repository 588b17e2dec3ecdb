"""Frame packing: a frame, decoded as the browser does it, loses nothing and holds nothing stale."""

import numpy as np
import pytest

from slamlab.layers import Boxes, Ellipses, Grid, Particles, Points, Poses, Segments
from slamlab.live.frame_packing import FramePacker, Scene
from slamlab.views import COLOURS


class Browser:
    """Keeps rows by key, as the script in the browser does."""

    def __init__(self):
        self.rows, self.brought = {}, 0

    def take(self, entries, data):
        numbers, at, now = np.frombuffer(data, "<f4"), 0, {}
        for entry in entries:
            width, count = entry["width"], entry["follow"] * entry["width"]
            kept = self.rows.get(entry["key"], np.empty((0, width)))[: entry["keep"]]
            assert len(kept) == entry["keep"]
            now[entry["key"]] = np.vstack([kept, numbers[at : at + count].reshape(-1, width)])
            at += count
        assert at == len(numbers)
        self.rows, self.brought = now, len(data)


@pytest.fixture
def send():
    """Pack layers for a browser; what it then has."""
    packer, browser = FramePacker(), Browser()

    def to_browser(*layers):
        browser.take(*packer.pack(Scene(list(layers)).drawables))
        return browser

    to_browser.packer = packer
    return to_browser


def test_every_kind_of_layer_is_sent_as_numbers(send):
    rows = np.arange(12.0).reshape(3, 4)
    browser = send(
        Points("map", rows[:, :2]),
        Segments("walls", rows),
        Poses("truth", rows[:, :3]),
        Boxes("box", rows),
    )
    expected = [rows[:, :2], rows, rows[:, :3], rows]
    for got, wanted in zip(browser.rows.values(), expected, strict=True):
        assert np.array_equal(got, wanted)


def test_an_ellipse_arrives_as_the_outline_that_holds_95_percent(send):
    centre, P = np.array([1.0, -2.0]), np.array([[0.3, 0.2], [0.2, 0.5]])
    ((x, y, a, b, angle),) = send(Ellipses("landmark", [centre], [P])).rows["ellipses  landmark"]
    t = np.linspace(0, 6, 7)
    c, s = np.cos(angle), np.sin(angle)
    rim = np.column_stack([a * np.cos(t), b * np.sin(t)]) @ [[c, s], [-s, c]]
    assert (x, y) == (1, -2)
    assert np.einsum("ni,ij,nj->n", rim, np.linalg.inv(P), rim) == pytest.approx(5.9915, rel=1e-4)


def test_the_mean_weight_of_particles_is_sent_as_one(send):
    rows = np.array([[0, 0, 9.0], [1, 2, 9]])
    got = send(Particles("sample", rows, np.array([0.25, 0.75]))).rows["samples  sample"]
    assert np.array_equal(got, [[0, 0, 0.5], [1, 2, 1.5]])


def test_only_new_rows_of_growing_arrays_are_sent(send):
    rng = np.random.default_rng(2)
    points = rng.normal(size=(20_000, 2))
    assert send(Points("map", points)).brought == 160_000
    more = np.vstack([points, [[1.0, 2.0]]])
    browser = send(Points("map", more))
    assert browser.brought == 8
    assert np.array_equal(browser.rows["points  map"], more.astype(np.float32))
    assert send(Points("map", more)).brought == 0


@pytest.mark.parametrize("change", [lambda p: p[1:], lambda p: p + 1, lambda p: p[:0]])
def test_changed_or_shortened_arrays_are_sent_again(send, change):
    points = np.arange(10.0).reshape(5, 2)
    send(Points("map", points), Points("scan", points))
    browser = send(Points("map", change(points)), Points("scan", points))
    assert np.array_equal(browser.rows["points  map"], change(points))
    assert np.array_equal(browser.rows["points  scan"], points)


def test_a_layer_that_returns_is_sent_completely(send):
    points = np.arange(10.0).reshape(5, 2)
    send(Points("map", points), Points("scan", points))
    assert list(send(Points("scan", points)).rows) == ["points  scan"]
    assert np.array_equal(send(Points("map", points)).rows["points  map"], points)


def test_two_layers_of_one_name_and_kind_are_distinguished(send):
    a, b = np.zeros((2, 2)), np.ones((3, 2))
    send(Points("map", a), Points("map", b))
    browser = send(Points("map", a), Points("map", b))
    assert [len(rows) for rows in browser.rows.values()] == [2, 3]


def test_a_new_screen_gets_all_rows(send):
    points = np.arange(10.0).reshape(5, 2)
    send(Points("map", points))
    send.packer.reset()
    assert send(Points("map", points)).brought == 40


def test_curves_follow_the_layers_and_are_distinguished_by_their_panel():
    line = np.array([[0.0, 1], [1, 4]])
    scene = Scene([], curves={"error [m]": {"naive": line}, "NEES": {"naive": line[:1]}})
    browser = Browser()
    browser.take(*FramePacker().pack(scene.drawables))
    assert [d.panel for d in scene.drawables] == ["error [m]", "NEES"]
    assert [len(rows) for rows in browser.rows.values()] == [2, 1]
    assert scene.drawables[0].colour.upper() == COLOURS["naive"]


def test_no_rows_are_no_bytes(send):
    browser = send(Points("map", np.empty((0, 2))), Ellipses("robot", [], []))
    assert browser.brought == 0
    assert [rows.shape for rows in browser.rows.values()] == [(0, 2), (0, 5)]


def test_colours_are_the_views_own_unless_others_are_given():
    layers = [Points("corrected", np.zeros((1, 2))), Poses("robot", np.zeros((1, 3)))]
    usual, own = Scene(layers).drawables, Scene(layers, colours={"robot": "red"}).drawables
    assert [d.colour.upper() for d in usual] == [COLOURS["corrected"], COLOURS["robot"]]
    assert [d.colour.upper() for d in own] == [COLOURS["corrected"], "#FF0000"]


def test_an_object_that_is_not_a_layer_is_refused():
    with pytest.raises(TypeError, match="ndarray"):
        _ = Scene([np.zeros(3)]).drawables


def test_a_grid_is_drawn_as_the_centres_of_occupied_cells():
    cells = np.full((3, 4), 0.5)
    cells[1, 2], cells[0, 0] = 0.97, 0.03
    (drawn,) = Scene([Grid("map", cells, np.array([-1.0, 2.0]), 0.1)]).drawables
    assert drawn.kind == "points"
    np.testing.assert_allclose(drawn.rows, [[-0.75, 2.15]], rtol=1e-6)
