"""Parser of planar pose-graph files (g2o, TORO): lines of a keyword, ids and numbers."""

from collections import Counter
from typing import NamedTuple

import numpy as np

from slamlab.files import SourceError, read_bytes


class Kind(NamedTuple):
    """Meaning of a keyword: the number and kind of its ids, and the size of its numbers."""

    ids: int
    size: int  # numbers of a pose (3) or a position (2)
    landmark: bool  # whether the last id is of a landmark
    role: str = "edge"  # or vertex (without an information matrix), or prior

    @property
    def numbers(self):
        """Count of the numbers after the ids."""
        triangle = self.size * (self.size + 1) // 2
        return self.size + (0 if self.role == "vertex" else triangle)


KINDS = {
    "VERTEX_SE2": Kind(1, 3, False, "vertex"),
    "VERTEX_XY": Kind(1, 2, True, "vertex"),
    "EDGE_SE2": Kind(2, 3, False),
    "EDGE_SE2_XY": Kind(2, 2, True),
    "EDGE_PRIOR_SE2": Kind(1, 3, False, "prior"),
    "EDGE_PRIOR_SE2_XY": Kind(1, 2, False, "prior"),
    "EDGE_PRIOR_XY": Kind(1, 2, True, "prior"),
}
TORO = {"VERTEX2": "VERTEX_SE2", "VERTEX": "VERTEX_SE2", "EDGE2": "EDGE_SE2", "EDGE": "EDGE_SE2"}
KINDS |= {word: KINDS[same] for word, same in TORO.items()}
TORO_ORDER = [0, 1, 2, 3, 4, 7, 5, 8, 6]  # from I11 I12 I22 I33 I13 I23 to the order of g2o
LEFT_OUT = "PARAMS_", "ROBOTLASER", "RAWLASER", "VERTEX_TAG", "VERTEX_ELLIPSE"  # no constraint
IN_3D = "SE3", "VERTEX3", "EDGE3", "XYZ", "CAM", "SIM3"  # in keywords of 3-D graphs
REMEDIES = {
    "ODOMETRY": "its matrix is ambiguous; write EDGE_SE2 and the information, row by row",
    "LANDMARK": "its matrix is ambiguous; write EDGE_SE2_XY and the information",
    "BR": "write bearing and range as EDGE_SE2_XY: x, y and their information",
    "EQUIV": "give both vertices the same id, or connect them by an EDGE2",
}


class Rows(NamedTuple):
    """All lines of a keyword: line numbers (m,) in the file, ids (m, k), and numbers (m, n)."""

    word: str
    kind: Kind
    lines: np.ndarray
    ids: np.ndarray
    numbers: np.ndarray


def read_rows(path):
    """Read the Rows of a file by keyword, the ``FIX`` lines as (line, id) pairs, and a Counter of
    ignored lines. Raises SourceError."""
    content, truncated = read_bytes(path)
    found, left_out, texts = {}, Counter(), content.splitlines()
    if truncated:
        raise SourceError(f"{path} is truncated: its compressed data ends in line {len(texts)}")
    for number, text in enumerate(texts, 1):
        words = text.partition(b"#")[0].decode("utf-8", "replace").split(None, 1)
        if not words:
            continue
        rows = found.get(words[0])
        if rows is None:
            if words[0].startswith(LEFT_OUT):
                left_out[words[0]] += 1
                continue
            if words[0] not in KINDS and words[0] != "FIX":
                raise SourceError(f"{path}, line {number}: {_unknown(words[0])}")
            rows = found[words[0]] = ([], [])
        rows[0].append(number)
        rows[1].append(words[-1])  # the keyword if nothing follows it
    fixed = zip(*found.pop("FIX", ((), ())), strict=True)
    fixed = [(k, _id(path, k, w)) for k, text in fixed for w in text.split() if w != "FIX"]
    return [_parse(path, word, *rows) for word, rows in found.items()], fixed, left_out


def _parse(path, word, lines, texts):
    """Parse all lines of a keyword at once; if that fails, one by one, to find the error."""
    kind = KINDS[word]
    try:
        table = np.loadtxt(texts, comments=None, ndmin=2)
        ids, numbers = np.split(table, [kind.ids], axis=1)
        exact = (ids % 1 == 0) & (abs(ids) < 2**53)  # and finite
        if numbers.shape[1] != kind.numbers or not (exact.all() and np.isfinite(numbers).all()):
            raise ValueError
        ids = ids.astype(np.int64)
    except ValueError:
        parsed = [_parse_line(path, word, *one) for one in zip(lines, texts, strict=True)]
        ids, numbers = map(np.array, zip(*parsed, strict=True), (object, float))
    if word in TORO and kind.role == "edge":
        numbers = numbers[:, TORO_ORDER]
    return Rows(word, kind, np.array(lines), ids, numbers)


def _parse_line(path, word, line, text):
    """Return the ids and the numbers of a line."""
    kind, words = KINDS[word], [each for each in text.split() if each != word]
    if len(words) != kind.ids + kind.numbers:
        raise SourceError(
            f"{path}, line {line}: {word} needs {kind.ids} id{'s'[: kind.ids - 1]} and "
            f"{kind.numbers} numbers, but this line has {len(words)} values, not "
            f"{kind.ids + kind.numbers}"
        )
    ids, numbers = words[: kind.ids], words[kind.ids :]
    return [_id(path, line, each) for each in ids], [_number(path, line, each) for each in numbers]


def _id(path, line, word):
    """Return an id, an integer of any size; 3.0 is read as 3."""
    try:
        return int(word.replace("_", "?"))
    except ValueError:
        number = _number(path, line, word)
    if not number.is_integer() or abs(number) > 2**53:
        raise SourceError(f"{path}, line {line}: an id must be an integer, not {word:.40}")
    return int(number)


def _number(path, line, word):
    try:
        number = float(word.replace("_", "?"))
    except ValueError:
        comma = "; use a decimal point" if "," in word else ""
        raise SourceError(f"{path}, line {line}: {word[:40]!r} is not a number{comma}") from None
    if not np.isfinite(number):
        raise SourceError(f"{path}, line {line}: {word[:40]} is not finite")
    return number


def _unknown(word):
    """Return a message about an unsupported keyword, with a remedy."""
    name = word if word.isprintable() and len(word) <= 40 else ascii(word[:40])
    if any(part in word for part in IN_3D):
        return (
            f"{name} belongs to a 3-D pose graph, but only planar graphs are supported: write x, "
            "y and yaw as VERTEX_SE2 and EDGE_SE2"
        )
    if word in REMEDIES:
        return f"{word} is not supported: {REMEDIES[word]}"
    return (
        f"{name} is not a keyword of a planar pose graph (g2o, TORO); use {', '.join(KINDS)} or FIX"
    )
