"""A poll: what is counted, what is not, and how it looks while nobody's answer can be told."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.audience.lecture import MOST_SLIDES, Lecture
from slamlab.audience.poll import MOST_BARS, Poll

finite = st.floats(-1e12, 1e12)


def numbers(votes):
    poll = Poll(1, "q", "", None, "m")
    for n, vote in enumerate(votes):
        poll.vote(str(n), vote)
    return poll.counts()


@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 2)), max_size=40))
def test_each_client_s_last_vote_counts_once(votes):
    poll = Poll(1, "q", "", ["a", "b", "c"])
    for client, answer in votes:
        poll.vote(str(client), answer)
    last = dict(votes)
    counted = [sum(answer == n for answer in last.values()) for n in range(3)]
    assert poll.counts() == {"answers": len(last), "counts": counted, "hands": [0, 0, 0]}


def test_hands_are_added_and_counted_anew_they_replace_what_was_counted():
    poll = Poll(1, "q", "", ["a", "b"])
    poll.vote("x", 1)
    poll.raise_hands([9, 9])
    poll.raise_hands([10, 4])
    assert poll.counts() == {"answers": 15, "counts": [10, 5], "hands": [10, 4]}


@given(st.lists(finite, min_size=1, max_size=60))
def test_bars_hold_every_number_once_and_are_few(votes):
    told = numbers(votes)
    assert sum(bar["count"] for bar in told["bars"]) == told["answers"] == len(votes)
    assert 1 <= len(told["bars"]) <= MOST_BARS
    edges = [(bar["from"], bar["to"]) for bar in told["bars"]]
    assert all(start <= end for start, end in edges)
    assert all(a[1] == b[0] for a, b in itertools.pairwise(edges))
    low, middle, high = told["quartiles"]
    assert min(votes) <= low <= middle <= high <= max(votes)


def test_a_wild_number_does_not_press_the_others_into_one_bar():
    told = numbers([*np.linspace(1.0, 2.0, 99), 1e12])
    assert told["bars"][-1]["to"] < 3
    assert min(bar["count"] for bar in told["bars"]) > 5


def test_without_an_answer_there_are_no_bars():
    assert numbers([]) == {"answers": 0, "bars": [], "quartiles": []}


def test_a_slide_that_looks_as_before_is_no_change_and_one_that_came_back_is_shown_again():
    lecture = Lecture(lambda: 0.0)
    lecture.show(0, 7, "<p>a</p>")
    first = lecture.state("x")
    lecture.show(0, 7, "<p>a</p><script>x</script>")
    assert lecture.state("x") == first
    lecture.show(1, 7, "<p>b</p>")
    lecture.show(0, 7, "<p>a</p>")
    again = lecture.state("x")
    assert (again["shown"], again["slides"][0]) == (0, first["slides"][0])
    assert again["version"] > first["version"]


def test_slides_are_bounded():
    lecture = Lecture(lambda: 0.0)
    for number in range(MOST_SLIDES):
        lecture.show(number, 7, str(number))
    with pytest.raises(ValueError, match="too many or too large"):
        lecture.show(MOST_SLIDES, 7, "one more")
    lecture.show(0, 7, "another text")
    with pytest.raises(ValueError, match="too many or too large"):
        lecture.show(1, 7, "x" * 70_000_000)


def test_at_the_end_everything_is_forgotten():
    lecture = Lecture(lambda: 0.0)
    lecture.show(0, 7, "<p>a</p>")
    lecture.ask("q", "?", ["a", "b"], "")
    lecture.poll.vote("x", 0)
    lecture.end()
    told = lecture.state("x")
    assert (told["over"], told["slides"], told["poll"], told["shown"]) == (True, {}, None, None)


def test_a_lecture_whose_page_is_silent_is_abandoned_and_one_that_is_heard_is_not():
    now = [0.0]
    lecture = Lecture(lambda: now[0], patience=600.0)
    for now[0] in (500.0, 1000.0, 1500.0):
        assert not lecture.abandoned
        lecture.hear()
    now[0] = 2100.0
    assert not lecture.abandoned
    now[0] = 2101.0
    assert lecture.abandoned
