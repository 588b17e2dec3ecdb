"""Batch grading: every submission of a class is graded or listed, and results are complete."""

import json
import os
import stat
from dataclasses import replace

import pytest

from classroom.cli import grade
from classroom.exercises.task import UNCHANGED
from classroom.grading import judge
from classroom.grading.gradebook import Gradebook
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import HTML, notebook, table, workers


def command(verb, *arguments):
    """The exit code of ``slamlab check`` or ``slamlab grade``, as bounded as can be had here."""
    level = ["--isolation", workers().level] if verb == "grade" else []
    return main([verb, *level, *(str(argument) for argument in arguments)])


def graded(out):
    return {row["submission"]: row for row in table(out / "grades.csv")}


def book(out):
    """Return the gradebook's row of each submission."""
    with Gradebook(f"sqlite:///{out / 'grades.db'}") as opened:
        return {record.submission: record for record in opened.latest_attempts()}


@pytest.fixture(scope="module")
def class_folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("class")
    silent = notebook(fake.SOLUTION, exercise=None)
    texts = {
        "full.ipynb": notebook(fake.SOLUTION),
        "as it was.ipynb": notebook("def double(a):\n    raise NotImplementedError('here')"),
        "missing/99_fake/99_fake.ipynb": notebook(fake.SOLUTION, "del double", exercise=None),
        "=1+1.ipynb": notebook(
            fake.SOLUTION + f"\ndef turn(v, a):\n    raise ValueError('{HTML}')"
        ),
        "silent.ipynb": silent,
        "empty.ipynb": "",
        "cut.ipynb": silent[:200],
        "none.ipynb": json.dumps({"cells": [], "metadata": {"slamlab": {"exercise": "99"}}}),
        "nobody/readme.txt": "later",
    }
    for name, text in texts.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def test_a_class_is_graded_and_everyone_is_listed(class_folder, tmp_path, capsys):
    out = tmp_path / "results"
    assert command("grade", class_folder, "--out", out, "--jobs", 2) == 1
    rows = graded(out)
    scores = {name: (row["score"], row["max_score"]) for name, row in rows.items()}
    ungraded = ("silent.ipynb", "empty.ipynb", "cut.ipynb", "nobody/readme.txt")
    assert scores == dict.fromkeys(ungraded, ("", "")) | {
        "full.ipynb": ("8", "8"),
        "as it was.ipynb": ("0", "8"),
        "missing/99_fake/99_fake.ipynb": ("4.5", "8"),
        "'=1+1.ipynb": ("5.5", "8"),
        "none.ipynb": ("0", "8"),
    }
    first = (out / "grades.csv").read_text("utf-8").splitlines()[0]
    assert first == (
        "submission,student,exercise,score,max_score,late_penalty,submitted,note,99-double,99-turn,"
        "99-total,99-double: keeps the sign,99-double: is twice as large,"
        f"99-double: {UNCHANGED.says},99-turn: turns left,99-turn: {UNCHANGED.says},"
        f"99-total: doubles the sum,99-total: {UNCHANGED.says}"
    )
    assert rows["full.ipynb"]["note"] == ""
    assert "Double a number: not attempted yet" in rows["as it was.ipynb"]["note"]
    note = rows["missing/99_fake/99_fake.ipynb"]["note"]
    assert note.startswith(
        "Double a number: double is not defined; Double a sum: tried with a correct double()"
    )
    for name in ungraded:
        assert rows[name]["note"].startswith("could not be graded: ")
    output = capsys.readouterr().out
    assert "5 graded, 4 could not be graded" in output
    assert len(book(out)) == len(list((out / "feedback").iterdir())) == 9
    assert {path.name for path in out.iterdir()} == {
        "grades.csv", "moodle.csv", "canvas.csv", "class.html", "grades.db", "feedback", "secret",
    }  # fmt: skip


def test_a_record_contains_what_justifies_a_grade(class_folder, tmp_path):
    out = tmp_path / "results"
    secret = tmp_path / "kept"
    secret.write_bytes(b"0123456789abcdef")
    command("grade", class_folder, "--out", out, "--secret", secret, "--exercise", "99")
    found = book(out)
    full, silent = found["full.ipynb"], found["silent.ipynb"]
    assert (full.graded, full.score, full.exercise, full.student) == (True, 8, "99", "full")
    assert len(full.sha256) == 64
    assert full.seed == judge.seed_for(b"0123456789abcdef", "99", full.sha256).hex()
    assert set(full.versions) == {"slamlab", "python", "numpy", "sympy"}
    assert full.isolation == workers().level
    assert [verdict.task for verdict in full.verdicts] == ["99-double", "99-turn", "99-total"]
    assert [law.points for law in full.verdicts[0].laws] == [1, 2, 0.5]
    assert set(full.seconds) == {"wall", "judge_cpu", "worker_cpu"}
    assert silent.graded
    assert not found["cut.ipynb"].graded
    assert found["cut.ipynb"].score is None
    assert not (out / "secret").exists()


