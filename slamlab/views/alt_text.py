"""Alternative text of a figure: its kind and axes."""

import re
from itertools import groupby

from matplotlib.container import BarContainer

COUNTS = {2: "two", 3: "three", 4: "four", 5: "five", 6: "six"}


def describe(fig):
    """Describe a figure and its panels, for example "Map: x [m] across, y [m] up."."""
    panels = [ax for ax in fig.axes if not _is_colour_bar(ax)]
    sentences = []
    for (kind, axes_), group in groupby(panels, lambda ax: (_kind(ax), _axes(ax))):
        titles = [ax.get_title() for ax in group]
        sentences.append(_panel(kind, axes_, titles))
    return " Beside it: ".join(sentences) if sentences else "Picture."


def _panel(kind, axes_, titles):
    named = ", ".join(_plain(title) for title in titles if title)
    many = len(titles) > 1
    kinds = "matrices" if kind == "matrix" else f"{kind}s"
    start = f"{COUNTS.get(len(titles), len(titles))} {kinds}" if many else kind
    parts = [start[0].upper() + start[1:], f" ({named})" if named else ""]
    return "".join(parts) + (f": {axes_}." if axes_ else ".")


def _plain(text):
    """Return a text with its formulas in plain letters: d_abs for $d_{abs}$."""
    plain = re.sub(r"\$([^$]*)\$", lambda formula: re.sub(r"[{}\\]", "", formula[1]), text)
    return " ".join(plain.split())


def _is_colour_bar(ax):
    return ax.get_label() == "<colorbar>" or hasattr(ax, "_colorbar")


def _kind(ax):
    if ax.xaxis.label.get_text() == "x [m]" and ax.yaxis.label.get_text() == "y [m]":
        return "map"
    if ax.images:
        return "matrix"
    if any(isinstance(each, BarContainer) for each in ax.containers):
        return "bar chart"
    return "chart" if ax.axison else "drawing"


def _axes(ax):
    if not ax.axison:
        return ""
    across, up = map(_plain, (ax.get_xlabel(), ax.get_ylabel()))
    across += " (logarithmic)" if across and ax.get_xscale() == "log" else ""
    up += " (logarithmic)" if up and ax.get_yscale() == "log" else ""
    return ", ".join(f"{name} {where}" for name, where in ((across, "across"), (up, "up")) if name)
