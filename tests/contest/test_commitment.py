"""A contest is fixed by its hash: nothing can be changed afterwards, nothing is told before."""

import hashlib
import json

import pytest

from slamlab.contest import commitment
from slamlab.contest.commitment import COMMITMENT, SECRET, ContestError, commit, read_contest
from slamlab.project.driving import Budget


def test_the_commitment_is_the_hash_of_what_will_be_revealed_and_holds_no_seed(tmp_path):
    contest = commit(tmp_path)
    secret, told = (tmp_path / name for name in (SECRET, COMMITMENT))
    assert told.read_text().split()[0] == hashlib.sha256(secret.read_bytes()).hexdigest()
    assert contest.seed in secret.read_text()
    assert contest.seed not in told.read_text()
    assert len(contest.seed) == 256 // 4
    assert secret.stat().st_mode & 0o077 == 0


def test_a_contest_stays_what_it_is_and_each_has_its_own_seed(tmp_path):
    assert commit(tmp_path / "one") == commit(tmp_path / "one")
    assert commit(tmp_path / "one").seed != commit(tmp_path / "two").seed


def test_the_limits_are_committed_too(tmp_path):
    budget = Budget(**commit(tmp_path).budget)
    assert (budget.total, budget.reading) == (Budget.total, Budget.reading)


@pytest.mark.parametrize("name", ["seed", "worlds", "families", "budget"])
def test_what_was_changed_afterwards_is_refused(tmp_path, name):
    commit(tmp_path)
    content = json.loads((tmp_path / SECRET).read_text())
    others = {"seed": "0" * 64, "worlds": 4, "families": ["plain"], "budget": {"total": 99.0}}
    (tmp_path / SECRET).write_text(json.dumps(content | {name: others[name]}))
    with pytest.raises(ContestError, match="is not what"):
        commit(tmp_path)


def test_another_version_of_the_course_is_refused(tmp_path, monkeypatch):
    commit(tmp_path)
    monkeypatch.setattr(commitment, "code_digest", lambda: "f" * 64)
    with pytest.raises(ContestError, match="judge with the same"):
        commit(tmp_path)


@pytest.mark.parametrize("content", ["", "{}", "[]", '{"seed": "not hexadecimal"}'])
def test_what_is_no_contest_is_refused(tmp_path, content):
    (tmp_path / SECRET).write_text(content)
    with pytest.raises(ContestError, match="is no contest"):
        read_contest(tmp_path / SECRET)


def test_what_draws_and_what_scores_is_part_of_the_code_that_is_hashed():
    decides = set(commitment.closure(commitment.DECIDES))
    names = ("drawing", "furniture", "points", "drive_errors", "driving")
    assert decides >= {f"slamlab.project.{name}" for name in names}
    assert "slamlab.exercises.drives.student_estimator" in decides
    assert decides >= {"slamlab.estimators.graph_slam", "slamlab.simulation.range_scanners"}
