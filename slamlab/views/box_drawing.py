"""Plots for the bounded filter (BOR): sectors, half-planes, angle intervals, interval plot."""

import numpy as np
from matplotlib.patches import Polygon, Wedge

from slamlab.views.colours import COLOURS
from slamlab.views.figures import axes, chart
from slamlab.views.legends import legend

# told apart without colour, too
_EDGE_STYLES = {
    "far": (COLOURS["corrected"], "solid"),
    "near": (COLOURS["naive"], "dashed"),
    "left": (COLOURS["landmark"], "dashdot"),
    "right": (COLOURS["robot"], "dotted"),
}
SHADED_SHARE = 0.08  # width of an edge's shaded side, as a share of the figure [1]
HALF_LENGTH = 100.0  # of the line that an edge is drawn as, from its foot [m]


def scene(title, window, size=(5, 4.2)):
    """Figure with one map whose window (axis limits) stays, whatever is drawn in it.

    Parameters
    ----------
    title : str or None
    window : (x_min, x_max, y_min, y_max) [m]
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = axes(title, size)
    ax.set_aspect("equal", adjustable="box")
    ax.set(xlim=window[:2], ylim=window[2:])
    return fig, ax


def sector(ax, origin, ranges, angles, label=None, **style):
    """Draw a sector of a ring: all points at an interval of ranges and of bearings from one point.

    Parameters
    ----------
    ax : Axes
    origin : (2,) [m]
    ranges : (near, far) [m]
    angles : (right, left), counter-clockwise [rad]
    label : str or None, for the legend
    style : what matplotlib's patches take

    Returns
    -------
    Wedge
    """
    near, far = ranges
    usual = {"facecolor": COLOURS["scan"], "edgecolor": COLOURS["scan"], "alpha": 0.35}
    wedge = Wedge(
        origin, far, *np.degrees(angles), width=far - near, label=label, **(usual | style)
    )
    ax.add_patch(wedge)
    ax.autoscale_view()
    return wedge


def edges(ax, half_planes, names):
    """Draw the edges of half-planes (linear constraints), their forbidden sides shaded.

    Parameters
    ----------
    ax : Axes
    half_planes : (a, b, c) each, allowed where a x + b y ≤ c
    names : str each: far, near, left or right

    Returns
    -------
    list of Line2D
    """
    lines, strip_width = [], SHADED_SHARE * np.ptp(ax.get_ylim())
    for (a, b, c), name in zip(half_planes, names, strict=True):
        colour, dash = _EDGE_STYLES[name]
        foot, along = c * np.array([a, b]), np.array([-b, a])
        lines.append(ax.axline(foot, foot + along, color=colour, linestyle=dash, label=name))
        ends = np.array([foot - HALF_LENGTH * along, foot + HALF_LENGTH * along])
        strip = np.concatenate([ends, ends[::-1] + strip_width * np.array([a, b])])
        shade = Polygon(strip, facecolor=colour, alpha=0.15, linewidth=0)
        ax.add_artist(shade)  # an artist leaves the limits alone, a patch does not
        shade.set_clip_path(ax.patch)
    return lines


def directions(ax, origin, angles, radius, label=None, **style):
    """Draw an angle interval (directions) as a slice of a pie.

    Parameters
    ----------
    ax : Axes
    origin : (2,) [m]
    angles : (right, left), counter-clockwise [rad]
    radius : float [m]
    label : str or None, for the legend
    style : what matplotlib's patches take

    Returns
    -------
    Wedge
    """
    return sector(ax, origin, (0.0, radius), angles, label, **style)


def intervals(rows, truth, xlabel, ylabel, title=None, last=1, size=(6, 4)):
    """Interval plot: intervals one above the other, the last set off, and the truth through all.

    Parameters
    ----------
    rows : {name: (low, high)}, from the top down
    truth : float
    xlabel, ylabel : str, with the unit in brackets
    title : str or None
    last : int, how many at the bottom are drawn as results
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = chart(xlabel, ylabel, title, size)
    heights = -np.arange(len(rows))
    for height, (low, high) in zip(heights, rows.values(), strict=True):
        result = -height >= len(rows) - last
        colour = COLOURS["corrected"] if result else COLOURS["scan"]
        ax.plot([low, high], [height, height], color=colour, linewidth=6 if result else 3)
    ax.axvline(truth, color=COLOURS["truth"], linestyle="dashed", label="truth")
    ax.set_yticks(heights, labels=list(rows))
    legend(ax)
    return fig, ax
