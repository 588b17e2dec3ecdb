"""Scan overlay: two scans in one frame (scan registration), with their correspondences."""

import numpy as np

from slamlab.layers import Points, Segments
from slamlab.views.figures import axes
from slamlab.views.layer_drawing import draw
from slamlab.views.legends import legend


def overlay(first, second, pairs=None, title=None, size=(5, 3.8)):
    """Draw a scan overlay: one scan over another, lines between corresponding points.

    Parameters
    ----------
    first : (m, 2) the scan that stays [m]
    second : (n, 2) the scan that is laid over it, moved already [m]
    pairs : (k, 2) int, correspondences: rows of second and of first, or None
    title : str or None
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    (Figure, Axes)
    """
    fig, ax = axes(title, size)
    if pairs is not None:
        lines = np.hstack([second[pairs[:, 0]], first[pairs[:, 1]]])
        draw(ax, Segments("pairs", lines), linewidth=0.8)
    draw(ax, Points("map", first), label="first scan", markersize=5)
    draw(ax, Points("scan", second), label="second scan", markersize=5)
    legend(ax, loc="upper left")
    return fig, ax
