"""Plot of a correlation matrix (matrix plot, heat map) with its blocks marked and named."""

import numpy as np

from slamlab.views.colours import COLOURS
from slamlab.views.figures import chart, panels

# ends that stay apart with any kind of colour vision; nothing is white
_COLOUR_MAP = "RdBu_r"
_MAX_LABELS = 12  # tick labels; more on an axis cannot be read


def correlation(rho, names, title=None, ax=None, size=(4.8, 4.2)):
    """Draw a correlation matrix from −1 (blue) over 0 (white) to 1 (red), lines between blocks.

    Parameters
    ----------
    rho : (3 + 2N, 3 + 2N) correlations, such as ``evaluation.correlation(P)``
    names : 1 + N names of the blocks, the robot's (three rows) before the landmarks' (two each)
    title : str or None
    ax : Axes to draw in, or None for a figure of its own
    size : (width, height) of that figure [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)

    Raises
    ------
    ValueError : names that do not fit, or numbers that are no correlations
    """
    rho = np.asarray(rho, dtype=float)
    edges = np.concatenate([[0], 3 + 2 * np.arange(len(names))])
    if rho.shape != (edges[-1], edges[-1]):
        raise ValueError(f"{len(names)} blocks, the first of 3 rows, do not fill {rho.shape}")
    if np.abs(rho).max() > 1 + 1e-9 or not np.isin(np.diag(rho).round(9), (0, 1)).all():
        raise ValueError("these are no correlations: give evaluation.correlation(P), not P")
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
    """Draw correlation matrices side by side, of a map that grows, with one colour bar for all.

    Parameters
    ----------
    rhos : dict, title to (3 + 2N, 3 + 2N) correlations
    names : names of the blocks of the largest; a smaller one has the first of them
    size : (width, height) of the whole figure [80 pixels of the page]

    Returns
    -------
    (Figure, list of Axes)

    Raises
    ------
    ValueError : numbers that are no correlations
    """
    fig, all_axes = panels(list(rhos), size, shared=False)
    for ax, rho in zip(all_axes, rhos.values(), strict=True):
        correlation(rho, names[: (len(rho) - 1) // 2], ax=ax)
        ax.set_aspect("equal", adjustable="box")
        ax.set(xlabel=None, ylabel=None)
    colour_bar(all_axes)
    return fig, all_axes


def colour_bar(axes):
    """Colour bar of correlation matrices, beside the axes that they are drawn in.

    Parameters
    ----------
    axes : Axes, or a list of them
    """
    first = np.ravel(axes)[0]
    bar = first.figure.colorbar(first.images[0], ax=axes, shrink=0.8, label="correlation")
    bar.set_ticks([-1, 0, 1])
