"""Scan matching: where a scan was taken, told by laying it over another."""

from slamlab.scanmatching.lines import point_to_line
from slamlab.scanmatching.matcher import Alignment, match
from slamlab.scanmatching.normals import normals
from slamlab.scanmatching.points import point_to_point, rigid_fit
from slamlab.scanmatching.result import Match, Round
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
