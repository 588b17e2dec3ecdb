"""Drawing of an estimator's layers: points, paths, covariance ellipses, grids, scan overlays."""

import numpy as np
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.colors import to_rgb
from matplotlib.markers import MarkerStyle
from matplotlib.patches import Ellipse, Rectangle
from matplotlib.path import Path

from slamlab.layers import Boxes, Ellipses, Grid, Particles, Points, Poses, Segments
from slamlab.views.colours import COLOURS, DASHES, in_legends
from slamlab.views.figures import axes, panels
from slamlab.views.legends import legend, legend_below

# 95 % of a Gaussian in the plane lies within this Mahalanobis distance: √χ²(0.95, 2)
SIGMAS_95 = 2.4477
LEVEL = "95 %"  # of confidence ellipses
UNKNOWN_GREY = np.array([0.85, 0.85, 0.85])  # of unknown cells
LANDMARK_SIZE = 10.0  # of a marker, larger than a scan's points
MAX_CELLS = 400  # cells of a grid in a row; larger grids are downsampled
# an arrow head that points along +x
ROBOT_ARROW = Path([(1.0, 0.0), (-0.7, 0.65), (-0.4, 0.0), (-0.7, -0.65), (1.0, 0.0)])


def draw(ax, layer, **style):
    """Draw a layer (points, poses, segments, ellipses, boxes, particles, occupancy grid) on axes.
    Returns a list of artists. Raises TypeError if it is not a layer.

    Parameters
    ----------
    ax : Axes
    layer : of :mod:`slamlab.layers`; its name determines colour, line style and legend entry
    style : as matplotlib's artists take it
    """
    usual = colour(layer)
    function, _ = _KINDS[type(layer)]
    usual = {"color": usual, "label": in_legends(layer.name)}
    if isinstance(layer, Ellipses):
        usual["label"] = with_level(usual["label"])
    if layer.name in DASHES and type(layer) in _OF_LINES:
        usual["linestyle"] = DASHES[layer.name]
    artists = function(ax, layer, usual | style)
    ax.autoscale_view()
    return artists


def with_level(name):
    """Return the legend entry of confidence ellipses with their level."""
    return name if LEVEL in name else f"{name}: {LEVEL} confidence ellipse"


def colour(layer):
    """Return the default colour for a layer's name or kind.

    layer : of :mod:`slamlab.layers`. Returns #RRGGBB. Raises TypeError if it is not a layer.
    """
    if type(layer) not in _KINDS:
        raise TypeError(f"cannot draw {type(layer).__name__}: expected a layer of slamlab.layers")
    _, default = _KINDS[type(layer)]
    return COLOURS.get(layer.name, COLOURS[default])


def side_by_side(layers_by_title, size=(11, 5), shared=True):
    """Draw maps side by side, such as odometry alone and the estimate. Returns (Figure, list of
    Axes).

    Parameters
    ----------
    layers_by_title : dict, title to list of layers, or to dict of the legend's entry to layer
    size, shared : as in ``panels``
    """
    fig, all_axes = panels(list(layers_by_title), size, shared)
    for ax, layers in zip(all_axes, layers_by_title.values(), strict=True):
        named = layers.items() if isinstance(layers, dict) else ((None, x) for x in layers)
        for label, layer in named:
            draw(ax, layer, **({"label": label} if label else {}))
    legend_below(fig)
    return fig, all_axes


def overlay(first, second, pairs=None, title=None, size=(5, 3.8)):
    """Draw two scans with lines between correspondences. Returns (Figure, Axes).

    Parameters
    ----------
    first : (m, 2) reference scan [m]
    second : (n, 2) scan aligned with it [m]
    pairs : (k, 2) int, correspondences: rows of second and of first, or None
    title, size : as in ``axes``
    """
    fig, ax = axes(title, size)
    if pairs is not None:
        lines = np.hstack([second[pairs[:, 0]], first[pairs[:, 1]]])
        draw(ax, Segments("correspondences", lines), linewidth=0.8)
    draw(ax, Points("map", first), label="first scan", markersize=5)
    draw(ax, Points("scan", second), label="second scan", markersize=5)
    legend(ax, loc="upper left")
    return fig, ax


def _points(ax, layer, style):
    xy = np.asarray(layer.xy, dtype=float).reshape(-1, 2)
    # many points are drawn small, so that sharp walls look sharp
    size = 1.5 if len(xy) > 2000 else 3.0
    if layer.name == "landmark":
        size = LANDMARK_SIZE
    return ax.plot(
        *xy.T, **({"linestyle": "none", "marker": ".", "markersize": size, "mew": 0} | style)
    )


def _segments(ax, layer, style):
    ends = np.asarray(layer.rows, dtype=float).reshape(-1, 2, 2)
    return [ax.add_collection(LineCollection(ends, **({"linewidth": 1.5} | style)))]


