"""A live view in a notebook: what is stored, and what its buttons do."""

import asyncio
import sys
from functools import partial

import ipywidgets
import pytest

from slamlab import estimators, sources, views
from slamlab.views import showing
from slamlab.views.live import live_view, run_loop
from slamlab.views.live.canvas import LiveCanvas
from slamlab.views.live.controls import Controls
from slamlab.views.live.raster import RasterScreen
from slamlab.views.live.run_loop import RunLoop
from slamlab.views.live.stepper import Stepper
from tests.views.displays import Displays
from tests.views.live_fakes import Car, FakeScreen, Sum, Walk

ALT = "a robot walks"


@pytest.fixture
def stored(monkeypatch):
    """What the cells of a notebook store."""
    yield Displays(monkeypatch, showing)
    run_loop.stop()


def walk(**more):
    return views.live(Walk, lambda source: Sum(), ALT, **more)


def test_the_still_is_a_display_of_its_own_with_its_text(stored):
    loop = walk()
    (controls,), (still,) = stored.widgets, stored.bundles
    assert loop.screen.widget in controls.children
    assert set(still) == {"text/html", "text/plain"}
    assert still["text/plain"] == f"Map: x [m] across, y [m] up. {ALT}"
    assert 'class="slamlab-still"' in still["text/html"]


def test_without_a_browser_nothing_runs(stored):
    loop = walk(play=True, steps=2)
    assert not loop.running
    assert loop.pair.count == 2
    assert loop.screen.sent == 0


def test_a_picture_comes_with_the_widget_the_newest_there_is(stored):
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


def test_the_still_is_the_same_bytes_each_time(stored):
    for _ in range(2):
        walk(steps=3)
    first, second = stored.bundles
    assert first == second


def test_the_still_has_a_panel_for_each_group_of_curves():
    pair = Stepper(
        Walk, lambda source: Sum(), curves={"way [m]": {"corrected": lambda pair: pair.time}}
    )
    pair.reset(0)
    pair.step()
    above, below = live_view.still_picture(pair.scene(), "A walk", (720, 480)).axes
    assert (above.get_title(), below.get_ylabel()) == ("A walk", "way [m]")
    (line,) = below.lines
    assert line.get_xydata().tolist() == [[0, 0], [1, 1]]


def test_a_script_drives_before_the_still_is_made(stored):
    loop = views.live(Car, lambda source: Sum(), ALT, script=["forward", "forward", "left"])
    assert loop.pair.source.commands == [(0.4, 0.0), (0.4, 0.0), (0.0, 0.6)]


def test_a_mistake_in_the_first_steps_surfaces_as_any_other(stored):
    with pytest.raises(ZeroDivisionError):
        views.live(Walk, lambda source: Sum(fails_at=1), ALT)


def test_a_view_without_text_is_refused(stored):
    with pytest.raises(ValueError, match="alt text"):
        views.live(Walk, lambda source: Sum(), "")


def test_without_anywidget_there_is_a_picture_all_the_same(stored, monkeypatch):
    assert isinstance(walk().screen, LiveCanvas)
    monkeypatch.setitem(sys.modules, "slamlab.views.live.canvas", None)
    loop = walk()
    assert isinstance(loop.screen, RasterScreen)
    assert loop.screen.sent == 1


def test_views_load_anywidget_only_for_a_live_view():
    import subprocess

    code = "import slamlab.views, sys; sys.exit('anywidget' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


@pytest.mark.parametrize(("world", "name"), [("room", "icp"), ("landmarks", "mak")])
def test_it_runs_what_the_course_has(stored, world, name):
    loop = views.live(
        partial(sources.simulation, world), partial(estimators.make, name), ALT, steps=3
    )
    assert loop.pair.drivable == (world == "room")
    assert loop.pair.count == 3


def test_a_cell_that_is_run_again_ends_the_loop_before(stored):
    async def watch():
        loop = walk()
        loop.pair.reset(0)
        loop.run()
        assert loop.running
        walk()
        assert not loop.running

    asyncio.run(watch())


class Heard(LiveCanvas):
    """A canvas whose browser is this test."""

    def __init__(self, **rest):
        super().__init__(**rest)
        self.messages = []
        self.widget.send = lambda content, buffers: self.messages.append((content, buffers))

    def say(self, **content):
        self._on_message(None, content, [])


