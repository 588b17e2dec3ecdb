"""What a review gives to whom, and what it changes: every change is a row of the ledger."""

import asyncio
import contextlib
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from slamlab.exercises.verdict import Verdict
from slamlab.grading import feedback
from slamlab.grading.gradebook import Gradebook, default_url
from slamlab.grading.ledger import chain_proof, contents
from slamlab.grading.records import Record
from slamlab.grading.term import term
from slamlab.reviewing import review_routes, taking_requests
from slamlab.reviewing.class_state import ClassState
from slamlab.reviewing.requests_file import RequestsError
from slamlab.reviewing.visible_text import visible
from tests.grading.conftest import know_the_fake
from tests.listening.client import Client, run
from tests.patience import PATIENCE

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


@pytest.fixture(autouse=True)
def _fake_exercise_is_known(monkeypatch):
    know_the_fake(monkeypatch)


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
    """The answers (status, what JSON holds) of somebody with the token to (path, said)."""

    async def each():
        async with served(state) as (client, token):
            assert await client.enter(token) == 200
            for path, said in requests:
                status, _, body = await client.ask("POST" if said else "GET", path, said)
                yield_to.append((status, json.loads(body)))

    yield_to = []
    run(each())
    return yield_to


def change(state, said, row=0, seen=None):
    """The answer to a change of a student's submission as it stands, or as it was ``seen``."""
    if seen is None:
        ((_, told),) = asked(state, (f"/submission/{row}/99", None))
        seen = told.get("seen", 0)
    (answer,) = asked(state, (f"/submission/{row}/99", {"seen": seen} | said))
    return answer


def points(value=2, reason="right idea", task="99-double"):
    return {"task": task, "points": value, "text": reason}


def kinds(state):
    return [row["kind"] for row in state.book.rows()]


def standing(state, row=0):
    state.refresh()
    return state.standings["99"][row]


def test_without_the_token_or_from_elsewhere_there_is_nothing(state):
    async def tried():
        async with served(state) as (client, token):
            for path in ("/table", "/submission/0/99", "/results", "/../pyproject.toml"):
                assert (await client.ask("GET", path))[0] in (403, 404)
            assert (await client.ask("POST", "/submission/0/99", points() | {"seen": 0}))[0] == 403
            assert await client.enter("guessed") == 403
            assert await client.enter(token) == 200
            status, headers, body = await client.ask("GET", "/table")
            assert status == 200 and b"Ben Ivo" in body
            assert headers["content-security-policy"].startswith("default-src 'self'")
            assert headers["content-type"] == "application/json"
            assert headers["x-content-type-options"] == "nosniff"
            for wrong in ({"Host": "slam.example"}, {"Origin": "http://elsewhere.example"},
                          {"Sec_Fetch_Site": "cross-site"}):  # fmt: skip
                assert (await client.ask("GET", "/table", **wrong))[0] == 403
                said = points() | {"seen": 0}
                assert (await client.ask("POST", "/submission/0/99", said, **wrong))[0] == 403

    run(tried())
    assert "override" not in kinds(state)


def test_the_page_is_given_and_holds_nothing_of_the_class(state):
    async def tried():
        async with served(state) as (client, token):
            for path in review_routes.SHIPPED:
                status, headers, body = await client.ask("GET", path)
                assert status == 200 and headers["content-security-policy"]
                assert token.encode() not in body and b"Kos" not in body
                assert b"innerHTML" not in body and b"style=" not in body

    run(tried())


def test_the_table_has_a_cell_for_everybody(state):
    ((status, told),) = asked(state, ("/table", None))
    assert status == 200 and told["who"] == "Prof. X"
    assert [one["id"] for one in told["students"]] == ["s1", "s2", "s3", "s4"]
    assert told["rows"] == [
        [{"state": "part", "total": 5.5, "flag": True}],
        [{"state": "part", "total": 2.25, "late": True}],
        [{"state": "ungraded", "total": None}],
        [{"state": "nothing"}],
    ]


