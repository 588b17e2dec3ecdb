"""Parse the text sources of the course: percent scripts (jupytext) to cells with stable ids."""

import re
import unicodedata
from dataclasses import dataclass, replace
from pathlib import Path

import jupytext
from nbformat import NotebookNode

ROOT = Path(__file__).resolve().parent.parent
KINDS = {"lessons": "lesson", "exercises": "exercise"}
METADATA = ("name", "slideshow", "tags", "answers", "minutes", "solved", "given")
OPTIONAL = ("## Deeper", "## In print", "## Appendix")
CHECK = re.compile(r'check\("([^"\\]+)"\)')
ID = re.compile(r"[a-zA-Z0-9_-]{1,64}")

_FORMAT = {"extension": ".py", "format_name": "percent", "comment_magics": False}
_MARKER = re.compile(r"# %%(\s|$|%)")
_HEADING = re.compile(r"#{1,2} +(.+)")


class CourseError(Exception):
    """A source has errors that must be fixed.

    Parameters
    ----------
    problems : list of str, each "file:line: what is wrong and what to do"
    """

    def __init__(self, problems):
        super().__init__("\n".join(problems))
        self.problems = list(problems)


@dataclass(frozen=True)
class Cell:
    """One cell of a source.

    Parameters
    ----------
    type : str, "markdown" or "code" ("raw" is rejected by the lint)
    text : str
    id : str, the name given, else the section's slug and an ordinal
    line : int, line of the cell's marker in the file
    metadata : dict, as written in the marker
    given : str or None, what is handed out in its place, where all of it is a solution
    """

    type: str
    text: str
    id: str
    line: int
    metadata: dict
    given: str | None = None

    @property
    def tags(self):
        """The cell's tags."""
        return list(self.metadata.get("tags", []))

    @property
    def answers(self):
        """The id of the question that the cell answers, or None."""
        return self.metadata.get("answers")

    @property
    def minutes(self):
        """The minutes planned for the section that begins here, or None."""
        return self.metadata.get("minutes")

    @property
    def slide(self):
        """The cell's slide type or None."""
        return self.metadata.get("slideshow", {}).get("slide_type")

    @property
    def check(self):
        """The task's id where the cell is a check and nothing else, or None."""
        match = CHECK.fullmatch(self.text.strip()) if self.type == "code" else None
        return match[1] if match else None


@dataclass(frozen=True)
class Source:
    """The source of one lesson or exercise.

    Parameters
    ----------
    path : Path
    kind : str, "lesson" or "exercise"
    cells : list of Cell
    """

    path: Path
    kind: str
    cells: list[Cell]

    @property
    def number(self):
        """The number the file's name starts with, such as "04"."""
        return self.path.stem.split("_")[0]

    @property
    def prefix(self):
        """What the ids of its questions begin with: its number, of an exercise such as "ex04"."""
        return f"ex{self.number}" if self.kind == "exercise" else self.number

    @property
    def file(self):
        """The name of its notebooks."""
        return file_name(self.path)

    def at(self, cell, line=0):
        """The place of a cell's line (counted from 1; 0 is the marker) as "file:line"."""
        return f"{_relative(self.path)}:{cell.line + line}"


def file_name(path):
    """The name of a source's notebooks; an exercise's begins with ex, so that tabs tell it apart.

    Parameters
    ----------
    path : Path, of the source

    Returns
    -------
    str
    """
    return f"{'ex' if path.parent.name == 'exercises' else ''}{path.stem}.ipynb"


def sources(root=ROOT):
    """List every source of the course, lessons first.

    Parameters
    ----------
    root : Path, the project's folder

    Returns
    -------
    list of Path
    """
    return [path for kind in KINDS for path in sorted((root / "course" / kind).glob("*.py"))]


def read(path):
    """Read and parse a source; its kind is told by its folder, ``lessons`` or ``exercises``.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Source

    Raises
    ------
    CourseError : where the text cannot be cut into cells
    """
    path = Path(path)
    text = path.read_text(encoding="utf-8")
    markers = [n for n, line in enumerate(text.splitlines(), 1) if _MARKER.match(line)]
    raw = jupytext.reads(text, fmt=_FORMAT).cells
    if len(raw) != len(markers):
        first = markers[0] if markers else 1
        raise CourseError(
            [f"{_relative(path)}:{first}: begin with a cell marker `# %%`, none inside a string"]
        )
    if path.parent.name not in KINDS:
        raise CourseError([f"{_relative(path)}:1: a source stands in {' or '.join(KINDS)}"])
    ids = _ids(raw)
    cells = [
        _from_files(path, Cell(c.cell_type, c.source, id, line, _metadata(c)))
        for c, id, line in zip(raw, ids, markers, strict=True)
    ]
    return Source(path, KINDS[path.parent.name], cells)


def slug(text):
    """A heading as part of an id: lower-case ASCII words joined by hyphens, at most 40 letters."""
    ascii_text = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    words = re.sub(r"[^a-z0-9]+", "-", ascii_text.lower()).strip("-")
    return words[:40].rstrip("-") or "section"


def heading(text):
    """The first heading of level 1 or 2 in a markdown text, or None."""
    lines = (_HEADING.fullmatch(line.strip()) for line in text.splitlines())
    return next((match[1] for match in lines if match), None)


def main_line(cells):
    """The cells before the optional sections that may end a lesson: Deeper, In print, Appendix.

    Parameters
    ----------
    cells : list of Cell

    Returns
    -------
    list of Cell
    """
    optional = (k for k, cell in enumerate(cells) if cell.text.startswith(OPTIONAL))
    return cells[: next(optional, len(cells))]


def _ids(raw):
    section, counts, ids = "start", {}, []
    for cell in raw:
        title = heading(cell.source) if cell.cell_type == "markdown" else None
        section = slug(title) if title else section
        check = CHECK.fullmatch(cell.source.strip()) if cell.cell_type == "code" else None
        if "name" in cell.metadata:
            ids.append(str(cell.metadata["name"]))
        elif check:
            ids.append(check[1])
        else:
            counts[section] = counts.get(section, 0) + 1
            ids.append(f"{section}-{counts[section]}")
    return ids


def _metadata(cell: NotebookNode):
    # jupytext notes how the text was laid out; that is none of the notebook's business
    layout = ("lines_to_next_cell", "lines_to_end_of_cell_marker", "cell_marker")
    return {k: _plain(v) for k, v in cell.metadata.items() if k not in layout}


def _plain(value):
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    return value


def _from_files(path, cell):
    """A cell that stands in two files of the course, ``solved`` and ``given``; else as it is."""
    if "solved" not in cell.metadata:
        return cell
    files = [path.parents[1] / cell.metadata.get(name, "") for name in ("solved", "given")]
    missing = [file for file in files if not file.is_file()]
    if missing:
        at = f"{_relative(path)}:{cell.line}"
        raise CourseError(
            [f"{at}: {_relative(missing[0])} is no file: solved= and given= name two"]
        )
    solved, given = (file.read_text(encoding="utf-8").rstrip("\n") for file in files)
    return replace(cell, text=solved, given=given)


def _relative(path):
    path = Path(path).resolve()
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)
