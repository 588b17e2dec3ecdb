"""Roster and grade passback by LTI Advantage, against a simulated LMS."""

import csv
import json
import stat
from datetime import datetime

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.records import Record
from classroom.grading.term import course_file
from slamlab.cli import main

pytest.importorskip("authlib")
from tests.classroom.grading.fake_lms import CLIENT, LEARNER, TEACHER, fake_lms

MEMBERS = [
    {"user_id": "u1", "name": "Ana Kos", "email": "ana@uni.hr", "lis_person_sourcedid": "s1",
     "roles": [LEARNER], "status": "Active"},
    {"user_id": "u2", "given_name": "Ben", "family_name": "Ivo", "email": "ben@uni.hr",
     "roles": ["Learner"]},
    {"user_id": "u3", "name": "Gone", "roles": [LEARNER], "status": "Inactive"},
    {"user_id": "u4", "name": "Prof. X", "roles": [TEACHER]},
    {"user_id": "u5", "name": "=1+1", "roles": [LEARNER, 7]},
    {"user_id": 6, "roles": LEARNER}, "nobody", {"roles": [LEARNER]},
]  # fmt: skip
TABLE = """time_zone = "UTC"
[exercises.04]
[lti]
client_id = "{client}"
token_url = "{url}/token"
members_url = "{url}/members"
line_items_url = "{url}/items"
"""


@pytest.fixture
def lms(tmp_path, monkeypatch, capsys):
    """An LMS that knows the course's key."""
    monkeypatch.chdir(tmp_path)
    with fake_lms(list(MEMBERS)) as made:
        (tmp_path / "course.toml").write_text(TABLE.format(url=made.url, client=CLIENT), "utf-8")
        assert main(["grade", "lti", "key"]) == 0
        made.trust(json.loads(capsys.readouterr().out.splitlines()[1]))
        yield made


def released(folder, points=((("s1"), 3.0), ("ben@uni.hr", 1.5))):
    """Grade and release exercise 04 for these students."""
    (folder / "results").mkdir(exist_ok=True)
    with Gradebook(default_url(folder / "results")) as book:
        for student, each in points:
            verdicts = (Verdict("04-h-robot", each, 3.5, problem="a sign"),)
            book.add(Record(f"{student}.ipynb", student, "04", verdicts=verdicts,
                            sha256=student, seed="b" * 64, titles={"04-h-robot": "H"}))  # fmt: skip
    assert main(["grade", "release", "04"]) == 0


def refused(capsys, *words):
    capsys.readouterr()
    assert main(["grade", "lti", *words]) == 2
    output = capsys.readouterr().err
    assert output.startswith("slamlab grade lti: ") and "secret-token" not in output
    return output


def test_the_private_key_is_reused_and_only_its_owner_can_read_it(lms, tmp_path, capsys):
    before = (tmp_path / "lti.pem").read_bytes()
    assert stat.S_IMODE((tmp_path / "lti.pem").stat().st_mode) == 0o600
    assert main(["grade", "lti", "key"]) == 0
    output = capsys.readouterr().out
    assert (tmp_path / "lti.pem").read_bytes() == before
    assert "BEGIN PUBLIC KEY" in output and "PRIVATE" not in output
    jwk = json.loads(output.splitlines()[1])
    assert jwk["alg"] == "RS256" and "d" not in jwk and "p" not in jwk


def test_the_roster_contains_active_learners(lms, tmp_path, capsys):
    assert main(["grade", "lti", "roster"]) == 0
    with open(tmp_path / "roster.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert rows == [["id", "name", "email"], ["s1", "Ana Kos", "ana@uni.hr"],
                    ["ben@uni.hr", "Ben Ivo", "ben@uni.hr"], ["u5", "'=1+1", ""]]  # fmt: skip


def test_an_existing_roster_is_compared_with_the_lms_and_kept(lms, tmp_path, capsys):
    (tmp_path / "roster.csv").write_text("id,name,email,04\ns1,Ana,,2026-12-01\ns9,Zoe,,\n")
    before = (tmp_path / "roster.csv").read_bytes()
    capsys.readouterr()
    assert main(["grade", "lti", "roster"]) == 0
    output = capsys.readouterr().out
    assert "in the LMS only: Ben Ivo; =1+1" in output and "not a student in the LMS: Zoe" in output
    assert (tmp_path / "roster.csv").read_bytes() == before


def test_released_scores_are_sent_once_per_learner(lms, tmp_path, capsys):
    main(["grade", "lti", "roster"])
    released(tmp_path)
    with Gradebook(default_url(tmp_path / "results")) as book:  # not released yet: not sent
        made = next(r for r in book.latest_attempts() if r.submission == "s1.ipynb")
        book.override_points(made, "04-h-robot", 2.0, "later")
    capsys.readouterr()
    assert main(["grade", "lti", "passback", "4"]) == 0
    assert "2 of 2 scores sent" in capsys.readouterr().out
    (item,) = lms.items
    assert item["resourceId"] == "slamlab-04" and item["scoreMaximum"] == 22
    assert [(s["userId"], s["scoreGiven"], s["scoreMaximum"]) for s in lms.scores] == [
        ("u1", 3.0, 22), ("u2", 1.5, 22)
    ]  # fmt: skip
    first = lms.scores[0]
    assert datetime.fromisoformat(first["timestamp"]).tzinfo and "a sign" in first["comment"]
    assert (first["activityProgress"], first["gradingProgress"]) == ("Completed", "FullyGraded")
    assert main(["grade", "lti", "passback", "04"]) == 0  # the same column, a later time
    assert len(lms.items) == 1 and lms.scores[2]["timestamp"] > first["timestamp"]
    with Gradebook(default_url(tmp_path / "results")) as book:
        assert book.notes("passback") == [{"exercise": "04", "sent": 2, "of": 2}] * 2


