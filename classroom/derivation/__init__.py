"""Derivations line by line, checked by computer algebra, with marked changes.

Read in this order: ``steps`` (``derive``), ``rules``; ``equality``, ``random_points`` (the check);
``changes``, ``marked_latex``, ``derivation_page`` (the display)."""

from classroom.derivation.rules import (
    blockwise,
    differentiate,
    expectation,
    partials,
    symmetric,
)
from classroom.derivation.steps import Derivation, derive

__all__ = [
    "Derivation",
    "blockwise",
    "derive",
    "differentiate",
    "expectation",
    "partials",
    "symmetric",
]
