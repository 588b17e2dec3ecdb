"""Submissions are found in any layout, and read whatever state they are in."""

import json
import os
import time
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest

from slamlab.grading import batch, hand_in_times, notebooks, submissions
from slamlab.grading.records import Record
from slamlab.grading.submissions import Submission, SubmissionError
from tests.grading.conftest import notebook


def lay(folder, *names, text="{}"):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def found(folder, out=None):
    return {
        s.name: s.student for s in submissions.find_submissions(folder, out) if s.problem is None
    }


def test_flat_files_and_folders_of_students(tmp_path):
    lay(tmp_path, "anna.ipynb", "ben/99_fake.ipynb", "ćiro/99_fake/99_fake.ipynb", "notes.txt")
    assert found(tmp_path) == {
        "anna.ipynb": "anna",
        "ben/99_fake.ipynb": "ben",
        "ćiro/99_fake/99_fake.ipynb": "ćiro",
    }


def test_nbgraders_course_folder_is_read_at_submitted_only(tmp_path):
    lay(tmp_path, "submitted/anna/99_fake/x.ipynb", "release/99_fake/x.ipynb", "source/99/x.ipynb")
    assert found(tmp_path) == {"anna/99_fake/x.ipynb": "anna"}
    assert found(tmp_path / "submitted") == {"anna/99_fake/x.ipynb": "anna"}


def test_downloads_of_moodle_and_canvas_tell_the_student(tmp_path):
    lay(
        tmp_path,
        "Ana Marija Kos_123456_assignsubmission_file_/99_fake.ipynb",
        "Ben Ivo_77_assignsubmission_file_99_fake.ipynb",
        "novakiva_1021_55031_99_fake-2.ipynb",
        "horvatjan_LATE_1022_55032_99_fake.ipynb",
    )
    assert sorted(found(tmp_path).values()) == [
        "Ana Marija Kos",
        "Ben Ivo",
        "horvatjan",
        "novakiva",
    ]


def test_results_checkpoints_and_hidden_folders_are_no_submissions(tmp_path):
    lay(tmp_path, "anna.ipynb", "out/x.ipynb", ".ipynb_checkpoints/anna-checkpoint.ipynb")
    lay(tmp_path, "__MACOSX/anna.ipynb", "._anna.ipynb")
    assert list(found(tmp_path, tmp_path / "out")) == ["anna.ipynb"]
    assert all(s.name != "out" for s in submissions.find_submissions(tmp_path, tmp_path / "out"))


def test_a_folder_without_a_notebook_is_listed_with_its_reason(tmp_path):
    lay(tmp_path, "anna/report.pdf", "ben.ipynb/empty.txt", "ciro/99/x.ipynb")
    problems = {s.name: s.problem for s in submissions.find_submissions(tmp_path)}
    assert problems["anna"] == problems["ben.ipynb"] == "a folder without a notebook in it"
    assert problems["ciro/99/x.ipynb"] is None
    with pytest.raises(SubmissionError, match="without a notebook"):
        submissions.read_notebook(submissions.find_submissions(tmp_path)[0])


def test_a_folder_that_is_none_is_refused(tmp_path):
    with pytest.raises(SubmissionError, match="is not there"):
        submissions.find_submissions(tmp_path / "nowhere")


def test_what_moodle_or_canvas_delivered_is_listed_whatever_it_is(tmp_path):
    lay(tmp_path, "Ben Ivo_102_assignsubmission_file_work.zip", "novak_1021_55031_x.pdf", "a.pdf")
    listed = {s.student: s.problem for s in submissions.find_submissions(tmp_path)}
    assert listed == {"Ben Ivo": "not a notebook", "novak": "not a notebook"}


def test_folders_in_folders_without_end_are_not_followed(tmp_path, monkeypatch):
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
    assert problems == {"anna.ipynb": None, "ben": "a folder without a notebook in it"}


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
        (b" \n", "empty"),
        (b'{"cells": [], "nbformat": ' + b"9" * 5000 + b"}", "a number in it is longer"),
        (notebook("x = 1").encode()[:60], "not a notebook, or a part of one"),
        (b"\x00\xff\x13PDF", "not a notebook, or a part of one"),
        (b"[1, 2]", "no cells and no metadata"),
        (b'{"cells": 3}', "no list of cells"),
        (b"[" * 100_000, "nested too deeply"),
        (b'{"cells": ' + b"[" * 100_000, "nested too deeply"),
        (b'{"nbformat": 3, "worksheets": [{"cells": 5}]}', "cannot be upgraded"),
        (b'{"nbformat": 3, "worksheets": 5}', "cannot be upgraded"),
    ],
    ids=lambda value: repr(value[:40]),
)
def test_what_is_no_notebook_is_refused_with_its_reason(data, reason):
    with pytest.raises(SubmissionError, match=reason):
        notebooks.parse(data)


