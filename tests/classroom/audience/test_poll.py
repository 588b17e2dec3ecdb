"""Polls: counts, bars, quartiles; state of a lecture."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from classroom.audience.lecture_state import MAX_SLIDES, LectureState
from classroom.audience.poll import MAX_BARS, Poll

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


def test_hands_are_added_and_a_new_count_replaces_the_old():
    poll = Poll(1, "q", "", ["a", "b"])
    poll.vote("x", 1)
    poll.raise_hands([9, 9])
    poll.raise_hands([10, 4])
    assert poll.counts() == {"answers": 15, "counts": [10, 5], "hands": [10, 4]}


@given(st.lists(finite, min_size=1, max_size=60))
def test_bars_hold_every_number_once_and_are_few(votes):
    reported = numbers(votes)
    assert sum(bar["count"] for bar in reported["bars"]) == reported["answers"] == len(votes)
    assert 1 <= len(reported["bars"]) <= MAX_BARS
    edges = [(bar["from"], bar["to"]) for bar in reported["bars"]]
    assert all(start <= end for start, end in edges)
    assert all(a[1] == b[0] for a, b in itertools.pairwise(edges))
    for bar in reported["bars"]:  # a reader finds in it what it counts
        assert bar["count"] <= sum(bar["from"] <= vote <= bar["to"] for vote in votes)
    assert edges[0][0] <= min(votes) and max(votes) <= edges[-1][1]
    low, middle, high = reported["quartiles"]
    assert min(votes) <= low <= middle <= high <= max(votes)


def test_an_outlier_does_not_squeeze_the_others_into_one_bar():
    reported = numbers([*np.linspace(1.0, 2.0, 99), 1e12])
    *others, last = reported["bars"]
    assert last["to"] == 1e12 and last["count"] <= 2 and others[-1]["to"] < 3
    assert min(bar["count"] for bar in others) > 5


def test_bars_have_round_limits():
    bars = numbers([53.0, 95.0])["bars"]
    assert [(bar["from"], bar["to"], bar["count"]) for bar in bars] == [
        (40, 60, 1),
        (60, 80, 0),
        (80, 100, 1),
    ]


def test_without_an_answer_there_are_no_bars():
    assert numbers([]) == {"answers": 0, "bars": [], "quartiles": []}


def test_an_unchanged_slide_is_no_change_and_an_earlier_one_is_shown_again():
    lecture = LectureState(lambda: 0.0)
    lecture.show(0, 7, "<p>a</p>")
    first = lecture.state("x")
    lecture.show(0, 7, "<p>a</p><script>x</script>")
    assert lecture.state("x") == first
    lecture.show(1, 7, "<p>b</p>")
    lecture.show(0, 7, "<p>a</p>")
    again = lecture.state("x")
    assert (again["shown"], again["slides"][0]) == (0, first["slides"][0])
    assert again["version"] > first["version"]


def test_number_and_size_of_slides_are_limited():
    lecture = LectureState(lambda: 0.0)
    for number in range(MAX_SLIDES):
        lecture.show(number, 7, str(number))
    with pytest.raises(ValueError, match="too many slides"):
        lecture.show(MAX_SLIDES, 7, "one more")
    lecture.show(0, 7, "another text")
    with pytest.raises(ValueError, match="too many slides"):
        lecture.show(1, 7, "x" * 70_000_000)


def test_the_end_deletes_slides_and_poll():
    lecture = LectureState(lambda: 0.0)
    lecture.show(0, 7, "<p>a</p>")
    lecture.ask("q", "?", ["a", "b"], "")
    lecture.poll.vote("x", 0)
    lecture.end()
    reported = lecture.state("x")
    ended = {"over": True, "slides": {}, "poll": None, "shown": None}
    assert {name: reported[name] for name in ended} == ended


def test_a_lecture_whose_page_is_silent_is_abandoned_and_one_with_contact_is_not():
    now = [0.0]
    lecture = LectureState(lambda: now[0], patience=600.0)
    for now[0] in (500.0, 1000.0, 1500.0):
        assert not lecture.abandoned
        lecture.keep_alive()
    now[0] = 2100.0
    assert not lecture.abandoned
    now[0] = 2101.0
    assert lecture.abandoned
