"""Process diagram: boxes and data flow."""

from dataclasses import dataclass

import numpy as np
from matplotlib.patches import FancyBboxPatch

from slamlab.views.colours import COLOURS
from slamlab.views.figures import empty
from slamlab.views.legends import legend_below

PAD = 0.06  # rounding of a box's corners [80 pixels of the page]
FONT_SIZE = 10  # [pt]
# kind of a box: frame colour, line style, background, legend entry
KINDS = {
    "device": (COLOURS["scan"], "solid", "#FFF6E0", "device"),
    "step": (COLOURS["truth"], "solid", "#FFFFFF", "function"),
    "kept": (COLOURS["corrected"], "solid", "#E3EFF8", "kept for the next step"),
    "lost": (COLOURS["limit"], "dashdot", "#FFFFFF", "forgotten"),
}


@dataclass(frozen=True)
class Box:
    """A box of a process diagram.

    Parameters
    ----------
    kind : str, one of KINDS
    text : str, in lines
    x, y : float, centre, from the lower left [80 pixels]
    width, height : float [80 pixels]
    """

    kind: str
    text: str
    x: float
    y: float
    width: float = 1.5
    height: float = 0.7

    def reach(self, axis):
        middle, size = ((self.x, self.width), (self.y, self.height))[axis]
        return middle - size / 2, middle + size / 2


def process(boxes, flows, size=(11, 5)):
    """Draw a process diagram; arrows are straight between boxes that face each other. Returns a
    Figure.

    Parameters
    ----------
    boxes : dict, name to Box
    flows : list of (from, to, text); "=" before a name marks a box that is read and written
    size : as in ``axes``
    """
    fig = empty(size)
    ax = fig.subplots()
    ax.set(xlim=(0, size[0]), ylim=(0, size[1]))
    ax.set_axis_off()
    for box in boxes.values():
        _draw_box(ax, box)
    for start, end, text in flows:
        _draw_flow(ax, boxes[start.removeprefix("=")], boxes[end], text, start.startswith("="))
    legend_below(fig)
    return fig


def _draw_box(ax, box):
    frame, dash, background, label = KINDS[box.kind]
    corner = box.x - box.width / 2 + PAD, box.y - box.height / 2 + PAD
    sides = box.width - 2 * PAD, box.height - 2 * PAD
    style = {"boxstyle": f"round,pad={PAD}", "edgecolor": frame, "facecolor": background}
    style |= {"linestyle": dash, "linewidth": 1.8, "label": label}
    ax.add_patch(FancyBboxPatch(corner, *sides, **style))
    ax.text(box.x, box.y, box.text, ha="center", va="center", fontsize=FONT_SIZE, linespacing=1.25)


def _draw_flow(ax, a, b, text, both):
    start, end = _ends(a, b)
    arrow = {"arrowstyle": "<|-|>" if both else "-|>", "shrinkA": 0, "shrinkB": 0, "lw": 1.2}
    ax.annotate("", end, start, arrowprops=arrow | {"color": COLOURS["truth"]})
    upright = abs(end[0] - start[0]) < abs(end[1] - start[1])
    at = (np.add(start, end) / 2) + ((0.15, 0) if upright else (0, 0.06))
    sides = ("left", "center") if upright else ("center", "bottom")
    ax.text(*at, text, ha=sides[0], va=sides[1], fontsize=FONT_SIZE, linespacing=1.15)


def _ends(a, b):
    start, end = np.empty(2), np.empty(2)
    for axis in (0, 1):
        (low, high), (least, most) = a.reach(axis), b.reach(axis)
        if max(low, least) < min(high, most):
            start[axis] = end[axis] = (max(low, least) + min(high, most)) / 2
        else:
            start[axis], end[axis] = (high, least) if high <= least else (low, most)
    return start, end
