"""Confidence-interval plot (forest plot): shares with error bars, a row each."""

import numpy as np
from matplotlib.ticker import PercentFormatter

from slamlab.views.colours import SERIES
from slamlab.views.figures import chart
from slamlab.views.legends import legend


def shares(rows, xlabel, title=None, size=(7, 3.2)):
    """Forest plot: shares (proportions) as markers, their confidence intervals as error bars.

    Parameters
    ----------
    rows : dict, name for the legend to dict, label of a row to (share, low, high); the same labels
        for every name
    xlabel : str
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = chart(xlabel, "", title, size)
    labels = list(next(iter(rows.values())))
    apart = 0.5 / len(rows)  # names share a row
    for k, ((name, of), (colour, _, marker)) in enumerate(zip(rows.items(), SERIES, strict=False)):
        share, low, high = np.array([of[label] for label in labels], dtype=float).T
        y = np.arange(len(labels)) + (k - (len(rows) - 1) / 2) * apart
        ax.errorbar(
            share,
            y,
            xerr=[share - low, high - share],
            fmt=marker,
            color=colour,
            capsize=3,
            label=name,
        )
    ax.set_yticks(range(len(labels)), labels)
    ax.set(xlim=(-0.02, 1.02), ylim=(len(labels) - 0.5, -0.5))
    ax.xaxis.set_major_formatter(PercentFormatter(1.0, symbol=" %"))
    if len(rows) > 1:
        legend(ax)
    return fig, ax