def test_a_submission_stands_beside_its_verdict_and_the_classs_mistakes(state):
    (_, first), (_, late), (_, broken), (_, none), (gone, _) = asked(
        state, *((f"/submission/{row}/99", None) for row in (0, 1, 2, 3, 4))
    )
    shown = HOSTILE.replace("\u202e", "⟦202e⟧").replace("\u202c", "⟦202c⟧")
    assert [cell["source"] for cell in first["code"]] == [shown, "import os"]
    assert first["signs"] == ["cell 2: imports os"] and first["late"] == 0
    double, turn, total = late["tasks"]
    assert (double["points"], double["judged"], double["most"]) == (1.0, 1.0, 3.5)
    assert double["mistakes"] == [{"text": "you squared", "count": 1, "own": True}]
    assert total["mistakes"] == [{"text": "not attempted yet", "count": 2, "own": True}]
    assert late["late"] == 0.75 and late["handed_in"] == "2026-12-01 12:00"
    assert broken["reason"] == "the file is empty" and "not kept" in broken["no_code"]
    assert [task["points"] for task in broken["tasks"]] == [None] * 3
    assert none["status"] == "nothing handed in" and "tasks" not in none
    assert gone == 404 and turn["by_hand"] is None


def test_points_by_hand_are_a_row_with_who_and_why(state):
    before = state.book.rows()
    status, told = change(state, points(2.5))
    assert status == 200 and told["total"] == 4.5 and told["cell"]["hand"] is True
    assert told["tasks"][0]["by_hand"] == "right idea" and told["tasks"][0]["judged"] == 3.5
    *same, row = state.book.rows()
    assert same == before and (row["kind"], row["who"]) == ("override", "Prof. X")
    assert state.book.overrides() == {("s1.ipynb", "99-double"): (2.5, "right idea")}
    assert chain_proof.altered(state.book.rows()) == []
    assert state.term.standings(state.book)["99"][0].total == 4.5
    assert "99-double set by hand to 2.5 points: right idea" in feedback.feedback_text(
        standing(state).mark
    )


def test_what_could_not_be_graded_is_given_points_by_hand(state):
    status, told = change(state, points(1), row=2)
    assert status == 200 and told["total"] == 1 and told["cell"]["state"] == "part"


@pytest.mark.parametrize(
    "said",
    [points(9), points(-1), points(float("nan")), points(float("inf")), points("2"), points(True),
     points(None), points(reason=""), points(reason=" \n"), points(reason="x" * 5000),
     points(task="98-x"), {"request": "none", "text": "x"}, {"text": "x" * 5000}],
    ids=str,
)  # fmt: skip
def test_what_makes_no_sense_is_told_and_changes_nothing(state, said):
    before = kinds(state)
    status, told = change(state, said, seen=0)
    assert status == 409 and len(told["error"]) > 10
    assert kinds(state) == before


@pytest.mark.parametrize(
    "said", [{"text": 7}, {"text": "x", "seen": "0"}, {"text": "x", "seen": True}, {"seen": None}]
)
def test_nonsense_is_refused(state, said):
    before = kinds(state)
    assert change(state, said, seen=0)[0] == 400
    assert kinds(state) == before


def test_nothing_is_changed_where_nothing_was_handed_in(state):
    assert change(state, points(), row=3, seen=0)[0] == 409
    assert change(state, points(), row=4, seen=0)[0] == 404


def test_what_another_one_does_meanwhile_is_seen_first(state):
    with Gradebook(default_url(state.term.course.results), "Tutor") as other:
        other.override_points("s1.ipynb", "99", "99-double", 1, "by the tutor")
        status, told = change(state, points(), seen=0)
        assert status == 409 and told["error"].startswith("Tutor has changed it")
        ((_, told),) = asked(state, ("/submission/0/99", None))
        assert told["tasks"][0]["points"] == 1 and told["history"][0]["who"] == "Tutor"
        assert change(state, points(3))[0] == 200
        other.add(replace(attempt("s4", 2.0), seen=9))
        ((_, table),) = asked(state, ("/table", None))
        assert table["rows"][3][0]["total"] == 4.0


