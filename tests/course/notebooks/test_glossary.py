"""The glossary leads from the field's terms to the files and lessons that contain them."""

import re
from functools import cache

import pytest

from course import glossary
from course.source import ROOT, read

ENTRIES = glossary.entries()
LESSONS = {path.stem[:2]: path for path in (ROOT / "course" / "lessons").glob("*.py")}


def plain(text):
    """A text in which a term is found whatever its case, hyphens and line breaks."""
    return re.sub(r"[\s\-–_#*`]+", " ", text).lower()


def report(text, words):
    """Whether one of some words stands in a text."""
    return any(plain(word) in plain(text) for word in words)


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry.term)
def test_a_term_stands_in_the_file_that_it_leads_to(entry):
    assert plain(entry.term) in plain((ROOT / entry.where).read_text("utf-8"))


@cache
def introduced(number):
    """The words that a lesson, given by its number, prints bold, and its headings."""
    found = []
    for cell in read(LESSONS[number]).cells:
        if cell.type == "markdown" and cell.slide != "notes":
            text = re.sub(r"```.*?```|`[^`]*`|\$[^$]*\$", " ", cell.text, flags=re.DOTALL)
            found += re.findall(r"\*\*(.+?)\*\*", text, re.DOTALL)
            found += re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return " § ".join(found)


@pytest.mark.parametrize("entry", [e for e in ENTRIES if e.lessons], ids=lambda entry: entry.term)
def test_a_term_is_taught_where_its_row_states(entry):
    words = entry.term, *entry.others
    for number in entry.lessons:
        assert report(LESSONS[number].read_text("utf-8"), words), f"lesson {number}"
    assert any(report(introduced(number), words) for number in entry.lessons), "not bold there"


def test_terms_stand_once_in_their_order_and_their_meanings_are_one_sentence():
    for entry in ENTRIES:
        assert re.fullmatch(r"[^a-z][^|]*[^.]\.", entry.meaning), entry.term
        assert not re.findall(r"[.!?] [A-Z]", entry.meaning), entry.term
    terms = [entry.term.lower() for entry in ENTRIES]
    assert terms == sorted(set(terms))


def test_a_row_with_too_few_fields_is_refused_with_its_number(tmp_path):
    file = tmp_path / "terms.md"
    file.write_text("| term | code |\n| --- | --- |\n| pose | | Where a robot is. |\n")
    with pytest.raises(ValueError, match="line 3: 3 fields, not 5"):
        glossary.entries(file)


def test_the_appendix_lists_the_terms_that_lessons_teach():
    page = read(ROOT / "course" / "appendices" / "glossary.py")
    (cell,) = (cell for cell in page.cells if glossary.MARK in cell.text)
    shown = glossary.filled(cell.text)
    assert glossary.MARK not in shown
    assert shown.count("\n| **") == sum(bool(entry.lessons) for entry in ENTRIES)


@pytest.mark.parametrize("package", glossary.PACKAGES)
def test_a_packages_readme_has_todays_index(package):
    readme = (ROOT / package / "README.md").read_text("utf-8")
    assert readme == glossary.indexed(readme, package), "run python -m course.glossary"
