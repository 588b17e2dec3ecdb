"""Layout of a figure: wraps titles, and moves legends off the data."""

import textwrap

import numpy as np

from slamlab.views.legends import make_room
from slamlab.views.notebook_output import grouped

MAX_ITERATIONS = 5  # of the layout, until the axes stop moving
TOLERANCE = 1e-3  # part of the figure; smaller moves are ignored


def lay_out(fig):
    """Repeat the layout until no axes move: maps of equal scale shrink as other axes grow."""
    engine = fig.get_layout_engine()
    if engine is None:
        return
    free = all(ax.get_aspect() == "auto" for ax in fig.axes)
    before = None
    for _ in range(1 if free else MAX_ITERATIONS):
        engine.execute(fig)
        bounds = np.array([ax.get_position().bounds for ax in fig.axes])
        if before is not None and np.allclose(bounds, before, atol=TOLERANCE):
            return
        before = bounds


def arrange(fig, lay_out=lay_out):
    """Group the digits of large numbers in all texts, then make room for titles and legends."""
    for spine in (spine for ax in fig.axes for spine in ax.spines.values()):
        spine.set_in_layout(False)  # it has the size of its axes, and is slow to measure
    for text in _texts(fig):
        text.set_text(grouped(text.get_text()))
    lay_out(fig)
    if any([_wrap_title(fig, ax) for ax in fig.axes]):
        lay_out(fig)
    if make_room(fig):
        lay_out(fig)


def _texts(fig):
    for ax in fig.axes:
        yield from (ax.title, ax.xaxis.label, ax.yaxis.label, *ax.texts)
    legends = [*fig.legends, *(ax.get_legend() for ax in fig.axes if ax.get_legend())]
    yield from (text for legend in legends for text in legend.get_texts())
    yield from fig.texts


def _wrap_title(fig, ax):
    title = ax.title
    if not title.get_text():
        return False
    box = title.get_window_extent()
    room = _room(fig, ax)
    if box.width <= room:
        return False
    words = " ".join(title.get_text().split())
    letters = max(12, int(len(words) * room / box.width) - 1)
    rows = _rows(words, letters)
    # the minimum number of rows, of similar length
    even = next(n for n in range(len(words) // rows, letters + 1) if _rows(words, n) <= rows)
    title.set_text(textwrap.fill(words, even, break_on_hyphens=False))
    return True


def _rows(words, letters):
    return len(textwrap.wrap(words, max(letters, 1), break_on_hyphens=False))


def _room(fig, ax):
    """Return the width [pixels] around the centre of axes that neighbouring titles leave free."""
    here = ax.get_window_extent()
    middle = (here.x0 + here.x1) / 2
    beside = [0.0, fig.bbox.width]
    for other in fig.axes:
        there = other.get_window_extent()
        if other.title.get_text() and there.y0 < here.y1 and here.y0 < there.y1 and other is not ax:
            beside.append((middle + (there.x0 + there.x1) / 2) / 2)
    return 2 * min(abs(middle - x) for x in beside)
