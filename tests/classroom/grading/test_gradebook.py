"""The gradebook loses and duplicates nothing, with every database."""

import os
import random
import shutil
import signal
import subprocess
import time
from dataclasses import replace

import pytest

from classroom.exercises.verdict import LawResult, Verdict
from classroom.grading import gradebook_rows
from classroom.grading.gradebook import Gradebook, GradebookError
from classroom.grading.ledger import chain_verification
from classroom.grading.records import Record
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import forget, notebook, slamlab
from tests.timeouts import until

LAW = LawResult("twice", "is twice as large", 0.0, 2.0, 3, 20)
VERDICT = Verdict("99-double", 1.0, 3.0, (LAW,), "square", "you squared")
ODD = "Zoë \0 \udce9 'quoted' \"twice\"\n=1+1"


def record(name="anna.ipynb", sha="a" * 64, student="anna", **more):
    made = {"exercise": "99", "verdicts": (VERDICT,), "sha256": sha, "seed": "b" * 64}
    made |= {"cells": {3: "ValueError: x"}, "notes": ("odd",), "titles": {"99-double": "Double"}}
    return Record(name, student, **(made | more))


def test_stored_records_are_read_back_unchanged_and_the_same_content_is_stored_once(book):
    ungraded = Record("b.ipynb", "b", reason="not a notebook")
    assert [book.add(each) for each in (record(), ungraded, record(), ungraded)] == [
        True, True, False, False,
    ]  # fmt: skip
    assert book.latest_attempts() == [record(), ungraded]
    assert list(book.attempts().values()) == [record(), ungraded]


def test_an_older_version_submitted_again_counts_and_is_stored_once(book):
    first, second = record(handed_in="2026-12-01T10:00:00+00:00"), record(sha="c" * 64)
    again = replace(first, handed_in="2026-12-03T10:00:00+00:00")
    assert [book.add(each) for each in (first, second)] == [True, True]
    assert book.latest_attempts() == [second]
    assert [book.add(each) for each in (again, again)] == [False, False]
    assert book.latest_attempts() == [again]
    assert len(book.attempts()) == 2


def test_the_same_name_in_two_exercises_counts_in_both(book):
    first, other = record(), replace(record(sha="c" * 64), exercise="04")
    ungraded = Record(first.submission, first.student, sha256="d" * 64, reason="not a notebook")
    corrected = record(sha="e" * 64)
    for made, counted in (
        (first, [first]),
        (other, [first, other]),
        (ungraded, [first, ungraded]),  # its exercise is unknown: that of the last attempt counts
        (corrected, [other, corrected]),
    ):
        book.add(made)
        assert book.latest_attempts() == counted


def test_names_may_contain_any_characters(book):
    book.add(record(ODD, cells={5: ODD, 12: ODD}))
    (found,) = book.latest_attempts()
    assert list(found.cells) == [5, 12]  # in the order of the notebook
    assert found.submission.startswith("Zoë \\x00 \\udce9")
    book.override_points(record(ODD), "99-double", 2, ODD)
    assert (found.submission, found.sha256, "99-double") in book.overrides()


def test_overrides_stay_after_a_regrade(book):
    book.add(record())
    book.override_points(record(), "99-double", 2, "half right")
    book.override_points(record(), "99-double", 2.5, "more than half")
    again = replace(record(), seconds={"wall": 1.0})
    assert book.add_all([again]) == 0
    assert book.latest_attempts() == [again]
    assert book.overrides()["anna.ipynb", record().sha256, "99-double"] == (2.5, "more than half")


def test_the_newest_attempt_of_merged_books_counts_whichever_comes_first(tmp_path, monkeypatch):
    older, newer = record(), record(sha="c" * 64)
    books = [Gradebook(f"sqlite:///{tmp_path / name}.db") for name in ("a", "b", "all")]
    for each, made, at in zip(books, (older, newer), ("2026-12-01", "2026-12-02"), strict=False):
        monkeypatch.setattr(gradebook_rows, "timestamp", lambda at=at: at)
        each.add(made)
    for each in (books[1], books[0]):
        books[2].merge(each)
    assert books[2].latest_attempts() == [newer]


@pytest.mark.parametrize("url", ["nonsense", "sqlite:////nowhere/at/all.db", "oracle://x"])
def test_a_database_that_cannot_be_opened_is_reported_in_one_line(url):
    with pytest.raises(GradebookError, match="the gradebook cannot be opened") as raised:
        Gradebook(url)
    assert "\n" not in str(raised.value)


