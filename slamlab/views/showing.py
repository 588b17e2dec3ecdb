"""Figures shown in a notebook: crisp WebP in HTML with alternative text, which a file keeps."""

import base64
import html
import io
from contextlib import contextmanager

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from slamlab.displays import grouped, show_bundle, show_controls
from slamlab.views.arrangement import arrange
from slamlab.views.figure_faults import report
from slamlab.views.figure_words import words

SHARPNESS = 2  # pixels of a picture to a pixel of the page: crisp where a screen has two
# the 8 shades of red, of green and of blue that edges of letters and lines have
SHADES = np.round(np.round(np.arange(256) / 255 * 7) / 7 * 255).astype(np.uint8)
PACKING = {"lossless": True, "method": 2, "quality": 25}  # small, and in 15 ms


def png(fig):
    """Render a figure as PNG, for a file of its own; deterministic: always the same bytes.

    Titles and legends are first given room (:func:`slamlab.views.arrangement.arrange`).

    Parameters
    ----------
    fig : Figure

    Returns
    -------
    bytes
    """
    return _packed(fig, "PNG")


def _packed(fig, kind, **packing):
    with _sharp(fig):
        arrange(fig)
        picture = _drawn(fig)
    packed = io.BytesIO()
    picture.save(packed, kind, **packing)
    return packed.getvalue()


@contextmanager
def _sharp(fig):
    """Pixels as fine as in the picture: letters are as wide in the layout as they will be drawn."""
    page = fig.dpi
    fig.dpi = SHARPNESS * page
    try:
        yield
    finally:
        fig.dpi = page


def _drawn(fig):
    """Picture of a figure as it is arranged: to lay it out anew costs as much as to draw it."""
    canvas = FigureCanvasAgg(fig)
    engine = fig.get_layout_engine()
    fig.set_layout_engine("none")
    canvas.draw()  # once; savefig draws twice, first to measure
    fig.set_layout_engine(engine)
    pixels = np.array(canvas.buffer_rgba())
    edges = _alone(pixels.view(np.uint32)[..., 0])
    pixels[edges] = SHADES[pixels[edges]]  # looks the same, and packs in two thirds of the bytes
    return Image.fromarray(pixels).convert("RGB")


def _alone(colours):
    """Pixels that no neighbour is like, as on edges of letters and lines: (n, m) bool of (n, m)."""
    across, down = colours[:, 1:] != colours[:, :-1], colours[1:] != colours[:-1]
    alone = np.ones(colours.shape, bool)
    alone[:, 1:] &= across
    alone[:, :-1] &= across
    alone[1:] &= down
    alone[:-1] &= down
    return alone


def bundle(fig, alt, data=None):
    """MIME bundle that a notebook stores of a figure: the picture in HTML, its words as text.

    HTML carries the alternative text to every front end, and to pages made of a notebook; a bare
    image loses it. Lossless WebP takes two thirds of the bytes of PNG, and every browser shows it.

    Parameters
    ----------
    fig : Figure
    alt : str, what is to be seen; of what kind the figure is and what its axes are is put before
    data : dict or None, heading to column (of numbers or text): a table to unfold below

    Returns
    -------
    dict by MIME type

    Raises
    ------
    ValueError : without alt text, or with columns of different length
    """
    if not isinstance(alt, str) or not alt.strip():
        raise ValueError("a figure needs alt text: say in a sentence what it shows")
    picture = base64.b64encode(_packed(fig, "WEBP", **PACKING)).decode()
    with _sharp(fig):
        report(fig, alt)
    alt = grouped(f"{words(fig)} {alt.strip()}")
    wide = round(fig.get_figwidth() * fig.dpi)
    shown = (
        f'<img class="slamlab-figure" width="{wide}" alt="{html.escape(alt)}" '
        f'src="data:image/webp;base64,{picture}">'
    )
    return {"text/html": shown + _table(data), "text/plain": alt}


def show(fig, alt, data=None):
    """Show (display) a figure in the notebook, with alternative text.

    Parameters
    ----------
    fig : Figure
    alt : str, what is to be seen; of what kind the figure is and what its axes are is put before
    data : dict or None, heading to column (of numbers or text): a table to unfold below

    Raises
    ------
    ValueError : without alt text, or with columns of different length
    """
    show_bundle(bundle(fig, alt, data))


def show_beside_still(box, still):
    """Show a widget that draws in the browser, and its still picture for where it cannot.

    Parameters
    ----------
    box : Widget
    still : dict by MIME type, what :func:`bundle` made
    """
    show_controls(box)
    # kept by a file; beside the drawing that lives it is not seen (widgets.css)
    show_bundle(still | {"text/html": f'<div class="slamlab-still">{still["text/html"]}</div>'})


def _table(data):
    if data is None:
        return ""
    head = "".join(f'<th scope="col">{html.escape(name)}</th>' for name in data)
    rows = "".join(
        f"<tr>{''.join(f'<td>{_cell(value)}</td>' for value in row)}</tr>"
        for row in zip(*data.values(), strict=True)
    )
    return (
        "<details><summary>data</summary>"
        f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></details>"
    )


def _cell(value):
    return html.escape(value if isinstance(value, str) else f"{value:.4g}")
