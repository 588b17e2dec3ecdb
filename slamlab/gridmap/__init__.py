"""Occupancy grid maps: ``occupancy_grid``; ROS map_server files: ``map_server``, ``map_yaml``."""

from slamlab.gridmap.occupancy_grid import OccupancyGrid, build

__all__ = ["OccupancyGrid", "build"]
