"""Legend placement below the panels or where the legend covers no data; enlarged markers."""

from matplotlib.collections import PathCollection
from matplotlib.lines import Line2D

from slamlab.views.occlusion import labels_within

PARTICLE_SIZE = 25.0  # of a particle in a legend, whatever its weight [pt²]
MIN_FONT_SIZE = 9.0  # of a legend [pt]
# positions tried for a legend, in this order
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
    """Add a legend with enlarged markers to Axes; when shown, it moves off the data. ``style`` is
    as matplotlib's legend takes it. Returns a Legend."""
    made = ax.legend(**{"fontsize": MIN_FONT_SIZE} | style)
    # the layout makes room only for a legend beside the axes
    made.set_in_layout("bbox_to_anchor" in style)
    _enlarge(made)
    return made


def legend_below(fig, title=None):
    """Add one legend below all panels of a Figure with constrained layout; it replaces earlier
    legends there. Returns a Legend."""
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
    """Move legends off the data, or put one below all panels; return True in the latter case."""
    legends = {ax: ax.get_legend() for ax in fig.axes if ax.get_legend() is not None}
    if all(_finds_room(ax, each) for ax, each in legends.items()):
        return False
    titles = {each.get_title().get_text() for each in legends.values()} - {""}
    for each in legends.values():
        each.remove()
    legend_below(fig, title=" ".join(sorted(titles)) or None)
    return True


def _finds_room(ax, legend):
    room, box = ax.get_window_extent(), legend.get_window_extent()
    if legend.get_bbox_to_anchor().bounds != ax.bbox.bounds:  # it is beside the axes
        return box.x1 <= ax.figure.bbox.x1 and not any(labels_within(ax, box))
    if box.width > room.width or box.height > room.height:
        return False
    for corner in (None, *CORNERS):
        if corner is not None:
            legend.set_loc(corner)
        if not any(labels_within(ax, legend.get_window_extent())):
            return True
    return False


def _columns(fig, entries):
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
            handle.set_sizes([PARTICLE_SIZE])
