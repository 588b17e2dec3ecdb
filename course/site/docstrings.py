"""Sphinx extension that escapes docstrings as plain text: ``|l|`` and ``a*b`` are not markup.

A page omits the reading order of files in a module's docstring, and all text after this list.
"""

import re

import numpy as np

_ORDER = "Read in this order"
_LITERAL = re.compile(r"(``.+?``|:\w+:`[^`]+`)")


def setup(app):
    """Register with Sphinx."""
    app.setup_extension("sphinx.ext.autodoc")
    # before numpydoc, which makes sections of the lines
    app.connect("autodoc-process-docstring", _plain, priority=100)
    app.connect("autodoc-skip-member", _skipped)
    return {"parallel_read_safe": True, "version": "1"}


def _plain(app, what, name, obj, options, lines):
    if what == "module":
        del lines[next((n for n, line in enumerate(lines) if _ORDER in line), len(lines)) :]
    lines[:] = ["".join(map(_escaped, _LITERAL.split(line))) for line in lines]


def _skipped(app, what, name, obj, skip, options):
    """Skip NumPy functions that are defaults of parameters, because they have no signature."""
    return True if isinstance(obj, np.ufunc) else None


def _escaped(text):
    return text if _LITERAL.fullmatch(text) else re.sub(r"([|*])", r"\\\1", text)
