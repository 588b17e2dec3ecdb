"""Submissions are found in every layout, and damaged files are reported."""

import json
import os
import time
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest

from classroom.grading import batch, notebooks, submissions
from classroom.grading.records import Record
from classroom.grading.submissions import Submission, SubmissionError
from tests.classroom.grading.conftest import notebook


def lay(folder, *names, text="{}"):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def found(folder, out=None):
    return {
        s.name: s.student for s in submissions.find_submissions(folder, out) if s.problem is None
    }


def test_flat_files_and_folders_of_students(tmp_path):
    names = {"anna.ipynb": "anna", "ben/99_fake.ipynb": "ben", "ćiro/99/99_fake.ipynb": "ćiro"}
    lay(tmp_path, *names, "notes.txt")
    assert found(tmp_path) == names


def test_nbgraders_course_folder_is_read_at_submitted_only(tmp_path):
    lay(tmp_path, "submitted/anna/99_fake/x.ipynb", "release/99_fake/x.ipynb", "source/99/x.ipynb")
    assert found(tmp_path) == {"anna/99_fake/x.ipynb": "anna"}
    assert found(tmp_path / "submitted") == {"anna/99_fake/x.ipynb": "anna"}


def test_results_checkpoints_and_hidden_folders_are_not_submissions(tmp_path):
    lay(tmp_path, "anna.ipynb", "out/x.ipynb", ".ipynb_checkpoints/anna-checkpoint.ipynb")
    lay(tmp_path, "__MACOSX/anna.ipynb", "._anna.ipynb")
    assert list(found(tmp_path, tmp_path / "out")) == ["anna.ipynb"]
    assert all(s.name != "out" for s in submissions.find_submissions(tmp_path, tmp_path / "out"))


def test_a_folder_without_a_notebook_is_listed_with_its_reason(tmp_path):
    lay(tmp_path, "anna/report.pdf", "ben.ipynb/empty.txt", "ciro/99/x.ipynb")
    (tmp_path / "dea").mkdir()
    problems = {s.name: s.problem for s in submissions.find_submissions(tmp_path)}
    assert problems["anna/report.pdf"].startswith("“report.pdf” is not a notebook; it is a printed")
    assert problems["ben.ipynb/empty.txt"].startswith("“empty.txt” is not a notebook; submit the")
    assert problems["ciro/99/x.ipynb"] is None
    assert problems["dea"].startswith("your submission contains no file")
    for listed in submissions.find_submissions(tmp_path):
        if listed.problem:
            with pytest.raises(SubmissionError):
                submissions.read_notebook(listed)


@pytest.mark.parametrize(
    ("name", "remedy"),
    [
        ("ex03.py", "it is a Python program: submit the file whose name ends in .ipynb"),
        ("ex03.html", "it is a printed copy"),
        ("colab.url", "it is a link: download the notebook"),
        ("ex03.7z", "it is an archive that cannot be opened here: submit the notebook itself"),
        ("notes.docx", "submit the file whose name ends in .ipynb"),
    ],
)
def test_a_student_reads_what_is_wrong_with_a_file_and_how_to_correct_it(tmp_path, name, remedy):
    lay(tmp_path, f"anna/{name}")
    (listed,) = submissions.find_submissions(tmp_path)
    assert listed.problem.startswith(f"“{name}” is not a notebook; {remedy}")


def test_every_file_of_moodle_or_canvas_is_listed(tmp_path):
    lay(tmp_path, "Ben Ivo_102_assignsubmission_file_work.zip", "novak_1021_55031_x.pdf", "a.pdf")
    listed = {s.student: s.problem for s in submissions.find_submissions(tmp_path)}
    assert sorted(listed) == ["Ben Ivo", "novak"] and all(listed.values())
    with pytest.raises(SubmissionError, match="does not exist"):
        submissions.find_submissions(tmp_path / "nowhere")


def test_deeply_nested_folders_are_not_followed(tmp_path, monkeypatch):
    lay(tmp_path, "anna.ipynb")
    monkeypatch.chdir(tmp_path)  # the whole path would be too long for one call
    for _ in range(1500):
        os.mkdir("ben")
        os.chdir("ben")
    try:
        problems = {s.name: s.problem for s in submissions.find_submissions(tmp_path)}
    finally:  # nor could pytest clear them away
        for _ in range(1500):
            os.chdir("..")
            os.rmdir("ben")
    assert problems == {"anna.ipynb": None, "ben": submissions.problem_of([])}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such names")
def test_names_of_any_kind_are_found(tmp_path):
    names = ["a b.ipynb", "q\"u'o.ipynb", "new\nline.ipynb", "$(x);.ipynb", "-.ipynb", "Я.IPYNB"]
    lay(tmp_path, *names)
    (tmp_path / os.fsdecode(b"latin-\xe9.ipynb")).write_text("{}")
    assert set(found(tmp_path)) == {*names, "latin-\\xe9.ipynb"}


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "empty"),
        (b'{"cells": [], "nbformat": ' + b"9" * 5000 + b"}", "a number with too many digits"),
        (notebook("x = 1").encode()[:60], "incomplete, it ends within line 1: save the notebook"),
        (b'{"cells": [\n<<<<<<< HEAD\n', "git marked a conflict of two versions in line 2"),
        (b'{"cells": [,],\n"metadata": {}}', "damaged in line 1"),
        (b"%PDF-1.7", "contains a PDF, not a notebook"),
        (b"PK\x03\x04x\xff", "contains a zip, not a notebook"),
        (b"<!DOCTYPE html><html>", "contains a web page, not a notebook"),
        (b"[1, 2]", "no cells and no metadata"),
        (b'{"cells": 3}', "no list of cells"),
        (b'{"cells": ' + b"[" * 100_000, "nested too deeply"),
        (b'{"nbformat": 3, "worksheets": [{"cells": 5}]}', "cannot be upgraded"),
    ],
    ids=lambda value: repr(value[:40]),
)
def test_a_file_that_is_not_a_notebook_is_refused_with_the_reason(data, reason):
    with pytest.raises(SubmissionError, match=reason):
        notebooks.parse(data)


