"""Reading log, the library's own file format: JSON lines, a header and one reading per line.

NaN, infinite limits and missing odometry are null. ``reckoned`` is the dead-reckoned pose, from
which the reader computes the motion during lost lines.
"""

import gzip
import json
from dataclasses import asdict, fields, replace
from itertools import chain
from pathlib import Path

import numpy as np

from slamlab.files import SourceError, reason
from slamlab.geometry import between, compose
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Observations, Reading, Scan, Trajectory
from slamlab.sources.base import LogFile

FORMAT, VERSION = "slamlab reading log", 1  # of the header
# exceptions that parsing a damaged line can raise
PARSE_ERRORS = (ValueError, TypeError, KeyError, AttributeError, RecursionError, OverflowError)


class ReadingLog(LogFile):
    kind = "a reading log"

    @staticmethod
    def recognises(head):
        try:
            return json.loads(head.split(b"\n", 1)[0])["format"] == FORMAT
        except (ValueError, TypeError, KeyError, RecursionError):
            return False

    def _parse(self, file):
        lines = file.lines()
        _, first, _ = next(lines, (1, b"", False))
        self._angles = self._parse_header(self.name, first)
        truth, before, gap, self.has_odometry = [], np.zeros(3), False, False
        for number, line, _ in lines:
            if not line.strip():
                continue
            try:
                reading, reckoned, true = self._parse_reading(json.loads(line))
            except PARSE_ERRORS:
                self._count_lost("lines without a valid reading", number)
                gap = True
                continue
            if reading.odometry is not None:
                self.has_odometry = True
                if gap:
                    reading = replace(reading, odometry=between(before, reckoned))
            before, gap = reckoned, False
            self._rows.append(reading)
            if true is not None:
                truth.append((reading.time, *true))
        if not len(self._rows):
            raise self._nothing_usable("valid reading after its header")
        if truth:
            truth = np.array(truth)
            self.truth = Trajectory(truth[:, 0], truth[:, 1:])

    def __iter__(self):
        return iter(self._rows)

    def _parse_header(self, path, line):
        """Parse name, robot and sensor, and return the common angles of the scans."""
        if not self.recognises(line):
            raise SourceError(f"{path} is not a reading log: its first line is not a header")
        header = json.loads(line)
        if header.get("version") != VERSION:
            found = f"{path} is a reading log of version {header.get('version')!r}"
            raise SourceError(f"{found}; this slamlab reads version {VERSION}")
        try:
            self.name = str(header["name"])
            self.robot = _decode_model(RobotModel, header["robot"])
            self.sensor = _decode_model(SensorModel, header["sensor"])
            return None if header["angles"] is None else _decode_array(header["angles"], (-1,))
        except (ValueError, TypeError, KeyError, AttributeError):
            raise SourceError(f"{path}: the header of this reading log is damaged") from None

    def _parse_reading(self, row):
        """Parse a row; return the Reading, the dead-reckoned pose, and the true pose or None."""
        scan = observations = control = None
        if (stored := row.get("scan")) is not None:
            angles = self._angles
            if stored.get("angles") is not None:
                angles = _decode_array(stored["angles"], (-1,))
            ranges = _decode_array(stored["ranges"], (len(angles),), gaps=True)
            limits = _decode_limit(stored["range_max"]), float(stored["range_min"])
            times = stored.get("times")
            if times is not None:
                times = _decode_array(times, (len(angles),))
            scan = Scan(angles, ranges, *limits, times)
        if (stored := row.get("observations")) is not None:
            z = _decode_array(stored["z"], (-1, 2))
            ids = np.array(stored["ids"], dtype=int).reshape(len(z))
            shapes = {"R": (len(z), 2, 2), "bisectors": len(z), "convex": len(z)}
            given = [key for key in shapes if stored.get(key) is not None]
            more = {key: _decode_array(stored[key], shapes[key]) for key in given}
            if "convex" in more:
                more["convex"] = more["convex"] > 0
            observations = Observations(z, ids, **more)
        if row.get("control") is not None:
            control = _decode_array(row["control"], (-1,))
        time = float(_decode_array([row["time"]], (1,))[0])
        odometry = None if row["odometry"] is None else _decode_array(row["odometry"], (3,))
        reckoned = _decode_array(row["reckoned"], (3,))
        true = None if row.get("truth") is None else _decode_array(row["truth"], (3,))
        return Reading(time, odometry, scan, observations, control), reckoned, true


def write(source, path):
    """Write the readings of a Source to a reading log, compressed if its name ends in ``.gz``.
    Returns their number. Raises SourceError if the file cannot be written."""
    readings, buffer = iter(source), []
    for reading in readings:
        buffer.append(reading)
        if reading.scan is not None:
            break
    angles = buffer[-1].scan.angles if buffer and buffer[-1].scan is not None else None
    truth = source.truth
    true = {} if truth is None else dict(zip(truth.times, truth.poses, strict=True))
    header = {
        "format": FORMAT,
        "version": VERSION,
        "name": source.name,
        "robot": _encode_limits(asdict(source.robot)),
        "sensor": _encode_limits(asdict(source.sensor)),
        "angles": None if angles is None else _encode_list(angles),
    }
    opener = gzip.open if str(path).endswith(".gz") else open
    reckoned, count = np.zeros(3), 0
    try:
        with opener(Path(path), "wt", encoding="utf-8") as file:
            file.write(json.dumps(header, allow_nan=False) + "\n")
            for reading in chain(buffer, readings):
                count += 1
                if reading.odometry is not None:
                    reckoned = compose(reckoned, reading.odometry)
                row = _encode_reading(reading, angles, reckoned, true.get(reading.time))
                file.write(json.dumps(row, allow_nan=False) + "\n")
    except OSError as error:
        raise SourceError(f"{path} cannot be written: {reason(error)}") from None
    return count


def _encode_reading(reading, angles, reckoned, true):
    row = {
        "time": float(reading.time),
        "odometry": None if reading.odometry is None else _encode_list(reading.odometry),
        "reckoned": _encode_list(reckoned),
    }
    if reading.scan is not None:
        scan = reading.scan
        row["scan"] = _encode_limits({"range_min": scan.range_min, "range_max": scan.range_max})
        row["scan"]["ranges"] = _encode_list(scan.ranges)
        if not np.array_equal(scan.angles, angles):
            row["scan"]["angles"] = _encode_list(scan.angles)
        if scan.times is not None:
            row["scan"]["times"] = _encode_list(scan.times)
    if reading.observations is not None:
        row["observations"] = {
            key: np.asarray(part).tolist()
            for key, part in vars(reading.observations).items()
            if part is not None
        }
    if reading.control is not None:
        row["control"] = _encode_list(reading.control)
    if true is not None:
        row["truth"] = _encode_list(true)
    return row


def _encode_list(values):
    return [float(v) if np.isfinite(v) else None for v in values]


def _encode_limits(table):
    return {key: float(v) if np.isfinite(v) else None for key, v in table.items()}


def _decode_model(kind, table):
    # default for missing fields: headers of older logs have fewer
    return kind(**{f.name: _decode_limit(table.get(f.name, f.default)) for f in fields(kind)})


def _decode_limit(value):
    return np.inf if value is None else float(value)


def _decode_array(values, shape, gaps=False):
    array = np.array(values, dtype=float).reshape(shape)
    if np.isinf(array).any() or (np.isnan(array).any() and not gaps):
        raise ValueError
    return array
