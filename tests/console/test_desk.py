"""The desk of a live run: who drives, who may stop it, what a driver's going does."""

import asyncio

import numpy as np
import pytest

from slamlab import estimators, films
from slamlab.console.desk import TERMINAL, Desk
from slamlab.console.filmed_stepper import FilmedStepper
from slamlab.console.lease import LENGTH, Lease
from slamlab.console.live_sources import source_for
from slamlab.console.watchers import MOST, PageScreen, Watchers
from slamlab.files.errors import SourceError
from slamlab.views.live.frame_packing import Scene
from tests.listening.client import run
from tests.patience import PATIENCE


class At:
    """A desk on situation 2, its time, and what is called at each tick."""

    def __init__(self, source="sim:situation-2", estimator="odometry", film=None, **more):
        self.now = 0.0
        with source_for(source) as make:
            self.stepper = FilmedStepper(make, lambda each: estimators.make(estimator, each), film)
        self.stepper.reset(0)
        self.desk = Desk(self.stepper, "title", lease=Lease(clock=lambda: self.now), **more)

    @property
    def pose(self):
        return self.stepper.source.truth.poses[-1]

    async def steps(self, count):
        """Wait until so many more readings are taken in, as the server does."""
        end = self.stepper.count + count
        async with asyncio.timeout(PATIENCE):
            while self.stepper.count < end:
                self.desk.tick()
                await asyncio.sleep(0.001)

    async def until_it_stands(self):
        async with asyncio.timeout(PATIENCE):
            while self.desk.control.moving:
                self.desk.tick()
                await asyncio.sleep(0.001)


def test_a_page_types_a_move_and_the_robot_makes_it():
    async def driven():
        at = At(speed=100)
        said = at.desk.execute("page", "0.5, 90")
        assert "turning by 90°" in said and at.desk.state("page")["drives"] == "you"
        assert at.desk.state("other")["drives"] == "another page"
        await at.until_it_stands()
        assert np.allclose(at.stepper.estimator.pose, [0, 0.5, np.pi / 2], atol=0.05)
        at.desk.tick()
        assert at.desk.state("page")["drives"] == ""
        at.desk.loop.pause()

    run(driven())


def test_while_one_drives_another_is_refused_but_may_stop():
    async def driven():
        at = At(speed=100)
        at.desk.press("one", "forward")
        await at.steps(2)
        for deed in ("forward", "run", "step"):
            with pytest.raises(ValueError, match="somebody else drives"):
                at.desk.press("two", deed)
        for line in ("1, 0", "reset", "exit"):
            with pytest.raises(ValueError, match="somebody else drives"):
                at.desk.execute("two", line)
        at.desk.set_speed("two", 1)
        assert at.desk.loop.speed == 100 and at.desk.control.moving
        assert at.desk.execute("two", "") == "the robot stands"
        assert not at.desk.control.moving
        at.desk.tick()
        at.desk.press("two", "left")
        at.desk.loop.pause()

    run(driven())


def test_a_driver_that_is_not_heard_of_loses_the_robot_which_stands():
    async def driven():
        at = At(speed=100)
        at.desk.press("page", "forward")
        await at.steps(1)
        at.now = LENGTH
        at.desk.renew("page")
        at.now = 2 * LENGTH
        await at.steps(1)
        assert at.desk.control.moving
        at.now = 2 * LENGTH + 0.01
        at.desk.tick()
        assert not at.desk.control.moving and at.desk.state("page")["drives"] == ""
        at.desk.renew("page")  # too late
        at.desk.tick()
        assert not at.desk.control.moving
        at.desk.loop.pause()

    run(driven())


def test_a_page_that_goes_leaves_the_robot_standing_and_others_do_not():
    async def driven():
        at = At(speed=100)
        at.desk.press("page", "left")
        at.desk.leave("another")
        assert at.desk.control.moving
        at.desk.leave("page")
        assert not at.desk.control.moving
        at.desk.loop.pause()

    run(driven())


