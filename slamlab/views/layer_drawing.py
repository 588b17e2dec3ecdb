"""Drawing of an estimator's layers: scan, track, occupancy grid, covariance ellipse, samples."""

import numpy as np
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.colors import to_rgb
from matplotlib.markers import MarkerStyle
from matplotlib.patches import Ellipse, Rectangle
from matplotlib.path import Path

from slamlab.layers import Boxes, Ellipses, Grid, Points, Poses, Samples, Segments
from slamlab.views.colours import COLOURS, DASHES, in_legends
from slamlab.views.figures import panels
from slamlab.views.legends import legend_below

# 95 % of a Gaussian in the plane lies within this Mahalanobis distance: √χ²(0.95, 2)
SIGMAS_95 = 2.4477
UNKNOWN_GREY = np.array([0.85, 0.85, 0.85])  # the grey of cells of which nothing is known
LANDMARK_SIZE = 10.0  # of a marker: landmarks are few among a scan's points
MAX_CELLS = 400  # cells of a grid in a row; of more a figure would lose some
# an arrow head that points along +x
ROBOT_ARROW = Path([(1.0, 0.0), (-0.7, 0.65), (-0.4, 0.0), (-0.7, -0.65), (1.0, 0.0)])


def draw(ax, layer, **style):
    """Draw a layer (points, poses, segments, ellipses, boxes, samples, occupancy grid) on axes.

    Parameters
    ----------
    ax : Axes
    layer : a layer of :mod:`slamlab.layers`; its name gives colour, dash and the legend's entry
    style : what matplotlib's artists take, such as ``color``, ``label``, ``alpha``

    Returns
    -------
    list of the artists drawn

    Raises
    ------
    TypeError : when it is no layer
    """
    usual = colour(layer)
    function, _ = _KINDS[type(layer)]
    usual = {"color": usual, "label": in_legends(layer.name)}
    if layer.name in DASHES and type(layer) in _OF_LINES:
        usual["linestyle"] = DASHES[layer.name]
    artists = function(ax, layer, usual | style)
    ax.autoscale_view()
    return artists


def colour(layer):
    """Default colour of a layer: that of its name, else that of its kind.

    Parameters
    ----------
    layer : a layer of :mod:`slamlab.layers`

    Returns
    -------
    str, #RRGGBB

    Raises
    ------
    TypeError : when it is no layer
    """
    if type(layer) not in _KINDS:
        raise TypeError(f"cannot draw {type(layer).__name__}: expected a layer of slamlab.layers")
    _, default = _KINDS[type(layer)]
    return COLOURS.get(layer.name, COLOURS[default])


def side_by_side(layers_by_title, size=(11, 5), shared=True):
    """Maps side by side for comparison, such as that of odometry alone beside a corrected one.

    Parameters
    ----------
    layers_by_title : dict, title to list of layers, or to dict of what the legend says to layer
    size : (width, height) of the whole figure [80 pixels of the page]
    shared : bool, whether all show the same part of the plane

    Returns
    -------
    (Figure, list of Axes)
    """
    fig, all_axes = panels(list(layers_by_title), size, shared)
    for ax, layers in zip(all_axes, layers_by_title.values(), strict=True):
        named = layers.items() if isinstance(layers, dict) else ((None, x) for x in layers)
        for label, layer in named:
            draw(ax, layer, **({"label": label} if label else {}))
    legend_below(fig)
    return fig, all_axes


def _points(ax, layer, style):
    xy = np.asarray(layer.xy, dtype=float).reshape(-1, 2)
    # many points: small, so that what is sharp looks sharp
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
    """Covariance ellipses of 95 %: half axes from eigenvalues, directions from eigenvectors."""
    patches = []
    for centre, covariance in zip(layer.centres, layer.covariances, strict=True):
        variances, directions = np.linalg.eigh(covariance)
        # rounding may leave a variance a hair below zero
        width, height = 2 * SIGMAS_95 * np.sqrt(np.maximum(variances, 0.0))
        angle = np.degrees(np.arctan2(directions[1, 0], directions[0, 0]))
        patches.append(Ellipse(centre, width, height, angle=angle))
    return _outlined(ax, patches, style)


def _boxes(ax, layer, style):
    rows = np.asarray(layer.rows, dtype=float).reshape(-1, 4)
    return _outlined(ax, [Rectangle((x0, y0), x1 - x0, y1 - y0) for x0, x1, y0, y1 in rows], style)


def _outlined(ax, patches, style):
    """Outlines with one entry in the legend; collections of patches have none of their own."""
    colour, label = style.pop("color"), style.pop("label")
    outline = {"facecolor": "none", "edgecolor": colour, "linewidth": 1.2} | style
    collection = ax.add_collection(PatchCollection(patches, match_original=False, **outline))
    dash = style.get("linestyle", "solid")
    return [collection, *ax.plot([], [], color=colour, label=label, linestyle=dash)]


def _samples(ax, layer, style):
    rows, weights = np.asarray(layer.rows, dtype=float), np.asarray(layer.weights, dtype=float)
    # the mean sample is as large as a dot of a scan; zero weight would vanish
    areas = 2.0 + 6.0 * weights * len(weights)
    return [
        ax.scatter(rows[:, 0], rows[:, 1], s=areas, **({"linewidths": 0, "alpha": 0.8} | style))
    ]


def _grid(ax, layer, style):
    """Occupancy grid: free cells white, unknown ones grey, occupied ones in the layer's colour."""
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
    """Downsample a grid (max pooling) that has too many cells to see: occupied stays occupied."""
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
    Samples: (_samples, "sample"),
    Grid: (_grid, "map"),
}
_OF_LINES = (Segments, Poses, Ellipses, Boxes)
