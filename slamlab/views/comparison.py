"""Charts for comparison: scatter, line, log-log, forest and strip plots, and a band."""

from itertools import cycle

import numpy as np
from matplotlib.ticker import MaxNLocator, NullFormatter, PercentFormatter

from slamlab.layers import Ellipses, Points
from slamlab.views.colours import COLOURS, SERIES
from slamlab.views.figures import axes, band, chart
from slamlab.views.layer_drawing import draw
from slamlab.views.legends import legend
from slamlab.views.notebook_output import grouped_tick

TICKS_APART = 0.09  # minimum distance of two labels, as a fraction of the axis
HALF_HEIGHT = 0.3  # of a strip; its values are spread over it in their order
_LINES = [":", "--", "-."]


def cloud(samples, covariances, title=None, size=(6, 4.5), layers=(), centre=None):
    """Draw a scatter plot of samples with 95 % confidence ellipses. Returns (Figure, Axes).

    Parameters
    ----------
    samples : (n, 2) or wider; x and y come first [m]
    covariances : dict, name for the legend to (2, 2) or larger [m²]
    title, size : as in ``axes``
    layers : more layers to draw
    centre : (2,) or longer, of the ellipses [m]; None for the mean of the samples
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
    """Draw a line plot of curves with a common x axis and a legend. Returns (Figure, Axes).

    Parameters
    ----------
    x : (n,)
    ys : dict, name for the legend to (n,)
    xlabel, ylabel, title, size : as in ``chart``
    """
    fig, ax = chart(xlabel, ylabel, title, size)
    if np.asarray(x).dtype.kind in "iu":
        ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    for (name, y), (colour, line, _) in zip(ys.items(), cycle(SERIES)):
        ax.plot(x, y, color=colour, linestyle=line, linewidth=2, label=name)
    legend(ax)
    return fig, ax


def against_band(x, ys, limits, xlabel, ylabel, title=None, size=(8, 4)):
    """Draw curves, such as NEES, on a logarithmic axis with their 95 % χ² interval. Returns
    (Figure, Axes).

    Parameters
    ----------
    x, ys, xlabel, ylabel, title, size : as in :func:`curves`
    limits : (low, high) of the interval
    """
    fig, ax = curves(x, ys, xlabel, ylabel, title, size)
    band(ax, *limits, "95 % χ² interval")
    ax.set(yscale="log", ylim=(1, 30 * max(map(np.max, ys.values()))))
    ax.yaxis.set_major_formatter(grouped_tick)
    ax.yaxis.set_minor_formatter(NullFormatter())
    legend(ax, loc="upper left", ncols=2)
    return fig, ax


def growth(x, measured, predicted, xlabel, ylabel, title=None, size=(6, 4)):
    """Draw a log-log plot with measurements as markers and predictions as lines. Returns (Figure,
    Axes).

    Parameters
    ----------
    x : (n,)
    measured, predicted : dict, name for the legend to (n,)
    xlabel, ylabel, title, size : as in ``chart``
    """
    fig, ax = chart(xlabel, ylabel, title, size)
    ax.set(xscale="log", yscale="log")
    for (name, y), (colour, _, marker) in zip(measured.items(), cycle(SERIES), strict=False):
        ax.plot(x, y, linestyle="none", marker=marker, color=colour, label=name)
    for (name, y), line in zip(predicted.items(), cycle(_LINES), strict=False):
        ax.plot(x, y, linestyle=line, color=COLOURS["truth"], label=name)
    # labels such as 20, not 2 × 10¹
    ax.set_xticks(x, labels=_labels(x))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.yaxis.set_major_formatter(grouped_tick)
    legend(ax)
    return fig, ax


def _labels(x):
    apart, last, labels = TICKS_APART * np.ptp(np.log(x)), -np.inf, []
    for position, value in zip(np.log(x), x, strict=True):
        labels.append(f"{value:g}" if position - last >= apart else "")
        last = position if labels[-1] else last
    return labels


def shares(rows, xlabel, title=None, size=(7, 3.2)):
    """Draw a forest plot of proportions with their confidence intervals. Returns (Figure, Axes).

    Parameters
    ----------
    rows : dict, name for the legend to dict, label of a row to (share, low, high); all with equal
        labels
    xlabel, title, size : as in ``chart``
    """
    fig, ax = chart(xlabel, "", title, size)
    labels = list(next(iter(rows.values())))
    apart = 0.5 / len(rows)  # series share a row
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


def strips(rows, limits, span, xlabel, title=None, size=(8, 3.8)):
    """Draw a strip plot on a logarithmic axis with limits: a strip for each group, a dot for each
    value. Returns (Figure, Axes).

    Parameters
    ----------
    rows : dict, name of a strip to (name of a colour, (n,) values above 0)
    limits : dict, name for the legend to a value
    span : (low, high) of the axis
    xlabel, title, size : as in ``chart``
    """
    fig, ax = chart(xlabel, "", title, size)
    for row, (name, values) in enumerate(rows.values()):
        up = row + np.linspace(-HALF_HEIGHT, HALF_HEIGHT, len(values))
        ax.plot(values, up, ".", color=COLOURS[name], markersize=7)
    for label, limit in limits.items():
        ax.axvline(limit, color=COLOURS["limit"], linestyle="dashdot", label=label)
    ax.set_yticks(range(len(rows)), rows)
    ax.set(xscale="log", xlim=span, ylim=(-2 * HALF_HEIGHT, len(rows) - 1 + 2 * HALF_HEIGHT))
    ax.xaxis.set_major_formatter(grouped_tick)
    legend(ax)
    return fig, ax
