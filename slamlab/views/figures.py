"""Figures and axes of Matplotlib without pyplot, so that no figure stays open."""

from matplotlib.figure import Figure

from slamlab.views.colours import COLOURS, SERIES

CSS_DPI = 96  # pixels of a page in an inch: 10 pt in a figure are 10 pt on the page
CYCLE = [colour for colour, *_ in SERIES]  # default colours
UNIT = 80  # pixels of a page in a unit of a figure's size; a notebook's page is 11 units wide


def empty(size):
    """Create an empty figure; size is (width, height) in units of 80 pixels of the page."""
    inches = [UNIT / CSS_DPI * side for side in size]
    return Figure(figsize=inches, dpi=CSS_DPI, layout="constrained")


def axes(title=None, size=(6, 5)):
    """Create a map: axes in metres with equal scale. Returns (Figure, Axes).

    Parameters
    ----------
    title : str or None
    size : (width, height) [80 pixels of the page]
    """
    fig, (ax,) = panels([title], size)
    return fig, ax


def panels(titles, size=(11, 5), shared=True):
    """Create maps side by side, one for each title. Returns (Figure, list of Axes).

    Parameters
    ----------
    titles : sequence of str or None
    size : (width, height) of the whole figure [80 pixels]
    shared : bool, whether all show the same region
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
    """Create a chart (x–y plot). Returns (Figure, Axes).

    Parameters
    ----------
    xlabel, ylabel : str, with the unit in brackets
    title, size : as in :func:`axes`
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
    """Draw a horizontal band in a chart, such as a 95 % interval. Returns a Patch.

    Parameters
    ----------
    ax : Axes
    low, high : float, along y
    label : str or None, for the legend
    """
    edge = {"edgecolor": COLOURS["limit"], "linestyle": "dashdot", "linewidth": 0.8}
    # the shade may be faint, because the edges are visible
    return ax.axhspan(low, high, facecolor=f"{COLOURS['guide']}66", label=label, zorder=0, **edge)


def two_sigma(ax, x, y, sigma, label, color=COLOURS["corrected"]):
    """Draw an estimate over time with its ±2σ band.

    Parameters
    ----------
    ax : Axes
    x, y, sigma : (n,)
    label : str
    color : as matplotlib takes it
    """
    ax.fill_between(
        x, y - 2 * sigma, y + 2 * sigma, color=color, alpha=0.2, label=f"±2σ of {label}"
    )
    ax.plot(x, y, color=color, linewidth=2, label=label)
