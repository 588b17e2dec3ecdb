"""Occupancy grids: maps of cells that forget what is no longer there."""

from slamlab.gridmap.grid import OccupancyGrid, build

__all__ = ["OccupancyGrid", "build"]
