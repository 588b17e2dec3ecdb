"""Parser for the course's text sources: it converts percent scripts (jupytext) to cells with stable
ids."""

import re
import unicodedata
from dataclasses import dataclass, replace
from pathlib import Path

import jupytext
from nbformat import NotebookNode

ROOT = Path(__file__).resolve().parent.parent
KINDS = {"lessons": "lesson", "exercises": "exercise", "appendices": "appendix"}
PATTERNS = {"lessons": "*.py", "exercises": "ex*/notebook.py", "appendices": "*.py"}
METADATA = ("name", "slideshow", "tags", "answers", "minutes", "solved", "given")
OPTIONAL = ("## Deeper", "## Appendix")
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
    id : str, the given name, or the section's slug and an ordinal
    line : int, line of the cell's marker in the file
    metadata : dict, as written in the marker
    given : str or None, the text handed out instead, if the whole cell is a solution
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
        """The task's id if the cell contains only a check, or None."""
        match = CHECK.fullmatch(self.text.strip()) if self.type == "code" else None
        return match[1] if match else None


@dataclass(frozen=True)
class Source:
    """The source of one lesson, exercise or appendix.

    Parameters
    ----------
    path : Path
    kind : str, "lesson", "exercise" or "appendix"
    cells : list of Cell
    """

    path: Path
    kind: str
    cells: list[Cell]

    @property
    def number(self):
        """The number at the start of the file name, such as "04"; of an appendix, its name."""
        return self.topic if self.kind == "appendix" else self.topic.split("_")[0]

    @property
    def topic(self):
        """The name of the source with its number, such as "04_models_and_jacobians"."""
        return topic(self.path)

    @property
    def prefix(self):
        """The prefix of the question ids: "04" for a lesson, "ex04" for an exercise."""
        return f"ex{self.number}" if self.kind == "exercise" else self.number

    @property
    def file(self):
        """The file name of the source's notebooks."""
        return file_name(self.path)

    def at(self, cell, line=0):
        """Return "file:line" for a line of a cell (from 1; 0 is the marker)."""
        return f"{_relative(self.path)}:{cell.line + line}"


def kind_folder(path):
    """Return the folder of all sources of a source's kind, such as ``course/lessons``."""
    return path.parents[1] if path.name == "notebook.py" else path.parent


def topic(path):
    """Return the name of a source with its number, such as "04_models_and_jacobians"."""
    return path.parent.name.removeprefix("ex") if path.name == "notebook.py" else path.stem


def file_name(path):
    """Return the name of a source's notebooks; the prefix "ex" distinguishes exercises from lessons
    in tabs.

    Parameters
    ----------
    path : Path, of the source

    Returns
    -------
    str
    """
    return f"{'ex' if kind_folder(path).name == 'exercises' else ''}{topic(path)}.ipynb"


def sources(root=ROOT, folder=None):
    """List every source of the course, lessons first.

    Parameters
    ----------
    root : Path, the project's folder
    folder : str, one of :data:`KINDS`, or None for all

    Returns
    -------
    list of Path
    """
    folders = [folder] if folder else KINDS
    return [p for each in folders for p in sorted((root / "course" / each).glob(PATTERNS[each]))]


def numbered(number, folder, root=ROOT):
    """Return the source with this number, such as "06", in a folder of :data:`KINDS`, or None."""
    found = (path for path in sources(root, folder) if topic(path).startswith(f"{number}_"))
    return next(found, None)


def read(path):
    """Read and parse a source; its folder, such as ``lessons``, determines its kind.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Source

    Raises
    ------
    CourseError : the text cannot be divided into cells
    """
    path = Path(path)
    text = path.read_text(encoding="utf-8")
    markers = [n for n, line in enumerate(text.splitlines(), 1) if _MARKER.match(line)]
    raw = jupytext.reads(text, fmt=_FORMAT).cells
    if len(raw) != len(markers):
        first = markers[0] if markers else 1
        raise CourseError(
            [f"{_relative(path)}:{first}: begin with a cell marker `# %%`, never in a string"]
        )
    if kind_folder(path).name not in KINDS:
        raise CourseError([f"{_relative(path)}:1: a source must be in {' or '.join(KINDS)}"])
    ids = _ids(raw)
    cells = [
        _from_files(path, Cell(c.cell_type, c.source, id, line, _metadata(c)))
        for c, id, line in zip(raw, ids, markers, strict=True)
    ]
    return Source(path, KINDS[kind_folder(path).name], cells)


def slug(text):
    """Convert a heading to a part of an id: lower-case ASCII words with hyphens, at most 40
    characters."""
    ascii_text = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    words = re.sub(r"[^a-z0-9]+", "-", ascii_text.lower()).strip("-")
    return words[:40].rstrip("-") or "section"


def heading(text):
    """Return the first heading of level 1 or 2 in a Markdown text, or None."""
    lines = (_HEADING.fullmatch(line.strip()) for line in text.splitlines())
    return next((match[1] for match in lines if match), None)


def main_line(cells):
    """Return the cells of a lesson before its optional sections (Deeper, Appendix).

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
    # jupytext records the layout of the text, which the notebook does not need
    layout = ("lines_to_next_cell", "lines_to_end_of_cell_marker", "cell_marker")
    return {k: _plain(v) for k, v in cell.metadata.items() if k not in layout}


def _plain(value):
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    return value


def _from_files(path, cell):
    """Return a cell with the text of the two files ``solved`` and ``given``, if the cell names
    them."""
    if "solved" not in cell.metadata:
        return cell
    course = kind_folder(path).parent
    files = [course / cell.metadata.get(name, "") for name in ("solved", "given")]
    missing = [file for file in files if not file.is_file()]
    if missing:
        at = f"{_relative(path)}:{cell.line}"
        raise CourseError(
            [f"{at}: {_relative(missing[0])} does not exist: solved= and given= name two files"]
        )
    solved, given = (file.read_text(encoding="utf-8").rstrip("\n") for file in files)
    return replace(cell, text=solved, given=given)


def _relative(path):
    path = Path(path).resolve()
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)
