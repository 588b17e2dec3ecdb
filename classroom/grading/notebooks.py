"""Parse untrusted Jupyter notebooks (.ipynb): code cells, exercise, regrade request, digest."""

import hashlib
import json
import re
from dataclasses import dataclass

MAX_CODE_CELLS = 1000  # of one notebook

SAVE = "save the notebook in JupyterLab and submit it again"
_DOWNLOAD = (
    "open your notebook in JupyterLab, choose Download in its menu File, and submit this file"
)
_EARLIER = (
    "it does not open in JupyterLab; submit an earlier copy that opens, or copy your solution into "
    "a new copy of the exercise's notebook"
)
_OTHER_KINDS = {
    "%pdf": "a PDF",
    "pk": "a zip",
    ("7z", "rar"): "an archive",
    ("<!doctype", "<html"): "a web page",
}

# possessive throughout, so that a hostile cell cannot cause catastrophic backtracking
_REQUEST = re.compile(
    r"\s*+#{1,6}+[ \t]*+request for another look[ \t]*+[:.]?+[ \t]*+(?:\n|\Z)", re.I
)
_CHECK = re.compile(r"\s*+(?:check\(\s*+[\"'][^\"']*+[\"']\s*+\)\s*+;?+\s*+)++")


class SubmissionError(Exception):
    """A submission cannot be read or graded; the message states why."""


@dataclass(frozen=True)
class Notebook:
    """The content of a submitted notebook."""

    cells: tuple[tuple[int, str], ...]  # (number, source) of code cells, check cells left out
    exercise: str | None  # named in its metadata
    sha256: str  # of the file's bytes
    notes: tuple[str, ...] = ()  # irregularities of the file
    request: str = ""  # regrade request: the text cells under the heading of _REQUEST


def parse(data: bytes, lesson=False) -> Notebook:
    """Parse a notebook's bytes. Raises SubmissionError if the bytes are not a notebook, or are a
    lesson and ``lesson`` is False.
    """
    if not data.strip():
        raise SubmissionError(f"the file is empty: {SAVE}")
    text, notes = _decoded(data)
    try:
        content = json.loads(text)
    except RecursionError:
        raise SubmissionError(f"the file is damaged (nested too deeply): {_EARLIER}") from None
    except json.JSONDecodeError as error:
        raise SubmissionError(_damage(text, error)) from None
    except ValueError:  # more digits than Python accepts
        raise SubmissionError(f"the file has a number with too many digits: {SAVE}") from None
    if not isinstance(content, dict):
        raise SubmissionError(f"the file has no cells and no metadata: {SAVE}")
    if "worksheets" in content or content.get("nbformat") in (1, 2, 3):
        content = _upgraded(content)
        notes.append("the notebook has an old format and was upgraded")
    if not isinstance(content.get("cells"), list):
        raise SubmissionError(f"the file has no list of cells: {SAVE}")
    if _named(content, "lesson") and not lesson:
        raise SubmissionError(
            "the notebook is a lesson, not an exercise: submit the notebook that you solved, from "
            "the folder exercises"
        )
    cells = tuple(_sources(content["cells"], ("code",)))
    if not cells:
        notes.append("the notebook has no code cells")
    if len(cells) > MAX_CODE_CELLS:
        raise SubmissionError(
            f"the notebook has {len(cells)} code cells, and at most {MAX_CODE_CELLS} are allowed: "
            f"delete cells, then {SAVE}"
        )
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
    return data.decode("latin-1"), ["the file is not UTF-8 and was read as Latin-1"]


def _damage(text, error):
    """Return why a text is not JSON, and what the student can do."""
    conflict = re.search(r"^<{7}", text, re.MULTILINE)
    if conflict:
        line = text.count("\n", 0, conflict.start()) + 1
        return (
            f"git marked a conflict of two versions in line {line} of the file: keep a copy of it, "
            "and open it in a text editor; where two versions stand between <<<<<<< and >>>>>>>, "
            "delete one of them and the lines that begin with <<<<<<<, ======= and >>>>>>>; "
            f"then open the file in JupyterLab, and {SAVE}"
        )
    begin = text.lstrip()[:20].lower()
    for signs, kind in _OTHER_KINDS.items():
        if begin.startswith(signs):
            return f"the file contains {kind}, not a notebook: {_DOWNLOAD}"
    where = f"line {error.lineno}"
    if error.pos >= len(text.rstrip()) - 1 or error.msg.startswith("Unterminated"):
        return f"the file is incomplete, it ends within {where}: {SAVE}"
    return f"the file is damaged in {where} ({error.msg}): {_EARLIER}"


def _upgraded(content):
    import nbformat

    try:
        return nbformat.convert(nbformat.from_dict(content), 4)
    except Exception as error:  # the converters raise many kinds for invalid content
        raise SubmissionError(
            "the notebook has an old format that cannot be upgraded "
            f"({type(error).__name__}): {SAVE}"
        ) from None


def _sources(cells, kinds):
    for number, cell in enumerate(cells, 1):
        if not isinstance(cell, dict) or cell.get("cell_type") not in kinds:
            continue
        source = cell.get("source", "")
        if isinstance(source, list):
            source = "".join(line for line in source if isinstance(line, str))
        if isinstance(source, str):
            # a lone surrogate, legal in JSON, cannot be encoded
            yield number, source.encode("utf-8", "replace").decode("utf-8")


def _named(content, kind):
    metadata = content.get("metadata")
    ours = metadata.get("slamlab") if isinstance(metadata, dict) else None
    named = ours.get(kind) if isinstance(ours, dict) else None
    return named if isinstance(named, str) else None
