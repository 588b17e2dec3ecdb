"""Frame packing (binary serialisation): layers as a JSON header and float32 bytes."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from matplotlib.colors import to_hex

from slamlab.layers import (
    OCCUPIED,
    Boxes,
    Ellipses,
    Grid,
    Layer,
    Particles,
    Points,
    Poses,
    Segments,
)
from slamlab.views.colours import COLOURS
from slamlab.views.layer_drawing import SIGMAS_95, colour

# kinds that are not the class's name; occupied cells of a grid are drawn as points
KINDS = {Grid: "points", Particles: "samples"}


@dataclass(frozen=True)
class Drawable:
    """A layer as a table of float32 rows [m, rad]; colour as #rrggbb. By ``kind``: points x y;
    segments x1 y1 x2 y2; poses x y θ; ellipses x y, half axes a b, direction of a; boxes x_min
    x_max y_min y_max; samples x y weight·n; curve time value [s, any], in a ``panel`` below the
    map.
    """

    kind: str
    name: str
    colour: str
    rows: np.ndarray
    panel: str = ""


@dataclass(frozen=True)
class Scene:
    """Content of a frame: layers, curves and status line of one moment. ``radius`` is the robot's
    radius [m]. If ``run`` changes, the view is fitted again. ``colours`` replace the default
    colours. ``curves`` maps a panel's title to {line's name: (n, 2) time [s] and value}.
    """

    layers: list[Layer]
    status: str = ""
    radius: float = 0.15
    run: int = 0
    colours: dict | None = None
    curves: dict = field(default_factory=dict)

    @cached_property
    def drawables(self):
        """Return a list of Drawable: layers, then curves. TypeError: an item is not a layer."""
        layers = [self._drawable(layer) for layer in self.layers]
        lines = ((panel, *line) for panel, named in self.curves.items() for line in named.items())
        return layers + [
            Drawable("curve", name, self.line_colour(name), _table(values, 2), panel)
            for panel, name, values in lines
        ]

    def line_colour(self, name):
        """Return the colour (#rrggbb) of the layer with that name."""
        return to_hex((self.colours or {}).get(name, COLOURS.get(name, COLOURS["corrected"])))

    def _drawable(self, layer):
        usual = colour(layer)
        shown = to_hex((self.colours or {}).get(layer.name, usual))
        kind = KINDS.get(type(layer), type(layer).__name__.lower())
        return Drawable(kind, layer.name, shown, rows(layer))


def rows(layer):
    """Return the table of a layer, (n, width) float32. TypeError: the object is not a layer."""
    match layer:
        case Points():
            return _table(layer.xy, 2)
        case Segments() | Boxes():
            return _table(layer.rows, 4)
        case Poses():
            return _table(layer.rows, 3)
        case Ellipses():
            return _ellipses(_table(layer.centres, 2), np.asarray(layer.covariances, dtype=float))
        case Particles():
            weights = np.asarray(layer.weights, dtype=float)
            xy = np.asarray(layer.rows, dtype=float)[:, :2]
            return _table(np.column_stack([xy, weights * len(weights)]), 3)
        case Grid():
            row, column = np.nonzero(np.asarray(layer.cells) > OCCUPIED)
            return _table(layer.origin + layer.side * (np.column_stack([column, row]) + 0.5), 2)
    raise TypeError(f"cannot pack {type(layer).__name__}: expected a layer of slamlab.layers")


def _table(values, width):
    return np.asarray(values, dtype=np.float32).reshape(-1, width)


def _ellipses(centres, covariances):
    if not len(centres):
        return np.empty((0, 5), np.float32)
    variances, directions = np.linalg.eigh(covariances)
    # rounding may leave a variance slightly below zero
    half = SIGMAS_95 * np.sqrt(np.maximum(variances, 0.0))
    angle = np.arctan2(directions[:, 1, 0], directions[:, 0, 0])
    return _table(np.column_stack([centres, half, angle]), 5)


def keyed(drawables):
    """Return a list of (key, drawable); the key identifies a layer in the next frame."""
    found = {}
    for drawable in drawables:
        key = f"{drawable.kind} {drawable.panel} {drawable.name}"
        while key in found:
            key += "'"
        found[key] = drawable
    return list(found.items())


def rows_in_common(old, new):
    """Return the length of the longest common prefix of two tables."""
    shorter = min(len(old), len(new))
    differs = (old[:shorter] != new[:shorter]).any(axis=1)
    return int(differs.argmax()) if differs.any() else shorter


def pack_frame(scene, packer, sent, drawn):
    """Pack a scene as header (dict) and rows (bytes); ``sent`` and ``drawn`` are frame numbers."""
    layers, rows = packer.pack(scene.drawables)
    header = {
        "kind": "frame",
        "number": sent,
        "behind": sent - drawn,
        "run": scene.run,
        "status": scene.status,
        "radius": scene.radius,
        "layers": layers,
    }
    return header, rows


class FramePacker:
    """Incremental encoder for one screen, which receives all frames in order."""

    def __init__(self):
        self._sent_rows = {}

    def reset(self):
        self._sent_rows = {}

    def pack(self, drawables):
        """Pack drawables as a list of dict, and their new rows as bytes (float32, little-endian). A
        layer consists of the first ``keep`` rows that the screen has under the layer's key, and of
        ``follow`` new rows.
        """
        sent, entries, pieces = {}, [], []
        for key, drawable in keyed(drawables):
            keep = rows_in_common(self._sent_rows.get(key, drawable.rows[:0]), drawable.rows)
            pieces.append(drawable.rows[keep:].astype("<f4", order="C").tobytes())
            entries.append(
                {
                    "key": key,
                    "kind": drawable.kind,
                    "name": drawable.name,
                    "colour": drawable.colour,
                    "panel": drawable.panel,
                    "width": drawable.rows.shape[1],
                    "keep": keep,
                    "follow": len(drawable.rows) - keep,
                }
            )
            sent[key] = drawable.rows
        self._sent_rows = sent
        return entries, b"".join(pieces)
