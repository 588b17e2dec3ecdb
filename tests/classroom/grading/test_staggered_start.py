"""Further workers start once the rest takes longer than their start, or when the first hangs."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from classroom.grading.batch import StaggeredStart


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def grade(count, start, each, max_wait=1000.0):
    """Grade with two threads and a fake clock; return the threads that took part."""
    clock = Clock()
    staggered, took_part = StaggeredStart(count, clock, max_wait), set()
    for k in range(count):
        first = threading.Thread(target=staggered)
        if k == 0:  # the first of a pool never waits
            first.start()
            first.join(5)
            assert not first.is_alive()
        clock.now += start if k == 0 else each
        staggered.done()
        other = threading.Thread(target=staggered, daemon=True)
        other.start()
        other.join(0.05)
        if not other.is_alive():
            took_part.add(k)
    return took_part


@pytest.mark.parametrize(
    ("count", "each", "first"),
    [(6, 0.08, 5), (40, 0.08, 1), (6, 3.0, 1)],
    ids=["a small class uses one worker", "a large class", "a small class of slow submissions"],
)
def test_further_workers_start_once_the_rest_takes_longer_than_their_start(count, each, first):
    assert min(grade(count, start=1.2, each=each)) == first


def test_further_workers_start_after_the_longest_wait_when_the_first_hangs():
    start = StaggeredStart(6, max_wait=0.01)
    for _ in range(2):
        start()


@pytest.mark.parametrize("stops", [True, False])
def test_waiting_threads_are_released_when_grading_stops_or_ends(stops):
    start = StaggeredStart(1, max_wait=1000.0)
    start()
    with ThreadPoolExecutor(1, initializer=start) as pool:
        future = pool.submit(int)
        start.release() if stops else start.done()
        assert future.result(60) == 0
