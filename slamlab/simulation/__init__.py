"""Simulated hardware: a differential-drive robot, its range scanners, a wall follower to drive it.

Read in this order:

- ``range_scanners``: Scanner and its presets: lidar, infrared, ultrasonic cone
- ``differential_drive``: Simulator, the true pose, encoders and odometry
- ``wall_follower``: the MAK thesis' controller
- ``cart``: a cart in a corridor, the linear system of lesson 03

Simulated drives as sources of readings are in :mod:`slamlab.sources`.
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".range_scanners": ["GP2D120", "RPLIDAR_A2", "ULTRASONIC", "Scanner"],
        ".differential_drive": ["DifferentialDrive", "Simulator", "arc", "follow"],
        ".wall_follower": ["WallFollower"],
    },
)