def _poses(ax, layer, style):
    rows = np.asarray(layer.rows, dtype=float).reshape(-1, 3)
    if not len(rows):
        return []
    x, y, theta = rows[-1]
    label = style.pop("label")
    track = ax.plot(*rows[:, :2].T, **({"linewidth": 1.2, "label": label} | style))
    head = ax.plot(
        [x],
        [y],
        marker=MarkerStyle(ROBOT_ARROW).rotated(rad=theta),
        markersize=12,
        linestyle="none",
        color=style["color"],
        label="_robot" if len(rows) > 1 else label,
    )
    if len(rows) == 1:
        track[0].set_label("_track")
    return [*track, *head]


def _ellipses(ax, layer, style):
    """Draw covariance ellipses (95 %)."""
    patches = []
    for centre, covariance in zip(layer.centres, layer.covariances, strict=True):
        variances, directions = np.linalg.eigh(covariance)
        # rounding may leave a variance slightly below zero
        width, height = 2 * SIGMAS_95 * np.sqrt(np.maximum(variances, 0.0))
        angle = np.degrees(np.arctan2(directions[1, 0], directions[0, 0]))
        patches.append(Ellipse(centre, width, height, angle=angle))
    return _outlined(ax, patches, style)


def _boxes(ax, layer, style):
    rows = np.asarray(layer.rows, dtype=float).reshape(-1, 4)
    boxes = [Rectangle((x0, y0), x1 - x0, y1 - y0) for x0, x1, y0, y1 in rows]
    return _outlined(ax, boxes, style, marker="s")


def _outlined(ax, patches, style, marker=None):
    """Draw outlines, and add the legend entry that collections of patches lack."""
    colour, label = style.pop("color"), style.pop("label")
    outline = {"facecolor": "none", "edgecolor": colour, "linewidth": 1.2} | style
    collection = ax.add_collection(PatchCollection(patches, match_original=False, **outline))
    entry = {"linestyle": style.get("linestyle", "solid"), "marker": marker}
    entry |= {"markersize": 8, "markerfacecolor": "white"}  # distinguishes boxes from ellipses
    return [collection, *ax.plot([], [], color=colour, label=label, **entry)]


def _particles(ax, layer, style):
    rows, weights = np.asarray(layer.rows, dtype=float), np.asarray(layer.weights, dtype=float)
    # a particle of mean weight is as large as a point of a scan; weight 0 stays visible
    areas = 2.0 + 6.0 * weights * len(weights)
    return [
        ax.scatter(rows[:, 0], rows[:, 1], s=areas, **({"linewidths": 0, "alpha": 0.8} | style))
    ]


def _grid(ax, layer, style):
    """Draw an occupancy grid with free cells white and unknown cells grey."""
    p, side = _downsampled(np.asarray(layer.cells, dtype=float), layer.side)
    colour, label = style.pop("color"), style.pop("label")
    towards = np.where(p[..., None] > 0.5, to_rgb(colour), 1.0)
    rgb = UNKNOWN_GREY + np.abs(2 * p[..., None] - 1) * (towards - UNKNOWN_GREY)
    (x, y), (rows, columns) = layer.origin, p.shape
    extent = (x, x + columns * side, y, y + rows * side)
    shown = {"origin": "lower", "extent": extent, "interpolation": "nearest", "zorder": 0} | style
    square = {"marker": "s", "linestyle": "none", "markeredgecolor": COLOURS["walls"], "mew": 0.5}
    return [
        ax.imshow(rgb, **shown),
        *ax.plot([], [], color=colour, label=label, **square),
        *ax.plot([], [], color=tuple(UNKNOWN_GREY), label="unknown", **square),
    ]


def _downsampled(p, side):
    """Downsample by max pooling: occupied cells stay occupied."""
    k = max(1, -(-max(p.shape) // MAX_CELLS))
    rows, columns = (-(-n // k) * k for n in p.shape)
    padded = np.full((rows, columns), 0.5)
    padded[: p.shape[0], : p.shape[1]] = p
    blocks = padded.reshape(rows // k, k, columns // k, k)
    most = blocks.max(axis=(1, 3))
    return np.where(most > 0.5, most, blocks.mean(axis=(1, 3))), k * side


# drawing function and default colour by kind of layer
_KINDS = {
    Points: (_points, "scan"),
    Segments: (_segments, "walls"),
    Poses: (_poses, "corrected"),
    Ellipses: (_ellipses, "landmark"),
    Boxes: (_boxes, "box"),
    Particles: (_particles, "sample"),
    Grid: (_grid, "map"),
}
_OF_LINES = (Segments, Poses, Ellipses, Boxes)
