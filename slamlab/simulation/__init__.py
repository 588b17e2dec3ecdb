"""Simulator of worlds, range scanners, a differential-drive robot and a hand-held lidar.

Read in this order:

- ``worlds``: walls and circles with exact ray casting
- ``range_scanners``: sensor models for lidar, infrared and ultrasonic sensors
- ``differential_drive``: ground-truth pose, encoders, wheel slip, odometry
- ``wall_follower``: controller from the MAK thesis
- ``pedestrian_gait``, ``pedestrians``: person with a hand-held lidar, and other people
- ``linear_system``: linear Gaussian system for the Kalman filter
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".range_scanners": ["GP2D120", "RPLIDAR_A2", "ULTRASONIC", "Scanner"],
        ".differential_drive": ["DifferentialDrive", "Simulator", "arc", "follow_waypoints"],
        ".wall_follower": ["WallFollower"],
    },
)
