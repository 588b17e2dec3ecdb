"""Strip plot (dot plot): how values of several groups spread over a logarithmic axis."""

import numpy as np

from slamlab.displays import grouped_tick
from slamlab.views.colours import COLOURS
from slamlab.views.figures import chart
from slamlab.views.legends import legend

HIGH = 0.3  # of a strip: its values are drawn apart by this much to either side, in their order


def strips(rows, limits, span, xlabel, title=None, size=(8, 3.8)):
    """Strip plot: a dot a value, a strip a group, over a logarithmic axis, with limits across.

    Parameters
    ----------
    rows : dict, what the strip is called to (name of a colour, (n,) values above 0)
    limits : dict, name for the legend to a value
    span : (low, high) of the axis
    xlabel : str, with the unit in brackets
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = chart(xlabel, "", title, size)
    for row, (name, values) in enumerate(rows.values()):
        up = row + np.linspace(-HIGH, HIGH, len(values))
        ax.plot(values, up, ".", color=COLOURS[name], markersize=7)
    for label, limit in limits.items():
        ax.axvline(limit, color=COLOURS["limit"], linestyle="dashdot", label=label)
    ax.set_yticks(range(len(rows)), rows)
    ax.set(xscale="log", xlim=span, ylim=(-2 * HIGH, len(rows) - 1 + 2 * HIGH))
    ax.xaxis.set_major_formatter(grouped_tick)
    legend(ax)
    return fig, ax
