"""Reading of films (:mod:`slamlab.films.film_file`); what is none or damaged is refused."""

import gzip
import json
import re
import zlib
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.files.text_files import GZIP, read_bytes
from slamlab.films.film_file import FORMAT, VERSION
from slamlab.films.quantising import COLUMNS, restore, unpack
from slamlab.views.live.frame_packing import Drawable

MAX_LINE = 1 << 20  # [bytes] of a header: what has no line end for so long is something else
_COLOUR = re.compile("#[0-9a-fA-F]{6}")


class FilmError(SourceError):
    """File that is no film, a damaged one, or one of another version."""


@dataclass(frozen=True)
class Film:
    """Film that was read from a file; its frames are gone through one by one.

    Parameters
    ----------
    header : dict
    layers : list of (Drawable without rows, steps of its columns)
    records : list, a frame: status line, list of (layer's number, rows to keep, packed rows)
    """

    header: dict
    layers: list
    records: list

    def __len__(self):
        """Number of frames."""
        return len(self.records)

    def __iter__(self):
        """Yield each frame: status line, list of Drawable."""
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

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Film

    Raises
    ------
    SourceError : it cannot be read
    FilmError : it is none, of another version, damaged or cut off: the text says which
    """
    check_header(path)
    content, truncated = read_bytes(path)
    if truncated:
        raise FilmError(f"{path} is damaged or was cut off: fetch it again, or record it anew")
    line, _, rest = content.partition(b"\n")
    header = _header(line, path)
    records, counts, layers, at = [], {}, [], 0
    while at < len(rest):
        try:
            record, counts, at = _record(rest, at, layers, counts)
        except (ValueError, TypeError, KeyError, AttributeError, IndexError, RecursionError):
            where = f"frame {len(records) + 1}"
            raise FilmError(f"{path}: {where} is damaged: record it anew") from None
        records.append(record)
    if not records:
        raise FilmError(f"{path} is a film without frames: record it anew")
    return Film(header, layers, records)


def check_header(path):
    """Check that a file begins as a film does, without reading more of it; errors as :func:`load`.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    dict, the header
    """
    if Path(path).is_dir():
        raise FilmError(f"{path} is a folder: name a film in it")
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
        read_bytes(path)  # says what is wrong with it
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
            f"{path} is no film: `slamlab run SOURCE --film FILE` records one"
        ) from None
    if version != VERSION:
        raise FilmError(f"{path} is of version {version}, this slamlab reads {VERSION}: update it")
    try:
        texts = all(isinstance(header[name], str) for name in ("title", "alt"))
        wide, high = header["size"]
        sound = texts and wide > 0 and high > 0 and header["radius"] >= 0
    except (ValueError, TypeError, KeyError):
        sound = False
    if not sound:
        raise FilmError(f"{path}: its header is damaged: record it anew")
    return header


def _record(data, at, layers, before):
    """Frame at a place of the file, how many rows each of its layers has, and the next place."""
    end = data.index(b"\n", at)
    line, at = json.loads(data[at:end]), end + 1
    layers += [_layer(told) for told in line.get("layers", [])]
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


def _layer(told):
    """Drawable without rows, and the steps of its columns."""
    kind, scale = told["kind"], [float(step) for step in told["steps"]]
    name, colour = str(told["name"]), str(told["colour"])
    sound = all(0 < step < np.inf for step in scale) and _COLOUR.fullmatch(colour)
    if len(scale) != len(COLUMNS[kind]) or not sound:
        raise ValueError
    return Drawable(kind, name, colour, np.empty((0, len(scale))), str(told["panel"])), scale
