"""Layout of successive pictures: axes keep their positions while all elements fit.

With this layout, nothing jumps while a slider moves, and the costly computation is done only once.
"""

import numpy as np

from slamlab.views.figure_layout import lay_out

KEPT = 3  # layouts: before titles are wrapped, after it, with legends below
SLACK = 1.5  # by which words may reach further than they did, or axes be elsewhere [pixels]


class SteadyLayout:
    """Callable(Figure) that lays out a figure like an earlier one if all elements fit.

    Use one layout for figures that are drawn by the same function.
    """

    def __init__(self):
        self._known = []  # (what a figure needed, the places of its axes), the last one first

    def __call__(self, fig):
        """Set the positions of a figure's axes."""
        for needed, places in self._known:
            if len(places) == len(fig.axes) and self._suits(fig, needed, places):
                return
        for ax in fig.axes:
            ax.set_in_layout(True)
        lay_out(fig)
        self._known = [(_needs(fig), list(map(_place, fig.axes))), *self._known[: KEPT - 1]]

    def _suits(self, fig, needed, places):
        for ax, (original, active, anchor, aspect) in zip(fig.axes, places, strict=True):
            ax.set_anchor(anchor)
            ax.set_box_aspect(aspect)
            ax.set_position(original, which="original")
            ax.set_position(active, which="active")
        (beyond, rooms), (beyond_then, rooms_then) = _needs(fig), needed
        return (
            beyond.shape == beyond_then.shape
            and (beyond <= beyond_then + SLACK).all()
            and np.allclose(rooms, rooms_then, rtol=0, atol=SLACK)  # of equal scale they may shrink
        )


def _place(ax):
    original, active = ax.get_position(original=True), ax.get_position()
    return original, active, ax.get_anchor(), ax.get_box_aspect()


def _needs(fig):
    """Return margins of text around each axes, sizes of legends, extents of axes [pixels]."""
    beyond, rooms = [], []
    for ax in fig.axes:
        tight = ax.get_tightbbox()
        room = ax.get_window_extent()
        rooms.append(room.extents)
        if tight is not None:
            beyond.append((tight.extents - room.extents) * [-1, -1, 1, 1])
    for legend in fig.legends:
        box = legend.get_window_extent()
        beyond.append([0, 0, box.width, box.height])
    return np.array(beyond), np.array(rooms)
