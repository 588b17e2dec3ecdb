"""The control panel of a live run: who drives, who may stop it, what happens when a page closes."""

import asyncio

import numpy as np
import pytest

from slamlab import estimators
from slamlab.files import SourceError
from slamlab.live import films
from slamlab.live.console.control_panel import TERMINAL, ControlPanel
from slamlab.live.console.drive_lock import LOCK_TIMEOUT, DriveLock
from slamlab.live.console.live_sources import source_for
from slamlab.live.console.page_screens import MAX_PAGES, PageScreen, PageScreens
from slamlab.live.console.recorded_run import RecordedRun
from slamlab.live.frame_packing import Scene
from tests.slamlab.web_server.client import run
from tests.timeouts import PATIENCE


class At:
    """A control panel on situation 2, with simulated time."""

    def __init__(self, source="sim:situation-2", estimator="odometry", film=None, **more):
        self.now = 0.0
        with source_for(source) as make:
            self.run = RecordedRun(make, lambda each: estimators.make(estimator, each), film)
        self.run.reset(0)
        self.panel = ControlPanel(self.run, "title", lock=DriveLock(clock=lambda: self.now), **more)

    @property
    def pose(self):
        return self.run.source.truth.poses[-1]

    async def steps(self, count):
        """Wait for more readings, and call ``tick`` as the server does."""
        end = self.run.count + count
        async with asyncio.timeout(PATIENCE):
            while self.run.count < end:
                self.panel.tick()
                await asyncio.sleep(0.001)

    async def until_it_stops(self):
        async with asyncio.timeout(PATIENCE):
            while self.panel.control.moving:
                self.panel.tick()
                await asyncio.sleep(0.001)


async def test_the_robot_makes_a_typed_move():
    at = At(speed=100)
    answer = at.panel.execute("page", "0.5, 90")
    assert "turning by 90°" in answer and at.panel.state("page")["driver"] == "you"
    assert at.panel.state("other")["driver"] == "another page"
    await at.until_it_stops()
    assert np.allclose(at.run.estimator.pose, [0, 0.5, np.pi / 2], atol=0.05)
    at.panel.tick()
    assert at.panel.state("page")["driver"] == ""
    at.panel.loop.pause()


async def test_every_word_typed_in_the_terminal_is_answered():
    at = At()
    assert at.panel.execute("terminal", "step") == "one step"
    assert at.panel.execute("terminal", "run") == "the run goes on"
    at.panel.loop.pause()


async def test_while_one_client_has_the_control_another_may_only_stop():
    at = At(speed=100)
    at.panel.press("one", "forward")
    await at.steps(2)
    for action in ("forward", "run", "step"):
        with pytest.raises(ValueError, match="another client is driving"):
            at.panel.press("two", action)
    for line in ("1, 0", "reset", "exit"):
        with pytest.raises(ValueError, match="another client is driving"):
            at.panel.execute("two", line)
    at.panel.set_speed("two", 1)
    assert at.panel.loop.speed == 100 and at.panel.control.moving
    assert at.panel.execute("two", "") == "the robot stops"
    assert not at.panel.control.moving
    at.panel.tick()
    at.panel.press("two", "left")
    at.panel.loop.pause()


async def test_the_robot_stops_when_the_lock_is_not_renewed():
    at = At(speed=100)
    at.panel.press("page", "forward")
    await at.steps(1)
    at.now = LOCK_TIMEOUT
    at.panel.renew("page")
    at.now = 2 * LOCK_TIMEOUT
    await at.steps(1)
    assert at.panel.control.moving
    at.now = 2 * LOCK_TIMEOUT + 0.01
    at.panel.tick()
    assert not at.panel.control.moving and at.panel.state("page")["driver"] == ""
    at.panel.renew("page")  # too late
    at.panel.tick()
    assert not at.panel.control.moving
    at.panel.loop.pause()


async def test_the_robot_stops_when_the_driving_page_closes():
    at = At(speed=100)
    at.panel.press("page", "left")
    at.panel.leave("another")
    assert at.panel.control.moving
    at.panel.leave("page")
    assert not at.panel.control.moving
    at.panel.loop.pause()


async def test_the_terminal_needs_not_renew_the_lock():
    at = At(speed=100)
    at.panel.execute(TERMINAL, "0.5, 0")
    for at.now in range(1, 20):
        at.panel.tick()
    assert at.panel.state("page")["driver"] == "the terminal"
    await at.until_it_stops()
    assert at.pose[0] == pytest.approx(0.5, abs=0.05)
    assert at.panel.execute(TERMINAL, "exit") and at.panel.ended.is_set()
    at.panel.loop.pause()


