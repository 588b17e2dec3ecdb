"""Figures of Matplotlib: axes in metres, panels, charts, bands.

Figures are made without pyplot: nothing global is opened, so nothing has to be closed.
"""

from matplotlib.figure import Figure

from slamlab.views.colours import COLOURS, SERIES

CSS_DPI = 96  # pixels of a page to an inch of print: text of 10 pt is as large as 10 pt of a page
CYCLE = [colour for colour, *_ in SERIES]  # of what is drawn without a colour
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
        ax.set_prop_cycle(color=CYCLE)
        if title:
            ax.set_title(title)
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
    ax.set_prop_cycle(color=CYCLE)
    ax.grid(color=COLOURS["guide"], linewidth=0.5)
    ax.set_axisbelow(True)
    if title:
        ax.set_title(title)
    return fig, ax


def band(ax, low, high, label=None):
    """Draw a band across a chart, such as where 95 % of values lie: shaded, its edges drawn.

    Parameters
    ----------
    ax : Axes
    low, high : float, of the axis that points up
    label : str or None, for the legend

    Returns
    -------
    Patch
    """
    edge = {"edgecolor": COLOURS["limit"], "linestyle": "dashdot", "linewidth": 0.8}
    # the shade may be faint, for the edges are not
    return ax.axhspan(low, high, facecolor=f"{COLOURS['guide']}66", label=label, zorder=0, **edge)


def two_sigma(ax, x, y, sigma, label, color=COLOURS["corrected"]):
    """Draw an estimate over time, and the band of ±2σ round it that a filter believes in.

    Parameters
    ----------
    ax : Axes
    x, y : (n,)
    sigma : (n,) standard deviations
    label : str, for the legend
    color : what matplotlib takes for one
    """
    ax.fill_between(
        x, y - 2 * sigma, y + 2 * sigma, color=color, alpha=0.2, label=f"±2σ of {label}"
    )
    ax.plot(x, y, color=color, linewidth=2, label=label)
