"""Text formats of RPLIDAR logs from the SDK, RoboStudio, Python drivers and scripts.

A format class parses a line into points (mark, angle, distance, time): the start flag of a
revolution, and numbers in the file's units. A missing time is NaN.
"""

import re
from collections import Counter
from datetime import datetime
from itertools import chain, islice

import numpy as np

SAMPLE = 5000  # points by which columns and units are determined
MAX_COLUMNS, LEAST_ROWS = 5, 20  # of a table without a header
MAX_ODD = 0.01  # share of outliers that are ignored in a column [1]
TRUE, BOOLEANS = frozenset((b"true", b"1", b"1.0")), frozenset((b"True", b"False"))
FIRST_WORD = re.compile(rb"[-+]?[\d.]+(?:[eE][-+]?\d+)?|\d{4}-.*|nan")  # a number or a date
NUMPY_NUMBER = re.compile(rb"np\.\w+\(([^()]*)\)")
# words of a table's header by role of the column
HEADER = {
    "mark": re.compile(r"start|new|sync"),
    "time": re.compile(r"time|stamp|zeit|tiempo|^t\b|^t_"),
    "angle": re.compile(r"ang|theta|azimut|bearing|winkel"),
    "distance": re.compile(r"dist|range|radius|^r\b|entfernung"),
    "turn": re.compile(r"scan|turn|rev|frame|sweep"),
}
UNITS = {
    "angle": {"degree": re.compile(r"deg|°|grad"), "radian": re.compile(r"rad(?!ius)")},
    "distance": {
        "mm": re.compile(r"mm|milli"),
        "cm": re.compile(r"cm|centi"),
        "m": re.compile(r"met|(?<![a-z])m(?![a-z])"),
    },
}


class UnreadableLine(ValueError):
    """A line should contain points but has no readable point."""


class KeyValueFormat:
    """Format with keys: ``theta: 12.3 Dist: 456.0 Q: 47``, ``{'angle': 12.3, …}`` and others."""

    ANGLE = rb"\b(?:theta|angle)['\"]?\s*[:=]\s*(?P<angle>[-+\w.]+)"
    DISTANCE = rb"\bdist(?:ance)?['\"]?\s*[:=]\s*(?P<distance>[-+\d.]+)\s*(?P<unit>[cm]?m\b)?"
    GAP = rb"[^{}\r\n]{0,200}?"
    ORDERS = re.compile(ANGLE + GAP + DISTANCE, re.I), re.compile(DISTANCE + GAP + ANGLE, re.I)
    PART = re.compile(rb"\{|theta|angle|dist|quality", re.IGNORECASE)  # of a truncated point
    MARK = re.compile(rb"\b(?:start\w*|new_scan)['\"]?\s*[:=]\s*(?:true|1)\b|\bS\s+theta", re.I)

    def __init__(self, head):
        first = self._point(_without_types(head))
        # the SDK prints the points of a revolution by angle, with the mark at its first point
        self.by_angle = b"theta" in first[0]
        unit = first["unit"].decode().lower() if first["unit"] else "mm" if self.by_angle else None
        self.units = {"angle": "degree", "distance": unit}
        self.bounded = False
        self.marks, self.wraps = not self.by_angle and self.MARK.search(head) is not None, True

    @classmethod
    def recognises(cls, head):
        return cls._point(_without_types(head)) is not None

    @classmethod
    def _point(cls, text):
        """Find the first point in a text, with angle and distance in either order."""
        found = (order.search(text) for order in cls.ORDERS)
        return next(filter(None, found), None)

    def points(self, line):
        points, line = [], _without_types(line)
        for piece in line.split(b"}") if b"}" in line else (line,):
            found = self._point(piece)
            if found is not None:
                mark = self.MARK.search(piece) is not None
                points.append((mark, _number(found["angle"]), _number(found["distance"]), np.nan))
            elif self.PART.search(piece):
                raise UnreadableLine
        return points


