"""Simulated time: it passes while somebody waits, and threads run in it one at a time, in order."""

import threading

import pytest

from slamlab.devices.clock import SimulatedClock


def ticking(clock, period, name, seen, until=10.0):
    """A thread of the clock that notes its name and the time every so often."""

    def tick():
        while clock.now() < until:
            seen.append((clock.now(), name))
            clock.sleep(period)

    return clock.start_thread(tick, name)


def test_alone_a_sleep_is_the_time_that_passes():
    clock = SimulatedClock(5.0)
    clock.sleep(2.5)
    clock.sleep(-1.0)
    assert clock.now() == 7.5


def test_threads_run_each_at_its_moment_and_those_of_one_moment_in_turn():
    clock, seen = SimulatedClock(), []
    ticking(clock, 0.5, "a", seen)
    ticking(clock, 0.75, "b", seen)
    assert not seen  # nobody has waited yet
    clock.sleep(1.5)
    assert seen == [(0, "a"), (0, "b"), (0.5, "a"), (0.75, "b"), (1.0, "a"), (1.5, "a"), (1.5, "b")]
    assert clock.now() == 1.5


def test_time_stands_while_nobody_waits():
    clock, seen = SimulatedClock(), []
    thread = ticking(clock, 0.5, "a", seen)
    clock.sleep(1.0)
    before = len(seen)
    thread.join(0.05)
    assert (clock.now(), len(seen)) == (1.0, before)


@pytest.mark.parametrize(("timeout", "came"), [(None, True), (2.0, True), (1.0, False)])
def test_who_waits_for_a_change_gets_it_at_its_time_or_the_timeout(timeout, came):
    clock, changed, told = SimulatedClock(), threading.Condition(), []

    def tell():
        clock.sleep(1.5)
        with changed:
            told.append(1)
            changed.notify_all()

    clock.start_thread(tell, "tells")
    with changed:
        assert clock.wait_for(changed, lambda: bool(told), timeout) is came
    assert clock.now() == (1.5 if came else 1.0)


def test_what_nobody_can_bring_about_is_not_waited_for():
    clock, changed = SimulatedClock(), threading.Condition()
    with changed:
        assert clock.wait_for(changed, lambda: False) is False


def test_joining_lets_time_pass_until_the_thread_ends_or_the_timeout():
    clock, seen = SimulatedClock(), []
    thread = ticking(clock, 0.5, "a", seen, until=3.0)
    clock.join(thread, 1.25)
    assert clock.now() == 1.25
    clock.join(thread, 100.0)
    assert clock.now() == 3.0 and len(seen) == 6


def test_an_error_ends_its_thread_and_time_goes_on(monkeypatch):
    clock, seen, raised = SimulatedClock(), [], []
    monkeypatch.setattr(threading, "excepthook", lambda told: raised.append(told.exc_type))
    clock.start_thread(lambda: 1 / 0, "fails")
    ticking(clock, 1.0, "a", seen)
    clock.sleep(3.0)
    assert len(seen) == 4 and raised == [ZeroDivisionError]


def test_several_may_wait_at_once_and_each_has_its_time():
    clock, seen, ends = SimulatedClock(), [], {}

    def wait(seconds):
        clock.sleep(seconds)
        ends[seconds] = clock.now()

    ticking(clock, 0.01, "a", seen)
    waiting = [threading.Thread(target=wait, args=(seconds,)) for seconds in (0.5, 1.0, 2.0)]
    for thread in waiting:
        thread.start()
    for thread in waiting:
        thread.join()
    assert all(ends[seconds] >= seconds for seconds in (0.5, 1.0, 2.0))
    times = [time for time, _ in seen]
    assert times == sorted(times) and len(times) == pytest.approx(clock.now() / 0.01, abs=2)
