"""Set-membership SLAM (BOR, bounded-error estimation): boxes contain the truth if noise is bounded.

Read in this order:

- ``intervals``, ``angle_intervals``: interval arithmetic; ``prediction``: the box after a motion
- ``half_planes``: the feasible set of an observation; ``clipping``: its bounding box
- ``contraction``: constraint propagation; ``bor_filter``: the set-membership filter
"""

from slamlab._lazy import exports

__all__ = exports(__name__, {".bor_filter": ["BOR"], ".contraction": ["EmptyIntersection"]})
