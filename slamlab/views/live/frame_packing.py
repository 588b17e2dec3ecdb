"""Frame packing (serialisation): layers as a JSON header and one piece of float32 bytes."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from matplotlib.colors import to_hex

from slamlab.layers import OCCUPIED, Boxes, Ellipses, Grid, Layer, Points, Poses, Samples, Segments
from slamlab.views.colours import COLOURS
from slamlab.views.layer_drawing import SIGMAS_95, colour


@dataclass(frozen=True)
class Drawable:
    """A layer as a table of float32 rows, ready to be drawn or sent.

    Parameters
    ----------
    kind : str, name of the layer's class in small letters
    name : str, for the legend
    colour : str, #rrggbb
    rows : (n, width) float32 [m, rad]: points x y; segments x1 y1 x2 y2; poses x y θ; ellipses
        x y, half axes a b, direction of a; boxes x_min x_max y_min y_max; samples x y weight·n;
        curves time value [s, any]
    panel : str, title of the panel below the map that a curve stands in
    """

    kind: str
    name: str
    colour: str
    rows: np.ndarray
    panel: str = ""


@dataclass(frozen=True)
class Scene:
    """Scene: all layers, curves and the status line of one moment, the content of a frame.

    Parameters
    ----------
    layers : list of Layer
    status : str, one line
    radius : float, of the robot [m]
    run : int, another number for another run: the view is fitted anew
    colours : dict or None, name to colour where it is not the usual one
    curves : dict, title of a panel to a dict of a line's name to (n, 2) time [s] and value
    """

    layers: list[Layer]
    status: str = ""
    radius: float = 0.15
    run: int = 0
    colours: dict | None = None
    curves: dict = field(default_factory=dict)

    @cached_property
    def drawables(self):
        """List of Drawable, layers, then curves; a TypeError where something is no layer."""
        layers = [self._drawable(layer) for layer in self.layers]
        lines = ((panel, *line) for panel, named in self.curves.items() for line in named.items())
        return layers + [
            Drawable("curve", name, self.line_colour(name), _table(values, 2), panel)
            for panel, name, values in lines
        ]

    def line_colour(self, name):
        """Colour of a curve (#rrggbb): that of the layer of its name."""
        return to_hex((self.colours or {}).get(name, COLOURS.get(name, COLOURS["corrected"])))

    def _drawable(self, layer):
        usual = colour(layer)
        shown = to_hex((self.colours or {}).get(layer.name, usual))
        # the walls of a grid are shown as the points in their cells' middles
        kind = "points" if isinstance(layer, Grid) else type(layer).__name__.lower()
        return Drawable(kind, layer.name, shown, rows(layer))


def rows(layer):
    """Convert a layer to its table of numbers (an occupancy grid to points), see :class:`Drawable`.

    Parameters
    ----------
    layer : Layer

    Returns
    -------
    (n, width) float32

    Raises
    ------
    TypeError : when it is no layer
    """
    match layer:
        case Points():
            return _table(layer.xy, 2)
        case Segments() | Boxes():
            return _table(layer.rows, 4)
        case Poses():
            return _table(layer.rows, 3)
        case Ellipses():
            return _ellipses(_table(layer.centres, 2), np.asarray(layer.covariances, dtype=float))
        case Samples():
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
    """Centres, half axes of the 95 % ellipses, direction of the first axis."""
    if not len(centres):
        return np.empty((0, 5), np.float32)
    variances, directions = np.linalg.eigh(covariances)
    # rounding may leave a variance a hair below zero
    half = SIGMAS_95 * np.sqrt(np.maximum(variances, 0.0))
    angle = np.arctan2(directions[:, 1, 0], directions[:, 0, 0])
    return _table(np.column_stack([centres, half, angle]), 5)


def keyed(drawables):
    """List of (key, drawable): by its key a layer is found again in the next frame."""
    found = {}
    for drawable in drawables:
        key = f"{drawable.kind} {drawable.panel} {drawable.name}"
        while key in found:
            key += "'"
        found[key] = drawable
    return list(found.items())


def rows_in_common(old, new):
    """Number of rows at the beginning in which two tables are equal (longest common prefix)."""
    shorter = min(len(old), len(new))
    differs = (old[:shorter] != new[:shorter]).any(axis=1)
    return int(differs.argmax()) if differs.any() else shorter


def pack_frame(scene, packer, sent, drawn):
    """Pack a scene as a frame, as a live feed takes it (``player/live_feed.js``).

    Parameters
    ----------
    scene : Scene
    packer : FramePacker of the screen
    sent, drawn : int, numbers of this frame and of the last one that was drawn

    Returns
    -------
    (dict, bytes) : header and rows
    """
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
    """Incremental (delta) encoder of frames for one screen: rows it already has are not sent again.

    Frames must arrive in order and all of them, which a comm of Jupyter guarantees.
    """

    def __init__(self):
        self._sent_rows = {}

    def reset(self):
        """Forget what was sent: the screen is a new one and gets whole frames."""
        self._sent_rows = {}

    def pack(self, drawables):
        """Pack a frame: the difference from what the screen has to these layers and no others.

        Parameters
        ----------
        drawables : list of Drawable

        Returns
        -------
        (list of dict, bytes) : per layer its key, kind, name, colour, panel, width of a row, how
            many rows to keep of those that the screen has under this key and how many follow; the
            following rows of all layers, float32 little-endian, in the same order
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
