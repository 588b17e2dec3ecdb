"""Bit plot: bytes as rows of bits, coloured by the field that they belong to."""

from matplotlib.patches import Rectangle

from slamlab.views.colours import SERIES
from slamlab.views.figures import empty


def bits(data, fields, marked=None, title=None, size=(8, 3.4)):
    """Draw bytes as rows of bits, highest bit first, coloured by field.

    Parameters
    ----------
    data : bytes, a row each
    fields : dict, name for the legend to a list of (byte, bit), four names at most
    marked : (byte, bit) that is framed, or None
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig = empty(size)
    ax = fig.subplots()
    for (name, places), (colour, *_) in zip(fields.items(), SERIES, strict=False):
        for k, (byte, bit) in enumerate(places):
            label = name if k == 0 else None
            square = Rectangle((7 - bit, byte), 0.94, 0.88, color=colour, label=label)
            ax.add_patch(square)
    for byte, value in enumerate(data):
        for bit in range(8):
            ax.text(7.47 - bit, byte + 0.46, value >> bit & 1, color="w", ha="center", va="center")
    if marked is not None:
        byte, bit = marked
        frame = Rectangle((6.95 - bit, byte - 0.06), 1.04, 1.0, fill=False, linewidth=3)
        ax.add_patch(frame)
    ax.set(xlim=(-0.1, 8.1), ylim=(len(data), -0.15), xlabel="bit", title=title)
    ax.set_xticks([7.47 - bit for bit in range(8)], range(8))
    rows = [f"byte {k}: {value:02x}" for k, value in enumerate(data)]
    ax.set_yticks([k + 0.46 for k in range(len(data))], rows)
    ax.tick_params(length=0)
    ax.spines[:].set_visible(False)
    ax.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return fig, ax