def test_a_refused_score_is_reported_and_the_others_are_sent(lms, tmp_path, capsys):
    main(["grade", "lti", "roster"])
    released(tmp_path, [("s1", 3.0), ("ben@uni.hr", 1.5), ("u5", 1.0)])
    lms.refused = ("u1",)
    lms.members.pop(1)
    capsys.readouterr()
    assert main(["grade", "lti", "passback", "04"]) == 1
    output = capsys.readouterr().out
    assert "1 of 3 scores sent" in output and "s1: " in output and "HTTP 422" in output
    assert "ben@uni.hr: " in output and [s["userId"] for s in lms.scores] == ["u5"]


def test_nothing_is_sent_before_a_release_nor_for_ambiguous_members(lms, tmp_path, capsys):
    (tmp_path / "roster.csv").write_text("id,name,email\ns1,Ana,\ns7,Eve,ana@uni.hr\n")
    assert "slamlab grade release 04" in refused(capsys, "passback", "04")
    released(tmp_path, [("s1", 3.0), ("s7", 1.5)])
    assert main(["grade", "lti", "passback", "04"]) == 1
    assert lms.scores == []


def test_the_token_is_sent_to_no_other_host(lms, tmp_path, capsys):
    with fake_lms([]) as other:
        for answer in ((302, {"Location": f"{other.url}/members"}, b""),
                       (307, {"Location": f"{lms.url}/members?page=0"}, b""),
                       (200, {"Link": f'<{other.url}/members>; rel="next"'}, b'{"members": []}'),
                       (200, {"Link": '<http://elsewhere/x>; rel="next"'}, b'{"members": []}'),
                       ):  # fmt: skip
            lms.answers["/members"] = answer
            refused(capsys, "roster")
        lms.answers = {"/token": (302, {"Location": f"{other.url}/token"}, b"")}
        refused(capsys, "roster")
        main(["grade", "lti", "roster"])
        assert other.asked == []


@pytest.mark.slow
def test_an_invalid_endless_or_too_long_answer_is_reported(lms, capsys, monkeypatch):
    monkeypatch.setattr("classroom.grading.lti.service.MAX_BYTES", 200_000)
    empty = b'{"members": []}'
    for answer, message in (
        ((200, {}, b"{"), ""), ((200, {}, b"[]"), ""), ((200, {}, b'{"members": {}}'), ""),
        ((200, {}, b""), ""), ((200, {}, b"[" * 100_000), ""), ((500, {}, b"\x1b[31mno"), ""),
        ((401, {}, b""), ""), ((200, {"Link": '</members>; rel="next"'}, empty), ""),
        ((200, {"Link": f'<{lms.url}/members>; rel="next"'}, empty), "the list has no end"),
        ((200, {}, b" " * 300_000), "more than"),
    ):  # fmt: skip
        lms.answers["/members"] = answer
        output = refused(capsys, "roster")
        assert "\x1b" not in output and message in output


def test_a_wrong_key_or_unreachable_lms_is_reported(lms, tmp_path, capsys):
    (tmp_path / "lti.pem").unlink()
    assert "Create a key with slamlab grade lti key" in refused(capsys, "roster")
    assert main(["grade", "lti", "key"]) == 0
    assert "invalid_client" in refused(capsys, "roster")
    (tmp_path / "lti.pem").write_text("no key")
    assert "not an RSA key" in refused(capsys, "roster")
    (tmp_path / "lti.pem").unlink()
    main(["grade", "lti", "key"])
    gone = TABLE.format(url="http://127.0.0.1:9", client=CLIENT)
    (tmp_path / "course.toml").write_text(gone, "utf-8")
    assert "ConnectionError" in refused(capsys, "roster")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [('client_id = "x"', "", "lacks client_id"), ("https://a.b/token", "http://a.b/token", "https://"),
     ("https://a.b/items", "https://c.d/items", "the same host"), ("https://a.b/items", "a", "URL"),
     ("https://a.b/items", "https://u:p@a.b/items", "URL"), ("client_id", "secret", "lti.secret"),
     ("https://a.b/items", "https://a.b:99999/", "URL"), ('"x"', "7", "text in quotes")],
)  # fmt: skip
def test_a_table_that_is_wrong_is_reported_at_every_start(tmp_path, old, new, message):
    text = TABLE.format(url="https://a.b", client="x").replace(old, new, 1)
    (tmp_path / "course.toml").write_text(text, "utf-8")
    with pytest.raises(course_file.CourseFileError, match=message):
        course_file.load(tmp_path / "course.toml")


def test_without_course_file_table_or_exercise_it_states_what_to_do(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert "slamlab grade init" in refused(capsys, "roster")
    (tmp_path / "course.toml").write_text('time_zone = "UTC"\n[exercises.04]\n')
    assert "no table [lti]" in refused(capsys, "roster")
    assert "needs an exercise" in refused(capsys, "passback")
