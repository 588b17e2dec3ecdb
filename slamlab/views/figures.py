"""Figures of Matplotlib: axes in metres, panels, charts, and the colours of the whole course.

Figures are made without pyplot: nothing global is opened, so nothing has to be closed.
"""

import textwrap

from matplotlib.figure import Figure

# colour-blind-safe palette of Okabe and Ito: told apart with any kind of colour vision
COLOURS = {
    "truth": "#000000",
    "walls": "#7F7F7F",
    "naive": "#D55E00",
    "corrected": "#0072B2",
    "map": "#0072B2",
    "scan": "#E69F00",
    "robot": "#CC79A7",
    "landmark": "#009E73",
    "box": "#56B4E9",
    "sample": "#CC79A7",
    "guide": "#BBBBBB",
    "perpendicular": "#BBBBBB",
}

CSS_DPI = 96  # pixels of a page to an inch of print: text of 10 pt is as large as 10 pt of a page
LETTER = 9  # pixels of the page to a letter of a title, about
UNIT = 80  # pixels of a page to a unit of a figure's size; 11 units fill a notebook's page


def empty(size):
    """Figure without axes.

    Parameters
    ----------
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    Figure
    """
    inches = [UNIT / CSS_DPI * side for side in size]
    return Figure(figsize=inches, dpi=CSS_DPI, layout="constrained")


def axes(title=None, size=(6, 5)):
    """Figure with one map: axes of equal scale (aspect ratio 1), in metres.

    Parameters
    ----------
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, (ax,) = panels([title], size)
    return fig, ax


def panels(titles, size=(11, 5), shared=True):
    """Figure with one map per title (subplots), side by side.

    Parameters
    ----------
    titles : sequence of str or None
    size : (width, height) of the whole figure [80 pixels of the page]
    shared : bool, whether all show the same part of the plane

    Returns
    -------
    (Figure, list of Axes)
    """
    fig = empty(size)
    shared = shared and len(titles) > 1
    all_axes = fig.subplots(1, len(titles), sharex=shared, sharey=shared, squeeze=False)[0]
    for ax, title in zip(all_axes, titles, strict=True):
        # "datalim" would fight with shared axes
        ax.set_aspect("equal", adjustable="box" if shared else "datalim")
        ax.set(xlabel="x [m]", ylabel="y [m]")
        if title:
            # beside others it must not run into theirs
            letters = max(12, int(UNIT * size[0] / len(titles) / LETTER))
            ax.set_title(textwrap.fill(title, letters))
    return fig, list(all_axes)


def chart(xlabel, ylabel, title=None, size=(6, 4)):
    """Figure with one chart (x–y plot): quantities over quantities, not a map.

    Parameters
    ----------
    xlabel, ylabel : str, with the unit in brackets
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig = empty(size)
    ax = fig.subplots()
    ax.set(xlabel=xlabel, ylabel=ylabel)
    ax.grid(color=COLOURS["guide"], linewidth=0.5)
    ax.set_axisbelow(True)
    if title:
        ax.set_title(title)
    return fig, ax
