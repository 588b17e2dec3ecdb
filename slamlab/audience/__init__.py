"""The class's phones: the slide as it stands, and a poll; a process of its own that listens.

The lecturer's page starts it through the kernel, and then speaks with it directly. Read in this
order:

- ``lecture``: what is known while it lasts: the slides shown, the poll
- ``poll``: a question put to the class: votes, hands, counts
- ``sanitising``: a slide's text and pictures, and nothing else of it
- ``phones``, ``control``: the routes of the two listeners, behind the guard of ``listening``
- ``addresses``: what the phones are told: addresses in this network, a QR code
- ``starting``: ``start``, which the deck calls; the process that runs already is found again
- ``process``, by ``__main__``: its life, from its addresses to its end
"""

from slamlab._lazy import exports

__all__ = exports(__name__, {".starting": ["start"]})
