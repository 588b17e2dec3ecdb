"""A whole class: everyone is graded or listed, results are whole files, text stays text."""

import csv
import html.parser
import json
import os
import signal
import stat
import subprocess
import sys
import time
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from slamlab.cli import main
from slamlab.exercises.verdict import LawResult, Verdict
from slamlab.grading import feedback, grade_tables, judge, records, sandbox
from slamlab.grading.gradebook import Gradebook
from slamlab.grading.late_policy import LatePolicy
from slamlab.grading.marks import mark
from slamlab.grading.records import Record
from tests.grading import fake
from tests.grading.conftest import lacks, notebook, workers
from tests.patience import PATIENCE

HTML = "<script>alert(1)</script><img src=x onerror=y>"


def command(verb, *arguments):
    """The exit code of ``slamlab check`` or ``slamlab grade``, as bounded as can be had here."""
    level = ["--isolation", workers().level] if verb == "grade" else []
    return main([verb, *level, *(str(argument) for argument in arguments)])


def table(out):
    with open(out / "grades.csv", encoding="utf-8", newline="") as file:
        return {row["submission"]: row for row in csv.DictReader(file)}


def book(out):
    """What the gradebook says of each submission."""
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
    assert command("grade", class_folder, "--out", out, "--jobs", 2) == 0
    rows = table(out)
    scores = {name: (row["score"], row["max_score"]) for name, row in rows.items()}
    assert scores == {
        "full.ipynb": ("8", "8"),
        "as it was.ipynb": ("0", "8"),
        "missing/99_fake/99_fake.ipynb": ("2.5", "8"),
        "'=1+1.ipynb": ("5.5", "8"),
        "silent.ipynb": ("", ""),
        "empty.ipynb": ("", ""),
        "cut.ipynb": ("", ""),
        "none.ipynb": ("0", "8"),
        "nobody": ("", ""),
    }
    first = (out / "grades.csv").read_text("utf-8").splitlines()[0]
    assert first == (
        "submission,student,exercise,score,max_score,late,handed_in,note,99-double,99-turn,"
        "99-total,99-double: sign,99-double: twice,99-double: unchanged,99-turn: turned,"
        "99-turn: unchanged,99-total: sum,99-total: unchanged"
    )
    assert rows["full.ipynb"]["note"] == ""
    assert "99-double: not attempted yet" in rows["as it was.ipynb"]["note"]
    note = rows["missing/99_fake/99_fake.ipynb"]["note"]
    assert note.startswith("99-double: double is not defined; 99-total: needs 99-double")
    for name in ("silent.ipynb", "empty.ipynb", "cut.ipynb", "nobody"):
        assert rows[name]["note"].startswith("could not be graded: ")
    said = capsys.readouterr().out
    assert "5 graded, 4 could not be graded" in said
    assert len(book(out)) == len(list((out / "feedback").iterdir())) == 9
    assert {path.name for path in out.iterdir()} == {
        "grades.csv", "moodle.csv", "canvas.csv", "class.html", "grades.db", "feedback", "secret",
    }  # fmt: skip


def test_a_record_holds_what_defends_a_grade(class_folder, tmp_path):
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
    def graded(out, *more):
        command("grade", class_folder, "--out", out, *more)
        return [replace(record, seconds={}) for record in book(out).values()]

    first, again, elsewhere, other = (
        graded(tmp_path / "a"),
        graded(tmp_path / "a", "--regrade"),
        graded(tmp_path / "c", "--secret", tmp_path / "a" / "secret", "--jobs", 1),
        graded(tmp_path / "b"),
    )
    assert first == again == elsewhere
    assert [r.seed for r in first] != [r.seed for r in other]
    assert [r.score for r in first] == [r.score for r in other]
    if os.name == "posix":
        assert stat.S_IMODE((tmp_path / "a" / "secret").stat().st_mode) == 0o600


