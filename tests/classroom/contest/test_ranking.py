"""Ranks: significantly better is ahead, all others are tied, order and labels do not matter."""

import numpy as np
import pytest

from classroom.contest.ranking import scores, standings
from classroom.contest.student_pseudonyms import draw_pseudonyms


def ranked(points):
    return standings(points, np.random.default_rng(0))


def hard_worlds(rng, shape=(7, 5)):
    """How hard each world is, for all alike [points]."""
    return 60 + 15 * rng.standard_normal(shape)


def test_the_score_is_the_mean_of_the_families_medians():
    points = np.array([[1.0, 2, 90], [10, 20, 30]])
    assert scores(points) == (2 + 20) / 2
    (standing,) = ranked(points[None])
    assert standing.score == 11
    np.testing.assert_array_equal(standing.families, [2, 20])


def test_the_better_one_in_every_world_is_ahead_though_worlds_differ_much():
    worlds = hard_worlds(np.random.default_rng(1))
    found = ranked([worlds, worlds + 2, worlds - 2])
    assert [s.rank for s in found] == [2, 1, 3]
    # unpaired intervals would not distinguish them: worlds are paired
    assert found[1].low < found[2].high


def test_a_lead_from_one_world_is_a_tie_and_equal_students_share_their_rank():
    worlds = hard_worlds(np.random.default_rng(2))
    lucky = worlds.copy()
    lucky[0, 0] += 30
    assert [s.rank for s in ranked([worlds, lucky])] == [1, 1]
    assert [s.rank for s in ranked([worlds, worlds + 5, worlds])] == [2, 1, 2]


def test_chance_alone_rarely_puts_a_student_ahead():
    rng, ahead = np.random.default_rng(4), 0
    for _ in range(60):
        worlds = hard_worlds(rng)
        both = worlds + 4 * rng.standard_normal((2, *worlds.shape))
        ahead += max(s.rank for s in ranked(both)) > 1
    assert ahead <= 6  # of 60: it is meant for one in twenty


@pytest.mark.parametrize("seed", range(5))
def test_the_interval_holds_the_score_and_the_order_of_students_does_not_matter(seed):
    rng = np.random.default_rng(seed)
    points = rng.uniform(0, 100, (6, 7, 5))
    order = rng.permutation(6)
    found, other = ranked(points), ranked(points[order])
    for place, i in enumerate(order):
        assert found[i].low <= found[i].score <= found[i].high
        assert (found[i].rank, found[i].score) == (other[place].rank, other[place].score)
    assert min(s.rank for s in found) == 1
    assert ranked(points[:0]) == []


def test_pseudonyms_are_unique_and_stay():
    students = [f"student {i}" for i in range(1100)]
    rng = np.random.default_rng(0)
    first = draw_pseudonyms(students[:40], {}, lambda free: free[rng.integers(len(free))])
    both = draw_pseudonyms(students, first, lambda free: free[rng.integers(len(free))])
    assert both.items() >= first.items()
    assert len(set(both.values())) == len(students)
    assert not any(name in both[name] for name in students)
