"""What a review gives to whom, and what it changes: every change is a row of the ledger."""

import asyncio
import contextlib
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading import feedback
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.ledger import chain_verification, contents
from classroom.grading.records import Record
from classroom.grading.term import term
from classroom.reviewing import regrade_requests, review_routes
from classroom.reviewing.class_state import ClassState
from classroom.reviewing.regrade_request_file import RegradeRequestError
from classroom.reviewing.visible_text import visible
from tests.classroom.grading.conftest import know_the_fake
from tests.slamlab.web_server.client import Client, run
from tests.timeouts import PATIENCE

COURSE = """
time_zone = "Europe/Zagreb"
[late]
per_day = 0.25
[exercises.99]
due = 2026-12-01T12:00:00
"""
ROSTER = """id,name,email,section
s1,Ana <b>Kos</b>,ana@uni.hr,Mon
s2,Ben Ivo,ben@uni.hr,Tue
s3,Ćiro Šarić,,Tue
s4,Dea Car,,
"""
LATER = "2026-12-01T11:00:01+00:00"
HOSTILE = "<script>alert(1)</script>\u202ereversed\u202c"


_know = pytest.fixture(autouse=True)(know_the_fake)


def attempt(student, points, cells=(), **more):
    verdicts = (
        Verdict("99-double", points, 3.5, hint="you squared" if points < 3.5 else None),
        Verdict("99-turn", 2.0, 2.5),
        Verdict("99-total", 0.0, 2.0, problem="not attempted yet"),
    )
    data = contents.packed(json.dumps(list(cells)).encode())
    kept = {"cells": contents.name_of(data)} if cells else {}
    return Record(f"{student}.ipynb", student, "99", verdicts=verdicts, sha256=student * 8,
                  seed="b" * 64, kept=kept, contents={kept["cells"]: data} if cells else {},
                  titles={v.task: v.task for v in verdicts}, **more)  # fmt: skip


@pytest.fixture
def state(tmp_path):
    """A class of four: late, flagged, unreadable, absent."""
    (tmp_path / "course.toml").write_text(COURSE, "utf-8")
    (tmp_path / "roster.csv").write_text(ROSTER, "utf-8")
    made = term.load(tmp_path / "course.toml")
    made.course.results.mkdir()
    with Gradebook(default_url(made.course.results), "Prof. X") as book:
        hostile = [(1, HOSTILE), (2, "import os")]
        book.add(attempt("s1", 3.5, hostile, signs=("cell 2: imports os",)))
        book.add(attempt("s2", 1.0, [(1, "x = 1")], handed_in=LATER))
        book.add(Record("s3.ipynb", "s3", "99", reason="the file is empty"))
        yield ClassState(made, book)


@contextlib.asynccontextmanager
async def served(state):
    """A class that is served, a client without a cookie, and the token."""
    address, over = asyncio.get_running_loop().create_future(), asyncio.Event()
    task = asyncio.create_task(review_routes.serve(state, 0, address.set_result, over))
    host, token = (await asyncio.wait_for(address, PATIENCE)).split("/#")
    try:
        yield Client(int(host.rpartition(":")[2])), token
    finally:
        over.set()
        await task


def asked(state, *requests):
    """Responses (status, JSON) to requests (path, content) of a client with the token."""

    async def each():
        async with served(state) as (client, token):
            assert await client.log_in(token) == 200
            for path, message in requests:
                status, _, body = await client.ask("POST" if message else "GET", path, message)
                yield_to.append((status, json.loads(body)))

    yield_to = []
    run(each())
    return yield_to


def change(state, message, row=0, seen=None):
    """The answer to a change of a student's submission as it stands, or as it was ``seen``."""
    if seen is None:
        ((_, reported),) = asked(state, (f"/submission/{row}/99", None))
        seen = reported.get("seen", 0)
    (answer,) = asked(state, (f"/submission/{row}/99", {"seen": seen} | message))
    return answer


def points(value=2, reason="right idea", task="99-double"):
    return {"task": task, "points": value, "text": reason}


def kinds(state):
    return [row["kind"] for row in state.book.rows()]


def result(state, row=0):
    state.refresh()
    return state.exercise_results["99"][row]


