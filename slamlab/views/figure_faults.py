"""Faults of a figure that a machine can see: covered data, small letters, what is cut off."""

import os
import re
from itertools import combinations
from pathlib import Path

from matplotlib.colors import same_color, to_hex
from matplotlib.lines import Line2D
from matplotlib.text import Text

from slamlab.views.colours import COLOURS, IN_LEGENDS, contrast
from slamlab.views.covering import lying_in

LETTERS = 9.0  # the least size of letters [pt of the page]
TOUCH = 1.0  # by so much words may share their frames, which are wider than the ink [pt]
LETTER_CONTRAST = 4.5  # the least contrast of letters to the paper [1]
# what a legend says, and the meaning whose colour that has
SAID = COLOURS | {said: COLOURS[name] for name, said in IN_LEGENDS.items()}
SAID |= {f"{name}s": COLOURS[name] for name in ("sample", "landmark")}
UNGROUPED = re.compile(r"\d,\d{3}|(?<![\d.])\d{5}")  # a large number in another form
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
    found += [f"no space before %: {said!r}" for said in _texts(shown) if re.search(r"\d%", said)]
    found += [f"not 10 000: {said!r}" for said in _texts(shown) if UNGROUPED.search(said)]
    found += [f"letters over letters: {pair}" for pair in _overlapping(fig, shown)]
    found += [*_other_colours(fig), *_alike(fig)]
    whole = fig.bbox.padded(1.0)
    for box in (legend.get_window_extent() for legend in _legends(fig)):
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


def _legends(fig):
    return [*fig.legends, *(ax.get_legend() for ax in fig.axes if ax.get_legend())]


def _texts(shown):
    return sorted({text.get_text() for text in shown})


def _overlapping(fig, shown):
    """Pairs of words that stand on each other; labels of ticks are matplotlib's own care."""
    written = {*_headings(fig), *(text for ax in fig.axes for text in ax.texts)}
    # the frame of slanted words is wider than they are
    level = [text for text in shown if text in written and text.get_rotation() % 90 == 0]
    boxes = [(text.get_text(), text.get_window_extent()) for text in level]
    for (one, here), (other, there) in combinations(boxes, 2):
        shared = here.intersection(here, there)
        if shared is not None and min(shared.width, shared.height) > TOUCH * fig.dpi / 72:
            yield f"{one!r} and {other!r}"


def _other_colours(fig):
    """Marks in another colour than the one table gives to what their label says."""
    drawn = [line for ax in fig.axes for line in ax.lines]
    for line in drawn:
        said = SAID.get(line.get_label())
        if said and not same_color(line.get_color(), said):
            yield f"{line.get_label()!r} is not in the colour of its meaning, {said}"
        if line.get_linestyle() == "-" and same_color(line.get_color(), COLOURS["predicted"]):
            yield f"{line.get_label()!r} is solid: what is predicted is dashed"


def _alike(fig):
    """Entries of a legend that nobody can tell apart."""
    entries = {}
    for ax in fig.axes if any(_legends(fig)) else ():
        entries |= dict(zip(*reversed(ax.get_legend_handles_labels()), strict=True))
    looks = {}
    for said, line in entries.items():
        if not isinstance(line, Line2D):
            continue
        look = to_hex(line.get_color()), line.get_linestyle(), line.get_marker()
        look = (*look, line.get_linewidth())
        if look in looks:
            yield f"in the legend {looks[look]!r} and {said!r} look the same"
        looks[look] = said


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
