"""Schematic drawings: coordinate frames, an encoder, bits of bytes, a resampling wheel."""

from itertools import cycle

import numpy as np
from matplotlib.patches import Arc, Circle, Rectangle, Wedge

from slamlab.views.colours import COLOURS, SERIES
from slamlab.views.figures import axes, chart, empty
from slamlab.views.legends import legend_below

BARRIER = np.pi / 2  # direction of an encoder's light barrier [rad]
_SHADES = ("#9AD0F5", "#F5D49A")  # of weights; neighbours differ in lightness as well


def frames(pose, landmark):
    """Draw the coordinate frames of world and robot, and a landmark's range and bearing. Returns a
    Figure.

    Parameters
    ----------
    pose : (3,) of the robot [m, m, rad]
    landmark : (2,) [m]
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
        # arrows do not extend the axis limits
        ax.plot(*tip, alpha=0)
    ax.plot(x, y, "o", color=colour)
    beside = {"xytext": (-8, -4), "textcoords": "offset points", "ha": "right"}
    ax.annotate(name, (x, y), color=colour, **beside)


def _angle(ax, x, y, radius, start, end, name, colour):
    low, high = np.degrees([start, end])
    ax.add_patch(Arc((x, y), 2 * radius, 2 * radius, theta1=low, theta2=high, color=colour, lw=1.5))
    middle = (start + end) / 2
    position = (x + 1.12 * radius * np.cos(middle), y + 1.12 * radius * np.sin(middle))
    ax.annotate(name, position, ha="center", va="center", fontsize="large")


def encoder(slots, turned, size=(9, 3.6)):
    """Draw a wheel's encoder: its disc, and its pulses since the wheel began to turn. Returns a
    Figure.

    Parameters
    ----------
    slots : int, ticks of a revolution
    turned : float, rotation from 0 to 2π [rad]
    size : as in ``axes``
    """
    fig = empty(size)
    disc, pulses = fig.subplots(1, 2, width_ratios=(1, 2))
    _draw_disc(disc, slots, turned)
    at = np.linspace(0, 2 * np.pi, 2000)
    light = np.mod(at * slots / (2 * np.pi), 1) < 0.5
    pulses.plot(np.degrees(at), light, color=COLOURS["guide"], linewidth=1, label="pulses to come")
    past = at <= turned
    seen = {"color": COLOURS["scan"], "linewidth": 2, "label": "pulses measured"}
    pulses.plot(np.degrees(at[past]), light[past], **seen)
    ticks = int(turned * slots / (2 * np.pi))
    pulses.set(xlim=(0, 360), ylim=(-0.2, 1.3), yticks=(0, 1), yticklabels=("dark", "light"))
    pulses.set_xlabel("turn of the wheel [degrees]")
    title = f"{ticks} ticks counted: {360 * ticks / slots:.0f}° of {np.degrees(turned):.0f}°"
    pulses.set_title(title)
    legend_below(fig)
    return fig


def _draw_disc(ax, slots, turned):
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.add_patch(Circle((0, 0), 1, facecolor=COLOURS["guide"], edgecolor=COLOURS["truth"]))
    width = 180 / slots  # of a slot, and of the gap between two [degree]
    for slot in range(slots):
        first = np.degrees(BARRIER + turned) - 2 * slot * width - width
        ax.add_patch(Wedge((0, 0), 0.92, first, first + width, width=0.3, facecolor="white"))
    ax.plot(0, 0.77, "o", color=COLOURS["scan"], markersize=9)
    ax.annotate("light barrier", (0, 0.77), (0, 1.15), ha="center", color=COLOURS["truth"])
    ax.plot(0, 0, "o", color=COLOURS["truth"])
    ax.set(xlim=(-1.15, 1.15), ylim=(-1.15, 1.35))


def bits(data, fields, marked=None, title=None, size=(8, 3.4)):
    """Draw bytes as rows of bits, most significant bit first, coloured by field. Returns (Figure,
    Axes).

    Parameters
    ----------
    data : bytes, one for each row
    fields : dict, name for the legend to list of (byte, bit); at most four names
    marked : (byte, bit) to frame, or None
    title, size : as in ``axes``
    """
    fig = empty(size)
    ax = fig.subplots()
    for (name, positions), (colour, *_) in zip(fields.items(), SERIES, strict=False):
        for k, (byte, bit) in enumerate(positions):
            label = name if k == 0 else None
            square = Rectangle((7 - bit, byte), 0.94, 0.88, color=colour, label=label)
            ax.add_patch(square)
    for byte, value in enumerate(data):
        for bit in range(8):
            ax.text(7.47 - bit, byte + 0.46, value >> bit & 1, color="w", ha="center", va="center")
    if marked is not None:
        byte, bit = marked
        frame = Rectangle((6.95 - bit, byte - 0.06), 1.04, 1.0, fill=False, linewidth=3)
        ax.add_patch(frame)
    ax.set(xlim=(-0.1, 8.1), ylim=(len(data), -0.15), xlabel="bit", title=title)
    ax.set_xticks([7.47 - bit for bit in range(8)], range(8))
    rows = [f"byte {k}: {value:02x}" for k, value in enumerate(data)]
    ax.set_yticks([k + 0.46 for k in range(len(data))], rows)
    ax.tick_params(length=0)
    ax.spines[:].set_visible(False)
    ax.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return fig, ax


def wheel(weights, picks, title=None, size=(7, 2.4)):
    """Draw an unrolled resampling wheel: weights end to end on [0, 1], and the sampled positions.
    Returns (Figure, Axes).

    Parameters
    ----------
    weights : (n,) that sum to one
    picks : dict, name of a row to (k,) positions
    title, size : as in ``axes``
    """
    fig, ax = chart("weights, end to end [1]", None, title, size)
    ax.grid(False)
    edges = np.concatenate([[0.0], np.cumsum(weights)])
    rows = len(picks)
    for k, (left, width, shade) in enumerate(zip(edges, weights, cycle(_SHADES), strict=False)):
        ax.barh(0, width, 0.6, left, color=shade, edgecolor=COLOURS["truth"], linewidth=0.6)
        if width > 0.03:
            ax.text(left + width / 2, 0, str(k), ha="center", va="center", fontsize=9)
    for row, positions in zip(range(rows, 0, -1), picks.values(), strict=True):
        ax.vlines(positions, -0.3, row - 0.1, color=COLOURS["guide"], linewidth=0.6)
        colour = COLOURS["corrected"] if row == rows else COLOURS["naive"]
        ax.plot(positions, np.full(len(positions), row), "v", color=colour, markersize=7)
    ax.set_yticks([*range(rows, 0, -1), 0], labels=[*picks, "particle"])
    ax.set(xlim=(0, 1), ylim=(-0.45, rows + 0.5))
    return fig, ax
