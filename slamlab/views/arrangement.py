"""Arrangement of a figure before it is shown: titles are wrapped, legends leave the data free."""

import textwrap

import numpy as np

from slamlab.displays import grouped
from slamlab.views.legends import make_room

MOST_LAYOUTS = 5  # the layout is made anew until nothing moves any more
STILL = 1e-3  # of the figure: what moves by less stands still


def lay_out(fig):
    """Lay out until nothing moves: maps of equal scale shrink as others grow, or the reverse.

    Where no scale is equal, nothing moves after the first time.

    Parameters
    ----------
    fig : Figure
    """
    engine = fig.get_layout_engine()
    if engine is None:
        return
    for spine in (spine for ax in fig.axes for spine in ax.spines.values()):
        spine.set_in_layout(False)  # it ends where its axes do, and takes long to measure
    free = all(ax.get_aspect() == "auto" for ax in fig.axes)
    before = None
    for _ in range(1 if free else MOST_LAYOUTS):
        engine.execute(fig)
        places = np.array([ax.get_position().bounds for ax in fig.axes])
        if before is not None and np.allclose(places, before, atol=STILL):
            return
        before = places


def arrange(fig, lay_out=lay_out):
    """Give titles and legends of a figure their room: nothing covered, nothing cut off.

    Large numbers in its words get their groups first.

    Parameters
    ----------
    fig : Figure
    lay_out : callable(Figure), gives the axes their places
    """
    for text in _written(fig):
        text.set_text(grouped(text.get_text()))
    lay_out(fig)
    if any([_wrap_title(fig, ax) for ax in fig.axes]):
        lay_out(fig)
    if make_room(fig):
        lay_out(fig)


def _written(fig):
    """Words of a figure that somebody wrote; labels of ticks are its axes' own."""
    for ax in fig.axes:
        yield from (ax.title, ax.xaxis.label, ax.yaxis.label, *ax.texts)
    legends = [*fig.legends, *(ax.get_legend() for ax in fig.axes if ax.get_legend())]
    yield from (text for legend in legends for text in legend.get_texts())
    yield from fig.texts


def _wrap_title(fig, ax):
    """Wrap a title that is wider than it has room for; whether it had to be."""
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
    # as many rows as are needed, and all about as long
    even = next(n for n in range(len(words) // rows, letters + 1) if _rows(words, n) <= rows)
    title.set_text(textwrap.fill(words, even, break_on_hyphens=False))
    return True


def _rows(words, letters):
    return len(textwrap.wrap(words, max(letters, 1), break_on_hyphens=False))


def _room(fig, ax):
    """Width about the middle of axes that no other title beside them needs [pixels]."""
    here = ax.get_window_extent()
    middle = (here.x0 + here.x1) / 2
    beside = [0.0, fig.bbox.width]
    for other in fig.axes:
        there = other.get_window_extent()
        if other.title.get_text() and there.y0 < here.y1 and here.y0 < there.y1 and other is not ax:
            beside.append((middle + (there.x0 + there.x1) / 2) / 2)
    return 2 * min(abs(middle - x) for x in beside)
