"""Log-log plot of how a quantity grows (scaling, complexity): measured and predicted."""

from itertools import cycle

import numpy as np
from matplotlib.ticker import NullFormatter

from slamlab.displays import grouped_tick
from slamlab.views.colours import COLOURS, SERIES
from slamlab.views.figures import chart
from slamlab.views.legends import legend

TICKS_APART = 0.09  # least distance of two labels, as a share of the axis
_LINES = [":", "--", "-."]


def growth(x, measured, predicted, xlabel, ylabel, title=None, size=(6, 4)):
    """Log-log plot: measurements as markers, predictions as lines; a power law is a straight line.

    Parameters
    ----------
    x : (n,)
    measured, predicted : dict, name for the legend to (n,)
    xlabel, ylabel : str, with the unit in brackets
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = chart(xlabel, ylabel, title, size)
    ax.set(xscale="log", yscale="log")
    for (name, y), (colour, _, marker) in zip(measured.items(), cycle(SERIES), strict=False):
        ax.plot(x, y, linestyle="none", marker=marker, color=colour, label=name)
    for (name, y), line in zip(predicted.items(), cycle(_LINES), strict=False):
        ax.plot(x, y, linestyle=line, color=COLOURS["truth"], label=name)
    # whoever reads off an error wants 20, not 2 × 10¹
    ax.set_xticks(x, labels=_labels(x))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.yaxis.set_major_formatter(grouped_tick)
    legend(ax)
    return fig, ax


def _labels(x):
    """Labels of ticks, empty where the one before is too near on a logarithmic axis."""
    apart, last, labels = TICKS_APART * np.ptp(np.log(x)), -np.inf, []
    for place, value in zip(np.log(x), x, strict=True):
        labels.append(f"{value:g}" if place - last >= apart else "")
        last = place if labels[-1] else last
    return labels
