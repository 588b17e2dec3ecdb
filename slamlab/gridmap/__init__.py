"""Occupancy grid maps: cells of log-odds that forget what is no longer there.

Read in this order:

- ``ray_traversal``: which cells a beam crosses; ``occupancy_grid``: OccupancyGrid, build
- ``map_server``: files of ROS map_server
"""

from slamlab.gridmap.occupancy_grid import OccupancyGrid, build

__all__ = ["OccupancyGrid", "build"]
