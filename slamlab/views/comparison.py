"""Comparison plots: ellipses over a scatter plot of samples, line plots, curves against a band."""

from itertools import cycle

import numpy as np
from matplotlib.ticker import MaxNLocator, NullFormatter

from slamlab.displays import grouped_tick
from slamlab.layers import Ellipses, Points
from slamlab.views.colours import COLOURS, SERIES
from slamlab.views.figures import axes, band, chart
from slamlab.views.layer_drawing import draw
from slamlab.views.legends import legend


def cloud(samples, covariances, title=None, size=(6, 4.5), layers=(), centre=None):
    """Scatter plot of samples (a point cloud), and 95 % covariance ellipses.

    Parameters
    ----------
    samples : (n, 2) or wider; the first two columns are x and y [m]
    covariances : dict, name for the legend to (2, 2) or larger [m²]
    title : str or None
    size : (width, height) [80 pixels of the page]
    layers : what else to draw, such as the track driven
    centre : (2,) or longer, of the ellipses, or None for the samples' mean [m]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = axes(title, size)
    xy = np.asarray(samples, dtype=float)[:, :2]
    draw(ax, Points("samples", xy), color=COLOURS["sample"])
    middle = xy.mean(axis=0) if centre is None else np.asarray(centre)[:2]
    for (name, covariance), (colour, line, _) in zip(covariances.items(), cycle(SERIES)):
        ellipse = Ellipses(name, [middle], [np.asarray(covariance)[:2, :2]])
        draw(ax, ellipse, color=colour, linewidth=2, linestyle=line)
    for layer in layers:
        draw(ax, layer, color=COLOURS["truth"])
    legend(ax)
    return fig, ax


def curves(x, ys, xlabel, ylabel, title=None, size=(6, 3.5)):
    """Line plot: curves over the same axis, with a legend.

    Parameters
    ----------
    x : (n,)
    ys : dict, name for the legend to (n,)
    xlabel, ylabel : str, with the unit in brackets
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = chart(xlabel, ylabel, title, size)
    if np.asarray(x).dtype.kind in "iu":
        ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    for (name, y), (colour, line, _) in zip(ys.items(), cycle(SERIES)):
        ax.plot(x, y, color=colour, linestyle=line, linewidth=2, label=name)
    legend(ax)
    return fig, ax


def against_band(x, ys, limits, xlabel, ylabel, title=None, size=(8, 4)):
    """Curves over a logarithmic axis, against the 95 % band that they should stay in, such as NEES.

    Parameters
    ----------
    x : (n,)
    ys : dict, name for the legend to (n,)
    limits : (low, high) of the band
    xlabel, ylabel : str, with the unit in brackets
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = curves(x, ys, xlabel, ylabel, title, size)
    band(ax, *limits, "95 % band")
    ax.set(yscale="log", ylim=(1, 30 * max(map(np.max, ys.values()))))
    ax.yaxis.set_major_formatter(grouped_tick)
    ax.yaxis.set_minor_formatter(NullFormatter())
    legend(ax, loc="upper left", ncols=2)
    return fig, ax
