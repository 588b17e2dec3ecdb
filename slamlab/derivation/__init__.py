"""Derivations line by line: each line named, checked by machine, with what changed in it marked.

Read in this order:

- ``steps``: ``derive`` and its steps
- ``rules``: what leads from one line to the next: ``partials``, ``differentiate``, ``blockwise``
- ``expectation``: the expected value of products of random columns
- ``equality``: whether a line equals the one before; ``random_points``: where that is tried
- ``changes``: what a line holds that the one before did not
- ``marked_latex``, ``derivation_page``: how it is shown
"""

from slamlab.derivation.expectation import expectation
from slamlab.derivation.rules import blockwise, differentiate, partials, symmetric
from slamlab.derivation.steps import Derivation, derive

__all__ = [
    "Derivation",
    "blockwise",
    "derive",
    "differentiate",
    "expectation",
    "partials",
    "symmetric",
]
