"""What a scan counts as a return."""

import numpy as np

from slamlab.readings import Scan


def test_a_scan_keeps_only_beams_that_returned_within_its_limits():
    ranges = np.array([np.nan, 0.05, 0.2, 1.0, 4.0, 7.9, 8.0, np.inf, -1.0])
    scan = Scan(np.linspace(0, 1, 9), ranges, range_max=8.0, range_min=0.1)
    np.testing.assert_array_equal(ranges[scan.valid], [0.2, 1.0, 4.0, 7.9])


def test_the_points_of_a_scan_lie_at_range_and_bearing_in_the_order_of_the_beams():
    angles = np.array([0.1, -2.0, 3.0, 1.5])
    ranges = np.array([2.0, np.nan, 0.5, 4.0])
    points = Scan(angles, ranges).points()
    assert points.shape == (3, 2)
    np.testing.assert_allclose(np.hypot(*points.T), [2.0, 0.5, 4.0])
    np.testing.assert_allclose(np.arctan2(points[:, 1], points[:, 0]), [0.1, 3.0, 1.5])
