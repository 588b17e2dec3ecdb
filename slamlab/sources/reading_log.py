"""Reading log, the project's own file format: JSON lines, a header and then one reading a line.

NaN is written as null, a limit of infinity too. Numbers come back exactly as they were. What the
header does not say of robot or sensor is as by default: older logs know fewer things.
``reckoned`` is the odometry summed up so far (dead reckoning): where a line is lost, its motion
is not.
"""

import gzip
import json
from dataclasses import asdict, fields
from itertools import chain
from pathlib import Path

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.files.text_files import reason
from slamlab.geometry import between, compose
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Observations, Reading, Scan, Trajectory
from slamlab.sources.log_file import LogFile

FORMAT, VERSION = "slamlab reading log", 1  # what the header says of the file format
# exceptions that parsing a damaged line can raise
PARSE_ERRORS = (ValueError, TypeError, KeyError, AttributeError, RecursionError, OverflowError)


class ReadingLog(LogFile):
    """Reading log as a source, plain or gzip."""

    def _parse(self, lines):
        first, *rest = lines or [(b"", False)]
        self._angles = self._parse_header(self.name, first[0])
        self._readings, truth, before, gap = [], [], np.zeros(3), False
        for line, _ in rest:
            if not line.strip():
                continue
            try:
                reading, reckoned, true = self._parse_reading(json.loads(line))
            except PARSE_ERRORS:
                self.damage["lines that are no reading"] += 1
                self.skipped += 1
                gap = True
                continue
            if gap:
                reading = Reading(**vars(reading) | {"odometry": between(before, reckoned)})
            before, gap = reckoned, False
            self._readings.append(reading)
            if true is not None:
                truth.append((reading.time, true))
        if not self._readings:
            raise SourceError(f"{self.name} holds no readable reading after its header")
        if truth:
            times, poses = zip(*truth, strict=True)
            self.truth = Trajectory(np.array(times), np.array(poses))

    def __len__(self):
        return len(self._readings)

    def __iter__(self):
        return iter(self._readings)

    def _parse_header(self, path, line):
        """Parse the header: name, robot and sensor; returns the angles that scans share."""
        try:
            header = json.loads(line)
            if header["format"] != FORMAT:
                raise ValueError
        except (ValueError, TypeError, KeyError, RecursionError):
            raise SourceError(f"{path} is no reading log: its first line is no header") from None
        if header.get("version") != VERSION:
            raise SourceError(
                f"{path} is a reading log of version {header.get('version')!r}; this slamlab "
                f"reads version {VERSION}"
            )
        try:
            self.name = str(header["name"])
            self.robot, self.sensor = (
                kind(
                    **{
                        f.name: _decode_limit(header[key].get(f.name, f.default))
                        for f in fields(kind)
                    }
                )
                for key, kind in (("robot", RobotModel), ("sensor", SensorModel))
            )
            return None if header["angles"] is None else _decode_array(header["angles"], (-1,))
        except (ValueError, TypeError, KeyError, AttributeError):
            raise SourceError(f"{path}: the header of this reading log is damaged") from None

    def _parse_reading(self, row):
        """Decode a line: a reading, the dead-reckoned pose, the true pose or None."""
        scan = observations = control = None
        if row.get("scan") is not None:
            angles = self._angles
            if row["scan"].get("angles") is not None:
                angles = _decode_array(row["scan"]["angles"], (-1,))
            scan = Scan(
                angles,
                _decode_array(row["scan"]["ranges"], (len(angles),), gaps=True),
                range_max=_decode_limit(row["scan"]["range_max"]),
                range_min=float(row["scan"]["range_min"]),
            )
        if row.get("observations") is not None:
            z = _decode_array(row["observations"]["z"], (-1, 2))
            ids = np.array(row["observations"]["ids"], dtype=int).reshape(len(z))
            told = {
                key: _decode_array(row["observations"][key], shape)
                for key, shape in {
                    "R": (len(z), 2, 2),
                    "bisectors": len(z),
                    "convex": len(z),
                }.items()
                if row["observations"].get(key) is not None
            }
            if "convex" in told:
                told["convex"] = told["convex"] > 0
            observations = Observations(z, ids, **told)
        if row.get("control") is not None:
            control = _decode_array(row["control"], (-1,))
        reading = Reading(
            float(_decode_array([row["time"]], (1,))[0]),
            _decode_array(row["odometry"], (3,)),
            scan,
            observations,
            control,
        )
        true = row.get("truth")
        return (
            reading,
            _decode_array(row["reckoned"], (3,)),
            None if true is None else _decode_array(true, (3,)),
        )


def write(source, path):
    """Write a source's readings as a reading log (file); a name that ends in ``.gz`` is compressed.

    Parameters
    ----------
    source : Source
    path : str or Path

    Returns
    -------
    int, how many readings were written

    Raises
    ------
    SourceError : the file cannot be written
    """
    readings, buffer = iter(source), []
    for reading in readings:
        buffer.append(reading)
        if reading.scan is not None:
            break
    angles = buffer[-1].scan.angles if buffer and buffer[-1].scan is not None else None
    true = (
        {}
        if source.truth is None
        else dict(zip(source.truth.times, source.truth.poses, strict=True))
    )
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
                reckoned = compose(reckoned, reading.odometry)
                row = _encode_reading(reading, angles, reckoned, true.get(reading.time))
                file.write(json.dumps(row, allow_nan=False) + "\n")
    except OSError as error:
        raise SourceError(f"{path} cannot be written: {reason(error)}") from None
    return count


def _encode_reading(reading, angles, reckoned, true):
    row = {
        "time": float(reading.time),
        "odometry": _encode_list(reading.odometry),
        "reckoned": _encode_list(reckoned),
    }
    if reading.scan is not None:
        row["scan"] = _encode_limits(
            {"range_min": reading.scan.range_min, "range_max": reading.scan.range_max}
        ) | {"ranges": _encode_list(reading.scan.ranges)}
        if not np.array_equal(reading.scan.angles, angles):
            row["scan"]["angles"] = _encode_list(reading.scan.angles)
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


def _decode_limit(value):
    return np.inf if value is None else float(value)


def _decode_array(values, shape, gaps=False):
    """Numbers of a JSON list as an array of this shape; null only where gaps are allowed."""
    array = np.array(values, dtype=float).reshape(shape)
    if np.isinf(array).any() or (np.isnan(array).any() and not gaps):
        raise ValueError
    return array