class TableFormat:
    """Table with one point per row, or lists of tuples; columns are found by header or values."""

    GROUP = re.compile(rb"[(\[]([^()\[\]]*)[)\]]")
    BEGIN = re.compile(rb"\s*[(\[]*\s*(?:[-+.\d]|np\.|True|False)")

    by_angle = False

    def __init__(self, head):
        self.units = {"angle": None, "distance": None}
        self.columns, self._turn, self._mark = {}, None, False
        lines = head.splitlines()
        self.listed = any(len(self._rows(line)) > 1 for line in lines[:50])
        if not any(self._read_header(line) for line in lines[:50]):
            rows = chain.from_iterable(map(self._rows, lines[:-1] or lines))
            self.columns = columns_by_numbers(list(islice(rows, SAMPLE)))
        self.bounded = self.listed or b"#COUNT" in head or "turn" in self.columns
        self.marks, self.wraps = self.bounded or "mark" in self.columns, not self.bounded
        self._needed = max(self.columns.values(), default=0) + 1

    @classmethod
    def recognises(cls, head):
        return {"angle", "distance"} <= set(cls(head).columns)

    def points(self, line):
        if line.startswith(b"#"):
            self._mark = self._mark or line.startswith(b"#COUNT")
            return []
        points = []
        for row in self._rows(line):
            if len(row) < self._needed:
                raise UnreadableLine
            angle, distance = (_number(row[self.columns[key]]) for key in ("angle", "distance"))
            mark, self._mark = self._mark or self._marked(row), False
            points.append((mark, angle, distance, _time(row, self.columns.get("time"))))
        if self.listed and points:
            points[0] = (True, *points[0][1:])
        return points

    def _marked(self, row):
        before, column = self._turn, self.columns.get("turn")
        if column is not None:
            self._turn = row[column]
        at = self.columns.get("mark")
        return (at is not None and row[at].lower() in TRUE) or before not in (None, self._turn)

    def _rows(self, line):
        """Return the words of each point in a line."""
        if not self.BEGIN.match(line):
            return []
        groups = self.GROUP.findall(_without_types(line)) or [line]
        rows = [words for group in groups if (words := _words(group))]
        return [row for row in rows if row[0] in BOOLEANS or FIRST_WORD.fullmatch(row[0])]

    def _read_header(self, line):
        names = [word.decode("utf-8", "replace").lower() for word in _words(line.lstrip(b"# \t"))]
        columns = {}
        for number, name in enumerate(names):
            role = next((r for r, pattern in HEADER.items() if pattern.search(name)), None)
            columns.setdefault(role, number)
        if self.BEGIN.match(line) or not {"angle", "distance"} <= set(columns):
            return False
        columns.pop(None, None)
        self.columns = columns
        for key, units in UNITS.items():
            name = names[columns[key]]
            self.units[key] = next(
                (u for u, pattern in units.items() if pattern.search(name)), None
            )
        return True


def columns_by_numbers(rows):
    """Find the columns of angle, distance and mark by their values; return {} if that fails."""
    width = Counter(map(len, rows)).most_common(1)[0][0] if rows else 0
    rows = [row for row in rows if len(row) == width]
    if not 2 <= width <= MAX_COLUMNS or len(rows) < LEAST_ROWS:
        return {}
    columns = {k: np.array([_number(row[k]) for row in rows]) for k in range(width)}
    marks = [k for k, column in columns.items() if np.isnan(column).all() or _is_mark(column)]
    angles = [k for k, column in columns.items() if k not in marks and _is_angle(column)]
    # increasing values are times or indices, constant ones are qualities
    rest = [k for k in columns if not (k in marks or k in angles or _only_rises(columns[k]))]
    broken = [k for k in rest if np.mean(columns[k] != np.round(columns[k])) > MAX_ODD]
    if len(rest) > 1 and not broken:  # millimetres, and a quality below
        rest = [max(rest, key=lambda k: np.nanquantile(columns[k], 1 - MAX_ODD))]
    rest = broken or rest
    if len(angles) != 1 or len(rest) != 1:
        return {}
    return {"angle": angles[0], "distance": rest[0], **({"mark": marks[0]} if marks else {})}


def _only_rises(values):
    return np.mean(np.diff(values) < 0) < MAX_ODD


def _is_mark(values):
    """Return whether the values are 1 at the beginning of a revolution and 0 otherwise."""
    return bool(np.isin(values, (0, 1)).all() and 0 < np.mean(values) < 0.1)


def _is_angle(values):
    """Return whether the values are angles of one or more revolutions."""
    possible = (values >= 0) & (values < 361)
    if np.mean(possible) < 1 - MAX_ODD:
        return False
    values = values[possible]
    steps = np.diff(values)
    whole = 361.0 if np.quantile(values, 1 - MAX_ODD) > 6.3 else 2 * np.pi + 0.02
    wraps = np.abs(steps) > whole / 2
    one_way = max(np.mean(steps[~wraps] >= 0), np.mean(steps[~wraps] <= 0)) if len(steps) else 0
    round_once = np.ptp(values) > 0.95 * whole
    return bool(one_way > 0.9 and round_once and (wraps.any() or whole > 300))


def _without_types(line):
    """Remove the type names that NumPy prints around numbers."""
    return NUMPY_NUMBER.sub(rb"\1", line) if b"np." in line else line


def _words(line):
    """Split a line by any separator into words; convert decimal commas to points."""
    for separator in (b";", b"\t"):
        if separator in line:
            return [w.strip().replace(b",", b".") for w in line.strip().split(separator)]
    return [w.strip() for w in line.split(b",")] if b"," in line else line.split()


def _number(word):
    try:
        return float(word)
    except ValueError:
        return np.nan


def _time(row, column):
    """Return the time of a row, a number in the file's unit or a date in seconds."""
    if column is None:
        return np.nan
    try:
        return float(row[column])
    except ValueError:
        pass
    try:
        return datetime.fromisoformat(row[column].decode("utf-8", "replace")).timestamp()
    except ValueError:
        return np.nan
