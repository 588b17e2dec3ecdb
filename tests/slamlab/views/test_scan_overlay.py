"""Scan overlay and its correspondences, as data."""

import numpy as np

from slamlab import views

FIRST = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.5]])
SECOND = np.array([[0.1, 0.2], [1.9, 0.4]])


def entries(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_each_pair_is_a_line_from_the_second_scan_to_the_first():
    _, ax = views.overlay(FIRST, SECOND, np.array([[0, 1], [1, 2]]))
    (lines,) = ax.collections
    drawn = [segment.tolist() for segment in lines.get_segments()]
    assert drawn == [[[0.1, 0.2], [1.0, 0.0]], [[1.9, 0.4], [2.0, 0.5]]]
    assert entries(ax) == ["correspondences", "first scan", "second scan"]


def test_without_pairs_only_the_two_scans_are_drawn():
    _, ax = views.overlay(FIRST, SECOND, title="two scans")
    assert not ax.collections
    first, second = (line.get_xydata() for line in ax.lines)
    assert np.array_equal(first, FIRST) and np.array_equal(second, SECOND)
    assert ax.get_title() == "two scans"
