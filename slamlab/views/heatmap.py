"""Heat map (heatmap) of tables of shares: a coloured cell a value, its number written in it."""

import numpy as np

from slamlab.views.figures import empty

_COLOUR_MAP = "cividis"  # colour map that is colour-blind safe
_BLACK_TEXT_ABOVE = 0.5  # share above which a cell is light: its number is black


def cells(tables, x, y, xlabel, ylabel, size=(7, 3)):
    """Heat maps of tables of shares (rates) side by side, on one colour scale from 0 to 100 %.

    Parameters
    ----------
    tables : dict, title to (len(y), len(x)) shares [1]
    x, y : the values that stand at the columns and rows
    xlabel, ylabel : str, with the unit in brackets
    size : (width, height) of the whole figure [80 pixels of the page]

    Returns
    -------
    (Figure, list of Axes)

    Raises
    ------
    ValueError : a table that does not fit its rows and columns, or numbers that are no shares
    """
    fig = empty(size)
    all_axes = fig.subplots(1, len(tables), sharey=True, squeeze=False)[0]
    for ax, (title, table) in zip(all_axes, tables.items(), strict=True):
        table = np.asarray(table, dtype=float)
        if table.shape != (len(y), len(x)):
            raise ValueError(f"{title}: {len(y)} rows of {len(x)} expected, got {table.shape}")
        if not ((table >= 0) & (table <= 1)).all():
            raise ValueError(f"{title}: shares lie between 0 and 1")
        picture = ax.imshow(table, cmap=_COLOUR_MAP, vmin=0, vmax=1, origin="lower", aspect="auto")
        for (row, column), share in np.ndenumerate(table):
            ink = "black" if share > _BLACK_TEXT_ABOVE else "white"
            ax.text(column, row, f"{100 * share:.0f}", ha="center", va="center", color=ink)
        ax.set_xticks(range(len(x)), labels=[f"{value:g}" for value in x])
        ax.set_yticks(range(len(y)), labels=[f"{value:g}" for value in y])
        ax.tick_params(length=0)
        ax.set(title=title, xlabel=xlabel)
    all_axes[0].set_ylabel(ylabel)
    bar = fig.colorbar(picture, ax=list(all_axes), label="share [%]")
    bar.set_ticks([0, 0.5, 1], labels=["0", "50", "100"])
    return fig, list(all_axes)
