"""Figures of Matplotlib: axes in metres, panels, colours, PNG and alt text for a notebook.

Figures are made without pyplot: nothing global is opened, so nothing has to be closed.
"""

import base64
import io

from IPython.display import display
from matplotlib.figure import Figure
from PIL import Image

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

DPI = 80  # resolution [pixels/inch]


def axes(title=None, size=(6, 5)):
    """Figure with one map: axes of equal scale (aspect ratio 1), in metres.

    Parameters
    ----------
    title : str or None
    size : (width, height) [inch]

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
    size : (width, height) of the whole figure [inch]
    shared : bool, whether all show the same part of the plane

    Returns
    -------
    (Figure, list of Axes)
    """
    fig = Figure(figsize=size, dpi=DPI, layout="constrained")
    shared = shared and len(titles) > 1
    all_axes = fig.subplots(1, len(titles), sharex=shared, sharey=shared, squeeze=False)[0]
    for ax, title in zip(all_axes, titles, strict=True):
        # "datalim" would fight with shared axes
        ax.set_aspect("equal", adjustable="box" if shared else "datalim")
        ax.set(xlabel="x [m]", ylabel="y [m]")
        if title:
            ax.set_title(title)
    return fig, list(all_axes)


def chart(xlabel, ylabel, title=None, size=(6, 4)):
    """Figure with one chart (x–y plot): quantities over quantities, not a map.

    Parameters
    ----------
    xlabel, ylabel : str, with the unit in brackets
    title : str or None
    size : (width, height) [inch]

    Returns
    -------
    (Figure, Axes)
    """
    fig = Figure(figsize=size, dpi=DPI, layout="constrained")
    ax = fig.subplots()
    ax.set(xlabel=xlabel, ylabel=ylabel)
    ax.grid(color=COLOURS["guide"], linewidth=0.5)
    ax.set_axisbelow(True)
    if title:
        ax.set_title(title)
    return fig, ax


def png(fig):
    """Render a figure as PNG with a palette of 256 colours; deterministic: always the same bytes.

    A figure of lines and letters looks the same in a palette and takes well under half the bytes.

    Parameters
    ----------
    fig : Figure

    Returns
    -------
    bytes
    """
    drawn, small = io.BytesIO(), io.BytesIO()
    fig.savefig(drawn, format="png", dpi=fig.dpi)
    picture = Image.open(drawn).convert("RGB")
    picture.quantize(method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(small, "PNG")
    return small.getvalue()


def bundle(fig, alt):
    """MIME bundle that a notebook stores of a figure: PNG, and alt text for who cannot see it.

    Parameters
    ----------
    fig : Figure
    alt : str, what the figure shows

    Returns
    -------
    (data, metadata) : dicts by MIME type

    Raises
    ------
    ValueError : without alt text
    """
    if not isinstance(alt, str) or not alt.strip():
        raise ValueError("a figure needs alt text: say in a sentence what it shows")
    data = {"image/png": base64.b64encode(png(fig)).decode(), "text/plain": alt}
    return data, {"image/png": {"alt": alt}}


def show(fig, alt):
    """Show (display) a figure in the notebook, with alternative text.

    Parameters
    ----------
    fig : Figure
    alt : str, what the figure shows

    Raises
    ------
    ValueError : without alt text
    """
    data, metadata = bundle(fig, alt)
    display(data, metadata=metadata, raw=True)
