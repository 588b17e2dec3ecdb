"""Plot of the resampling wheel: importance weights end to end, and the positions drawn."""

from itertools import cycle

import numpy as np

from slamlab.views.colours import COLOURS
from slamlab.views.figures import chart

_SHADES = ("#9AD0F5", "#F5D49A")  # neighbours differ in lightness, too


def wheel(weights, picks, title=None, size=(7, 2.4)):
    """Draw a resampling wheel, unrolled: weights as bars on [0, 1], rows of markers that pick.

    Parameters
    ----------
    weights : (n,) that sum to one
    picks : dict, name of a row to (k,) positions from 0 to 1
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
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
    ax.set_yticks([*range(rows, 0, -1), 0], labels=[*picks, "sample"])
    ax.set(xlim=(0, 1), ylim=(-0.45, rows + 0.5))
    return fig, ax