@pytest.mark.slow
def test_grading_again_gives_the_same_and_a_new_secret_other_inputs(class_folder, tmp_path):
    def again(out, *more):
        command("grade", class_folder, "--out", out, *more)
        return [replace(record, seconds={}) for record in book(out).values()]

    first, second = again(tmp_path / "a"), again(tmp_path / "a", "--regrade")
    secret = tmp_path / "a" / "secret"
    elsewhere = again(tmp_path / "c", "--secret", secret, "--jobs", 1)
    other = again(tmp_path / "b")
    assert first == second == elsewhere
    assert [r.seed for r in first] != [r.seed for r in other]
    assert [r.score for r in first] == [r.score for r in other]
    if os.name == "posix":
        assert stat.S_IMODE((tmp_path / "a" / "secret").stat().st_mode) == 0o600


def test_a_file_name_used_in_two_exercises_keeps_both_marks(tmp_path):
    folder, out = tmp_path / "class", tmp_path / "out"
    folder.mkdir()
    texts = "{", notebook(fake.SOLUTION), notebook("x = 1", exercise="04")
    for text, code in zip(texts, (1, 0, 0), strict=True):
        (folder / "anna.ipynb").write_text(text)
        assert command("grade", folder, "--out", out) == code
    words = "anna.ipynb", "99-turn", "1", "--reason", "later", "--out", out
    assert main(["grade", "adjust", *map(str, words)]) == 0
    rows = {row["exercise"]: row["score"] for row in table(out / "grades.csv")}
    assert rows == {"99": "6.5", "04": "0"}
    pages = sorted(path.name.split("-")[-1] for path in (out / "feedback").iterdir())
    assert pages == ["04.html", "99.html"]


def test_an_unreadable_notebook_is_listed_once_and_graded_when_it_is_repaired(tmp_path):
    folder, out = tmp_path / "class", tmp_path / "out"
    folder.mkdir()
    (folder / "anna.ipynb").write_text(notebook(fake.SOLUTION)[:99])
    for _ in range(2):
        command("grade", folder, "--out", out)
        assert not book(out)["anna.ipynb"].graded
    (folder / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    command("grade", folder, "--out", out)
    assert book(out)["anna.ipynb"].score == 8
    with Gradebook(f"sqlite:///{out / 'grades.db'}") as opened:
        assert len(opened.attempts()) == 2


def test_results_within_the_folder_are_not_graded(class_folder, tmp_path):
    out = class_folder / "out"
    command("grade", class_folder, "--out", out)
    (out / "x.ipynb").write_text(notebook(fake.SOLUTION))
    command("grade", class_folder, "--out", out)
    assert len(graded(out)) == 9


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere", "--out", "out"], "nowhere does not exist"),
        (["full", "--out", "out", "--exercise", "77"], "no exercise '77': the exercises are "),
        (["full", "--out", "out", "--secret", "none"], "the secret none cannot be read"),
        (["full", "--out", "out", "--secret", "short"], "shorter than 16 bytes"),
        (["full", "--out", "full"], "must not be the submissions folder"),
        (["full", "--out", "short"], "the folder short cannot be created"),
        (["empty", "--out", "out"], "empty contains no notebook"),
        (["full", "--out", "out", "--jobs", "0"], "--jobs must be at least 1"),
    ],
)
def test_wrong_use_is_reported_in_one_line(arguments, message, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    (tmp_path / "empty").mkdir()
    (tmp_path / "short").write_text("abc")
    assert command("grade", *arguments) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_an_interrupted_run_states_how_to_continue(monkeypatch, capsys):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(grade, "_grade", interrupted)
    assert command("grade", "submissions", "--out", "graded") == 130
    assert "stopped. Run the same command again to continue" in capsys.readouterr().err


def test_a_notebook_is_checked_from_the_command_line(class_folder, capsys):
    assert command("check", class_folder / "full.ipynb") == 0
    output = capsys.readouterr().out
    assert "✓ 99-turn · Turn a vector: 2.5 of 2.5 points" in output
    assert output.endswith("8 of 8 points\n")
    assert command("check", class_folder / "missing" / "99_fake" / "99_fake.ipynb") == 1
    assert "double is not defined" in capsys.readouterr().out
    assert command("check", class_folder / "none.ipynb") == 1
    output = capsys.readouterr()
    assert "of 8 points\n" in output.out and not output.err


def test_an_exercise_may_be_named_without_its_zero(tmp_path, capsys):
    path = tmp_path / "anna.ipynb"
    path.write_text(notebook("h = None", exercise=None), encoding="utf-8")
    for id in ("4", "04"):
        assert command("check", path, "--exercise", id) == 1
        assert "✗ 04-" in capsys.readouterr().out
    assert command("check", path, "--exercise", "444") == 2
    assert "no exercise '444'" in capsys.readouterr().err


def test_a_notebook_that_cannot_be_checked_is_reported_in_one_line(class_folder, capsys):
    for name in ("cut.ipynb", "empty.ipynb", "silent.ipynb", "nobody", "absent"):
        assert command("check", class_folder / name) == 2
        error = capsys.readouterr().err
        assert name in error
        assert error.count("\n") == 1
