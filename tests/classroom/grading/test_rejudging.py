"""Attempts are rejudged from stored answers, with the same results as from a worker."""

import dataclasses
import json
import re

import numpy as np
import pytest

from classroom.exercises import catalogue
from classroom.exercises.correctness_laws import Law
from classroom.exercises.function_calls import StudentError
from classroom.grading import course_digests, judge, rejudge_report, rejudging
from classroom.grading.gradebook import Gradebook
from classroom.grading.ledger import contents, score_verification
from classroom.grading.records import Record
from classroom.grading.remarks import ANY
from classroom.grading.stored_answers import GRADED, OPEN, AnswerRecorder, NotStored, StoredAnswers
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, workers

SEED = b"a seed of 16 b.."
LAZY = fake.SOLUTION + "\ndef turn(v, angle):\n    return v[::-1]\n"
WRONG = fake.SOLUTION + "\ndef double(a):\n    return a * a\n"
FAILS = fake.SOLUTION + "\ndef turn(v, angle):\n    raise ValueError('x')\n"
CLASS = {"right": fake.SOLUTION, "lazy": LAZY, "wrong": WRONG, "fails": FAILS, "empty": "x = 1"}


@pytest.fixture(scope="module")
def attempts():
    """A record of each notebook, as it is graded."""
    with pytest.MonkeyPatch.context() as patch:
        know(patch, fake.EXERCISE)
        return {name: graded(cell, name) for name, cell in CLASS.items()}


def graded(cell, name="anna", by=None):
    cells = [(1, cell)]
    made = judge.judge_notebook(catalogue.EXERCISES["99"], cells, SEED, by or workers())
    return Record(f"{name}.ipynb", name, "99", seed=SEED.hex(), sha256=name, **made)


def know(monkeypatch, exercise):
    monkeypatch.setattr(catalogue, "EXERCISES", {"99": exercise})


def changed(task, **how):
    """The exercise with one task changed."""
    tasks = [dataclasses.replace(t, **how) if t.id == task else t for t in fake.EXERCISE.tasks]
    return dataclasses.replace(fake.EXERCISE, tasks=tuple(tasks))


def milder(points=2.0):
    """The exercise with a milder law of turning: the length of the vector stays."""

    def stays(inputs, outputs):
        lengths = (np.linalg.norm(a, axis=1) for a in (inputs["v"], outputs["result"]))
        return np.isclose(*lengths)

    law = Law("turned", points, "keeps the length", stays)
    return changed("99-turn", laws=(law,), diagnoses=())


class NoWorkers:
    """Workers that must not be started."""

    level = "none"

    def start(self, exercise):
        raise AssertionError("student code was run")


def again(record, by=None):
    return rejudging.rejudge(record, record.contents, by or NoWorkers())


def verdicts(record):
    return json.dumps([dataclasses.asdict(verdict) for verdict in record.verdicts])


def test_the_same_version_changes_nothing(attempts):
    for record in attempts.values():
        assert again(record).after is record


def test_a_changed_law_is_judged_from_stored_outputs_with_the_same_result(attempts, monkeypatch):
    know(monkeypatch, milder())
    gains = {}
    for name, cell in CLASS.items():
        one = again(attempts[name])
        assert (one.problem, one.ran) == (None, False)
        assert verdicts(one.after) == verdicts(graded(cell, name))
        gains[name] = one.after.score - one.before.score
    assert gains == {"right": 0, "lazy": 2.5, "wrong": 0, "fails": 0, "empty": 0}


def test_gains_and_losses_are_reported_with_the_reason(attempts, monkeypatch):
    know(monkeypatch, milder(points=1.5))
    found = rejudge_report.changes([again(r) for r in attempts.values()], {})
    assert [(by, row[1], row[5]) for by, row in found] == [
        (-0.5, "right", "99-turn 2.5 → 2: “turned” is worth 1.5 instead of 2 points"),
        (-0.5, "wrong", "99-turn 2.5 → 2: “turned” is worth 1.5 instead of 2 points"),
        (0.0, "empty", found[2][1][5]),
        (0.0, "fails", found[3][1][5]),
        (
            2.0,
            "lazy",
            "99-turn 0 → 2: “turned” now holds, “unchanged” earns 0.5 with the other laws",
        ),
    ]
    by_hand = {("lazy.ipynb", ANY, "99-turn"): (1.0, "x")}
    ((by, row),) = rejudge_report.changes([again(attempts["lazy"])], by_hand)
    assert by == 0
    assert row[5].endswith("99-turn is set by hand")


