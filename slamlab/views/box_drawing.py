"""Plots for set-membership estimation (BOR): sectors, half-planes, intervals."""

import numpy as np
from matplotlib.patches import Polygon, Wedge

from slamlab.views.colours import COLOURS
from slamlab.views.figures import axes, chart
from slamlab.views.legends import legend

# distinguishable without colour
_EDGE_STYLES = {
    "far": (COLOURS["corrected"], "solid"),
    "near": (COLOURS["naive"], "dashed"),
    "left": (COLOURS["landmark"], "dashdot"),
    "right": (COLOURS["robot"], "dotted"),
}
SHADED_SHARE = 0.08  # width of an edge's shaded side, as a share of the figure [1]
HALF_LENGTH = 100.0  # of the line of an edge, from its foot point [m]


def scene(title, window, size=(5, 4.2)):
    """Create a map with a fixed window (x_min, x_max, y_min, y_max) [m]; return (Figure, Axes)."""
    fig, ax = axes(title, size)
    ax.set_aspect("equal", adjustable="box")
    ax.set(xlim=window[:2], ylim=window[2:])
    return fig, ax


def sector(ax, origin, ranges, angles, label=None, **style):
    """Draw the sector between two ranges (near, far) [m] and two bearings (right, left) [rad];
    return a Wedge.
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
    """Draw the edges of half-planes a x + b y ≤ c and shade their infeasible sides; return a list
    of Line2D. ``names`` are far, near, left or right.
    """
    lines, strip_width = [], SHADED_SHARE * np.ptp(ax.get_ylim())
    for (a, b, c), name in zip(half_planes, names, strict=True):
        colour, dash = _EDGE_STYLES[name]
        foot_point, along = c * np.array([a, b]), np.array([-b, a])
        lines.append(
            ax.axline(foot_point, foot_point + along, color=colour, linestyle=dash, label=name)
        )
        ends = np.array([foot_point - HALF_LENGTH * along, foot_point + HALF_LENGTH * along])
        strip = np.concatenate([ends, ends[::-1] + strip_width * np.array([a, b])])
        shade = Polygon(strip, facecolor=colour, alpha=0.15, linewidth=0)
        ax.add_artist(shade)  # an artist does not change the axis limits, a patch does
        shade.set_clip_path(ax.patch)
    return lines


def directions(ax, origin, angles, radius, label=None, **style):
    """Draw an interval of directions (right, left) [rad]; return a Wedge."""
    return sector(ax, origin, (0.0, radius), angles, label, **style)


def intervals(rows, truth, xlabel, ylabel, title=None, last=1, size=(6, 4)):
    """Draw an interval plot of the truth and ``rows``, {name: (low, high)}; the last rows are
    results.
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