def test_a_change_reads_no_attempt_again(state, monkeypatch):
    monkeypatch.setattr(state.book, "attempts", None)
    assert change(state, points(1.5))[1]["total"] == 3.5
    assert standing(state).total == 3.5


def test_a_comment_reaches_the_student_and_the_newest_counts(state):
    for text in ("first", HOSTILE, ""):
        assert change(state, {"text": text})[1]["comment"] == visible(text)
        mark = standing(state).mark
        page = feedback.feedback_page(mark, "Ana")
        assert "<script>" not in page and ("first" in page) == (text == "first")
        assert ("&lt;script&gt;alert(1)" in page) == (text == HOSTILE)
        assert mark.remarks == ((text,) if text else ())
        assert state.term.standings(state.book)["99"][0].mark == mark
    change(state, {"text": "two\nlines"})
    assert standing(state).mark.note.endswith("two lines")
    assert kinds(state).count("comment") == 4


def csv_of(state, text):
    file = state.term.course.results / "requests.csv"
    file.write_text(text, "utf-8")
    return taking_requests.take_requests(state, file)


def test_a_request_is_read_once_and_answered(state):
    text = "When;Student;Exercise;Request\n1;ana@uni.hr;99;why, <b>\n2;Ben Ivo;99;look\n"
    assert "2 new requests, 0 known" in csv_of(state, text)[0]
    assert "0 new requests, 2 known" in csv_of(state, text)[0]
    ((_, table),) = asked(state, ("/table", None))
    assert [row[0].get("asked") for row in table["rows"]] == [True, True, None, None]
    ((_, told),) = asked(state, ("/submission/0/99", None))
    (request,) = told["requests"]
    assert (request["text"], request["answer"]) == ("why, <b>", "")
    assert standing(state).mark.remarks == ()
    status, told = change(state, {"request": request["key"], "text": "it is right"})
    assert status == 200 and told["requests"][0]["answer"] == "it is right"
    assert "asked" not in told["cell"]
    assert standing(state).mark.remarks == ("You asked: why, <b>\nAnswer: it is right",)
    assert change(state, {"request": request["key"], "text": "x"}, row=1)[0] == 409


def test_requests_of_nobody_or_nothing_are_named_by_their_line(state):
    lines = ["x,99,look", "s4,99,look", "s1,98,look", "s1,99,", f"s1,99,{'x' * 5000}", "s1", ""]
    said = csv_of(state, "student,exercise,request\n" + "\n".join(lines))
    assert "0 new" in said[0] and [line.split(": ")[0][-6:] for line in said[1:]] == [
        f"line {n}" for n in range(2, 8)
    ]
    assert "request" not in kinds(state)


@pytest.mark.parametrize(
    "data", [b"", b"id,text\n", b"student,exercise,request,request\n", b"\xff\xfe", b"a\0b\n", None]
)
def test_a_file_that_is_no_list_of_requests_is_refused_in_words(state, tmp_path, data):
    file = tmp_path / "requests.csv"
    if data is not None:
        file.write_bytes(data)
    with pytest.raises(RequestsError, match=r"requests\.csv: "):
        taking_requests.take_requests(state, file)


def test_who_is_forgotten_is_forgotten_with_comment_request_and_answer(state):
    csv_of(state, "student,exercise,request\ns1,99,a private matter\n")
    change(state, {"text": "a private word"})
    key = next(iter(state.requests))
    change(state, {"request": key, "text": "a private answer"})
    state.book.forget("s1")
    assert "private" not in json.dumps(state.book.rows())
    ((_, table), (_, told)) = asked(state, ("/table", None), ("/submission/0/99", None))
    assert table["rows"][0] == [{"state": "nothing"}] and "requests" not in told
    assert chain_proof.altered(state.book.rows()) == []


def test_unseen_letters_are_shown_and_others_kept():
    kept = "Zoë 漢字 π ✓\n\tx = 1"
    assert visible({"a": [kept, 1, None, True]}) == {"a": [kept, 1, None, True]}
    assert visible("a\u202eb\u200bc\x1b[31m\r\nd") == "a⟦202e⟧b⟦200b⟧c⟦001b⟧[31m\nd"
    assert visible("\ud800") == "⟦d800⟧"


