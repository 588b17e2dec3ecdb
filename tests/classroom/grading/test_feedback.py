"""Feedback pages and tables of a class: complete, escaped, and with distinct names."""

import html.parser
from dataclasses import replace
from datetime import UTC, datetime

import pytest

from classroom.cli.grade_output import print_summary
from classroom.exercises.verdict import LawResult, Verdict
from classroom.grading import feedback, grade_tables, records
from classroom.grading.late_policy import LatePolicy
from classroom.grading.marks import mark
from classroom.grading.records import Record
from tests.classroom.grading.conftest import HTML, table

OURS = {"html", "head", "meta", "title", "style", "body", "h1", "h2", "p", "div", "section", "span"}
OURS |= {"bdi", "ul", "li", "strong", "code", "details", "summary", "pre"}


class Tags(html.parser.HTMLParser):
    """Collects the tags of a page."""

    def __init__(self, text):
        super().__init__()
        self.tags = set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        assert not [name for name, _ in attributes if name.startswith("on")]


def test_feedback_lists_laws_overrides_the_late_penalty_and_how_to_gain_the_remaining_points():
    laws = (LawResult("a", "is <even>", 1, 1, 0, 20), LawResult("b", "grows", 0.0, 2, 7, 20))
    verdict = Verdict("99-turn", 1, 3, laws, "right", "turn the other way")
    graded = Record("x.ipynb", "x", "99", verdicts=(verdict,), titles={"99-turn": "T"})
    text = feedback.feedback_page(mark(graded))
    for expected in ("is &lt;even&gt;", "false for some inputs", "turn the other way",
                     "To gain 2 points", "1 of 3 points"):  # fmt: skip
        assert expected in text
    assert "right" not in Tags(text).tags
    late = LatePolicy({"99": datetime(2026, 12, 1, tzinfo=UTC)}, per_day=0.25)
    graded = replace(graded, handed_in="2026-12-01T12:00:00+00:00")
    text = feedback.feedback_page(
        mark(graded, {("x.ipynb", None, "99-turn"): (2.0, "right idea")}, late)
    )
    for expected in ("1.5 of 3 points", "Late penalty: 0.5 points (25 % of 2)",
                     "T: set by hand to 2 points (right idea)"):  # fmt: skip
        assert expected in text
    assert "No score<" in feedback.feedback_page(mark(Record("x.ipynb", "x", "99", reason="empty")))


def test_the_summary_of_a_term_names_the_folders_of_the_feedback_pages(tmp_path, capsys):
    (tmp_path / "99/feedback").mkdir(parents=True)
    graded = Record("x.ipynb", "x", "99", verdicts=(Verdict("99-turn", 1, 3),))
    print_summary([graded], tmp_path, by="student")
    output = capsys.readouterr().out
    assert f"1 graded: {tmp_path / 'grades.csv'}, class.html, 99/feedback/\n" in output
    assert " ".join(output.split()).startswith("Scores before late penalty and overrides")


def test_feedback_escapes_the_texts_of_a_submission():
    problem = Verdict("99-turn", 0, 2, problem=HTML, kind="raised", hint=HTML)
    more = {"cells": {3: HTML}, "notes": (HTML,), "titles": {"99-turn": HTML}}
    graded = Record(HTML, HTML, HTML, verdicts=(problem,), **more)
    for record in (graded, Record(HTML, HTML, reason=HTML)):
        text = feedback.feedback_page(mark(record, {(HTML, None, HTML): (1.0, HTML)}))
        assert Tags(text).tags <= OURS
        assert "&lt;script&gt;" in text


@pytest.mark.parametrize("start", ["=", "+", "-", "@", "\t=", "\r@", "\n+", "a; @"])
def test_no_cell_of_the_table_is_a_formula(start, tmp_path):
    name = f'{start}cmd|"/c calc"!A1'
    grade_tables.write_tables(tmp_path, [mark(Record(name, name, reason=name))])
    (row,) = table(tmp_path / "grades.csv")
    for part in row["submission"].split(";"):
        assert part.lstrip()[0] not in "=+-@"
    assert row["note"].startswith("could not be graded")


def test_feedback_files_have_distinct_names_for_all_submissions(tmp_path):
    names = ["a/b.ipynb", "a-b.ipynb", "a b.ipynb", "../../a.ipynb", "", "Я.ipynb", "x" * 400]
    stems = {Record(name, "x").stem for name in names}
    assert len(stems) == len(names)
    for stem in stems:
        records.write_atomically(tmp_path / f"{stem}.json", "half a character: \udce9")
    assert len(list(tmp_path.iterdir())) == len(names)
