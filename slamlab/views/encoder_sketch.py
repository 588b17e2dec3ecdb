"""Sketch of a wheel's encoder: a disc with slots, a light barrier, and the pulses it counts."""

import numpy as np
from matplotlib.patches import Circle, Wedge

from slamlab.views.colours import COLOURS
from slamlab.views.figures import empty

BARRIER = np.pi / 2  # where the light barrier looks at the disc [rad]


def encoder(slots, turned, size=(9, 3.6)):
    """Draw an encoder: its disc as it stands now, and the pulses since the wheel began to roll.

    Parameters
    ----------
    slots : int, ticks of a whole turn
    turned : float, how far the wheel has turned, from 0 to a whole turn [rad]
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    Figure
    """
    fig = empty(size)
    disc, pulses = fig.subplots(1, 2, width_ratios=(1, 2))
    _draw_disc(disc, slots, turned)
    at = np.linspace(0, 2 * np.pi, 2000)
    light = np.mod(at * slots / (2 * np.pi), 1) < 0.5
    pulses.plot(np.degrees(at), light, color=COLOURS["guide"], linewidth=1)
    past = at <= turned
    pulses.plot(np.degrees(at[past]), light[past], color=COLOURS["scan"], linewidth=2)
    ticks = int(turned * slots / (2 * np.pi))
    pulses.set(xlim=(0, 360), ylim=(-0.2, 1.3), yticks=(0, 1), yticklabels=("dark", "light"))
    pulses.set_xlabel("turn of the wheel [degrees]")
    told = f"{ticks} ticks counted: {360 * ticks / slots:.0f}° of {np.degrees(turned):.0f}°"
    pulses.set_title(told)
    return fig


def _draw_disc(ax, slots, turned):
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.add_patch(Circle((0, 0), 1, facecolor=COLOURS["guide"], edgecolor=COLOURS["truth"]))
    width = 180 / slots  # of a slot, and of what stands between two [degree]
    for slot in range(slots):
        first = np.degrees(BARRIER + turned) - 2 * slot * width - width
        ax.add_patch(Wedge((0, 0), 0.92, first, first + width, width=0.3, facecolor="white"))
    ax.plot(0, 0.77, "o", color=COLOURS["scan"], markersize=9)
    ax.annotate("light barrier", (0, 0.77), (0, 1.15), ha="center", color=COLOURS["truth"])
    ax.plot(0, 0, "o", color=COLOURS["truth"])
    ax.set(xlim=(-1.15, 1.15), ylim=(-1.15, 1.35))
