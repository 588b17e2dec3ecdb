"""Sketch of coordinate frames, range and bearing: the conventions, drawn to scale."""

import numpy as np
from matplotlib.patches import Arc

from slamlab.views.colours import COLOURS
from slamlab.views.figures import axes


def frames(pose, landmark):
    """Draw the coordinate frames of world and robot, and a landmark's range and bearing.

    Parameters
    ----------
    pose : (3,) of the robot [m, m, rad]
    landmark : (2,) [m]

    Returns
    -------
    Figure
    """
    fig, ax = axes("Frames and angles", size=(7, 5))
    x, y, theta = pose
    dx, dy = landmark[0] - x, landmark[1] - y
    direction = np.arctan2(dy, dx)

    _axes_of_frame(ax, 0, 0, 0, "world", COLOURS["truth"])
    _axes_of_frame(ax, x, y, theta, "robot", COLOURS["corrected"])
    ax.plot([x, x + 1.6], [y, y], ":", color=COLOURS["guide"])
    ax.plot([x, landmark[0]], [y, landmark[1]], "--", color=COLOURS["scan"])
    ax.plot(*landmark, "*", color=COLOURS["landmark"], markersize=14)
    ax.annotate("landmark p", landmark, xytext=(8, 4), textcoords="offset points")
    ax.annotate(
        "range r",
        ((x + landmark[0]) / 2, (y + landmark[1]) / 2),
        xytext=(-10, 12),
        textcoords="offset points",
        ha="right",
    )
    _angle(ax, x, y, 1.5, 0, theta, "θ", COLOURS["corrected"])
    _angle(ax, x, y, 2.0, theta, direction, "β", COLOURS["scan"])
    ax.margins(0.12)
    return fig


def _axes_of_frame(ax, x, y, theta, name, colour):
    for turn, axis in ((0, "x"), (np.pi / 2, "y")):
        tip = (x + np.cos(theta + turn), y + np.sin(theta + turn))
        ax.annotate("", tip, (x, y), arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2})
        ax.annotate(axis, tip, xytext=(5, 3), textcoords="offset points", color=colour)
        # arrows alone do not widen the view
        ax.plot(*tip, alpha=0)
    ax.plot(x, y, "o", color=colour)
    beside = {"xytext": (-8, -4), "textcoords": "offset points", "ha": "right"}
    ax.annotate(name, (x, y), color=colour, **beside)


def _angle(ax, x, y, radius, start, end, name, colour):
    low, high = np.degrees([start, end])
    ax.add_patch(Arc((x, y), 2 * radius, 2 * radius, theta1=low, theta2=high, color=colour, lw=1.5))
    middle = (start + end) / 2
    place = (x + 1.12 * radius * np.cos(middle), y + 1.12 * radius * np.sin(middle))
    ax.annotate(name, place, ha="center", va="center", fontsize="large")
