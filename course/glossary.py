"""The glossary: ``docs/terms.md``, a table of the field's terms, their code and their lessons.

The appendix "Glossary" lists the terms that lessons teach. ``python -m course.glossary`` writes the
index of terms in the README of each package.
"""

from dataclasses import dataclass

from course.source import ROOT

FILE = ROOT / "docs" / "terms.md"
MARK = "{{glossary}}"
HEAD = "| term | what it is, and where | lesson |\n| --- | --- | --- |\n"
FIELDS = 5  # of a row
PACKAGES, INDEX = ("slamlab", "classroom"), "## Find a term in the code\n"


@dataclass(frozen=True)
class Entry:
    """A row of the table.

    Parameters
    ----------
    term : str
    others : tuple of str, synonyms
    meaning : str, one sentence
    where : str, the file that implements it, such as "slamlab/geometry.py"
    lessons : tuple of str, such as "07"; empty where none teaches it
    """

    term: str
    others: tuple[str, ...]
    meaning: str
    where: str
    lessons: tuple[str, ...]


def entries(file=FILE):
    """Return all rows in order.

    Parameters
    ----------
    file : Path

    Returns
    -------
    list of Entry

    Raises
    ------
    ValueError : a row has not five fields
    """
    lines = list(enumerate(file.read_text(encoding="utf-8").splitlines(), 1))
    rows = [(number, line) for number, line in lines if line.startswith("|")][2:]
    found = []
    for number, line in rows:
        fields = [field.strip() for field in line.strip().strip("|").split("|")]
        if len(fields) != FIELDS:
            raise ValueError(
                f"{file.name}, line {number}: {len(fields)} fields, not {FIELDS}: {line}"
            )
        term, others, meaning, where, lessons = fields
        found.append(Entry(term, _parts(others), meaning, where.strip("`"), _parts(lessons)))
    return found


def table(lessons):
    """Return a Markdown table of the terms that lessons teach.

    Parameters
    ----------
    lessons : dict, number of a lesson to its notebook's stem

    Returns
    -------
    str
    """
    rows = []
    for entry in entries():
        if not entry.lessons:
            continue
        term = f"**{entry.term}**" + (f" ({', '.join(entry.others)})" if entry.others else "")
        links = ", ".join(f"[{number}]({lessons[number]}.ipynb)" for number in entry.lessons)
        # a file's name does not break: in a column of its own it would squeeze the sentence
        rows.append(f"| {term} | {entry.meaning} `{entry.where}` | {links} |")
    return HEAD + "\n".join(rows)


def filled(text):
    """Return a cell's text with the table in place of the mark."""
    if MARK not in text:
        return text
    stems = {path.stem[:2]: path.stem for path in (ROOT / "course" / "lessons").glob("*.py")}
    return text.replace(MARK, table(stems))


def indexed(readme, package):
    """Return the text of a package's README with its index: the terms of each file in order."""
    terms = {}
    for entry in entries():
        if entry.where.startswith(f"{package}/"):
            words = entry.term + (f" ({', '.join(entry.others)})" if entry.others else "")
            terms.setdefault(entry.where.removeprefix(f"{package}/"), []).append(words)
    rows = [f"- `{file}`: {', '.join(terms[file])}\n" for file in sorted(terms)]
    before, _, _ = readme.partition(INDEX)
    return before + INDEX + "\n" + "".join(rows)


def _parts(field):
    return tuple(part.strip() for part in field.split(",") if part.strip() not in ("", "-"))


if __name__ == "__main__":
    for package in PACKAGES:
        readme = ROOT / package / "README.md"
        readme.write_text(indexed(readme.read_text(encoding="utf-8"), package), encoding="utf-8")
