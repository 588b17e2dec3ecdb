"""File format of films: gzip around a header line and, for each frame, a line and its numbers.

Lines are JSON in UTF-8, without line breaks inside. The header line has

- ``format``: "slamlab film"; ``version``: 1
- ``title``, ``alt``: str; ``size``: [width, height] of the picture [pixels]; ``radius`` of the
  robot [m]

A frame's line has

- ``status``: str, one line to be shown
- ``layers``: list of the layers that are new, only where some are. Layers are numbered from 0 as
  they come: each is named once, with its ``kind``, ``name``, ``colour`` (#rrggbb), ``panel`` and
  ``steps``, a step for each column of its rows. One that needs larger steps is named again.
- ``rows``: a list [layer, keep, follow] for each layer shown, in the order they are drawn: of the
  rows that the layer had in the frame before (none, if it was not shown) the first ``keep`` stay,
  ``follow`` rows are added

and after its line come the rows that follow, of all layers in that order, as 16-bit integers:
multiples of the layer's steps (:mod:`slamlab.films.quantising`). Of each layer, 2 · follow · width
bytes: the differences down the columns, column after column, all low bytes, then all high ones;
-32768 stands for what is not finite. Kinds of layers and their columns are those of
:class:`slamlab.views.live.frame_packing.Drawable`.
"""

import gzip
import json
import zlib
from contextlib import closing
from dataclasses import dataclass, replace

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.files.text_files import GZIP, read_bytes
from slamlab.films.quantising import COLUMNS, pack, quantise, restore, steps, unpack
from slamlab.views.live.frame_packing import Drawable, keyed, rows_in_common

FORMAT, VERSION = "slamlab film", 1  # of the header
MAX_LINE = 1 << 20  # [bytes] of a header: what has no line end for so long is something else


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


def header_line(title, alt, size, radius):
    """Encode the header: the first line of a film, bytes."""
    width, height = map(int, size)
    return _line(
        {
            "format": FORMAT,
            "version": VERSION,
            "title": title,
            "alt": alt,
            "size": [width, height],
            "radius": float(radius),
        }
    )


class FrameEncoder:
    """Incremental (delta) encoder of a film's frames: rows that stay are not written again."""

    def __init__(self):
        self._layers = {}  # by key: number, declaration
        self._before = {}  # by number: rows of the frame before, int16
        self._count = 0

    def encode(self, scene):
        """Encode the next frame: its line and its numbers.

        Parameters
        ----------
        scene : Scene

        Returns
        -------
        bytes
        """
        fresh, entries, pieces, now = [], [], [], {}
        for key, drawable in keyed(scene.drawables):
            number, layer = self._declared(key, drawable, fresh)
            whole = quantise(drawable.kind, drawable.rows, layer["steps"])
            keep = rows_in_common(self._before.get(number, whole[:0]), whole)
            entries.append([number, keep, len(whole) - keep])
            pieces.append(pack(whole[keep:]))
            now[number] = whole
        self._before = now
        new = {"layers": fresh} if fresh else {}
        return _line({"status": scene.status, **new, "rows": entries}) + b"".join(pieces)

    def _declared(self, key, drawable, fresh):
        """Number and declaration of a layer, declared anew where it has outgrown its steps."""
        number, known = self._layers.get(key, (None, None))
        layer = {
            "kind": drawable.kind,
            "name": drawable.name,
            "colour": drawable.colour,
            "panel": drawable.panel,
            "steps": steps(drawable.kind, drawable.rows, known and known["steps"]),
        }
        if layer != known:
            number, self._count = self._count, self._count + 1
            self._layers[key] = number, layer
            fresh.append(layer)
        return number, layer


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
    if len(scale) != len(COLUMNS[kind]):
        raise ValueError
    names = (str(told[name]) for name in ("name", "colour"))
    return Drawable(kind, *names, np.empty((0, len(scale))), str(told["panel"])), scale


def _line(content):
    text = json.dumps(content, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode() + b"\n"
