"""A live view in a notebook: what is stored, and what its buttons do."""

import sys
from functools import partial

import ipywidgets
import numpy as np
import pytest

from slamlab import estimators, live, sources
from slamlab.layers import Poses, Segments
from slamlab.live import run_loop
from slamlab.live.canvas import LiveCanvas
from slamlab.live.controls import Controls
from slamlab.live.estimator_run import EstimatorRun
from slamlab.live.frame_packing import Scene
from slamlab.live.raster_screen import RasterScreen
from slamlab.live.run_loop import RunLoop
from slamlab.live.run_scene import still_picture
from slamlab.views import figure_display
from tests.slamlab.views.live_fakes import Car, FakeScreen, Sum, Walk
from tests.slamlab.views.outputs import Displays

ALT = "a robot walks"


@pytest.fixture
def stored(monkeypatch):
    """What the cells of a notebook store."""
    yield Displays(monkeypatch, figure_display)
    run_loop.stop()


def looped(screen, source=Walk):
    """A loop whose source has given its first reading."""
    pair = EstimatorRun(source, lambda source: Sum())
    pair.reset(0)
    return RunLoop(pair, screen)


def walk(**more):
    return live.watch(Walk, lambda source: Sum(), ALT, **more)


def test_the_still_is_a_display_of_its_own_with_its_text(stored):
    loop = walk()
    walk()
    controls, (still, again) = stored.widgets[0], stored.bundles
    assert still == again  # the same bytes each time
    assert loop.screen.widget in controls.children
    assert set(still) == {"text/html", "text/plain"}
    assert still["text/plain"] == f"Map: x [m] across, y [m] up. {ALT}"
    assert 'class="slamlab-still"' in still["text/html"]


def test_without_a_browser_nothing_runs(stored):
    loop = walk(play=True, steps=2)
    assert not loop.running
    assert loop.pair.count == 2
    assert loop.screen.sent == 0


def test_the_widget_contains_the_newest_picture(stored):
    loop = walk(steps=3)
    for count in (3, 4):
        frame = loop.screen.widget.get_state()["frame"]
        assert frame["header"]["status"].startswith(f"step {count} of")
        points = {layer["name"]: layer["follow"] for layer in frame["header"]["layers"]}
        assert points["map"] == count
        numbers = sum(layer["follow"] * layer["width"] for layer in frame["header"]["layers"])
        assert len(frame["rows"]) == 4 * numbers
        loop.pair.step()
        loop.show()  # no browser: nothing is sent
    assert loop.screen.sent == 0


def test_the_still_has_a_panel_for_each_group_of_curves():
    pair = EstimatorRun(
        Walk, lambda source: Sum(), curves={"way [m]": {"corrected": lambda pair: pair.time}}
    )
    pair.reset(0)
    pair.step()
    above, below = still_picture(pair.scene(), "A walk", (720, 480)).axes
    assert (above.get_title(), below.get_ylabel()) == ("A walk", "way [m]")
    (line,) = below.lines
    assert line.get_xydata().tolist() == [[0, 0], [1, 1]]


def test_a_legend_names_only_what_is_drawn():
    rows = np.zeros((2, 4))
    layers = [Segments("walls", rows), Segments("loop", rows[:0]), Poses("truth", rows[:0, :3])]
    (drawn,) = still_picture(Scene(layers), None, (720, 480)).legends
    assert [text.get_text() for text in drawn.get_texts()] == ["walls"]
    screen = RasterScreen(ALT)
    screen.offer(Scene(layers))
    caption = screen.widget.children[1].value
    assert caption.count("■") == 1 and "walls" in caption


def test_a_script_runs_before_the_still_picture_is_made(stored):
    loop = live.watch(Car, lambda source: Sum(), ALT, script=["forward", "forward", "left"])
    assert loop.pair.source.commands == [(0.4, 0.0), (0.4, 0.0), (0.0, 0.6)]


def test_an_error_in_the_first_steps_is_raised(stored):
    with pytest.raises(ZeroDivisionError):
        live.watch(Walk, lambda source: Sum(fails_at=1), ALT)


def test_a_view_without_alt_text_is_refused(stored):
    with pytest.raises(ValueError, match="alt text"):
        live.watch(Walk, lambda source: Sum(), "")


def test_without_anywidget_a_raster_picture_is_shown(stored, monkeypatch):
    assert isinstance(walk().screen, LiveCanvas)
    monkeypatch.setitem(sys.modules, "slamlab.live.canvas", None)
    loop = walk()
    assert isinstance(loop.screen, RasterScreen)
    assert loop.screen.sent == 1


