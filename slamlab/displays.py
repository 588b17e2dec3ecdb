"""Displays of a notebook: what its page shows, in a form that its file keeps."""

import re

from IPython.display import DisplayHandle, display

# five digits and more, but in names, times, fractions, addresses and behind a decimal point
_LARGE = re.compile(r"(?<![\w.,/:#=^])(?<!\w-)\d{5,}(?![\w/:])")


def show_bundle(shown):
    """Show a MIME bundle as a display of its own, where another can take its place.

    Beside no widget a file keeps it, and shows it when it is opened again.

    Parameters
    ----------
    shown : dict by MIME type

    Returns
    -------
    DisplayHandle : its ``update(bundle, raw=True)`` shows another bundle instead
    """
    handle = DisplayHandle()
    handle.display(shown, raw=True)
    return handle


def show_controls(box, words="Run this cell for its controls."):
    """Show a widget, or words where none can be: in a file, or where no kernel runs.

    Parameters
    ----------
    box : Widget
    words : str
    """
    display((box._repr_mimebundle_() or {}) | {"text/plain": words}, raw=True)


def grouped(told):
    """A number or a text, its whole numbers of five digits and more in groups of three: 10 000.

    Parameters
    ----------
    told : int, float or str

    Returns
    -------
    str
    """
    return _LARGE.sub(lambda found: f"{int(found[0]):,}".replace(",", " "), str(told))


def grouped_tick(x, _position=None):
    """The label of a tick, for ``set_major_formatter``: its number in short, :func:`grouped`.

    Parameters
    ----------
    x : float

    Returns
    -------
    str
    """
    return grouped(f"{x:g}")
