"""Faults of a figure that a machine can see: covered data, small letters, what is cut off."""

import os
from pathlib import Path

from matplotlib.text import Text

from slamlab.views.colours import contrast
from slamlab.views.covering import lying_in

LETTERS = 9.0  # the least size of letters [pt of the page]
LETTER_CONTRAST = 4.5  # the least contrast of letters to the paper [1]
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
    found += [f"letters too faint: {text!r}" for text in _faint(fig, shown)]
    whole = fig.bbox.padded(1.0)
    legends = [*fig.legends, *(ax.get_legend() for ax in fig.axes if ax.get_legend())]
    for box in (legend.get_window_extent() for legend in legends):
        if not (whole.contains(*box.min) and whole.contains(*box.max)):
            found.append("cut off at the edge: a legend")
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
    """Names of what lies under a legend."""
    for ax in fig.axes:
        legends = [legend for legend in (ax.get_legend(), *fig.legends) if legend is not None]
        for legend in legends:
            yield from lying_in(ax, legend.get_window_extent())


def _faint(fig, shown):
    """Letters that can hardly be read on the paper; what stands on a picture is not judged."""
    on_pictures = {text for ax in fig.axes if ax.images for text in ax.texts}
    for text in shown:
        if text in on_pictures:
            continue
        if contrast(text.get_color(), _ground(text)) < LETTER_CONTRAST:
            yield text.get_text()


def _ground(text):
    """What letters stand on: the topmost filled patch there, else the paper."""
    if text.axes is None or text not in text.axes.texts:
        return "#FFFFFF"
    at = text.get_transform().transform(text.get_position())
    filled = [patch for patch in text.axes.patches if patch.get_fill() and patch.contains_point(at)]
    return filled[-1].get_facecolor() if filled else "#FFFFFF"