def test_a_file_name_that_returns_in_another_exercise_keeps_both_marks(tmp_path):
    folder, out = tmp_path / "class", tmp_path / "out"
    folder.mkdir()
    for text in ("{", notebook(fake.SOLUTION), notebook("x = 1", exercise="04")):
        (folder / "anna.ipynb").write_text(text)
        assert command("grade", folder, "--out", out) == 0
    words = "anna.ipynb", "99-turn", "1", "--reason", "later", "--out", out
    assert main(["grade", "adjust", *map(str, words)]) == 0
    with open(out / "grades.csv", encoding="utf-8", newline="") as file:
        rows = {row["exercise"]: row["score"] for row in csv.DictReader(file)}
    assert rows == {"99": "6.5", "04": "0"}
    pages = sorted(path.name.split("-")[-1] for path in (out / "feedback").iterdir())
    assert pages == ["04.html", "99.html"]


def test_what_could_not_be_read_stands_once_and_is_graded_when_it_is_mended(tmp_path):
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
    assert len(table(out)) == 9


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["nowhere", "--out", "out"], "nowhere is not there"),
        (["full", "--out", "out", "--exercise", "77"], "no exercise '77'; there are "),
        (["full", "--out", "out", "--secret", "none"], "the secret none cannot be read"),
        (["full", "--out", "out", "--secret", "short"], "shorter than 16 bytes"),
        (["full", "--out", "full"], "another folder than the submissions'"),
        (["full", "--out", "short"], "short cannot be made"),
        (["empty", "--out", "out"], "there is no notebook in empty"),
        (["full", "--out", "out", "--jobs", "0"], "--jobs must be at least 1"),
    ],
)
def test_wrong_use_is_told_in_one_line(arguments, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    (tmp_path / "empty").mkdir()
    (tmp_path / "short").write_text("abc")
    assert command("grade", *arguments) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1


def test_a_notebook_is_checked_from_the_command_line(class_folder, capsys):
    assert command("check", class_folder / "full.ipynb") == 0
    said = capsys.readouterr().out
    assert "✓ 99-turn · Turn a vector: 2.5 of 2.5 points" in said
    assert said.endswith("8 of 8 points\n")
    assert command("check", class_folder / "missing" / "99_fake" / "99_fake.ipynb") == 1
    assert "double is not defined" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["=1+1.ipynb", "as it was.ipynb", "none.ipynb"])
def test_checking_a_notebook_with_a_task_that_is_not_passed_ends_with_1(name, class_folder, capsys):
    assert command("check", class_folder / name) == 1
    said = capsys.readouterr()
    assert "of 8 points\n" in said.out
    assert not said.err


def test_an_exercise_may_be_named_without_its_zero(tmp_path, capsys):
    path = tmp_path / "anna.ipynb"
    path.write_text(notebook("h = None", exercise=None), encoding="utf-8")
    for id in ("4", "04"):
        assert command("check", path, "--exercise", id) == 1
        assert "✗ 04-" in capsys.readouterr().out
    assert command("check", path, "--exercise", "444") == 2
    assert "no exercise '444'" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["cut.ipynb", "empty.ipynb", "silent.ipynb", "nobody", "absent"])
def test_a_notebook_that_cannot_be_checked_is_told_in_one_line(name, class_folder, capsys):
    assert command("check", class_folder / name) == 2
    error = capsys.readouterr().err
    assert name in error
    assert error.count("\n") == 1


class Tags(html.parser.HTMLParser):
    """Collects the tags of a page."""

    def __init__(self, text):
        super().__init__()
        self.tags = set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        assert not [name for name, _ in attributes if name.startswith("on")]


OURS = {"html", "head", "meta", "title", "style", "body", "h1", "h2", "p", "div", "section", "span"}
OURS |= {"ul", "li", "strong", "code", "details", "summary", "pre"}


def test_feedback_says_what_held_what_broke_and_what_gains_the_rest():
    laws = (LawResult("a", "is <even>", 1, 1, 0, 20), LawResult("b", "grows", 0.0, 2, 7, 20))
    verdict = Verdict("99-turn", 1, 3, laws, "right", "turn the other way")
    graded = Record("x.ipynb", "x", "99", verdicts=(verdict,), titles={"99-turn": "T"})
    text = feedback.feedback_page(mark(graded))
    for expected in ("is &lt;even&gt;", "broken by some inputs", "turn the other way"):
        assert expected in text
    assert "To gain 2 points" in text
    assert "1 of 3 points" in text
    assert "right" not in Tags(text).tags


