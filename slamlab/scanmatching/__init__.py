"""Scan matching: where a scan was taken, told by laying it over another."""

from slamlab.scanmatching.lines import point_to_line
from slamlab.scanmatching.match import Match, Round
from slamlab.scanmatching.normals import normals
from slamlab.scanmatching.points import point_to_point, rigid_fit

__all__ = ["Match", "Round", "normals", "point_to_line", "point_to_point", "rigid_fit"]
