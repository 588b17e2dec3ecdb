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
-32 768 stands for what is not finite. Kinds of layers and their columns are those of
:class:`slamlab.views.live.frame_packing.Drawable`.
"""

import json

from slamlab.films.quantising import pack, quantise, steps
from slamlab.views.live.frame_packing import keyed, rows_in_common

FORMAT, VERSION = "slamlab film", 1  # of the header


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


def _line(content):
    text = json.dumps(content, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode() + b"\n"
