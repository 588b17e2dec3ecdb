"""Regrade requests: recorded once and answered, refused with a message, erased with a student."""

import json
import re
import shutil
from pathlib import Path

import pytest

from classroom.grading import feedback
from classroom.grading.ledger import chain_verification
from classroom.reviewing import regrade_requests
from classroom.reviewing.regrade_request_file import RegradeRequestError
from classroom.reviewing.visible_text import visible
from tests.classroom.reviewing.reviewed_class import HOSTILE, asked, change, kinds, result


def csv_of(state, text):
    file = state.term.course.results / "requests.csv"
    file.write_text(text, "utf-8")
    return regrade_requests.take_regrade_requests(state, file)


def test_a_request_is_recorded_once_and_answered(state):
    text = "When;Student;Exercise;Request\n1;ana@uni.hr;99;why, <b>\n2;Ben Ivo;99;look\n"
    assert "2 new requests, 0 already known" in csv_of(state, text)[0]
    assert "0 new requests, 2 already known" in csv_of(state, text)[0]
    ((_, table),) = asked(state, ("/table", None))
    assert [row[0].get("asked") for row in table["rows"]] == [True, True, None, None]
    ((_, reported),) = asked(state, ("/submission/0/99", None))
    (request,) = reported["requests"]
    assert (request["text"], request["answer"]) == ("why, <b>", "")
    assert result(state).mark.remarks == ()
    status, reported = change(state, {"request": request["key"], "text": "it is right"})
    assert status == 200 and reported["requests"][0]["answer"] == "it is right"
    assert "asked" not in reported["cell"]
    assert result(state).mark.remarks == ("You asked: why, <b>\nAnswer: it is right",)
    assert change(state, {"request": request["key"], "text": "x"}, row=1)[0] == 409


def test_requests_without_a_student_or_submission_are_reported_by_line(state):
    lines = ["x,99,look", "s4,99,look", "s1,98,look", "s1,99,", f"s1,99,{'x' * 5000}", "s1", ""]
    text = csv_of(state, "student,exercise,request\n" + "\n".join(lines))
    assert "0 new" in text[0] and [line.split(": ")[0][-6:] for line in text[1:]] == [
        f"line {n}" for n in range(2, 8)
    ]
    assert "request" not in kinds(state)


@pytest.mark.parametrize("name", ["requests.csv", "requests.zip", "requests"])
def test_an_invalid_request_file_is_refused_with_a_message(state, tmp_path, name):
    file = tmp_path / name
    twice = b"student,exercise,request,request\n"
    for data in (None, b"", b"id,text\n", twice, b"\xff\xfe", b"a\0b\n", b"PK"):
        if data is not None and name != "requests":
            file.write_bytes(data)
        elif data is not None:
            file.mkdir(exist_ok=True)
        with pytest.raises(RegradeRequestError, match=name):
            regrade_requests.take_regrade_requests(state, file)


def test_an_erased_student_is_erased_with_comment_request_and_answer(state):
    csv_of(state, "student,exercise,request\ns1,99,a private matter\n")
    change(state, {"text": "a private word"})
    key = next(iter(state.requests))
    change(state, {"request": key, "text": "a private answer"})
    state.book.forget("s1")
    assert "private" not in json.dumps(state.book.rows())
    ((_, table), (_, reported)) = asked(state, ("/table", None), ("/submission/0/99", None))
    assert table["rows"][0] == [{"state": "nothing"}] and "requests" not in reported
    assert chain_verification.find_alterations(state.book.rows()) == []


def mailed(*texts, exercise="99", kind="markdown"):
    """A notebook that holds these text cells, and code that must not be run."""
    cells = [{"cell_type": kind, "metadata": {}, "source": text} for text in texts]
    cells.append({"cell_type": "code", "metadata": {}, "source": "1 / 0", "outputs": []})
    return json.dumps({"nbformat": 4, "nbformat_minor": 5, "cells": cells,
                       "metadata": {"slamlab": {"exercise": exercise}}})  # fmt: skip


ASKS = "## Request for another look\n"


@pytest.mark.parametrize("zipped", [False, True])
def test_a_notebook_with_a_request_is_not_an_attempt(state, tmp_path, zipped):
    files = {
        "s1/99_a.ipynb": mailed("# Title", f"{ASKS}why, {HOSTILE}", f"\n{ASKS.upper()}and this?"),
        "ben@uni.hr.ipynb": mailed([ASKS, "look"], kind="raw"),
        "s4.ipynb": mailed(f"{ASKS}I handed in nothing"),
        "Zed.ipynb": mailed(f"{ASKS}I am nobody"),
        "s3/a.ipynb": mailed(ASKS, "Request for another look, not a heading"),
        "s3/b.ipynb": mailed(ASKS + "x" * 5000),
        "s3/c.ipynb": mailed(ASKS + "x", exercise="98"),
        "s3/d.ipynb": "{",
    }
    folder = tmp_path / "mail"
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, "utf-8")
    place = shutil.make_archive(folder, "zip", folder) if zipped else folder
    attempts = len(state.book.attempts())
    first, *others = regrade_requests.take_regrade_requests(state, Path(place))
    assert "2 new requests, 0 already known" in first
    assert {re.search(r", ([\w/@.]+\.ipynb): not", line)[1] for line in others} == {
        "s4.ipynb", "Zed.ipynb", "s3/b.ipynb", "s3/c.ipynb", "s3/d.ipynb"
    }  # fmt: skip
    again = regrade_requests.take_regrade_requests(state, Path(place))[0]
    assert "0 new requests, 2 already known" in again
    assert len(state.book.attempts()) == attempts
    ((_, reported),) = asked(state, ("/submission/0/99", None))
    (request,) = reported["requests"]
    assert request["text"] == visible(f"why, {HOSTILE}\n\nand this?")
    change(state, {"request": request["key"], "text": "it is right"})
    page = feedback.feedback_page(result(state).mark, "Ana")
    assert "Answer: it is right" in page and "<script>" not in page
