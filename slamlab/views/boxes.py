"""What a bounded filter looks at: the sector a sighting leaves, its edges, and angles."""

import numpy as np
from matplotlib.patches import Polygon, Wedge

from slamlab.views.figures import COLOURS, axes, chart

# told apart without colour, too
_EDGES = {
    "far": (COLOURS["corrected"], "solid"),
    "near": (COLOURS["naive"], "dashed"),
    "left": (COLOURS["landmark"], "dashdot"),
    "right": (COLOURS["robot"], "dotted"),
}
STRIP = 0.08  # how wide the shaded side of an edge is, as a share of the picture
FAR = 100.0  # an edge is a line: this long [m]


def scene(title, window, size=(5, 4.2)):
    """A figure with one map that shows a part of the plane, whatever is drawn in it.

    Parameters
    ----------
    title : str or None
    window : (x_min, x_max, y_min, y_max) [m]
    size : (width, height) [inch]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = axes(title, size)
    ax.set_aspect("equal", adjustable="box")
    ax.set(xlim=window[:2], ylim=window[2:])
    return fig, ax


def sector(ax, origin, ranges, angles, label=None, **style):
    """A piece of a ring: all that is seen at some ranges and angles from one point.

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
    """Lines with their forbidden sides shaded.

    Parameters
    ----------
    ax : Axes
    half_planes : (a, b, c) each, allowed where a x + b y ≤ c
    names : str each: far, near, left or right

    Returns
    -------
    list of Line2D
    """
    lines, strip_width = [], STRIP * np.ptp(ax.get_ylim())
    for (a, b, c), name in zip(half_planes, names, strict=True):
        colour, dash = _EDGES[name]
        foot, along = c * np.array([a, b]), np.array([-b, a])
        lines.append(ax.axline(foot, foot + along, color=colour, linestyle=dash, label=name))
        ends = np.array([foot - FAR * along, foot + FAR * along])
        strip = np.concatenate([ends, ends[::-1] + strip_width * np.array([a, b])])
        shade = Polygon(strip, facecolor=colour, alpha=0.15, linewidth=0)
        ax.add_artist(shade)  # an artist leaves the limits alone, a patch does not
        shade.set_clip_path(ax.patch)
    return lines


def directions(ax, origin, angles, radius, label=None, **style):
    """An interval of angles as a slice of a pie.

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
    """Intervals one above the other, the last of them set off, and the truth through them all.

    Parameters
    ----------
    rows : {name: (low, high)}, from the top down
    truth : float
    xlabel, ylabel : str, with the unit in brackets
    title : str or None
    last : int, how many at the bottom are drawn as results
    size : (width, height) [inch]

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
    ax.legend(loc="upper right")
    return fig, ax
