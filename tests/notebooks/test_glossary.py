"""The glossary leads from the field's terms to the files and lessons that hold them."""

import re

import pytest

from course import glossary
from course.source import ROOT, read

ENTRIES = glossary.entries()
LESSONS = {path.stem[:2]: path for path in (ROOT / "course" / "lessons").glob("*.py")}


def plain(text):
    """A text in which a term is found whatever its case, hyphens and line breaks."""
    return re.sub(r"[\s\-–_#*`]+", " ", text).lower()


def says(text, words):
    """Whether one of some words stands in a text."""
    return any(plain(word) in plain(text) for word in words)


@pytest.mark.parametrize("entry", ENTRIES, ids=[entry.term for entry in ENTRIES])
def test_a_term_stands_in_the_file_that_it_leads_to(entry):
    assert plain(entry.term) in plain((ROOT / entry.where).read_text("utf-8"))


@pytest.mark.parametrize("entry", ENTRIES, ids=[entry.term for entry in ENTRIES])
def test_a_term_is_taught_where_it_says_so(entry):
    words = entry.term, *entry.others, *([entry.source] if entry.source else [])
    for number in entry.lessons:
        assert says(LESSONS[number].read_text("utf-8"), words), f"lesson {number}"


@pytest.mark.parametrize("entry", ENTRIES, ids=[entry.term for entry in ENTRIES])
def test_a_meaning_is_one_sentence(entry):
    assert re.fullmatch(r"[^a-z][^|]*[^.]\.", entry.meaning)
    assert len(re.findall(r"[.!?] [A-Z]", entry.meaning)) == 0


def test_terms_stand_once_and_in_their_order():
    terms = [entry.term.lower() for entry in ENTRIES]
    assert terms == sorted(set(terms))


def test_a_line_with_too_few_fields_is_refused_with_its_number(tmp_path):
    file = tmp_path / "glossary.txt"
    file.write_text("pose | | Where a robot is.\n")
    with pytest.raises(ValueError, match="line 1: 3 fields, not 6"):
        glossary.entries(file)


def test_lesson_00_has_the_whole_table_at_its_end():
    (cell,) = (cell for cell in read(LESSONS["00"]).cells if glossary.MARK in cell.text)
    shown = glossary.filled(cell.text)
    assert glossary.MARK not in shown
    assert shown.count("\n| **") == len(ENTRIES)
