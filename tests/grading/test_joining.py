"""A further worker joins when what is left takes longer than its start, or when the first hangs."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from slamlab.grading.joining import Joining


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def grade(count, start, each, patience=1000.0):
    """Grade with two threads by a clock of our own; the threads that took part."""
    clock = Clock()
    joining, took_part = Joining(count, clock, patience), set()
    for k in range(count):
        first = threading.Thread(target=joining)
        if k == 0:  # the first of a pool never waits
            first.start()
            first.join(5)
            assert not first.is_alive()
        clock.now += start if k == 0 else each
        joining.done()
        other = threading.Thread(target=joining, daemon=True)
        other.start()
        other.join(0.05)
        if not other.is_alive():
            took_part.add(k)
    return took_part


def test_a_small_class_has_one_worker_to_its_end():
    assert grade(6, start=1.2, each=0.08) == {5}


def test_a_large_class_is_joined_as_soon_as_two_are_done():
    assert min(grade(40, start=1.2, each=0.08)) == 1


def test_a_small_class_of_slow_ones_is_joined_as_well():
    assert min(grade(6, start=1.2, each=3.0)) == 1


def test_where_the_first_one_hangs_the_others_join_after_some_patience():
    joining = Joining(6, patience=0.01)
    for _ in range(2):
        joining()


@pytest.mark.parametrize("stops", [True, False])
def test_who_waits_is_released_when_all_is_stopped(stops):
    joining = Joining(1, patience=1000.0)
    joining()
    with ThreadPoolExecutor(1, initializer=joining) as pool:
        future = pool.submit(int)
        joining.release() if stops else joining.done()
        assert future.result(60) == 0