@pytest.mark.parametrize(
    "line, message",
    [("foo", "is not a command"), ("1e9, 0", "too far"), ("map", "start with --map"),
                   ("film", "start with --film")]
)  # fmt: skip
async def test_a_refused_command_explains_why_and_takes_no_lock(line, message):
    at = At()
    with pytest.raises(ValueError, match=message):
        at.panel.execute("page", line)
    with pytest.raises(ValueError, match="no button"):
        at.panel.press("page", "nonsense")
    at.panel.tick()
    assert at.panel.lock.holder is None


async def test_a_recording_cannot_be_driven():
    at = At("sim:landmarks", "mak")
    for action in (at.panel.press, at.panel.execute):
        with pytest.raises(ValueError, match="is a recording"):
            action("page", "forward")


def test_the_map_is_saved_and_the_film_holds_the_steps_while_it_was_on(tmp_path):
    async def driven(film):
        at = At(speed=100, film=film, map_file=tmp_path / "map.png")
        at.panel.press("page", "forward")
        await at.steps(3)
        at.panel.press("page", "film")
        before = film.frames
        await at.steps(3)
        at.panel.press("page", "stop")
        assert film.frames == before
        at.panel.press("page", "map")
        async with asyncio.timeout(PATIENCE):
            while not at.panel.message:
                await asyncio.sleep(0.01)
        assert "is in map.png" in at.panel.message
        at.panel.loop.pause()
        return before

    with films.FilmRecorder(tmp_path / "a.film", "a", "a") as film:
        frames = run(driven(film))
    loaded = films.load(tmp_path / "a.film")
    assert len(loaded) == frames >= 3
    *_, (_, last) = loaded
    assert {"truth", "naive"} <= {layer.name for layer in last}
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


def test_the_map_is_saved_at_the_end_unless_it_was_saved_before(tmp_path):
    async def ended():
        at = At(map_file=tmp_path / "map.png")
        await at.panel.save_last_map()
        first = at.panel.message
        (tmp_path / "map.png").unlink()
        await at.panel.save_last_map()
        return first

    assert "is in map.png" in run(ended())
    assert not (tmp_path / "map.png").exists()


@pytest.mark.parametrize(
    ("source", "estimator", "tracks", "own"),
    [
        ("sim:situation-2", "walls", 1, False),
        ("sim:situation-2", "icp", 1, True),
        ("sim:flat-carried", "icp", 0, False),
    ],
)
def test_the_naive_track_is_shown_once_and_never_without_odometry(source, estimator, tracks, own):
    run_ = At(source, estimator=estimator).run
    drawn = [(each.kind, each.name) for each in run_.scene().drawables]
    assert drawn.count(("poses", "naive")) == tracks
    assert ("naive" in [layer.name for layer in run_.estimator.layers()]) == own


def test_only_bytes_of_devices_are_recorded():
    with pytest.raises(SourceError, match="Omit --record"), source_for("sim:room", record="a"):
        pass


class Page:
    """A page that acknowledges frames when the test does."""

    def __init__(self, screens):
        self.frames = []
        self.screen = PageScreen(self.frames.append)
        assert screens.add(self.screen)
        screens.start(self.screen, False)


def test_every_page_gets_whole_frames_at_its_own_rate():
    screens = PageScreens()
    screens.offer(Scene([], "first"))
    quick, slow = Page(screens), Page(screens)
    assert len(quick.frames) == len(slow.frames) == 1 and b"first" in slow.frames[0]
    for number in range(1, 6):
        quick.screen.acknowledge(number)
        screens.offer(Scene([], f"scene {number}"))
    assert len(quick.frames) == 6 and len(slow.frames) == 1
    assert not screens.free
    slow.screen.acknowledge(1)
    assert len(slow.frames) == 2 and b"scene 5" in slow.frames[-1]  # the newest, no backlog
    screens.remove(slow.screen)
    screens.offer(Scene([], "last"))
    assert len(slow.frames) == 2


def test_the_number_of_pages_is_limited():
    screens = PageScreens()
    for _ in range(MAX_PAGES):
        Page(screens)
    assert not screens.add(PageScreen(print)) and len(screens) == MAX_PAGES
