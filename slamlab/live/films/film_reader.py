"""Reader of film files, with checks for damage."""

import gzip
import json
import re
import zlib
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from slamlab.files import GZIP, SourceError, read_bytes
from slamlab.live.films.film_file import FORMAT, VERSION
from slamlab.live.films.quantising import COLUMNS, restore, unpack
from slamlab.live.frame_packing import Drawable

MAX_LINE = 1 << 20  # [bytes] of a header; a longer first line is not a film
_COLOUR = re.compile("#[0-9a-fA-F]{6}")


class FilmError(SourceError):
    """The file is not a film, is damaged, or has another version."""


@dataclass(frozen=True)
class Film:
    """Film; iteration yields each frame's status line and list of Drawable.

    Parameters
    ----------
    header : dict
    layers : list of (Drawable without rows, steps of its columns)
    records : list of (status line, list of (layer's number, rows to keep, packed rows))
    """

    header: dict
    layers: list
    records: list

    def __len__(self):
        return len(self.records)

    def __iter__(self):
        before = {}
        for status, entries in self.records:
            now = {}
            for number, keep, data in entries:
                added = unpack(data, len(self.layers[number][1]))
                now[number] = np.concatenate([before[number][:keep], added]) if keep else added
            before = now
            yield status, [self._shown(number, whole) for number, whole in now.items()]

    def _shown(self, number, whole):
        layer, steps = self.layers[number]
        return replace(layer, rows=restore(whole, steps))


def load(path):
    """Load a film.

    Raises
    ------
    SourceError : the file cannot be read
    FilmError

    path : str or Path. Returns a Film.
    """
    check_header(path)
    content, truncated = read_bytes(path)
    if truncated:
        raise FilmError(f"{path} is damaged or incomplete. Copy the film again, or record it again")
    line, _, rest = content.partition(b"\n")
    header = _header(line, path)
    records, counts, layers, at = [], {}, [], 0
    while at < len(rest):
        try:
            record, counts, at = _record(rest, at, layers, counts)
        except (ValueError, TypeError, KeyError, AttributeError, IndexError, RecursionError):
            where = f"frame {len(records) + 1}"
            raise FilmError(f"{path}: {where} is damaged. Record the film again") from None
        records.append(record)
    if not records:
        raise FilmError(f"{path} is a film without frames. Record the film again")
    return Film(header, layers, records)


def check_header(path):
    """Return a film's header (dict) without reading the frames; see :func:`load` for errors."""
    if Path(path).is_dir():
        raise FilmError(f"{path} is a folder. Name a film in it")
    try:
        with open(path, "rb") as file:
            packed = file.read(2) == GZIP
        line = b""
        if packed:
            with closing(gzip.open(path)) as film:
                line = film.readline(MAX_LINE)
    except (EOFError, zlib.error, gzip.BadGzipFile):
        line = b""
    except OSError:
        read_bytes(path)  # raises a clear error
        raise
    return _header(line, path)


def _header(line, path):
    try:
        header = json.loads(line)
        version = header["version"]
        if header["format"] != FORMAT:
            raise ValueError
    except (ValueError, TypeError, KeyError, RecursionError):
        raise FilmError(
            f"{path} is not a film. Record one with `slamlab run SOURCE --film FILE`"
        ) from None
    if version != VERSION:
        raise FilmError(
            f"{path} has version {version}; this slamlab reads version {VERSION}. Update slamlab"
        )
    try:
        texts = all(isinstance(header[name], str) for name in ("title", "alt"))
        wide, high = header["size"]
        valid = texts and wide > 0 and high > 0 and header["radius"] >= 0
    except (ValueError, TypeError, KeyError):
        valid = False
    if not valid:
        raise FilmError(f"{path}: its header is damaged. Record the film again")
    return header


def _record(data, at, layers, before):
    """Return the frame at an offset, the numbers of rows of its layers, and the next offset."""
    end = data.index(b"\n", at)
    line, at = json.loads(data[at:end]), end + 1
    layers += [_layer(declared) for declared in line.get("layers", [])]
    entries, counts = [], {}
    for number, keep, follow in line["rows"]:
        size = 2 * follow * len(layers[number][1])
        fits = 0 <= keep <= before.get(number, 0) and follow >= 0 and at + size <= len(data)
        if not fits or number < 0 or number in counts:
            raise ValueError
        entries.append((number, keep, data[at : at + size]))
        counts[number] = keep + follow
        at += size
    return (str(line["status"]), entries), counts, at


def _layer(declared):
    kind, scale = declared["kind"], [float(step) for step in declared["steps"]]
    name, colour = str(declared["name"]), str(declared["colour"])
    valid = all(0 < step < np.inf for step in scale) and _COLOUR.fullmatch(colour)
    if len(scale) != len(COLUMNS[kind]) or not valid:
        raise ValueError
    return Drawable(kind, name, colour, np.empty((0, len(scale))), str(declared["panel"])), scale
