"""Plots of matrices: correlation matrices, linked plots with a map, heat maps of shares."""

import numpy as np
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke

from slamlab.views.colours import COLOURS
from slamlab.views.figures import chart, empty, panels
from slamlab.views.layer_drawing import draw

# colour-blind safe and diverging; zero is white
_COLOUR_MAP = "RdBu_r"
_MAX_LABELS = 12  # tick labels on an axis; more are illegible
_SHARES_MAP = "cividis"  # colour-blind safe
_BLACK_TEXT_ABOVE = 0.5  # above this share a cell is light and its number black


def correlation(rho, names, title=None, ax=None, size=(4.8, 4.2)):
    """Draw a correlation matrix, from −1 (blue) through 0 (white) to 1 (red), with block lines.
    Returns (Figure, Axes). Raises ValueError if the number of names does not fit, or numbers are
    not correlations.

    Parameters
    ----------
    rho : (3 + 2N, 3 + 2N), such as ``evaluation.correlation(P)``
    names : 1 + N names of blocks: the robot's three rows, then two a landmark
    title, size : as in ``axes``
    ax : Axes to draw in, or None for a new figure
    """
    rho = np.asarray(rho, dtype=float)
    edges = np.concatenate([[0], 3 + 2 * np.arange(len(names))])
    if rho.shape != (edges[-1], edges[-1]):
        raise ValueError(f"{len(names)} blocks, the first of 3 rows, do not fit {rho.shape}")
    if np.abs(rho).max() > 1 + 1e-9 or not np.isin(np.diag(rho).round(9), (0, 1)).all():
        raise ValueError("these are not correlations: pass evaluation.correlation(P), not P")
    own = ax is None
    if own:
        _, ax = chart(None, None, None, size)
    ax.grid(False)
    ax.imshow(rho, cmap=_COLOUR_MAP, vmin=-1, vmax=1, interpolation="nearest")
    inner = edges[1:-1] - 0.5
    ax.hlines(inner, -0.5, edges[-1] - 0.5, color=COLOURS["guide"], linewidth=0.6)
    ax.vlines(inner, -0.5, edges[-1] - 0.5, color=COLOURS["guide"], linewidth=0.6)
    every = -(-len(names) // _MAX_LABELS)
    middles = (edges[:-1] + edges[1:] - 1) / 2
    ax.set_xticks(middles[::every], labels=names[::every], rotation=90 if len(names) > 6 else 0)
    ax.set_yticks(middles[::every], labels=names[::every])
    ax.tick_params(length=0)
    if own:
        colour_bar(ax)
    if title:
        ax.set_title(title)
    return ax.figure, ax


def correlations(rhos, names, size=(11, 4)):
    """Draw correlation matrices of a growing map side by side, with one colour bar. Returns
    (Figure, list of Axes). Raises ValueError if numbers are not correlations.

    Parameters
    ----------
    rhos : dict, title to (3 + 2N, 3 + 2N)
    names : of the blocks of the largest
    size : as in ``panels``
    """
    fig, all_axes = panels(list(rhos), size, shared=False)
    for ax, rho in zip(all_axes, rhos.values(), strict=True):
        correlation(rho, names[: (len(rho) - 1) // 2], ax=ax)
        ax.set_aspect("equal", adjustable="box")
        ax.set(xlabel=None, ylabel=None)
    colour_bar(all_axes)
    return fig, all_axes


def colour_bar(axes):
    """Add a colour bar for correlation matrices.

    axes : Axes, or a list of them.
    """
    first = np.ravel(axes)[0]
    bar = first.figure.colorbar(first.images[0], ax=axes, shrink=0.8, label="correlation")
    bar.set_ticks([-1, 0, 1])


def linked(landmarks, rho, names, marked=0, layers=(), room=None, view=None, size=(9.5, 4.2)):
    """Draw a map of landmarks and the correlation matrix of [robot, landmarks] on one colour scale.

    A landmark's colour shows its mean correlation (x with x, y with y) with the framed landmark.
    Returns the Figure and its (map, matrix) Axes.

    Parameters
    ----------
    landmarks : (N, 2) [m]
    rho : (3 + 2N, 3 + 2N), such as ``evaluation.correlation(P)``
    names : N
    marked : int, row of landmarks
    layers : more layers for the map
    room : int or None, number of landmarks that the matrix has room for
    view : (x_min, x_max, y_min, y_max) [m], or None for all
    size : as in ``axes``
    """
    fig, (left, right) = panels([None, None], size, shared=False)
    for ax in (left, right):
        ax.set_aspect("equal", adjustable="box")
    for layer in layers:
        draw(left, layer)
    correlation(rho, ["r", *map(str, names)], ax=right)
    (picture,) = right.images
    own = 3 + 2 * marked
    beside = [(rho[own, k] + rho[own + 1, k + 1]) / 2 for k in range(3, len(rho), 2)]
    scale = {"cmap": picture.get_cmap(), "norm": picture.norm}
    left.scatter(
        *landmarks.T, c=beside, s=50, edgecolors=COLOURS["truth"], linewidths=0.7, zorder=3, **scale
    )
    left.scatter(
        *landmarks[marked], s=260, marker="s", facecolors="none", edgecolors=COLOURS["truth"]
    )
    rim = [withStroke(linewidth=2.5, foreground="#FFFFFF")]  # names may overlap ellipses
    for name, position in zip(names, landmarks, strict=True):
        name = left.annotate(str(name), position, xytext=(4, 3), textcoords="offset points")
        name.set(fontsize=9, path_effects=rim)
    if view is not None:
        left.set(xlim=view[:2], ylim=view[2:])
    end = 3 + 2 * (len(names) if room is None else room) - 0.5
    right.set(xlim=(-0.5, end), ylim=(end, -0.5), xlabel="", ylabel="")
    for corner, wide, high in [((-0.5, own - 0.5), len(rho), 2), ((own - 0.5, -0.5), 2, len(rho))]:
        right.add_patch(
            Rectangle(corner, wide, high, fill=False, edgecolor=COLOURS["truth"], linewidth=1.5)
        )
    bar = fig.colorbar(picture, ax=right, shrink=0.8, label="correlation")
    bar.set_ticks([-1, 0, 1])
    return fig, (left, right)


def cells(tables, x, y, xlabel, ylabel, size=(7, 3)):
    """Draw heat maps of tables of shares side by side, on one colour scale from 0 to 100 %. Returns
    (Figure, list of Axes). Raises ValueError if a table has another shape, or numbers are not
    shares.

    Parameters
    ----------
    tables : dict, title to (len(y), len(x)) shares [1]
    x, y : values at the columns and rows
    xlabel, ylabel, size : as in ``chart``
    """
    fig = empty(size)
    all_axes = fig.subplots(1, len(tables), sharey=True, squeeze=False)[0]
    for ax, (title, table) in zip(all_axes, tables.items(), strict=True):
        table = np.asarray(table, dtype=float)
        if table.shape != (len(y), len(x)):
            raise ValueError(f"{title}: expected shape {(len(y), len(x))}, got {table.shape}")
        if not ((table >= 0) & (table <= 1)).all():
            raise ValueError(f"{title}: shares must be between 0 and 1")
        picture = ax.imshow(table, cmap=_SHARES_MAP, vmin=0, vmax=1, origin="lower", aspect="auto")
        for (row, column), share in np.ndenumerate(table):
            ink = "black" if share > _BLACK_TEXT_ABOVE else "white"
            ax.text(column, row, f"{100 * share:.0f}", ha="center", va="center", color=ink)
        ax.set_xticks(range(len(x)), labels=[f"{value:g}" for value in x])
        ax.set_yticks(range(len(y)), labels=[f"{value:g}" for value in y])
        ax.tick_params(length=0)
        ax.set(title=title, xlabel=xlabel)
    all_axes[0].set_ylabel(ylabel)
    bar = fig.colorbar(picture, ax=list(all_axes), label="share [%]")
    bar.set_ticks([0, 0.5, 1], labels=["0", "50", "100"])
    return fig, list(all_axes)