def class_of(folder, count):
    """A folder of submissions, and their names."""
    folder.mkdir()
    names = [f"s{i:03}_04.ipynb" for i in range(count)]
    for i, name in enumerate(names):
        (folder / name).write_text(notebook(f"x = {i}", fake.SOLUTION, exercise="04"))
    return names


def grading_of(folder, *words):
    """A running ``slamlab grade``, in a folder that holds a class."""
    (folder / "temporary").mkdir(exist_ok=True)  # a killed process does not clean up
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
    pipes["env"] = os.environ | {"TMPDIR": str(folder / "temporary")}
    level = "--isolation", "none"
    return slamlab("grade", folder / "class", "--out", folder / "out", *level, *words, **pipes)


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_a_regrade_killed_at_any_time_changes_no_mark_and_no_row(tmp_path):
    class_of(tmp_path / "class", 12)

    def done(*words):
        grading = grading_of(tmp_path, *words)
        grading.communicate()
        return grading.returncode

    assert done() == 0
    url, rng = f"sqlite:///{tmp_path / 'out' / 'grades.db'}", random.Random(5)

    def state():
        with Gradebook(url) as opened:
            rows = opened.rows()
            assert chain_verification.find_alterations(rows) == []
            return len(rows), opened.attempts()

    before = state()
    table = (tmp_path / "out" / "grades.csv").read_bytes()
    for _ in range(3):
        regrading = grading_of(tmp_path, "--regrade")
        until(lambda: list((tmp_path / "temporary").glob("slamlab-*/*")))
        time.sleep(rng.uniform(0, 1))
        regrading.send_signal(signal.SIGKILL)
        regrading.communicate()
        assert state() == before
        assert (tmp_path / "out" / "grades.csv").read_bytes() == table
        shutil.rmtree(tmp_path / "temporary")
    assert done("--regrade") == 0
    after = state()
    # a record that is the same to its measured times is not stored again
    assert before[0] <= after[0] <= before[0] + 12
    assert set(after[1]) == set(before[1])
    scores = [{key: one.score for key, one in found.items()} for _, found in (before, after)]
    assert scores[0] == scores[1]


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_a_database_stopped_during_a_run_is_awaited_without_loss(tmp_path, server):
    url, does = server
    forget(url)
    names = class_of(tmp_path / "class", 100)  # not done while it is being stopped
    grading = grading_of(tmp_path, "--db", url, "--jobs", "1")
    until(lambda: len(list((tmp_path / "out").glob("feedback/*"))) > 1)
    does("stop")
    try:
        output = grading.stderr.readline()
        while output and b"does not answer" not in output:
            output = grading.stderr.readline()
    finally:
        does("start")
    assert b"the gradebook does not answer; waiting up to 60 s" in output
    assert b"Traceback" not in grading.communicate()[1]
    assert grading.returncode == 0
    with Gradebook(url) as opened:
        assert [r.submission for r in opened.latest_attempts()] == names
        assert len(opened.attempts()) == len(names)
        assert chain_verification.find_alterations(opened.rows()) == []


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize(
    "kills", [1, pytest.param(4, marks=pytest.mark.slow), pytest.param(20, marks=pytest.mark.soak)]
)
def test_a_grader_killed_at_any_time_loses_and_duplicates_nothing(tmp_path, kills):
    out, names = tmp_path / "out", class_of(tmp_path / "class", 6 * kills)
    rng, graded = random.Random(9), lambda: len(list(out.glob("feedback/*")))
    for _ in range(kills):
        before = graded()
        grading = grading_of(tmp_path)
        until(lambda: graded() > before or grading.poll() is not None)  # noqa: B023
        time.sleep(rng.uniform(0, 0.2))
        grading.send_signal(signal.SIGKILL)
        grading.communicate()
    last = grading_of(tmp_path)
    last.communicate()
    assert last.returncode == 0
    with Gradebook(f"sqlite:///{out / 'grades.db'}") as opened:
        assert [r.submission for r in opened.latest_attempts()] == names
        assert len(opened.attempts()) == len(names)
    assert len((out / "grades.csv").read_text().splitlines()) == len(names) + 1
    assert len(list((out / "feedback").iterdir())) == len(names)


def test_unknown_fields_of_other_versions_are_ignored():
    stored = gradebook_rows.stored(record())["record"]
    assert gradebook_rows.stored_record(stored | {"fingerprints": {"99-double": "x"}}) == (
        gradebook_rows.stored_record(stored)
    )
