"""Display of figures in a notebook: WebP in HTML with alternative text."""

import base64
import html
import io
from contextlib import contextmanager

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from slamlab.views.alt_text import describe
from slamlab.views.figure_checks import report
from slamlab.views.figure_layout import arrange
from slamlab.views.notebook_output import grouped, show_bundle, show_controls

SHARPNESS = 2  # pixels of a picture for a pixel of the page, for screens of high resolution
# 8 shades of each colour channel for the edges of letters and lines
SHADES = np.round(np.round(np.arange(256) / 255 * 7) / 7 * 255).astype(np.uint8)
PACKING = {"lossless": True, "method": 2, "quality": 25}  # small, and in 15 ms


def png(fig):
    """Render a figure as PNG with its final layout; the same figure gives the same bytes.

    fig : Figure. Returns bytes.
    """
    return _packed(fig, "PNG")


def _packed(fig, kind, **packing):
    with _sharp(fig):
        arrange(fig)
        picture = render(fig)
    packed = io.BytesIO()
    picture.save(packed, kind, **packing)
    return packed.getvalue()


@contextmanager
def _sharp(fig):
    """Lay out a figure at the picture's resolution, so that text has its final width."""
    page = fig.dpi
    fig.dpi = SHARPNESS * page
    try:
        yield
    finally:
        fig.dpi = page


def render(fig):
    """Render a figure without computing the layout again."""
    canvas = FigureCanvasAgg(fig)
    engine = fig.get_layout_engine()
    fig.set_layout_engine("none")
    canvas.draw()  # once; savefig draws twice
    fig.set_layout_engine(engine)
    pixels = np.array(canvas.buffer_rgba())
    edges = _isolated(pixels.view(np.uint32)[..., 0])
    pixels[edges] = SHADES[pixels[edges]]  # looks the same, and needs two thirds of the bytes
    return Image.fromarray(pixels).convert("RGB")


def _isolated(colours):
    """Return a mask of pixels that differ from all four neighbours, (n, m) bool."""
    across, down = colours[:, 1:] != colours[:, :-1], colours[1:] != colours[:-1]
    isolated = np.ones(colours.shape, bool)
    isolated[:, 1:] &= across
    isolated[:, :-1] &= across
    isolated[1:] &= down
    isolated[:-1] &= down
    return isolated


def bundle(fig, alt, data=None):
    """Return the MIME bundle of a figure for a notebook; arguments and errors as in :func:`show`.
    Unlike a bare image, HTML keeps the alternative text in every front end. Lossless WebP needs two
    thirds of the bytes of PNG.
    """
    if not isinstance(alt, str) or not alt.strip():
        raise ValueError("a figure needs alt text: describe its content in a sentence")
    picture = base64.b64encode(_packed(fig, "WEBP", **PACKING)).decode()
    with _sharp(fig):
        report(fig, alt)
    alt = grouped(f"{describe(fig)} {alt.strip()}")
    wide = round(fig.get_figwidth() * fig.dpi)
    shown = (
        f'<img class="slamlab-figure" width="{wide}" alt="{html.escape(alt)}" '
        f'src="data:image/webp;base64,{picture}">'
    )
    return {"text/html": shown + _table(data), "text/plain": alt}


def show(fig, alt, data=None):
    """Show a figure in the notebook, with alternative text. Raises ValueError if the alt text is
    missing or columns differ in length.

    Parameters
    ----------
    fig : Figure
    alt : str, description of the figure; its kind and axes are prepended
    data : dict or None, heading to column: a table that can be unfolded
    """
    show_bundle(bundle(fig, alt, data))


def show_beside_still(box, still):
    """Show a widget, and a still picture for viewers without widgets."""
    show_controls(box)
    # the file keeps it; widgets.css hides it beside a live widget
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
