"""Parse untrusted Jupyter notebooks (.ipynb): code cells, exercise, request, checksum."""

import hashlib
import json
import re
from dataclasses import dataclass

MAX_CODE_CELLS = 1000  # of one notebook

# possessive throughout: it must not try a hostile cell's letters in every way there is
_REQUEST = re.compile(
    r"\s*+#{1,6}+[ \t]*+request for another look[ \t]*+[:.]?+[ \t]*+(?:\n|\Z)", re.I
)
_CHECK = re.compile(r"\s*+(?:check\(\s*+[\"'][^\"']*+[\"']\s*+\)\s*+;?+\s*+)++")


class SubmissionError(Exception):
    """A submission cannot be read or graded; the message says why."""


@dataclass(frozen=True)
class Notebook:
    """The content of a submitted notebook.

    Parameters
    ----------
    cells : (number, source) of the student's code cells in order, check cells left out
    exercise : str or None, the exercise its metadata names
    sha256 : str, of the file's bytes
    notes : what was odd about the file
    request : str, for another look: what its text cells under that heading say; empty for none
    """

    cells: tuple[tuple[int, str], ...]
    exercise: str | None
    sha256: str
    notes: tuple[str, ...] = ()
    request: str = ""


def parse(data: bytes, lesson=False) -> Notebook:
    """Parse the bytes of a notebook file.

    Parameters
    ----------
    data : bytes
    lesson : bool, whether it may be a lesson

    Returns
    -------
    Notebook

    Raises
    ------
    SubmissionError
    """
    if not data.strip():
        raise SubmissionError("the file is empty")
    text, notes = _decoded(data)
    try:
        content = json.loads(text)
    except RecursionError:
        raise SubmissionError("nested too deeply to be a notebook") from None
    except json.JSONDecodeError as error:
        raise SubmissionError(f"not a notebook, or a part of one: {error}") from None
    except ValueError:  # of more digits than Python reads
        raise SubmissionError("not a notebook: a number in it is longer than any is") from None
    if not isinstance(content, dict):
        raise SubmissionError("not a notebook: no cells and no metadata")
    if "worksheets" in content or content.get("nbformat") in (1, 2, 3):
        content = _upgraded(content)
        notes.append("an old notebook format, upgraded")
    if not isinstance(content.get("cells"), list):
        raise SubmissionError("not a notebook: it has no list of cells")
    if _named(content, "lesson") and not lesson:
        raise SubmissionError("a lesson, not an exercise; those are in the folder exercises")
    cells = tuple(_sources(content["cells"], ("code",)))
    if not cells:
        notes.append("no code cells")
    if len(cells) > MAX_CODE_CELLS:
        raise SubmissionError(f"{len(cells)} cells of code, more than {MAX_CODE_CELLS}")
    own = tuple((number, source) for number, source in cells if not _CHECK.fullmatch(source))
    digest = hashlib.sha256(data).hexdigest()
    texts = (source for _, source in _sources(content["cells"], ("markdown", "raw")))
    asked = [source[match.end() :].strip() for source in texts if (match := _REQUEST.match(source))]
    request = "\n\n".join(filter(None, asked))
    return Notebook(own, _named(content, "exercise"), digest, tuple(notes), request)


def _decoded(data):
    for encoding in (
        ("utf-8-sig", "utf-16") if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ("utf-8-sig",)
    ):
        try:
            return data.decode(encoding), []
        except UnicodeDecodeError:
            continue
    return data.decode("latin-1"), ["not UTF-8, read as Latin-1"]


def _upgraded(content):
    import nbformat

    try:
        return nbformat.convert(nbformat.from_dict(content), 4)
    except Exception as error:  # the converters expect what they expect
        raise SubmissionError(
            f"an old notebook that cannot be upgraded: {type(error).__name__}"
        ) from None


def _sources(cells, kinds):
    """Number and source of the cells of some kinds."""
    for number, cell in enumerate(cells, 1):
        if not isinstance(cell, dict) or cell.get("cell_type") not in kinds:
            continue
        source = cell.get("source", "")
        if isinstance(source, list):
            source = "".join(line for line in source if isinstance(line, str))
        if isinstance(source, str):
            # half a character, legal in JSON, cannot be sent on
            yield number, source.encode("utf-8", "replace").decode("utf-8")


def _named(content, kind):
    metadata = content.get("metadata")
    ours = metadata.get("slamlab") if isinstance(metadata, dict) else None
    named = ours.get(kind) if isinstance(ours, dict) else None
    return named if isinstance(named, str) else None
