"""A source that blocks, as a device does: nothing else waits for it, no thread is left."""

import asyncio
import queue
import threading
from types import SimpleNamespace

import numpy as np
import pytest

import slamlab.live.live_view as live_view
from slamlab import live
from slamlab.files import SourceError
from slamlab.live import reading_thread, run_loop
from slamlab.live.estimator_run import EstimatorRun
from slamlab.live.run_loop import RunLoop
from slamlab.readings import Reading
from slamlab.sources.base import Source
from slamlab.views import figure_display
from tests.slamlab.views.live_fakes import FakeScreen, Sum, Walk, until
from tests.slamlab.views.outputs import Displays

ALT = "a robot waits"


class Device(Source):
    """Yields a reading at the test's request; until then readers wait, unless it is closed."""

    name = "a device"

    def __init__(self, rng=None):
        super().__init__()
        self.closed, self.inside, self.most, self.commands = False, 0, 0, []
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
    pair = EstimatorRun(source, lambda source: Sum(), **more)
    pair.reset(0, timeout=0.001)
    return RunLoop(pair, FakeScreen())


async def test_the_notebook_stays_responsive_while_a_source_is_silent():
    loop, turns = made(), []

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
    loop.close()


async def test_a_late_reading_is_processed_and_shown():
    loop = made()
    loop.run()
    for count in (1, 2, 3):
        loop.pair.source.give()
        await until(lambda count=count: loop.pair.count == count)
    await until(lambda: loop.screen.scenes[-1].status.startswith("step 3 "))
    loop.close()
    assert loop.pair.estimator.pose[0] == pytest.approx(0.3)


async def test_live_readings_do_not_wait_for_pictures():
    loop = made()
    loop.screen.at_once = False
    loop.run()
    for count in (1, 2, 3, 4, 5):
        loop.pair.source.give()
        await until(lambda count=count: loop.pair.count == count)
    assert loop.screen.most == 1
    loop.pause()
    loop.screen.draw()
    await until(lambda: loop.screen.scenes[-1].status.startswith("step 5 "))
    loop.close()


async def test_a_step_waits_for_one_reading_and_then_pauses():
    loop = made()
    loop.step()
    assert loop.running  # the button shows pause, and pause ends the wait
    loop.pair.source.give()
    loop.pair.source.give()
    await until(lambda: not loop.running)
    assert loop.pair.count == 1
    loop.close()


async def test_a_reading_asked_for_before_a_pause_is_not_lost():
    loop = made()
    loop.run()
    loop.pause()
    loop.pair.source.give(0.7)
    loop.step()
    await until(lambda: loop.pair.count == 1)
    loop.close()
    assert loop.pair.estimator.pose[0] == 0.7


def test_a_long_wait_is_announced(monkeypatch):
    loop = made()
    monkeypatch.setattr(reading_thread, "monotonic", lambda: loop.pair._reader._request.began + 7)
    assert loop.pair.status() == "no reading for 7 s"
    loop.close()


async def test_a_source_that_raises_is_reported_in_one_line_and_run_begins_it_again():
    loop = made()
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


async def test_an_unavailable_source_is_reported_in_one_line_and_reset_tries_again():
    there = []

    def plugged(rng):
        if not there:
            raise SourceError("no robot at /dev/ttyUSB0: is it plugged in?")
        return Walk(rng)

    loop = made(Walk)
    tries = [
        lambda: loop.reset(pair=EstimatorRun(plugged, lambda source: Sum())),
        loop.run,
        loop.reset,
    ]
    for press in [*tries, loop.step, lambda: loop.drive("forward")]:
        press()
        await until(lambda: loop.screen.free)
    there.append(True)
    loop.reset()
    await until(lambda: loop.pair.count == 1)
    messages = [scene.status for scene in loop.screen.scenes]
    assert all(status.startswith("⚠ no robot at /dev/ttyUSB0") for status in messages[:3])
    assert all(status.startswith("⚠ the source is closed") for status in messages[3:5])


def test_a_source_made_for_the_view_is_closed_with_it_and_its_thread_ends():
    for close in (lambda loop: loop.close(), lambda loop: loop.screen.on_closed()):
        loop = made()
        assert threading.active_count() > 1 and loop.pair._reader.blocked
        close(loop)
        assert loop.pair.source.closed
        assert not waiting()


async def test_a_reset_closes_the_source_before_and_one_thread_waits_at_most():
    loop = made()
    sources = [loop.pair.source]
    for _ in range(3):
        loop.reset()
        sources.append(loop.pair.source)
    other = EstimatorRun(Walk, lambda source: Sum())
    loop.reset(pair=other)
    assert loop.pair is other and other.count == 1
    assert all(source.closed for source in sources)
    assert max(source.most for source in sources) == 1


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
async def test_a_real_robot_gets_commands_at_once_and_stops_without_them(end):
    loop = made(Robot)
    loop.run()
    for name in ("forward", "stop", "left"):
        loop.drive(name)
    end(loop)
    messages = [(0.4, 0.0), (0.0, 0.0), (0.0, 0.6), (0.0, 0.0)]
    assert loop.pair.source.commands == messages
    loop.close()


@pytest.fixture
def cell(monkeypatch):
    """Tell which cell runs, and what it displays."""
    displays = Displays(monkeypatch, figure_display)
    monkeypatch.setattr(live_view, "FIRST_READING_TIMEOUT", 0.001)
    monkeypatch.setattr(live_view, "_shown", {})

    def run(cell, message):
        parent = {"metadata": {"cellId": cell}, "msg_id": message}
        monkeypatch.setattr(
            live_view, "get_ipython", lambda: SimpleNamespace(get_parent=lambda: parent)
        )

    run.stills = displays.bundles
    return run


def test_a_silent_source_is_shown_and_closed_when_the_cell_runs_again(cell):
    cell("one", "1")
    first, twin = (live.watch(Device, lambda source: Sum(), ALT) for _ in range(2))
    assert "<img" in cell.stills[0]["text/html"]
    cell("two", "2")
    other = live.watch(Device, lambda source: Sum(), ALT)
    assert not any(loop.pair.source.closed for loop in (first, twin, other))
    cell("one", "3")
    again = live.watch(Device, lambda source: Sum(), ALT)
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
        live.watch(device, lambda source: 1 / 0, ALT)
    cell("one", "2")
    loop = live.watch(device, lambda source: Sum(), ALT)
    assert [each.closed for each in opened] == [True, False]
    loop.close()