@pytest.mark.parametrize(("world", "name"), [("room", "icp"), ("landmarks", "mak")])
def test_it_runs_what_the_course_has(stored, world, name):
    loop = live.watch(
        partial(sources.simulation, world), partial(estimators.make, name), ALT, steps=3
    )
    assert loop.pair.drivable == (world == "room")
    assert loop.pair.count == 3


async def test_running_a_cell_again_ends_its_loop(stored):
    loop = walk()
    loop.pair.reset(0)
    loop.run()
    assert loop.running
    walk()
    assert not loop.running


class RecordingCanvas(LiveCanvas):
    """A canvas whose browser is this test."""

    def __init__(self, **rest):
        super().__init__(**rest)
        self.messages = []
        self.widget.send = lambda content, buffers: self.messages.append((content, buffers))

    def say(self, **content):
        self._on_message(None, content, [])


def test_the_canvas_sends_frames_after_ready_and_waits_for_acknowledgements(stored):
    loop = looped(RecordingCanvas())
    canvas = loop.screen
    loop.step()
    assert canvas.messages == []
    canvas.say(kind="ready")
    loop.step()
    loop.step()
    assert [header["number"] for header, _ in canvas.messages] == [1]
    canvas.say(kind="drawn", number=1)
    assert [header["behind"] for header, _ in canvas.messages] == [1, 1]
    canvas.say(kind="drawn", number=99)  # of another kernel
    loop.step()
    assert len(canvas.messages) == 2
    # the page is reopened and has no data
    canvas.say(kind="ready")
    header, (rows,) = canvas.messages[-1]
    assert all(layer["keep"] == 0 for layer in header["layers"])
    assert len(rows) == 4 * sum(layer["follow"] * layer["width"] for layer in header["layers"])


async def test_a_closed_view_pauses_and_can_be_shown_again(stored):
    loop = looped(RecordingCanvas())
    loop.screen.say(kind="ready")
    loop.run()
    loop.screen.say(kind="gone")
    assert not loop.running
    loop.screen.say(kind="ready")
    assert loop.screen.messages[-1][0]["status"].startswith("step 1 of")


def test_a_browser_on_the_same_machine_gets_no_short_messages(stored):
    canvas = looped(RecordingCanvas()).screen
    for near in (True, False):
        canvas.say(kind="ready", near=near)
    (_, (long,)), (_, (short,)) = canvas.messages
    assert len(long) > 100_000 > len(short)
    assert long.startswith(short) and not any(long[len(short) :])


@pytest.mark.parametrize("message", [None, [], {}, {"kind": "drawn"}, {"kind": "key", "name": {}}])
def test_messages_that_are_not_from_the_page_are_ignored(message):
    loop = looped(LiveCanvas())
    loop.screen._on_message(None, message, [])
    assert loop.pair.count == 1


async def test_a_closed_widget_ends_the_loop():
    loop = looped(LiveCanvas())
    loop.run()
    loop.screen.widget.comm.handle_close({})
    assert not loop.running


@pytest.fixture
def controls():
    loop = looped(FakeScreen())
    return Controls(loop, {"Walk": loop.pair, "Car": EstimatorRun(Car, lambda source: Sum())})


async def test_drive_buttons_are_shown_only_for_a_robot(controls):
    drive = controls.widget.children[2].layout
    assert drive.display == "none"
    controls.source_buttons[1].click()
    assert drive.display != "none"
    assert [b.button_style for b in controls.source_buttons] == ["", "info"]
    controls.drive[1].click()
    assert controls.loop.pair.source.commands == [(0.4, 0.0)]


async def test_the_run_button_shows_what_it_would_do(controls):
    assert controls.run.description == "▶ run"
    controls.run.click()
    assert controls.run.description == "❚❚ pause"
    controls.run.click()
    assert controls.run.description == "▶ run"
    assert not controls.loop.running


async def test_speed_and_seed_reach_the_loop(controls):
    controls.speed.value = 50
    controls.seed.value = 7
    controls.reset.click()
    controls.step.click()
    assert (controls.loop.speed, controls.loop.seed, controls.loop.pair.count) == (50, 7, 2)
    assert isinstance(controls.seed, ipywidgets.BoundedIntText)


def test_the_browser_reports_reduced_motion(stored):
    canvas = looped(RecordingCanvas()).screen
    for reported, calm in (({"calm": True}, True), ({"calm": "yes"}, False), ({}, False)):
        canvas.say(kind="ready", **reported)
        assert canvas.calm is calm
