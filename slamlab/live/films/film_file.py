"""File format of films, compressed by gzip: a header line; for each frame, a line and numbers.

Lines are JSON in UTF-8. The header has ``format`` "slamlab film"; ``version`` 1; ``title``,
``alt``; ``size`` [width, height] [pixels]; ``radius`` of the robot [m]. A frame's line contains

- ``status``: str, one line
- ``layers``, only if some are new: numbered from 0 in their order, each with ``kind``, ``name``,
  ``colour`` (#rrggbb), ``panel`` and ``steps``, a step for each column of its rows; a layer that
  needs larger steps is declared again
- ``rows``: a list [layer, keep, follow] for each layer shown, in drawing order: the first ``keep``
  rows of the last frame are kept, and ``follow`` rows are added

The added rows of all layers follow in drawing order, as 16-bit multiples of the steps
(``quantising``), in 2 · follow · width bytes per layer. They are stored as differences down the
columns, column after column: first all low bytes, then all high bytes. -32 768 represents
non-finite values. Kinds and their columns are those of
:class:`slamlab.live.frame_packing.Drawable`.
"""

import json

from slamlab.live.films.quantising import pack, quantise, steps
from slamlab.live.frame_packing import keyed, rows_in_common

FORMAT, VERSION = "slamlab film", 1  # of the header


def header_line(title, alt, size, radius):
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
    """Incremental encoder of frames: kept rows are not written again."""

    def __init__(self):
        self._layers = {}  # by key: number, declaration
        self._before = {}  # by number: rows of the last frame, int16
        self._count = 0

    def encode(self, scene):
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
        """Return the number and declaration of a layer, declared again if it needs larger steps."""
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


def _line(content):
    text = json.dumps(content, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode() + b"\n"