def test_the_canvas_speaks_only_when_the_browser_is_ready_and_waits_for_its_word(stored):
    pair = Stepper(Walk, lambda source: Sum())
    pair.reset(0)
    loop = RunLoop(pair, Heard())
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
    # the page is opened anew and has nothing
    canvas.say(kind="ready")
    header, (rows,) = canvas.messages[-1]
    assert all(layer["keep"] == 0 for layer in header["layers"])
    assert len(rows) == 4 * sum(layer["follow"] * layer["width"] for layer in header["layers"])


def test_a_view_that_is_gone_pauses_and_is_shown_anew_as_it_was(stored):
    async def watch():
        pair = Stepper(Walk, lambda source: Sum())
        pair.reset(0)
        loop = RunLoop(pair, Heard())
        loop.screen.say(kind="ready")
        loop.run()
        loop.screen.say(kind="gone")
        assert not loop.running
        loop.screen.say(kind="ready")
        assert loop.screen.messages[-1][0]["status"].startswith("step 1 of")

    asyncio.run(watch())


def test_a_browser_on_the_same_machine_gets_no_short_messages(stored):
    pair = Stepper(Walk, lambda source: Sum())
    pair.reset(0)
    canvas = RunLoop(pair, Heard()).screen
    for near in (True, False):
        canvas.say(kind="ready", near=near)
    (_, (long,)), (_, (short,)) = canvas.messages
    assert len(long) > 100_000 > len(short)
    assert long.startswith(short) and not any(long[len(short) :])


@pytest.mark.parametrize("message", [None, [], {}, {"kind": "drawn"}, {"kind": "key", "name": {}}])
def test_what_no_browser_of_ours_says_is_ignored(message):
    canvas = LiveCanvas()
    pair = Stepper(Walk, lambda source: Sum())
    pair.reset(0)
    RunLoop(pair, canvas)
    canvas._on_message(None, message, [])
    assert pair.count == 1


def test_a_closed_widget_ends_the_loop():
    async def watch():
        pair = Stepper(Walk, lambda source: Sum())
        pair.reset(0)
        loop = RunLoop(pair, LiveCanvas())
        loop.run()
        loop.screen.widget.comm.handle_close({})
        assert not loop.running

    asyncio.run(watch())


@pytest.fixture
def controls():
    pairs = {"Walk": Stepper(Walk, lambda source: Sum()), "Car": Stepper(Car, lambda source: Sum())}
    pairs["Walk"].reset(0)
    return Controls(RunLoop(pairs["Walk"], FakeScreen()), pairs)


def visible(controls):
    return controls.widget.children[2].layout.display != "none"


def test_buttons_for_driving_are_there_when_there_is_something_to_drive(controls):
    async def watch():
        assert not visible(controls)
        controls.source_buttons[1].click()
        assert visible(controls)
        assert [b.button_style for b in controls.source_buttons] == ["", "info"]
        controls.drive[1].click()
        assert controls.loop.pair.source.commands == [(0.4, 0.0)]

    asyncio.run(watch())


def test_the_run_button_says_what_it_would_do(controls):
    async def watch():
        assert controls.run.description == "▶ run"
        controls.run.click()
        assert controls.run.description == "❚❚ pause"
        controls.run.click()
        assert controls.run.description == "▶ run"
        assert not controls.loop.running

    asyncio.run(watch())


def test_speed_and_seed_reach_the_loop(controls):
    async def watch():
        controls.speed.value = 50
        controls.seed.value = 7
        controls.reset.click()
        controls.step.click()

    asyncio.run(watch())
    assert (controls.loop.speed, controls.loop.seed, controls.loop.pair.count) == (50, 7, 2)
    assert isinstance(controls.seed, ipywidgets.BoundedIntText)


def test_the_browser_tells_whether_its_reader_asked_for_reduced_motion(stored):
    pair = Stepper(Walk, lambda source: Sum())
    pair.reset(0)
    canvas = RunLoop(pair, Heard()).screen
    for told, calm in (({"calm": True}, True), ({"calm": "yes"}, False), ({}, False)):
        canvas.say(kind="ready", **told)
        assert canvas.calm is calm
