"""Plots, figures and widgets (visualisation), without any estimation. Read in this order:

- ``colours``: a colour for each meaning; ``figures``: axes; ``layer_drawing``: layers of estimators
- ``legends``, ``figure_layout``, ``occlusion``: layout of titles and legends
- ``figure_checks``: automatic checks of a figure
- ``notebook_output``, ``figure_display``, ``alt_text``: figures in a notebook, alternative text
- ``comparison``, ``matrix_plot``, ``box_drawing``, ``schematics``, ``process_diagram``: plots
- ``sliders``, ``play_button``: interactive figures
"""

from slamlab.views import box_drawing as boxes
from slamlab.views.colours import COLOURS, SERIES
from slamlab.views.comparison import against_band, cloud, curves, growth, shares, strips
from slamlab.views.figure_display import png, show
from slamlab.views.figures import axes, band, chart, panels, two_sigma
from slamlab.views.layer_drawing import colour, draw, overlay, side_by_side
from slamlab.views.legends import legend, legend_below
from slamlab.views.matrix_plot import cells, colour_bar, correlation, correlations, linked
from slamlab.views.notebook_output import grouped
from slamlab.views.process_diagram import Box, process
from slamlab.views.schematics import bits, encoder, frames, wheel
from slamlab.views.sliders import explore

__all__ = ["COLOURS", "SERIES", "Box", "against_band", "axes", "band", "bits", "boxes", "cells"]
__all__ += ["chart", "cloud", "colour", "colour_bar", "correlation", "correlations", "curves"]
__all__ += ["draw", "encoder", "explore", "frames", "grouped", "growth", "legend", "legend_below"]
__all__ += ["linked", "overlay", "panels", "png", "process", "shares", "show", "side_by_side"]
__all__ += ["strips", "two_sigma", "wheel"]