def test_the_terminal_drives_as_long_as_the_program_lives():
    async def driven():
        at = At(speed=100)
        at.desk.execute(TERMINAL, "0.5, 0")
        for at.now in range(1, 20):
            at.desk.tick()
        assert at.desk.state("page")["drives"] == "the terminal"
        await at.until_it_stands()
        assert at.pose[0] == pytest.approx(0.5, abs=0.05)
        assert at.desk.execute(TERMINAL, "exit") and at.desk.over.is_set()
        at.desk.loop.pause()

    run(driven())


@pytest.mark.parametrize(
    "line, told", [("foo", "is no command"), ("1e9, 0", "too far"), ("map", "say --map"),
                   ("film", "say --film")]
)  # fmt: skip
def test_what_cannot_be_done_is_said_and_nobody_drives(line, told):
    async def typed():
        at = At()
        with pytest.raises(ValueError, match=told):
            at.desk.execute("page", line)
        with pytest.raises(ValueError, match="no button"):
            at.desk.press("page", "nonsense")
        at.desk.tick()
        assert at.desk.lease.holder is None

    run(typed())


def test_a_recording_is_not_driven():
    async def typed():
        at = At("sim:landmarks", "mak")
        for deed in (at.desk.press, at.desk.execute):
            with pytest.raises(ValueError, match="a recording plays"):
                deed("page", "forward")

    run(typed())


def test_the_map_is_saved_and_the_film_holds_the_steps_it_was_on_for(tmp_path):
    async def driven(film):
        at = At(speed=100, film=film, map_file=tmp_path / "map.png")
        at.desk.press("page", "forward")
        await at.steps(3)
        at.desk.press("page", "film")
        before = film.frames
        await at.steps(3)
        at.desk.press("page", "stop")
        assert film.frames == before
        at.desk.press("page", "map")
        async with asyncio.timeout(PATIENCE):
            while not at.desk.said:
                await asyncio.sleep(0.01)
        assert "is in map.png" in at.desk.said
        at.desk.loop.pause()
        return before

    with films.FilmRecorder(tmp_path / "a.film", "a", "a") as film:
        frames = run(driven(film))
    loaded = films.load(tmp_path / "a.film")
    assert len(loaded) == frames >= 3
    *_, (_, last) = loaded
    assert {"truth", "naive"} <= {layer.name for layer in last}
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


def test_naive_is_shown_once_whether_or_not_the_estimator_shows_it_itself():
    for estimator, beside in (("walls", 1), ("icp", 0)):
        at_hand = At(estimator=estimator).stepper
        tracks = [x for x in at_hand.scene().drawables if (x.kind, x.name) == ("poses", "naive")]
        assert len(tracks) == 1
        own = [layer.name for layer in at_hand.estimator.layers()].count("naive")
        assert bool(own) != bool(beside)


def test_bytes_are_recorded_of_devices_only():
    with pytest.raises(SourceError, match="leave --record"), source_for("sim:room", record="a"):
        pass


class Page:
    """A page that draws when it is told to."""

    def __init__(self, watchers):
        self.frames = []
        self.screen = PageScreen(self.frames.append)
        assert watchers.join(self.screen)
        watchers.begin(self.screen, False)


def test_every_page_gets_whole_frames_at_its_own_pace():
    watchers = Watchers()
    watchers.offer(Scene([], "first"))
    quick, slow = Page(watchers), Page(watchers)
    assert len(quick.frames) == len(slow.frames) == 1 and b"first" in slow.frames[0]
    for number in range(1, 6):
        quick.screen.acknowledge(number)
        watchers.offer(Scene([], f"scene {number}"))
    assert len(quick.frames) == 6 and len(slow.frames) == 1
    assert not watchers.free
    slow.screen.acknowledge(1)
    assert len(slow.frames) == 2 and b"scene 5" in slow.frames[-1]  # the newest, no backlog
    watchers.leave(slow.screen)
    watchers.offer(Scene([], "last"))
    assert len(slow.frames) == 2


def test_only_so_many_pages_look():
    watchers = Watchers()
    for _ in range(MOST):
        Page(watchers)
    assert not watchers.join(PageScreen(print)) and len(watchers) == MOST
