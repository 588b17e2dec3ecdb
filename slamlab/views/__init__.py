"""Plots, figures and widgets (visualisation); the only room that imports a plotting library.

Drawing takes plain arrays (:mod:`slamlab.layers`): it computes no pose and no map.

Read in this order:

- ``colours``: one a meaning; ``figures``: axes; ``layer_drawing``: what an estimator shows
- ``legends``, ``arrangement``, ``covering``: where legends and titles find room
- ``figure_faults``: what a machine can see to be wrong with a figure
- ``showing``, ``figure_words``: how a figure reaches a notebook, and its alternative text
- ``comparison``, ``bit_plot``, ``box_drawing``, ``heatmap``, ``interval_plot``, ``loglog_plot``,
  ``matrix_plot``, ``linked_map``, ``scan_overlay``, ``strip_plot``, ``resampling_wheel``,
  ``frame_sketches``, ``encoder_sketch``, ``process_diagram``: one plot each
- ``sliders``, ``play_button``, ``widget_errors``: interactive figures
- ``player``: the drawing in a browser, in JavaScript; of what runs and of films
- ``live``: any source and estimator, live, driven by hand; ``editor``: a world edited by hand
"""

from slamlab.displays import grouped
from slamlab.views import box_drawing as boxes
from slamlab.views.bit_plot import bits
from slamlab.views.colours import COLOURS, SERIES
from slamlab.views.comparison import against_band, cloud, curves
from slamlab.views.encoder_sketch import encoder
from slamlab.views.figures import axes, band, chart, panels, two_sigma
from slamlab.views.frame_sketches import frames
from slamlab.views.heatmap import cells
from slamlab.views.interval_plot import shares
from slamlab.views.layer_drawing import colour, draw, side_by_side
from slamlab.views.legends import legend, legend_below
from slamlab.views.linked_map import linked
from slamlab.views.live import apart, live
from slamlab.views.loglog_plot import growth
from slamlab.views.matrix_plot import colour_bar, correlation, correlations
from slamlab.views.process_diagram import Box, process
from slamlab.views.resampling_wheel import wheel
from slamlab.views.scan_overlay import overlay
from slamlab.views.showing import png, show
from slamlab.views.sliders import explore
from slamlab.views.strip_plot import strips

__all__ = [
    "COLOURS",
    "SERIES",
    "Box",
    "against_band",
    "apart",
    "axes",
    "band",
    "bits",
    "boxes",
    "cells",
    "chart",
    "cloud",
    "colour",
    "colour_bar",
    "correlation",
    "correlations",
    "curves",
    "draw",
    "encoder",
    "explore",
    "frames",
    "grouped",
    "growth",
    "legend",
    "legend_below",
    "linked",
    "live",
    "overlay",
    "panels",
    "png",
    "process",
    "shares",
    "show",
    "side_by_side",
    "strips",
    "two_sigma",
    "wheel",
]
