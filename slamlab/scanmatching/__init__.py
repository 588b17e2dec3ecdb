"""Scan matching (scan registration).

Read in this order:

- ``icp_point_to_point``, ``icp_point_to_line``, ``nearest_neighbours``: textbook ICP
- ``scan_matcher``: the scan matcher for SLAM, based on ``preprocessing`` (``beam_order``,
  ``local_line_fits``, ``normals``, ``adaptive_neighbourhoods``, ``quantiles``), ``centroids``,
  ``correlative_matching``, ``correspondences``, ``registration``, ``match_covariance``,
  ``correlated_errors``, ``match_quality`` and ``match_result``
- ``submap``: several scans as one target
"""

from slamlab.scanmatching.icp_point_to_line import point_to_line
from slamlab.scanmatching.icp_point_to_point import point_to_point, rigid_fit
from slamlab.scanmatching.match_result import Iteration, Match
from slamlab.scanmatching.normals import normals
from slamlab.scanmatching.preprocessing import PointCloud, preprocess
from slamlab.scanmatching.scan_matcher import Alignment, match

__all__ = ["Alignment", "Iteration", "Match", "PointCloud", "match", "normals"]
__all__ += ["point_to_line", "point_to_point", "preprocess", "rigid_fit"]