def test_feedback_says_what_was_set_by_hand_and_what_lateness_took():
    late = LatePolicy({"99": datetime(2026, 12, 1, tzinfo=UTC)}, per_day=0.25)
    verdict = Verdict("99-turn", 1, 3)
    graded = Record("x.ipynb", "x", "99", verdicts=(verdict,), titles={"99-turn": "T"})
    graded = replace(graded, handed_in="2026-12-01T12:00:00+00:00")
    text = feedback.feedback_page(mark(graded, {("x.ipynb", "99-turn"): (2.0, "right idea")}, late))
    assert "1.5 of 3 points" in text
    assert "0.5 points taken for lateness" in text
    assert "99-turn set by hand to 2 points: right idea" in text
    lost = feedback.feedback_page(mark(Record("x.ipynb", "x", "99", reason="empty")))
    assert "Could not be graded<" in lost


def test_whatever_stands_in_a_submission_is_text_in_its_feedback():
    problem = Verdict("99-turn", 0, 2, problem=HTML, kind="raised", hint=HTML)
    graded = Record(
        HTML,
        HTML,
        HTML,
        verdicts=(problem,),
        cells={3: HTML},
        notes=(HTML,),
        titles={"99-turn": HTML},
    )
    for record in (graded, Record(HTML, HTML, reason=HTML)):
        text = feedback.feedback_page(mark(record, {(HTML, HTML): (1.0, HTML)}))
        assert Tags(text).tags <= OURS
        assert "&lt;script&gt;" in text


@pytest.mark.parametrize("start", ["=", "+", "-", "@", "\t=", "\r@", "\n+", "a;=", "a; @"])
def test_no_cell_of_the_table_is_a_formula(start, tmp_path):
    name = f'{start}cmd|"/c calc"!A1'
    grade_tables.write_tables(tmp_path, [mark(Record(name, name, reason=name))])
    (row,) = table(tmp_path).values()
    for part in row["submission"].split(";"):
        assert part.lstrip()[0] not in "=+-@"
    assert row["note"].startswith("could not be graded")


def test_files_are_named_apart_whatever_submissions_are_called(tmp_path):
    names = ["a/b.ipynb", "a-b.ipynb", "a b.ipynb", "../../a.ipynb", "", "Я.ipynb", "x" * 400]
    stems = {Record(name, "x").stem for name in names}
    assert len(stems) == len(names)
    for stem in stems:
        records.write_atomically(tmp_path / f"{stem}.json", "half a character: \udce9")
    assert len(list(tmp_path.iterdir())) == len(names)


def grading_of_one_that_never_ends(tmp_path, level):
    """A running ``slamlab grade`` in which a worker hangs."""
    folder, temporary = tmp_path / "class", tmp_path / "temporary"
    folder.mkdir()
    temporary.mkdir()
    stays = "while True:\n    try:\n        while True: pass\n    except BaseException: pass"
    (folder / "hangs_04.ipynb").write_text(notebook(stays, exercise="04"), "utf-8")
    start = "import sys; from slamlab.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", start, "grade", folder, "--out", tmp_path / "out"]
    grading = subprocess.Popen(
        [*command, "--isolation", level],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        env=os.environ | {"TMPDIR": str(temporary)},
    )
    # the zygote and the worker; round them two of bubblewrap's own, after those of the probe
    expected = 2 if level == sandbox.NONE else 4
    assert comes_true(lambda: len(processes_of(temporary, "ex04")) >= expected)
    return grading, temporary


def processes_of(folder, word):
    """Numbers of the processes whose command line names a folder and a word (Linux)."""
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = path.read_bytes()
        except OSError:  # it has just ended
            continue
        if os.fsencode(folder) in words and word.encode() in words:
            found.append(path.parent.name)
    return found


def comes_true(claim, seconds=60):
    end = time.monotonic() + seconds
    while not claim():
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
@pytest.mark.parametrize("level", [sandbox.NONE, sandbox.STRICT])
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGKILL"])
def test_a_grader_that_is_ended_leaves_no_worker_running(tmp_path, name, level):
    if lacks(level):
        pytest.skip(lacks(level))
    grading, temporary = grading_of_one_that_never_ends(tmp_path, level)
    grading.send_signal(getattr(signal, name))
    _, said = grading.communicate(timeout=PATIENCE)
    assert b"Traceback" not in said
    assert grading.returncode == (-signal.SIGKILL if name == "SIGKILL" else 130)
    assert comes_true(lambda: not processes_of(temporary, ""))
