"""Automatic checks of a figure: covered data, overlaps, font size, contrast, colours."""

import os
import re
from itertools import combinations
from pathlib import Path

from matplotlib.colors import same_color, to_hex
from matplotlib.lines import Line2D
from matplotlib.text import Text

from slamlab.views.colours import COLOURS, IN_LEGENDS, contrast
from slamlab.views.occlusion import labels_within

MIN_FONT_SIZE = 9.0  # [pt of the page]
MAX_OVERLAP = 1.0  # of two texts' boxes, which are larger than the letters [pt]
MIN_CONTRAST = 4.5  # of text to its background [1]
# label in a legend to the colour of its meaning
LABEL_COLOURS = COLOURS | {label: COLOURS[name] for name, label in IN_LEGENDS.items()}
LABEL_COLOURS |= {f"{name}s": COLOURS[name] for name in ("sample", "landmark")}
UNGROUPED = re.compile(r"\d,\d{3}|(?<![\d.])\d{5}")  # a large number in another notation
REPORT = "SLAMLAB_FIGURE_FAULTS"  # file to which the faults of all figures shown are appended


def faults(fig):
    """Return the faults of a figure as a list of str."""
    fig.draw_without_rendering()
    found = [f"the legend covers {name}" for name in _covered(fig)]
    shown = [text for text in fig.findobj(Text) if text.get_visible() and text.get_text().strip()]
    small = sorted({text.get_text() for text in shown if text.get_fontsize() < MIN_FONT_SIZE})
    found += [f"letters smaller than {MIN_FONT_SIZE:g} pt: {text!r}" for text in small[:3]]
    found += [f"letters too faint: {text!r}" for text in _low_contrast(fig, shown)]
    found += [f"no space before %: {text!r}" for text in _texts(shown) if re.search(r"\d%", text)]
    found += [f"not 10 000: {text!r}" for text in _texts(shown) if UNGROUPED.search(text)]
    found += [f"letters over letters: {pair}" for pair in _overlapping(fig, shown)]
    found += [*_other_colours(fig), *_same_looks(fig)]
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
    """Append a figure's faults and its alt text to the file ``$SLAMLAB_FIGURE_FAULTS``."""
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
    """Yield the pairs of texts that overlap."""
    written = {*_headings(fig), *(text for ax in fig.axes for text in ax.texts)}
    # the box of rotated text is larger than the text
    level = [text for text in shown if text in written and text.get_rotation() % 90 == 0]
    boxes = [(text.get_text(), text.get_window_extent()) for text in level]
    for (one, here), (other, there) in combinations(boxes, 2):
        shared = here.intersection(here, there)
        if shared is not None and min(shared.width, shared.height) > MAX_OVERLAP * fig.dpi / 72:
            yield f"{one!r} and {other!r}"


def _other_colours(fig):
    drawn = [line for ax in fig.axes for line in ax.lines]
    for line in drawn:
        expected = LABEL_COLOURS.get(line.get_label())
        if expected and not same_color(line.get_color(), expected):
            yield f"{line.get_label()!r} does not have the colour of its meaning, {expected}"
        if line.get_linestyle() == "-" and same_color(line.get_color(), COLOURS["predicted"]):
            yield f"{line.get_label()!r} is solid: predictions must be dashed"


def _same_looks(fig):
    entries = {}
    for ax in fig.axes if any(_legends(fig)) else ():
        entries |= dict(zip(*reversed(ax.get_legend_handles_labels()), strict=True))
    looks = {}
    for label, line in entries.items():
        if not isinstance(line, Line2D):
            continue
        look = to_hex(line.get_color()), line.get_linestyle(), line.get_marker()
        look = (*look, line.get_linewidth())
        if look in looks:
            yield f"{looks[look]!r} and {label!r} look the same in the legend"
        looks[look] = label


def _headings(fig):
    own = [text for ax in fig.axes for text in (ax.title, ax.xaxis.label, ax.yaxis.label)]
    return [*own, *fig.texts]


def _covered(fig):
    for ax in fig.axes:
        legends = [legend for legend in (ax.get_legend(), *fig.legends) if legend is not None]
        for legend in legends:
            yield from labels_within(ax, legend.get_window_extent())


def _low_contrast(fig, shown):
    """Yield the texts with too little contrast, except texts on pictures."""
    on_pictures = {text for ax in fig.axes if ax.images for text in ax.texts}
    for text in shown:
        if text in on_pictures:
            continue
        if contrast(text.get_color(), _background(text)) < MIN_CONTRAST:
            yield text.get_text()


def _background(text):
    """Return the colour of the topmost filled patch under a text, or white."""
    if text.axes is None or text not in text.axes.texts:
        return "#FFFFFF"
    at = text.get_transform().transform(text.get_position())
    filled = [patch for patch in text.axes.patches if patch.get_fill() and patch.contains_point(at)]
    return filled[-1].get_facecolor() if filled else "#FFFFFF"
