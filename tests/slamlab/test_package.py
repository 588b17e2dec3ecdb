"""The library knows nothing of teaching."""

import re
from pathlib import Path

import slamlab

ROOT = Path(slamlab.__file__).parent
TEACHING = re.compile(
    r"\b(students?|exercises?|lessons?|lectur\w+|homeworks?|coursework|grad(?:e|es|ed|ers?|ing)|classroom)\b",
    re.IGNORECASE,
)
SUFFIXES = {".py", ".js", ".css", ".html", ".svg"}


def texts():
    """Every source file of the library with its text."""
    paths = [path for path in sorted(ROOT.rglob("*")) if path.suffix in SUFFIXES]
    return [(path.relative_to(ROOT).as_posix(), path.read_text("utf-8")) for path in paths]


def test_no_word_of_teaching_stands_in_it():
    messages = [(name, word) for name, text in texts() for word in TEACHING.findall(text)]
    assert messages == []