def test_a_file_too_large_a_link_and_a_pipe_are_refused(tmp_path):
    large = tmp_path / "large.ipynb"
    with open(large, "wb") as file:
        file.truncate(submissions.MAX_NOTEBOOK_BYTES + 1)
    (tmp_path / "link.ipynb").symlink_to(large)
    os.mkfifo(tmp_path / "pipe.ipynb")
    for name, reason in [("large", "MB"), ("link", "a symbolic link"), ("pipe", "not a file")]:
        path = tmp_path / f"{name}.ipynb"
        with pytest.raises(SubmissionError, match=reason):
            submissions.read_notebook(Submission(path.name, name, path))


def test_code_cells_are_read_in_order_without_checks_and_invalid_cells():
    cells = [
        {"cell_type": "markdown", "source": "text"},
        {"cell_type": "code", "source": ["a = 1\n", "b = 2"]},
        {"cell_type": "code", "source": 'check("99-double")'},
        {"cell_type": "code", "source": "x = check('99-double')"},
        {"cell_type": "code"},
        {"cell_type": "code", "source": 5},
        {"cell_type": "code", "source": "s = '\ud800'"},
        "no cell",
    ]
    read = notebooks.parse(json.dumps({"cells": cells}).encode())
    assert read.cells == (
        (2, "a = 1\nb = 2"),
        (4, "x = check('99-double')"),
        (5, ""),
        (7, "s = '?'"),
    )


def of_code(*sources):
    cells = [{"cell_type": "code", "source": source} for source in sources]
    return notebooks.parse(json.dumps({"cells": cells}).encode())


def test_cells_that_are_almost_checks_are_parsed_quickly():
    begin, long = time.process_time(), " " * 100_000
    for source in ('check("a")' + long + "x", 'check("a")  ' * 1000 + "x", long + "check("):
        assert of_code(source).cells == ((1, source),)
    assert time.process_time() - begin < 20  # every way of reading it would take years


def test_too_many_cells_are_refused_and_none_are_noted():
    with pytest.raises(SubmissionError, match="1001 code cells"):
        of_code(*["1 / 0"] * (notebooks.MAX_CODE_CELLS + 1))
    assert of_code().notes == ("the notebook has no code cells",)


def test_an_old_format_is_upgraded_and_other_encodings_are_read():
    cell = {"cell_type": "code", "language": "python", "input": "x = 'é'", "outputs": []}
    old = {"nbformat": 3, "nbformat_minor": 0, "metadata": {}, "worksheets": [{"cells": [cell]}]}
    read = notebooks.parse(json.dumps(old).encode())
    assert read.cells == ((1, "x = 'é'"),)
    text = notebook("x = 'é'").replace("\\u00e9", "é")
    for encoding, notes in [
        ("utf-8-sig", ()),
        ("utf-16", ()),
        ("latin-1", ("the file is not UTF-8 and was read as Latin-1",)),
    ]:
        read = notebooks.parse(text.encode(encoding))
        assert read.cells == ((1, "x = 'é'"),)
        assert read.notes == notes


def test_a_lesson_is_not_a_submission():
    text = notebook(exercise=None, metadata={"slamlab": {"lesson": "99"}})
    with pytest.raises(SubmissionError, match="a lesson, not an exercise"):
        notebooks.parse(text.encode())


def test_a_time_in_the_future_is_replaced_by_the_first_reading(tmp_path):
    lay(tmp_path, "anna.ipynb", "ben.ipynb")
    os.utime(tmp_path / "anna.ipynb", (1_924_000_000, 1_924_000_000))
    os.utime(tmp_path / "ben.ipynb", (1_700_000_000, 1_700_000_000))
    listed = batch.content_hashes(submissions.find_submissions(tmp_path))

    def read(now, attempts=()):
        found = submissions.find_submissions(tmp_path)
        return batch.clamp_future_times(found, listed, attempts, now)

    now = datetime(2026, 11, 23, 12, tzinfo=UTC)
    anna, ben = read(now)
    assert anna.handed_in == now.isoformat() and "is in the future" in anna.note
    assert ben.handed_in.startswith("2023-11-14") and ben.note == ""
    first = Record("anna.ipynb", "anna", sha256=listed[0][1], handed_in=anna.handed_in)
    again, _ = read(now + timedelta(days=30), [first])  # so that a regrade makes nobody late
    assert again.handed_in == now.isoformat()
    wrong = replace(first, handed_in="2030-12-20T00:00:00+00:00")  # of an older version
    assert read(now, [wrong])[0].handed_in == now.isoformat()
    moodle = replace(
        submissions.find_submissions(tmp_path)[0],
        name="Ana_1_assignsubmission_file_x.ipynb",
        when="2031-01-01T00:00:00+00:00",
    )
    assert batch.clamp_future_times([moodle], [], [], now) == [moodle]  # the time is that of an LMS
