"""A source that blocks, as a device does: nothing else waits for it, no thread is left."""

import asyncio
import queue
import threading
from types import SimpleNamespace

import numpy as np
import pytest

from slamlab import views
from slamlab.files.errors import SourceError
from slamlab.readings import Reading
from slamlab.sources.base import Source
from slamlab.views import showing
from slamlab.views.live import cell_views, live_view, reading_thread, run_loop
from slamlab.views.live.run_loop import RunLoop
from slamlab.views.live.stepper import Stepper
from tests.views.displays import Displays
from tests.views.live_fakes import FakeScreen, Sum, Walk, until

ALT = "a robot waits"


class Device(Source):
    """Gives a reading when the test says so; until then whoever asks waits, unless it is closed."""

    name = "a device"

    def __init__(self, rng=None):
        super().__init__()
        self.closed, self.inside, self.most = False, 0, 0
        self._coming = queue.Queue()

    def __iter__(self):
        time = 0
        while True:
            self.inside += 1
            self.most = max(self.most, self.inside)
            come = self._coming.get()
            self.inside -= 1
            if come is None:
                return
            if isinstance(come, Exception):
                raise come
            yield Reading(time=float(time), odometry=np.array([come, 0.0, 0.0]))
            time += 1

    def give(self, come=0.1):
        self._coming.put(come)

    def close(self):
        self.closed = True
        self._coming.put(None)


class Robot(Device):
    """A device that can be driven and whose readings come in their own time."""

    def __init__(self, rng=None):
        super().__init__()
        self.commands = []

    def drive(self, command):
        self.commands.append(command)


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr(run_loop, "READING_TIMEOUT", 0.001)
    monkeypatch.setattr(run_loop, "IDLE_POLL", 0.001)
    yield
    run_loop.stop()
    assert not waiting(), "a thread is left behind"


def waiting():
    """Threads that wait for a reading; one whose source was closed gets the time to end."""
    for thread in threading.enumerate():
        if isinstance(thread, reading_thread._ReadRequest):
            thread.join(5)
    return [t for t in threading.enumerate() if isinstance(t, reading_thread._ReadRequest)]


def made(source=Device, **more):
    """A loop whose source has given nothing yet."""
    pair = Stepper(source, lambda source: Sum(), **more)
    pair.reset(0, timeout=0.001)
    return RunLoop(pair, FakeScreen())


def test_all_else_goes_on_while_a_source_keeps_one_waiting_and_every_button_answers():
    loop, turns = made(), []

    async def watch():
        async def others():
            while True:
                turns.append(0)
                await asyncio.sleep(0)

        beside = asyncio.create_task(others())
        loop.run()
        await until(lambda: len(turns) > 20)
        assert loop.running and loop.pair.count == 0
        for press in (loop.pause, loop.step, loop.reset, loop.run, loop.pause):
            press()
            before = len(turns)
            await until(lambda before=before: len(turns) > before + 20)
        assert not loop.running
        beside.cancel()

    asyncio.run(watch())
    loop.close()


def test_a_reading_that_comes_late_is_taken_in_and_shown():
    loop = made()

    async def watch():
        loop.run()
        for count in (1, 2, 3):
            loop.pair.source.give()
            await until(lambda count=count: loop.pair.count == count)
        await until(lambda: loop.screen.scenes[-1].status.startswith("step 3 "))
        loop.close()

    asyncio.run(watch())
    assert loop.pair.estimator.pose[0] == pytest.approx(0.3)


def test_what_comes_in_its_own_time_waits_for_no_picture_and_the_next_one_shows_it_all():
    loop = made()
    loop.screen.at_once = False

    async def watch():
        loop.run()
        for count in (1, 2, 3, 4, 5):
            loop.pair.source.give()
            await until(lambda count=count: loop.pair.count == count)
        assert loop.screen.most == 1
        loop.pause()
        loop.screen.draw()
        await until(lambda: loop.screen.scenes[-1].status.startswith("step 5 "))
        loop.close()

    asyncio.run(watch())


def test_a_step_waits_for_one_reading_and_then_pauses():
    loop = made()

    async def watch():
        loop.step()
        assert loop.running  # the button says pause, and pause gives up waiting
        loop.pair.source.give()
        loop.pair.source.give()
        await until(lambda: not loop.running)
        assert loop.pair.count == 1
        loop.close()

    asyncio.run(watch())


def test_a_reading_asked_for_before_a_pause_is_not_lost():
    loop = made()

    async def watch():
        loop.run()
        loop.pause()
        loop.pair.source.give(0.7)
        loop.step()
        await until(lambda: loop.pair.count == 1)
        loop.close()

    asyncio.run(watch())
    assert loop.pair.estimator.pose[0] == 0.7


def test_who_waits_long_is_told_so(monkeypatch):
    loop = made()
    monkeypatch.setattr(reading_thread, "monotonic", lambda: loop.pair._reader._request.began + 7)
    assert loop.pair.status() == "no reading for 7 s"
    loop.close()


