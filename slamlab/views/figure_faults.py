"""Faults of a figure that a machine can see: covered data, small letters, what is cut off."""

import os
from pathlib import Path

from matplotlib.collections import Collection
from matplotlib.lines import Line2D
from matplotlib.text import Text

LETTERS = 9.0  # the least size of letters [pt of the page]
REPORT = "SLAMLAB_FIGURE_FAULTS"  # a file to which the faults of all figures shown are added


def faults(fig):
    """Find the faults of a figure.

    Parameters
    ----------
    fig : Figure

    Returns
    -------
    list of str, each a fault in words
    """
    fig.draw_without_rendering()
    found = [f"the legend covers {name}" for name in _covered(fig)]
    shown = [text for text in fig.findobj(Text) if text.get_visible() and text.get_text().strip()]
    small = sorted({text.get_text() for text in shown if text.get_fontsize() < LETTERS})
    found += [f"letters smaller than {LETTERS:g} pt: {text!r}" for text in small[:3]]
    whole = fig.bbox.padded(1.0)
    for text in _headings(fig):
        box = text.get_window_extent()
        if text in shown and not (whole.contains(*box.min) and whole.contains(*box.max)):
            found.append(f"cut off at the edge: {text.get_text()!r}")
    return found


def report(fig, alt):
    """Add a figure's faults to the file that ``SLAMLAB_FIGURE_FAULTS`` names, if it names one.

    Parameters
    ----------
    fig : Figure
    alt : str, by which the figure is known
    """
    if REPORT not in os.environ:
        return
    lines = [" ".join(f"{alt} → {fault}".split()) + "\n" for fault in faults(fig)]
    with Path(os.environ[REPORT]).open("a", encoding="utf-8") as file:
        file.writelines(lines)


def _headings(fig):
    own = [text for ax in fig.axes for text in (ax.title, ax.xaxis.label, ax.yaxis.label)]
    return [*own, *fig.texts]


def _covered(fig):
    """Names of the artists that lie under a legend."""
    for ax in fig.axes:
        legends = [legend for legend in (ax.get_legend(), *fig.legends) if legend is not None]
        for legend in legends:
            box = legend.get_window_extent()
            for artist in (*ax.lines, *ax.collections):
                if artist.get_visible() and _lies_in(artist, ax, box):
                    yield artist.get_label().lstrip("_")


def _lies_in(artist, ax, box):
    inside = box.intersection(box, ax.get_window_extent())
    if inside is None:
        return False
    if isinstance(artist, Line2D):
        points = artist.get_transform().transform(artist.get_xydata())
        if artist.get_linestyle() not in ("None", "none", "", " "):
            path = artist.get_path().transformed(artist.get_transform())
            return bool(path.intersects_bbox(inside, filled=False))
        return _any_within(points, inside)
    if isinstance(artist, Collection):
        offsets = artist.get_offset_transform().transform(artist.get_offsets())
        if len(artist.get_paths()) > 1 or len(offsets) <= 1:
            shift = artist.get_transform()
            return any(
                path.transformed(shift).intersects_bbox(inside, filled=False)
                for path in artist.get_paths()
                if len(path.vertices)
            )
        return _any_within(offsets, inside)
    return False


def _any_within(points, box):
    (left, bottom), (right, top) = box.min, box.max
    x, y = points.T
    return bool(((x > left) & (x < right) & (y > bottom) & (y < top)).any())