def test_other_inputs_are_answered_by_running_the_stored_cells(attempts, monkeypatch):
    know(monkeypatch, changed("99-turn", inputs=lambda rng: {
        "v": rng.uniform(1, 2, (9, 2)), "angle": rng.uniform(0.3, 1.2, 9)}))  # fmt: skip
    one = ran_again(attempts["lazy"])
    assert verdicts(one.after) == verdicts(graded(LAZY, "lazy"))
    assert set(one.after.contents) == {one.after.kept["outputs"]}
    known = one.before.contents | one.after.contents  # what was answered now is kept as well
    assert score_verification.verify(one.after, known).verified


def ran_again(record):
    """Rejudge an attempt for which the code must be run."""
    with pytest.raises(AssertionError, match="student code was run"):
        again(record)
    one = again(record, workers())
    assert one.ran
    return one


def test_a_task_that_can_be_judged_only_now_is_run(attempts, monkeypatch):
    assert attempts["wrong"].verdicts[2].replaced == ("double",)
    know(monkeypatch, changed("99-total", needs=()))
    one = ran_again(attempts["wrong"])
    assert verdicts(one.after) == verdicts(graded(WRONG, "wrong"))


def test_changed_modules_of_a_worker_count_as_changed_inputs(attempts, monkeypatch):
    know(monkeypatch, milder())
    monkeypatch.setattr(course_digests, "worker_digest", lambda exercise: "another")
    assert ran_again(attempts["lazy"]).after.score == attempts["lazy"].score + 2.5


def test_without_stored_contents_the_mark_stays_with_a_report(attempts, monkeypatch):
    know(monkeypatch, milder())
    bare = dataclasses.replace(attempts["lazy"], kept={}, contents={})
    one = again(bare)
    assert one.after is bare
    assert "grade it again from its file" in one.problem
    know(monkeypatch, fake.EXERCISE)
    catalogue.EXERCISES.clear()
    assert "exercise 99 no longer exists" in again(bare).problem


