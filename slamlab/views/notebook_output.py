"""Notebook output: MIME bundles and widgets; digit grouping of large numbers."""

import re

from slamlab.extras import needs

# five digits or more, except in names, times, fractions, addresses and after a decimal point
_LARGE = re.compile(r"(?<![\w.,/:#=^])(?<!\w-)\d{5,}(?![\w/:])")


def show_bundle(shown):
    """Show a MIME bundle; return a DisplayHandle, whose ``update(new, raw=True)`` replaces it."""
    with needs("notebook"):
        from IPython.display import DisplayHandle
    handle = DisplayHandle()
    handle.display(shown, raw=True)
    return handle


def show_controls(box, text="Run this cell for its controls."):
    """Show a widget, or a text where widgets do not work, such as in a file without a kernel."""
    with needs("notebook"):
        from IPython.display import display
    display((box._repr_mimebundle_() or {}) | {"text/plain": text}, raw=True)


def grouped(value):
    """Group the digits of integers with five or more digits in threes: 10 000.

    value : int, float or str. Returns a str.
    """
    return _LARGE.sub(lambda found: f"{int(found[0]):,}".replace(",", " "), str(value))


def grouped_tick(x, _position=None):
    return grouped(f"{x:g}")
