"""Occlusion: which data of axes a box, such as a legend, would cover."""

import numpy as np
from matplotlib.collections import Collection
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle
from matplotlib.patches import Patch
from matplotlib.text import Text


def labels_within(ax, box):
    """Yield labels of lines, points, areas and texts of laid-out axes within a Bbox [pixels]."""
    inside = box.intersection(box, ax.get_window_extent())
    if inside is None:
        return
    # a band that crosses the axes stays visible
    areas = [patch for patch in ax.patches if patch.get_data_transform() == ax.transData]
    for artist in (*ax.lines, *ax.collections, *areas, *ax.texts):
        if artist.get_visible() and _lies_in(artist, inside):
            yield artist.get_label().lstrip("_")


def _lies_in(artist, box):
    if isinstance(artist, Text):
        return artist.get_text() != "" and artist.get_window_extent().overlaps(box)
    if isinstance(artist, Line2D):
        return _line_lies_in(artist, box)
    if isinstance(artist, Collection):
        return _collection_lies_in(artist, box)
    if isinstance(artist, Patch):
        path = artist.get_path().transformed(artist.get_transform())
        return bool(path.intersects_bbox(box, filled=artist.get_fill()))
    return False


def _line_lies_in(line, box):
    points = line.get_transform().transform(line.get_xydata())
    if _any_within(points, box.padded(_marker_radius(line))):
        return True
    if line.get_linestyle() in ("None", "none", "", " "):
        return False
    path = line.get_path().transformed(line.get_transform())
    return bool(len(path.vertices) and path.intersects_bbox(box, filled=False))


def _marker_radius(line):
    """Return the radius of a line's markers [pixels]."""
    marker = MarkerStyle(line.get_marker())
    outline = marker.get_path().transformed(marker.get_transform()).vertices
    size = line.get_markersize() * line.figure.dpi / 72
    return size * np.abs(outline).max(initial=0.0)


def _collection_lies_in(collection, box):
    offsets = collection.get_offset_transform().transform(collection.get_offsets())
    if len(collection.get_paths()) == 1 and len(offsets) > 1:
        return _any_within(offsets, box)
    shift = collection.get_transform()
    return any(
        path.transformed(shift).intersects_bbox(box, filled=False)
        for path in collection.get_paths()
        if len(path.vertices)
    )


def _any_within(points, box):
    (left, bottom), (right, top) = box.min, box.max
    x, y = points.T
    return bool(((x > left) & (x < right) & (y > bottom) & (y < top)).any())
