"""The open board shows only significant gains, and only scores, until the contest closes."""

import json

import numpy as np
import pytest

from classroom.contest.open_leaderboard import STEP, is_significant_gain, update_shown_scores
from classroom.contest.ranking import scores

SHAPE = 7, 5


def version(rng, worlds, better=0.0, own=5.0):
    """Points of a version: the worlds' own, alike for all, what it is better, and luck."""
    return worlds + better + own * rng.standard_normal(worlds.shape)


def hard(rng):
    return 60 + 15 * rng.standard_normal(SHAPE)


def test_a_significant_gain_is_shown_though_worlds_differ_much():
    rng = np.random.default_rng(1)
    worlds = hard(rng)
    assert is_significant_gain(worlds, worlds + STEP)
    assert is_significant_gain(version(rng, worlds), version(rng, worlds, better=15))


def test_an_insignificant_gain_is_not_shown():
    worlds = hard(np.random.default_rng(2))
    lucky = worlds.copy()
    lucky[0, :2] += 60
    for found in (worlds, worlds + 0.9 * STEP, worlds - 5, lucky):
        assert not is_significant_gain(worlds, found)


def test_fifty_equally_good_versions_gain_next_to_nothing(tmp_path):
    """Over forty students; who saw all scores would gain by the best of them."""
    shown, best = [], []
    for student in range(40):
        rng = np.random.default_rng([3, student])
        worlds = hard(rng)
        tries = [version(rng, worlds) for _ in range(50)]
        now = tries[0]
        for found in tries[1:]:
            now = found if is_significant_gain(now, found) else now
        shown.append(scores(now) - scores(tries[0]))
        best.append(max(map(scores, tries)) - scores(tries[0]))
    assert np.mean(shown) < 0.5 * np.mean(best)
    assert np.median(shown) < 1.5


def test_the_old_score_stays_and_only_whole_points_are_reported(tmp_path):
    file, worlds = tmp_path / "ladder.json", np.full(SHAPE, 50.2)
    assert update_shown_scores(file, {"ada": worlds, "bob": worlds - 20}) == {"ada": 50, "bob": 30}
    assert update_shown_scores(file, {"ada": worlds + 1, "bob": worlds - 40}) == {
        "ada": 50,
        "bob": 30,
    }
    assert update_shown_scores(file, {"ada": worlds + 9}) == {"ada": 59, "bob": 30}
    assert np.shape(json.loads(file.read_text())["ada"]) == SHAPE


@pytest.mark.parametrize("points", [np.zeros(SHAPE), np.full(SHAPE, 100.0)])
def test_the_first_version_is_always_shown(tmp_path, points):
    assert update_shown_scores(tmp_path / "ladder.json", {"ada": points}) == {"ada": points[0, 0]}