def test_without_the_token_or_from_another_origin_only_a_page_without_content_is_served(state):
    async def tried():
        async with served(state) as (client, token):
            for path in ("/table", "/submission/0/99", "/results", "/../pyproject.toml"):
                assert (await client.ask("GET", path))[0] in (403, 404)
            assert (await client.ask("POST", "/submission/0/99", points() | {"seen": 0}))[0] == 403
            assert await client.log_in("guessed") == 403
            assert await client.log_in(token) == 200
            status, headers, body = await client.ask("GET", "/table")
            assert status == 200 and b"Ben Ivo" in body
            assert headers["content-type"] == "application/json"
            wrong, message = {"Origin": "http://elsewhere.example"}, points() | {"seen": 0}
            assert (await client.ask("GET", "/table", **wrong))[0] == 403
            assert (await client.ask("POST", "/submission/0/99", message, **wrong))[0] == 403
            client.cookie = None
            for path in review_routes.PAGE:
                status, headers, body = await client.ask("GET", path)
                assert status == 200 and headers["content-security-policy"]
                assert token.encode() not in body and b"Kos" not in body
                assert b"innerHTML" not in body and b"style=" not in body

    run(tried())
    assert "override" not in kinds(state)


def test_the_table_has_a_cell_for_every_student(state):
    ((status, reported),) = asked(state, ("/table", None))
    assert status == 200 and reported["who"] == "Prof. X"
    assert [one["id"] for one in reported["students"]] == ["s1", "s2", "s3", "s4"]
    assert reported["rows"] == [
        [{"state": "part", "total": 5.5, "flag": True}],
        [{"state": "part", "total": 2.25, "late": True}],
        [{"state": "ungraded", "total": None}],
        [{"state": "nothing"}],
    ]


def test_a_submission_view_has_code_verdict_and_mistakes_of_the_class(state):
    (_, first), (_, late), (_, broken), (_, none), (gone, _) = asked(
        state, *((f"/submission/{row}/99", None) for row in (0, 1, 2, 3, 4))
    )
    shown = HOSTILE.replace("\u202e", "⟦202e⟧").replace("\u202c", "⟦202c⟧")
    assert [cell["source"] for cell in first["code"]] == [shown, "import os"]
    assert first["flags"] == ["cell 2: imports os"] and first["late"] == ""
    double, turn, total = late["tasks"]
    assert (double["points"], double["judged"], double["most"]) == (1.0, 1.0, 3.5)
    assert double["mistakes"] == [{"text": "you squared", "count": 1, "own": True}]
    assert total["mistakes"] == [{"text": "not attempted yet", "count": 2, "own": True}]
    assert late["late"].startswith("Late penalty: 0.75 points (25 % of 3)")
    assert late["handed_in"] == "2026-12-01 12:00"
    assert broken["reason"] == "the file is empty" and "not stored" in broken["no_code"]
    assert [task["points"] for task in broken["tasks"]] == [None] * 3
    assert none["status"] == "not submitted" and "tasks" not in none
    assert gone == 404 and turn["by_hand"] is None


def test_points_set_by_hand_are_a_ledger_row_with_author_and_reason(state):
    before = state.book.rows()
    status, reported = change(state, points(2.5))
    assert status == 200 and reported["total"] == 4.5 and reported["cell"]["hand"] is True
    assert reported["tasks"][0]["by_hand"] == "right idea" and reported["tasks"][0]["judged"] == 3.5
    *same, row = state.book.rows()
    assert same == before and (row["kind"], row["who"]) == ("override", "Prof. X")
    assert state.book.overrides() == {("s1.ipynb", "s1" * 8, "99-double"): (2.5, "right idea")}
    assert chain_verification.find_alterations(state.book.rows()) == []
    assert state.term.exercise_results(state.book)["99"][0].total == 4.5
    text = feedback.feedback_text(result(state).mark)
    assert "99-double: set by hand to 2.5 points (right idea)" in text
    status, reported = change(state, points(1), row=2)  # a file that could not be graded
    assert status == 200 and reported["total"] == 1 and reported["cell"]["state"] == "part"


INVALID = [
    points(9), points(-1), points(float("nan")), points(float("inf")), points("2"), points(True),
    points(reason=" \n"), points(reason="x" * 5000), points(task="98-x"),
    {"request": "none", "text": "x"}, {"text": "x" * 5000},
]  # fmt: skip
NONSENSE = [{"text": 7}, {"text": "x", "seen": "0"}, {"text": "x", "seen": True}, {"seen": None}]


