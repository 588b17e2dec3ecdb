"""The hash fixes a contest: it cannot be changed afterwards, and reveals nothing before."""

import hashlib
import json

import pytest

from classroom.contest import seed_commitment
from classroom.contest.seed_commitment import COMMITMENT, SECRET, ContestError, commit, read_contest
from classroom.project.estimator_runs import Budget


def test_the_commitment_is_the_hash_of_what_will_be_revealed_and_holds_no_seed(tmp_path):
    contest = commit(tmp_path)
    secret, reported = (tmp_path / name for name in (SECRET, COMMITMENT))
    assert reported.read_text().split()[0] == hashlib.sha256(secret.read_bytes()).hexdigest()
    assert contest.seed in secret.read_text()
    assert contest.seed not in reported.read_text()
    assert len(contest.seed) == 256 // 4
    assert secret.stat().st_mode & 0o077 == 0
    budget = Budget(**contest.budget)
    assert (budget.total, budget.reading) == (Budget.total, Budget.reading)


def test_a_contest_stays_what_it_is_and_each_has_its_own_seed(tmp_path):
    assert commit(tmp_path / "one") == commit(tmp_path / "one")
    assert commit(tmp_path / "one").seed != commit(tmp_path / "two").seed


@pytest.mark.parametrize("name", ["seed", "worlds", "families", "budget"])
def test_a_contest_that_was_changed_afterwards_is_refused(tmp_path, name):
    commit(tmp_path)
    content = json.loads((tmp_path / SECRET).read_text())
    others = {"seed": "0" * 64, "worlds": 4, "families": ["plain"], "budget": {"total": 99.0}}
    (tmp_path / SECRET).write_text(json.dumps(content | {name: others[name]}))
    with pytest.raises(ContestError, match="the hash of"):
        commit(tmp_path)


def test_another_version_of_the_course_is_refused(tmp_path, monkeypatch):
    commit(tmp_path)
    monkeypatch.setattr(seed_commitment, "code_digest", lambda: "f" * 64)
    with pytest.raises(ContestError, match="use the same version"):
        commit(tmp_path)


@pytest.mark.parametrize("content", ["", "{}", "[]", '{"seed": "not hexadecimal"}'])
def test_a_folder_that_is_not_a_contest_is_refused(tmp_path, content):
    (tmp_path / SECRET).write_text(content)
    with pytest.raises(ContestError, match="is not a contest file"):
        read_contest(tmp_path / SECRET)


def test_what_draws_and_what_scores_is_part_of_the_code_that_is_hashed():
    decides = set(seed_commitment.closure(seed_commitment.DECIDES))
    names = "world_generation furniture_placement point_scale estimate_errors estimator_runs"
    assert decides >= {f"classroom.project.{name}" for name in names.split()}
    assert "classroom.exercises.function_calls.student_estimator" in decides
    assert decides >= {"slamlab.estimators.graph_slam", "slamlab.simulation.range_scanners"}
