"""Every drawing and widget of the course; the only room that imports a plotting library.

Drawing takes plain arrays (:mod:`slamlab.layers`): it computes no pose and no map.
"""

from slamlab.views import boxes
from slamlab.views.cells import cells
from slamlab.views.compare import cloud, curves
from slamlab.views.correlation import correlation
from slamlab.views.figures import COLOURS, axes, chart, panels, png, show
from slamlab.views.growth import growth
from slamlab.views.layers import draw, legend, side_by_side
from slamlab.views.linked import linked
from slamlab.views.live import apart, live
from slamlab.views.overlay import overlay
from slamlab.views.samples import wheel
from slamlab.views.shares import shares
from slamlab.views.sketches import frames
from slamlab.views.widgets import explore

__all__ = [
    "COLOURS",
    "apart",
    "axes",
    "boxes",
    "cells",
    "chart",
    "cloud",
    "correlation",
    "curves",
    "draw",
    "explore",
    "frames",
    "growth",
    "legend",
    "linked",
    "live",
    "overlay",
    "panels",
    "png",
    "shares",
    "show",
    "side_by_side",
    "wheel",
]
