"""Tables of numbers in text files: separators, comments, headers with column names, and damage."""

import re
from array import array
from collections import Counter
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from slamlab.files import InputFile, SourceError

COMMENTS = (b"#", b"%", b"//")
SAMPLED = 50  # rows that determine the number of columns, and largest number of headers
HEADER_LENGTH = 10_000  # part of a header that is read [bytes]
MAX_QUOTED = 60  # part of a header that a message quotes [1]
UNITS = {
    "ns": 1e-9, "us": 1e-6, "µs": 1e-6, "ms": 1e-3, "s": 1.0, "m": 1.0, "cm": 1e-2, "mm": 1e-3,
    "rad": 1.0, "deg": np.pi / 180, "°": np.pi / 180,
}  # fmt: skip


@dataclass(frozen=True)
class Header:
    """A line above the rows that may name columns; ``factors`` to SI units (None: no unit)."""

    line: int
    text: str
    names: list[str]
    factors: list[float | None]
    commented: bool


class TextTable:
    """A text file as a table; ``read`` returns some of its columns.

    ``headers``, ``width`` (number of columns), ``commas`` (whether its first row has commas) and
    ``start`` (its first number) describe the file. ``damage`` counts unusable rows by kind, and
    ``where`` contains the first line of each kind. An empty file's error names a ``row``.
    """

    def __init__(self, path, row):
        if Path(path).is_fifo():
            raise SourceError(f"{path} is a pipe, but it is read twice: write it to a file")
        self.path, self.headers, self.commas = path, [], False
        self.damage, self.where = Counter(), {}
        sample = list(islice(self._rows(InputFile(path), self.headers), SAMPLED))
        if not sample:
            begin = "".join(f"; line {h.line} begins with {h.text!r}" for h in self.headers[:1])
            raise SourceError(f"{path} contains no {row}{begin}")
        self.width = Counter(len(fields) for _, fields in sample).most_common(1)[0][0]
        self.start = _number(sample[0][1][0])

    def read(self, columns, kind):
        """Return line numbers (n,) and given columns (n, k); count unusable rows as ``kind``."""
        numbers, values, columns = array("q"), array("d"), list(columns)
        file = InputFile(self.path)
        for number, fields in self._rows(file, []):
            try:
                if len(fields) != self.width:
                    raise ValueError
                row = [_number(fields[column]) for column in columns]
            except ValueError:
                self.count(kind, [number])
                continue
            numbers.append(number)
            values.extend(row)
        numbers, values = np.array(numbers), np.array(values).reshape(-1, len(columns))
        finite = np.isfinite(values).all(axis=1)
        self.count("rows that are not finite", numbers[~finite])
        if file.truncated:
            self.count("file truncated", numbers[-1:])
        return numbers[finite], values[finite]

    def count(self, kind, numbers):
        """Count lines (n,) as damage of the given kind."""
        if len(numbers):
            self.damage[kind] += len(numbers)
            self.where.setdefault(kind, int(numbers[0]))

    def damage_summary(self):
        """Summarise the damage in words; name the first line of each kind of damage."""
        return ", ".join(
            f"{kind}: {count} (first in line {self.where[kind]})"
            for kind, count in self.damage.items()
        )

    def _rows(self, file, headers):
        """Yield line number and fields of each row of numbers; add lines above to ``headers``."""
        begun = False
        for number, line, ended in file.lines():
            text = line.strip()
            if not text or (file.truncated and not ended):
                continue
            if text.startswith(COMMENTS):
                if not begun and len(headers) < SAMPLED:
                    headers.append(_header(number, text, commented=True))
                continue
            fields = _split(text)
            if not begun and _is_number(fields[0]):
                begun, self.commas = True, b"," in text
            if begun:
                yield number, fields
            elif len(headers) < SAMPLED:
                headers.append(_header(number, text, commented=False))


def named_columns(header, patterns):
    """Find columns by their names in a header: {name: (column, factor or None)}. ``patterns`` is
    {name: regular expressions}; the first pattern that matches exactly one column is used."""
    found = {}
    for name, expressions in patterns.items():
        for expression in expressions:
            fitting = [i for i, n in enumerate(header.names) if re.fullmatch(expression, n)]
            if len(fitting) == 1:
                found[name] = fitting[0], header.factors[fitting[0]]
                break
    return found


def _split(text):
    """Split a row into fields. If semicolons, tabs or blanks separate them, a comma is a decimal
    sign."""
    text = text.replace(b'"', b"")
    fields = [field.strip() for field in text.split(b",")]
    if b";" in text:
        fields = text.replace(b",", b".").split(b";")
    elif len(fields) == 1 or any(len(field.split()) > 1 for field in fields):
        fields = text.replace(b",", b".").split() or [b""]
    return fields[:-1] if len(fields) > 1 and not fields[-1].strip() else fields


def _number(field):
    if b"_" in field:  # Python allows it as a separator of thousands
        raise ValueError
    return float(field)


def _is_number(field):
    try:
        _number(field)
    except ValueError:
        return False
    return True


def _header(number, text, commented):
    shown = text[:MAX_QUOTED].decode("utf-8", "replace")
    text = text[:HEADER_LENGTH].decode("utf-8", "replace").lower().strip("#%/ \t")
    parts = re.split(r"[,;\t]", text)
    if len(parts) == 1:  # names are separated by blanks; each may have its unit in brackets
        parts = re.findall(r"[^\s\[(]+(?:\s*[\[(][^\])]*[\])])?", text)
    named = [_name(part) for part in parts]
    return Header(number, shown, [n for n, _ in named], [unit for _, unit in named], commented)


def _name(part):
    """Return a column's name, reduced to letters and underscores, and its unit's factor or None."""
    unit = re.search(r"[\[(]([^\])]*)[\])]", part)
    bare = re.sub(r"[\[(].*", "", part)
    name = re.sub(r"[^a-z0-9°µ]+", "_", bare).strip("_")
    stem, _, suffix = name.rpartition("_")
    if unit is None and stem and suffix in UNITS:
        return stem, UNITS[suffix]
    return name, None if unit is None else UNITS.get(unit[1].strip())
