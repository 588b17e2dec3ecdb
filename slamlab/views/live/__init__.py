"""The one live view: any source and estimator, run, paused, stepped, reset and driven by hand.

What is seen are layers (:mod:`slamlab.layers`); nothing in here computes a pose or a map.
"""

from slamlab.views.live.apart import apart
from slamlab.views.live.show import live

__all__ = ["apart", "live"]
