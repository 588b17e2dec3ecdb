"""Scan matching (scan registration): where a scan was taken, found by laying it over another.

Read in this order:

- ``icp_point_to_point``, ``icp_point_to_line``, ``nearest_neighbours``: ICP as in lesson 13
- ``matcher``: match, the one that the SLAMs use, a step each in:
  ``surfaces`` (with ``local_line_fits``, ``neighbourhoods``, ``normals``), ``correlative_search``,
  ``correspondences``, ``registration``, ``match_covariance`` (degenerate directions),
  ``common_error``,
  ``match_quality``
- ``submap``: several scans as one, to match the next with; ``match_result``: what comes back
"""

from slamlab.scanmatching.icp_point_to_line import point_to_line
from slamlab.scanmatching.icp_point_to_point import point_to_point, rigid_fit
from slamlab.scanmatching.match_result import Match, Round
from slamlab.scanmatching.matcher import Alignment, match
from slamlab.scanmatching.normals import normals
from slamlab.scanmatching.surfaces import Surface, surface

__all__ = [
    "Alignment",
    "Match",
    "Round",
    "Surface",
    "match",
    "normals",
    "point_to_line",
    "point_to_point",
    "rigid_fit",
    "surface",
]