def test_stored_answers_are_bounded_and_the_smallest_come_first():
    rng, kept = np.random.default_rng(3), AnswerRecorder(fake.EXERCISE)
    tasks = fake.EXERCISE.tasks
    sets = [{"": {"a": rng.uniform(size=9)}} for _ in tasks]
    answers = [{"": {"result": rng.uniform(size=n)}} for n in (4000, 3000, 90_000)]
    for i, task in enumerate(tasks):
        kept.keep(task, GRADED, sets[i], answers[i])
    kept.keep(tasks[1], OPEN, sets[1], StudentError("time", "too long"))
    data = kept.packed()
    assert 0 < len(data) <= contents.MAX_BYTES
    found = StoredAnswers(data, fake.EXERCISE)
    back = found.answer(tasks[1], GRADED, sets[1])[""]["result"]
    assert (back == answers[1][""]["result"]).all()
    with pytest.raises(StudentError, match="too long"):
        found.answer(tasks[1], OPEN, sets[1])
    for i in (0, 2):
        with pytest.raises(NotStored):
            found.answer(tasks[i], GRADED, sets[i])
    with pytest.raises(NotStored, match="have changed"):
        found.answer(tasks[1], GRADED, sets[0])
    for broken in (data[:-1], data[: len(data) // 2] + b"x" + data[len(data) // 2 + 1 :]):
        with pytest.raises(contents.ContentError):
            StoredAnswers(broken, fake.EXERCISE)


def test_each_real_exercise_has_its_own_and_constant_digest():
    exercise = catalogue.exercise("04")
    digests = [course_digests.task_digest(task) for task in exercise.tasks]
    assert len(set(digests)) == len(digests)
    assert digests == [course_digests.task_digest(task) for task in exercise.tasks]
    assert len({course_digests.worker_digest(catalogue.exercise(id)) for id in ("04", "06")}) == 2


def test_a_score_is_verified_and_an_altered_score_is_detected(attempts, monkeypatch):
    def found(record, contents=None, *secret):
        return score_verification.verify(record, contents or record.contents, *secret)

    assert all(found(record).verified for record in attempts.values())
    record = attempts["lazy"]
    first, second, third = record.verdicts
    second = dataclasses.replace(second, points=2.5)
    forged = dataclasses.replace(record, verdicts=(first, second, third))
    assert "99-turn has 2.5 points; the judge gives 0" in found(forged).wrong
    other = dataclasses.replace(record, seed=(b"another of 16 b.").hex())
    assert not found(other).verified
    assert "does not match" in found(record, None, b"s" * 16).wrong
    right = attempts["right"]
    swapped = {record.kept["outputs"]: right.contents[right.kept["outputs"]]}
    assert "are missing or altered" in found(record, record.contents | swapped).wrong
    know(monkeypatch, milder())
    lacking = found(record).lacks
    assert "slamlab " in lacking and lacking.endswith("(99-turn)")


def test_a_score_without_outputs_is_verified_by_running_its_cells(attempts):
    record = attempts["lazy"]
    cells = {name: hash for name, hash in record.kept.items() if name == "cells"}
    bare = dataclasses.replace(record, kept=cells)
    assert "--run" in score_verification.verify(bare, record.contents).unverified
    assert score_verification.verify(bare, record.contents, start=workers().start).verified


def test_rejudging_writes_only_when_it_is_accepted(tmp_path, monkeypatch, capsys):
    folder, out = tmp_path / "class", tmp_path / "out"
    folder.mkdir()
    for name in ("lazy", "right"):
        (folder / f"{name}.ipynb").write_text(notebook(CLASS[name]))
    words = ["--out", str(out), "--isolation", workers().level]
    assert main(["grade", str(folder), *words]) == 0
    (folder / "right.ipynb").write_text(notebook(CLASS["right"], "newer = 1"))
    assert main(["grade", str(folder), *words]) == 0

    def state():
        with Gradebook(f"sqlite:///{out / 'grades.db'}") as book:
            newest = {r.submission: (r.sha256, r.score) for r in book.latest_attempts()}
            return newest, len(book.rows()), list(book.attempts())

    before = state()
    know(monkeypatch, milder(1.0))
    assert main(["grade", "rejudge", *words]) == 0
    output = capsys.readouterr().out
    assert "99 lazy (lazy.ipynb): 5.5 → 7: 99-turn 0 → 1.5: “turned” now holds" in output
    assert "3 attempts judged again, 0 of them by running the code: 1 gain points, 2 " in output
    assert "Nothing was written" in output
    assert state() == before
    assert main(["grade", "verify", *words]) == 0
    assert re.search(r"needs the version: .*\blazy\.ipynb \(99\).*: ", capsys.readouterr().out)
    assert main(["grade", "rejudge", "--accept", *words, "--as", "Prof. X"]) == 0
    after = state()
    assert after[1] == before[1] + 3
    assert after[2] == before[2]  # attempts keep their order: no older one becomes the newest
    assert after[0] == {
        "lazy.ipynb": (before[0]["lazy.ipynb"][0], 7.0),
        "right.ipynb": (before[0]["right.ipynb"][0], 7.0),
    }
    assert "lazy.ipynb,lazy,99,7,7" in (out / "grades.csv").read_text("utf-8")
    capsys.readouterr()
    assert main(["grade", "verify", *words]) == 0
    assert "3 of 3 scores verified" in capsys.readouterr().out
    assert main(["grade", "rejudge", *words]) == 0
    assert "0 gain points, 0 lose points" in capsys.readouterr().out
    assert main(["grade", "forget", "lazy", "--out", str(out)]) == 0
    assert "lazy" not in (out / "grades.csv").read_text("utf-8")
    assert not list((out / "feedback").glob("lazy*"))
    assert b"lazy" not in (out / "grades.db").read_bytes()
    assert main(["grade", "verify", *words]) == 0
