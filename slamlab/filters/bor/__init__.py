"""BOR: set-membership SLAM (bounded-error estimation); boxes hold the truth if noise is bounded.

Read in this order:

- ``intervals``, ``angle_intervals``: interval arithmetic
- ``prediction``: the box after a motion
- ``half_planes``: the region an observation allows; ``clipping``: its bounding box
- ``contraction``: constraint propagation over landmark, robot and heading; ``bor``: the filter
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {".bor": ["BOR"], ".contraction": ["EmptyIntersection"]},
)
