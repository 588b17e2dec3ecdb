"""Legends: enlarged markers, one below all panels, or where in the axes nothing is covered."""

from matplotlib.collections import PathCollection
from matplotlib.lines import Line2D

from slamlab.views.covering import lying_in

SAMPLE = 25.0  # of a sample in a legend, whatever their weights are [pt²]
LEAST = 9.0  # of a legend's letters [pt]
# where in the axes a legend is tried, in this order
CORNERS = [
    "upper right",
    "upper left",
    "lower left",
    "lower right",
    "center right",
    "center left",
    "upper center",
    "lower center",
    "center",
]


def legend(ax, **style):
    """Legend with enlarged markers, so that the small points of a map can be seen.

    When the figure is shown it moves to where it covers nothing: a free corner, or below.

    Parameters
    ----------
    ax : Axes
    style : what matplotlib's legend takes, such as ``loc``

    Returns
    -------
    Legend
    """
    made = ax.legend(**{"fontsize": LEAST} | style)
    # inside the axes it needs no room of its own, beside them it does
    made.set_in_layout("bbox_to_anchor" in style)
    _enlarge(made)
    return made


def legend_below(fig, title=None):
    """Legend of all panels below them, where it covers nothing; one entry a label, made anew.

    Parameters
    ----------
    fig : Figure, laid out by constraints, as all figures of the course
    title : str or None

    Returns
    -------
    Legend
    """
    for old in list(fig.legends):
        old.remove()
    entries = {}
    for ax in fig.axes:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    made = fig.legend(
        entries.values(),
        entries,
        loc="outside lower center",
        ncols=_columns(fig, entries),
        frameon=False,
        title=title,
    )
    _enlarge(made)
    return made


def make_room(fig):
    """Move the legends that cover data: each to a free place in its axes, else all below them.

    Parameters
    ----------
    fig : Figure, laid out

    Returns
    -------
    bool, whether the figure is to be laid out anew, for a legend below it
    """
    legends = {ax: ax.get_legend() for ax in fig.axes if ax.get_legend() is not None}
    if all(_finds_room(ax, each) for ax, each in legends.items()):
        return False
    titles = {each.get_title().get_text() for each in legends.values()} - {""}
    for each in legends.values():
        each.remove()
    legend_below(fig, title=" ".join(sorted(titles)) or None)
    return True


def _finds_room(ax, legend):
    """Whether a legend covers nothing, where it stands or in a corner that it was moved to."""
    room, box = ax.get_window_extent(), legend.get_window_extent()
    if legend.get_bbox_to_anchor().bounds != ax.bbox.bounds:  # it is to stand beside the axes
        return box.x1 <= ax.figure.bbox.x1 and not any(lying_in(ax, box))
    if box.width > room.width or box.height > room.height:
        return False
    for corner in (None, *CORNERS):
        if corner is not None:
            legend.set_loc(corner)
        if not any(lying_in(ax, legend.get_window_extent())):
            return True
    return False


def _columns(fig, entries):
    """As many columns as have room, and as few as the rows need, so that rows are even."""
    letters = max(map(len, entries), default=1)
    wide = 0.075 * letters + 0.55  # [inches] of an entry, about
    most = max(1, int(fig.get_figwidth() / wide))
    rows = -(-len(entries) // most)
    return -(-len(entries) // rows) if rows else 1


def _enlarge(legend):
    for handle in legend.legend_handles:
        if isinstance(handle, Line2D) and handle.get_marker() == ".":
            handle.set_markersize(8)
        elif isinstance(handle, PathCollection):
            handle.set_sizes([SAMPLE])
