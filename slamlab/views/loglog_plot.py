"""Log-log plot of how a quantity grows (scaling, complexity): measured and predicted."""

from itertools import cycle

from matplotlib.ticker import NullFormatter, StrMethodFormatter

from slamlab.views.figures import COLOURS, chart

# told apart without colour, too
_MARKERS = [("o", COLOURS["corrected"]), ("s", COLOURS["naive"]), ("^", COLOURS["landmark"])]
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
    for (name, y), (marker, colour) in zip(measured.items(), cycle(_MARKERS), strict=False):
        ax.plot(x, y, linestyle="none", marker=marker, color=colour, label=name)
    for (name, y), line in zip(predicted.items(), cycle(_LINES), strict=False):
        ax.plot(x, y, linestyle=line, color=COLOURS["truth"], label=name)
    # whoever reads off an error wants 20, not 2 × 10¹
    ax.set_xticks(x, labels=[f"{value:g}" for value in x])
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    ax.legend()
    return fig, ax
