"""The glossary: the field's terms, where they stand in the code, and which lesson teaches them.

``glossary.txt`` holds a term a line: ``term | other words | meaning | file | lessons | in the
sources``. Lesson 00 gets it as a table.
"""

from dataclasses import dataclass

from course.source import ROOT

FILE = ROOT / "course" / "glossary.txt"
MARK = "{{glossary}}"
HEAD = "| term | what it is, and where | lesson | in the sources |\n| --- | --- | --- | --- |\n"


@dataclass(frozen=True)
class Entry:
    """A term.

    Parameters
    ----------
    term : str, the field's word
    others : tuple of str, other words for it that are common
    meaning : str, one sentence
    where : str, the file that does it, such as "slamlab/geometry.py"
    lessons : tuple of str, such as "07"; empty where none teaches it
    source : str, the word of the theses or of the first edition; empty where it is the same
    """

    term: str
    others: tuple[str, ...]
    meaning: str
    where: str
    lessons: tuple[str, ...]
    source: str


def entries(file=FILE):
    """All entries, as they stand.

    Parameters
    ----------
    file : Path

    Returns
    -------
    list of Entry

    Raises
    ------
    ValueError : a line that has not six fields
    """
    found = []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        fields = [field.strip() for field in line.split("|")]
        if len(fields) != 6:
            raise ValueError(f"{file.name}, line {number}: {len(fields)} fields, not 6: {line}")
        term, others, meaning, where, lessons, source = fields
        found.append(Entry(term, _parts(others), meaning, where, _parts(lessons), source))
    return found


def table(lessons):
    """The glossary in Markdown.

    Parameters
    ----------
    lessons : dict, number of a lesson to its notebook's stem

    Returns
    -------
    str
    """
    rows = []
    for entry in entries():
        term = f"**{entry.term}**" + (f" ({', '.join(entry.others)})" if entry.others else "")
        links = ", ".join(f"[{number}]({lessons[number]}.ipynb)" for number in entry.lessons)
        # a file's name does not break: in a column of its own it would squeeze the sentence
        what = f"{entry.meaning} `{entry.where}`"
        rows.append(f"| {term} | {what} | {links} | {entry.source} |")
    return HEAD + "\n".join(rows)


def filled(text):
    """A cell's text with the glossary where it is asked for."""
    if MARK not in text:
        return text
    stems = {path.stem[:2]: path.stem for path in (ROOT / "course" / "lessons").glob("*.py")}
    return text.replace(MARK, table(stems))


def _parts(field):
    return tuple(part.strip() for part in field.split(",") if part.strip() not in ("", "-"))
