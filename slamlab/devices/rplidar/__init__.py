"""Slamtec's RPLIDAR: its protocol, and a driver that gives whole turns."""

from slamlab.devices.rplidar.lidar import Lidar

__all__ = ["Lidar"]