def test_a_source_that_raises_says_so_in_one_line_and_is_begun_anew_by_run():
    loop = made()

    async def watch():
        loop.run()
        loop.pair.source.give(OSError("the cable\n is out"))
        await until(lambda: not loop.running)
        assert loop.screen.scenes[-1].status == "⚠ OSError: the cable is out"
        first = loop.pair.source
        loop.run()
        assert loop.pair.source is not first and first.closed
        loop.pair.source.give()
        await until(lambda: loop.pair.count == 1)
        loop.close()

    asyncio.run(watch())


def test_a_source_that_cannot_be_had_says_so_in_one_line_and_reset_tries_again():
    there = []

    def plugged(rng):
        if not there:
            raise SourceError("no robot at /dev/ttyUSB0: is it plugged in?")
        return Walk(rng)

    loop = made(Walk)

    async def watch():
        tries = [
            lambda: loop.reset(pair=Stepper(plugged, lambda source: Sum())),
            loop.run,
            loop.reset,
        ]
        for press in [*tries, loop.step, lambda: loop.drive("forward")]:
            press()
            await until(lambda: loop.screen.free)
        there.append(True)
        loop.reset()
        await until(lambda: loop.pair.count == 1)

    asyncio.run(watch())
    told = [scene.status for scene in loop.screen.scenes]
    assert all(status.startswith("⚠ no robot at /dev/ttyUSB0") for status in told[:3])
    assert all(status.startswith("⚠ there is no source") for status in told[3:5])


def test_a_source_made_for_the_view_is_closed_with_it_and_its_thread_ends():
    for close in (lambda loop: loop.close(), lambda loop: loop.screen.on_closed()):
        loop = made()
        assert threading.active_count() > 1 and loop.pair._reader.blocked
        close(loop)
        assert loop.pair.source.closed
        assert not waiting()


def test_a_reset_closes_the_source_before_and_one_thread_waits_at_most():
    loop = made()
    sources = [loop.pair.source]

    async def watch():
        for _ in range(3):
            loop.reset()
            sources.append(loop.pair.source)
        loop.close()

    asyncio.run(watch())
    assert all(source.closed for source in sources)
    assert max(source.most for source in sources) == 1


def test_who_chooses_another_simulation_closes_the_source_of_the_one_before():
    loop = made()
    before = loop.pair.source

    async def watch():
        loop.reset(pair=Stepper(Walk, lambda source: Sum()))
        await until(lambda: loop.pair.count == 1)

    asyncio.run(watch())
    assert before.closed


def test_a_source_handed_in_stays_open_and_no_two_views_read_it_at_once():
    device = Device()
    loop = made(device)
    for _ in range(3):
        loop.close()
        loop = made(device)  # as when a cell is run again
    assert not device.closed
    device.give(0.4)
    assert loop.pair.step(5) and loop.pair.estimator.pose[0] == 0.4
    assert device.most == 1
    device.close()


@pytest.mark.parametrize(
    "end", [RunLoop.pause, RunLoop.step, RunLoop.close, lambda loop: run_loop.stop()]
)
def test_a_robot_with_a_clock_of_its_own_is_told_at_once_and_stands_when_nobody_steers(end):
    loop = made(Robot)

    async def watch():
        loop.run()
        for name in ("forward", "stop", "left"):
            loop.drive(name)
        end(loop)

    asyncio.run(watch())
    told = [(0.4, 0.0), (0.0, 0.0), (0.0, 0.6), (0.0, 0.0)]
    assert loop.pair.source.commands == told
    loop.close()


@pytest.fixture
def cell(monkeypatch):
    """Tell which cell runs, and what it displays."""
    displays = Displays(monkeypatch, showing)
    monkeypatch.setattr(live_view, "FIRST_READING_TIMEOUT", 0.001)
    monkeypatch.setattr(cell_views, "_shown", {})

    def run(cell, message):
        parent = {"metadata": {"cellId": cell}, "msg_id": message}
        monkeypatch.setattr(
            cell_views, "get_ipython", lambda: SimpleNamespace(get_parent=lambda: parent)
        )

    run.stills = displays.bundles
    return run


def test_a_cell_shows_a_source_that_gives_nothing_and_run_again_closes_it(cell):
    cell("one", "1")
    first, twin = (views.live(Device, lambda source: Sum(), ALT) for _ in range(2))
    assert "<img" in cell.stills[0]["text/html"]
    cell("two", "2")
    other = views.live(Device, lambda source: Sum(), ALT)
    assert not any(loop.pair.source.closed for loop in (first, twin, other))
    cell("one", "3")
    again = views.live(Device, lambda source: Sum(), ALT)
    assert first.pair.source.closed and twin.pair.source.closed
    assert not again.pair.source.closed and not other.pair.source.closed
    again.close()
    other.close()


def test_a_view_that_could_not_be_shown_is_closed_when_its_cell_is_run_again(cell):
    opened = []

    def device(rng):
        opened.append(Device())
        return opened[-1]

    cell("one", "1")
    with pytest.raises(ZeroDivisionError):
        views.live(device, lambda source: 1 / 0, ALT)
    cell("one", "2")
    loop = views.live(device, lambda source: Sum(), ALT)
    assert [each.closed for each in opened] == [True, False]
    loop.close()