def test_a_file_too_large_a_link_and_a_pipe_are_refused(tmp_path):
    large = tmp_path / "large.ipynb"
    with open(large, "wb") as file:
        file.truncate(submissions.MAX_NOTEBOOK_BYTES + 1)
    (tmp_path / "link.ipynb").symlink_to(large)
    os.mkfifo(tmp_path / "pipe.ipynb")
    for name, reason in [("large", "MB"), ("link", "a link"), ("pipe", "not a file")]:
        path = tmp_path / f"{name}.ipynb"
        with pytest.raises(SubmissionError, match=reason):
            submissions.read_notebook(Submission(path.name, name, path))


def test_cells_are_read_in_order_checks_left_out_odd_ones_ignored():
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


@pytest.mark.parametrize(
    "source",
    ['check("a")' + " " * 100_000 + "x", 'check("a")  ' * 1000 + "x", " " * 100_000 + "check("],
    ids=lambda source: source[:14],
)
def test_a_cell_that_is_nearly_a_check_is_read_at_once(source):
    begin = time.process_time()
    cells = [{"cell_type": "code", "source": source}]
    assert notebooks.parse(json.dumps({"cells": cells}).encode()).cells == ((1, source),)
    assert time.process_time() - begin < 20  # every way of reading it would take years


def test_more_cells_than_anybody_writes_are_refused():
    cells = [{"cell_type": "code", "source": "1 / 0"}] * (notebooks.MAX_CODE_CELLS + 1)
    with pytest.raises(SubmissionError, match="1001 cells of code"):
        notebooks.parse(json.dumps({"cells": cells}).encode())


def test_no_code_cells_is_noted():
    assert notebooks.parse(b'{"cells": []}').notes == ("no code cells",)


def test_an_old_format_is_upgraded_and_other_encodings_are_read():
    cell = {"cell_type": "code", "language": "python", "input": "x = 'é'", "outputs": []}
    old = {"nbformat": 3, "nbformat_minor": 0, "metadata": {}, "worksheets": [{"cells": [cell]}]}
    read = notebooks.parse(json.dumps(old).encode())
    assert read.cells == ((1, "x = 'é'"),)
    text = notebook().replace(
        '"cells": []', '"cells": [{"cell_type": "code", "source": "x = \'é\'"}]'
    )
    for encoding, notes in [
        ("utf-8-sig", ()),
        ("utf-16", ()),
        ("latin-1", ("not UTF-8, read as Latin-1",)),
    ]:
        read = notebooks.parse(text.encode(encoding))
        assert read.cells == ((1, "x = 'é'"),)
        assert read.notes == notes


def test_a_lesson_is_no_submission():
    text = notebook(exercise=None, metadata={"slamlab": {"lesson": "99"}})
    with pytest.raises(SubmissionError, match="a lesson, not an exercise"):
        notebooks.parse(text.encode())


def exercise(name, text, bound=None):
    submission = Submission(name, "anna", None)
    return submissions.identify_exercise(submission, notebooks.parse(text.encode()), bound).id


def test_the_exercise_is_told_by_the_command_line_the_metadata_or_the_start_of_the_name():
    silent = notebook(exercise=None)
    assert exercise("work.ipynb", notebook(exercise="99")) == "99"
    assert exercise("99_fake.ipynb", silent) == "99"
    assert exercise("anna/99_fake/ex99_fake.ipynb", silent) == "99"
    assert exercise("anna 1999.ipynb", silent, "99") == "99"
    for metadata in (5, {"slamlab": 5}, {"slamlab": {"exercise": []}}):
        assert exercise("99_x.ipynb", notebook(exercise=None, metadata=metadata)) == "99"
    with pytest.raises(SubmissionError, match="--exercise"):
        exercise("anna 1999.ipynb", silent)


def test_a_time_that_is_yet_to_come_counts_as_when_it_was_first_read(tmp_path):
    lay(tmp_path, "anna.ipynb", "ben.ipynb")
    os.utime(tmp_path / "anna.ipynb", (1_924_000_000, 1_924_000_000))
    os.utime(tmp_path / "ben.ipynb", (1_700_000_000, 1_700_000_000))
    listed = batch.content_hashes(submissions.find_submissions(tmp_path))

    def read(now, attempts=()):
        found = submissions.find_submissions(tmp_path)
        return hand_in_times.without_future(found, listed, attempts, now)

    now = datetime(2026, 11, 23, 12, tzinfo=UTC)
    anna, ben = read(now)
    assert anna.handed_in == now.isoformat() and "yet to come" in anna.note
    assert ben.handed_in.startswith("2023-11-14") and ben.note == ""
    first = Record("anna.ipynb", "anna", sha256=listed[0][1], handed_in=anna.handed_in)
    again, _ = read(now + timedelta(days=30), [first])  # so that nobody becomes late by it
    assert again.handed_in == now.isoformat()
    wrong = replace(first, handed_in="2030-12-20T00:00:00+00:00")  # of an older version
    assert read(now, [wrong])[0].handed_in == now.isoformat()
    moodle = replace(
        submissions.find_submissions(tmp_path)[0],
        name="Ana_1_assignsubmission_file_x.ipynb",
        when="2031-01-01T00:00:00+00:00",
    )
    assert hand_in_times.without_future([moodle], [], [], now) == [moodle]  # an LMS said so
