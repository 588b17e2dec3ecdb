"""Scan matching (scan registration).

Read in this order:

- ``icp_point_to_point``, ``icp_point_to_line``, ``nearest_neighbours``: textbook ICP
- ``scan_matcher``: the scan matcher for SLAM, based on ``preprocessing`` (``beam_order``,
  ``local_line_fits``, ``normals``, ``adaptive_neighbourhoods``, ``quantiles``), ``centroids``,
  ``correlative_matching``, ``correspondences``, ``registration``, ``match_covariance``,
  ``correlated_errors``, ``match_quality`` and ``match_result``
- ``submap``: several scans as one target
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".icp_point_to_line": ["point_to_line"],
        ".icp_point_to_point": ["point_to_point", "rigid_fit"],
        ".match_result": ["Iteration", "Match"],
        ".normals": ["normals"],
        ".preprocessing": ["PointCloud", "preprocess"],
        ".scan_matcher": ["Alignment", "match"],
    },
)
