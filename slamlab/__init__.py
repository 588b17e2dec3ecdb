"""Simultaneous localisation and mapping, small enough to read.

Metres, radians, seconds. A pose is ``[x, y, theta]`` with theta counter-clockwise from +x.
"""

__version__ = "0.1.0"
