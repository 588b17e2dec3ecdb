"""What a review gives to whom, and what it changes: every change is a row of the ledger."""

from dataclasses import replace

from classroom.grading import feedback
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.ledger import chain_verification
from classroom.reviewing import review_routes
from classroom.reviewing.visible_text import visible
from tests.classroom.reviewing.reviewed_class import (
    HOSTILE,
    LATER,
    asked,
    attempt,
    change,
    kinds,
    points,
    result,
    served,
)
from tests.slamlab.web_server.client import run


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
