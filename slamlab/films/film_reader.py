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
    """Film that was read from a file.

    Parameters
    ----------
    header : dict
    frames : list of (status, list of Drawable)
    """

    header: dict
    frames: list


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
    frames, before, layers, at = [], {}, [], 0
    while at < len(rest):
        try:
            (status, shown), before, at = _frame(rest, at, layers, before)
        except (ValueError, TypeError, KeyError, IndexError, RecursionError):
            raise FilmError(f"{path}: frame {len(frames) + 1} is damaged: record it anew") from None
        frames.append((status, shown))
    if not frames:
        raise FilmError(f"{path} is a film without frames: record it anew")
    return Film(header, frames)


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
    return header


def _frame(data, at, layers, before):
    """Frame at a place of the file, the rows of its layers by number, and the next one's place."""
    end = data.index(b"\n", at)
    line, at = json.loads(data[at:end]), end + 1
    layers += [_layer(told) for told in line.get("layers", [])]
    shown, now = [], {}
    for number, keep, follow in line["rows"]:
        layer, scale = layers[number]
        old = before.get(number, layer.rows)
        size = 2 * follow * len(scale)
        if not 0 <= keep <= len(old) or follow < 0 or number < 0 or at + size > len(data):
            raise ValueError
        new = restore(unpack(data[at : at + size], len(scale)), scale)
        now[number] = np.concatenate([old[:keep], new])
        shown.append(replace(layer, rows=now[number]))
        at += size
    return (str(line["status"]), shown), now, at


def _layer(told):
    """Drawable without rows, and the steps of its columns."""
    kind, scale = told["kind"], [float(step) for step in told["steps"]]
    name, colour = str(told["name"]), str(told["colour"])
    sound = all(0 < step < np.inf for step in scale) and _COLOUR.fullmatch(colour)
    if len(scale) != len(COLUMNS[kind]) or not sound:
        raise ValueError
    return Drawable(kind, name, colour, np.empty((0, len(scale))), str(told["panel"])), scale