def test_an_invalid_request_is_reported_and_changes_nothing(state):
    before = kinds(state)
    for message in INVALID:
        status, reported = change(state, message, seen=0)
        assert status == 409 and len(reported["error"]) > 10, message
    for message in NONSENSE:
        assert change(state, message, seen=0)[0] == 400, message
    assert change(state, points(), row=3, seen=0)[0] == 409, "there is no submission"
    assert change(state, points(), row=4, seen=0)[0] == 404, "there is no student"
    assert kinds(state) == before


def test_a_concurrent_change_of_another_grader_is_shown_first(state, monkeypatch):
    with Gradebook(default_url(state.term.course.results), "Tutor") as other:
        other.override_points(attempt("s1", 3.5), "99-double", 1, "by the tutor")
        status, reported = change(state, points(), seen=0)
        assert status == 409 and reported["error"].startswith("Tutor has changed the submission")
        ((_, reported),) = asked(state, ("/submission/0/99", None))
        assert reported["tasks"][0]["points"] == 1 and reported["history"][0]["who"] == "Tutor"
        with monkeypatch.context() as patch:
            patch.setattr(state.book, "attempts", None)  # a change does not load them again
            assert change(state, points(3))[1]["total"] == 5
        other.add(replace(attempt("s4", 2.0), seen=9))
        ((_, table),) = asked(state, ("/table", None))
        assert table["rows"][3][0]["total"] == 4.0


def test_the_newest_comment_is_in_the_feedback(state):
    for text in ("first", HOSTILE, ""):
        assert change(state, {"text": text})[1]["comment"] == visible(text)
        mark = result(state).mark
        page = feedback.feedback_page(mark, "Ana")
        assert "<script>" not in page and ("first" in page) == (text == "first")
        assert ("&lt;script&gt;alert(1)" in page) == (text == HOSTILE)
        assert mark.remarks == ((text,) if text else ())
        assert state.term.exercise_results(state.book)["99"][0].mark == mark
    change(state, {"text": "two\nlines"})
    assert result(state).mark.note.endswith("two lines")
    assert kinds(state).count("comment") == 4


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


def test_invisible_characters_are_shown():
    kept = "Zoë 漢字 π ✓\n\tx = 1"
    assert visible({"a": [kept, 1, None, True]}) == {"a": [kept, 1, None, True]}
    assert visible("a\u202eb\u200bc\x1b[31m\r\nd") == "a⟦202e⟧b⟦200b⟧c⟦001b⟧[31m\nd"
    assert visible("\ud800") == "⟦d800⟧"


ALONE = "def f(a, b):\n    c = a + b * 2\n    d = c - a / (b + 1)\n    return d * c + a - b"


def test_two_similar_submissions_are_shown_side_by_side(state):
    renamed = ALONE.replace("c", "mine").replace("return", "return  # <b>\u202e") + "\nrest = 1"
    state.book.add(attempt("s1", 3.5, [(1, HOSTILE), (3, ALONE)], handed_in=LATER))
    state.book.add(attempt("s2", 1.0, [(4, renamed)], handed_in=LATER))
    ((_, reported), (status, both)) = asked(
        state, ("/similarity/99", None), ("/similarity/99/0/1", None)
    )
    assert [pair["rows"] for pair in reported["pairs"]] == [[0, 1]] and reported["compared"] == 2
    assert reported["not_compared"] == [{"row": 2, "why": "the file is empty"}]
    (_, left), (right,) = both["sides"]
    assert status == 200 and (left["number"], right["number"]) == (3, 4)
    assert [kind for _, kind, _ in left["lines"]] == ["shared"] * 4
    assert left["lines"][0] == ["def f(a, b):", "shared", "4:1"]
    assert "⟦202e⟧" in right["lines"][3][0] and right["lines"][4][0] == "rest = 1"
    state.book.add(attempt("s2", 1.0, [(4, "x = 1")], handed_in=LATER, seen=7))
    ((_, reported), (status, _), (gone, _)) = asked(
        state, ("/similarity/99", None), ("/similarity/99/0/3", None), ("/similarity/98", None)
    )
    assert reported["pairs"] == [] and (status, gone) == (404, 404)


def test_similarity_is_computed_once_until_another_attempt_counts(state, monkeypatch):
    before = state.similarity("99")
    state.book.override_points(attempt("s1", 3.5), "99-double", 1, "by hand")
    state.refresh()
    assert state.similarity("99") is before
    state.book.add(attempt("s4", 2.0, [(1, ALONE)]))
    state.refresh()
    assert state.similarity("99") is not before and "s4" in state.similarity("99").comparison._cells


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