ALONE = "def f(a, b):\n    c = a + b * 2\n    d = c - a / (b + 1)\n    return d * c + a - b"


def test_two_who_share_what_is_rare_stand_side_by_side(state):
    renamed = ALONE.replace("c", "mine").replace("return", "return  # <b>\u202e") + "\nrest = 1"
    state.book.add(attempt("s1", 3.5, [(1, HOSTILE), (3, ALONE)], handed_in=LATER))
    state.book.add(attempt("s2", 1.0, [(4, renamed)], handed_in=LATER))
    ((_, told), (status, both)) = asked(state, ("/likeness/99", None), ("/likeness/99/0/1", None))
    assert [pair["rows"] for pair in told["pairs"]] == [[0, 1]] and told["compared"] == 2
    assert told["not_compared"] == [{"row": 2, "why": "the file is empty"}]
    (_, left), (right,) = both["sides"]
    assert status == 200 and (left["number"], right["number"]) == (3, 4)
    assert [kind for _, kind, _ in left["lines"]] == ["alike"] * 4
    assert left["lines"][0] == ["def f(a, b):", "alike", "4:1"]
    assert "⟦202e⟧" in right["lines"][3][0] and right["lines"][4][0] == "rest = 1"
    state.book.add(attempt("s2", 1.0, [(4, "x = 1")], handed_in=LATER, seen=7))
    ((_, told), (status, _), (gone, _)) = asked(
        state, ("/likeness/99", None), ("/likeness/99/0/3", None), ("/likeness/98", None)
    )
    assert told["pairs"] == [] and (status, gone) == (404, 404)


def test_likeness_is_computed_once_until_another_attempt_counts(state, monkeypatch):
    before = state.likeness("99")
    state.book.override_points("s1.ipynb", "99", "99-double", 1, "by hand")
    state.refresh()
    assert state.likeness("99") is before
    state.book.add(attempt("s4", 2.0, [(1, ALONE)]))
    state.refresh()
    assert state.likeness("99") is not before and "s4" in state.likeness("99").of_class._cells


def mailed(*texts, exercise="99", kind="markdown"):
    """A notebook that holds these text cells, and code that must not be run."""
    cells = [{"cell_type": kind, "metadata": {}, "source": text} for text in texts]
    cells.append({"cell_type": "code", "metadata": {}, "source": "1 / 0", "outputs": []})
    return json.dumps({"nbformat": 4, "nbformat_minor": 5, "cells": cells,
                       "metadata": {"slamlab": {"exercise": exercise}}})  # fmt: skip


ASKS = "## Request for another look\n"


@pytest.mark.parametrize("zipped", [False, True])
def test_a_request_comes_with_a_notebook_that_is_no_attempt(state, tmp_path, zipped):
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
    first, *others = taking_requests.take_requests(state, Path(place))
    assert "2 new requests, 0 known" in first
    assert {re.search(r", ([\w/@.]+\.ipynb): not", line)[1] for line in others} == {
        "s4.ipynb", "Zed.ipynb", "s3/b.ipynb", "s3/c.ipynb", "s3/d.ipynb"
    }  # fmt: skip
    assert "0 new requests, 2 known" in taking_requests.take_requests(state, Path(place))[0]
    assert len(state.book.attempts()) == attempts
    ((_, told),) = asked(state, ("/submission/0/99", None))
    (request,) = told["requests"]
    assert request["text"] == visible(f"why, {HOSTILE}\n\nand this?")
    change(state, {"request": request["key"], "text": "it is right"})
    page = feedback.feedback_page(standing(state).mark, "Ana")
    assert "Answer: it is right" in page and "<script>" not in page


def test_a_folder_or_zip_of_nothing_is_refused_in_words(state, tmp_path):
    (tmp_path / "bad.zip").write_bytes(b"PK")
    (tmp_path / "empty").mkdir()
    for name in ("bad.zip", "empty"):
        with pytest.raises(RequestsError, match=name):
            taking_requests.take_requests(state, tmp_path / name)
