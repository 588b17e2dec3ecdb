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


def test_without_threads_a_sleep_advances_simulated_time():
    clock = SimulatedClock(5.0)
    clock.sleep(2.5)
    clock.sleep(-1.0)
    assert clock.now() == 7.5


def test_threads_run_in_the_order_of_their_wake_up_times():
    clock, seen = SimulatedClock(), []
    ticking(clock, 0.5, "a", seen)
    ticking(clock, 0.75, "b", seen)
    assert not seen  # nobody has waited yet
    clock.sleep(1.5)
    assert seen == [(0, "a"), (0, "b"), (0.5, "a"), (0.75, "b"), (1.0, "a"), (1.5, "a"), (1.5, "b")]
    threading.Event().wait(0.05)  # nobody waits in simulated time now
    assert clock.now() == 1.5 and len(seen) == 7


@pytest.mark.parametrize(("timeout", "came"), [(None, True), (2.0, True), (1.0, False)])
def test_a_wait_for_a_change_ends_at_its_time_or_at_the_timeout(timeout, came):
    clock, changed, messages = SimulatedClock(), threading.Condition(), []

    def tell():
        clock.sleep(1.5)
        with changed:
            messages.append(1)
            changed.notify_all()

    clock.start_thread(tell, "tells")
    with changed:
        assert clock.wait_for(changed, lambda: bool(messages), timeout) is came
    assert clock.now() == (1.5 if came else 1.0)


def test_an_impossible_condition_is_not_waited_for():
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
    monkeypatch.setattr(threading, "excepthook", lambda message: raised.append(message.exc_type))
    clock.start_thread(lambda: 1 / 0, "fails")
    ticking(clock, 1.0, "a", seen)
    clock.sleep(3.0)
    assert len(seen) == 4 and raised == [ZeroDivisionError]


def test_several_threads_can_wait_at_once():
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
