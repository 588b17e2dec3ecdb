"""Sources of readings (sensor data): simulations, log files, ROS bags, recordings, live devices.

Read in this order:

- ``base``: Source, what all offer; ``opener``: open, by one string
- ``simulated_robot``, ``landmark_runs``, ``arena_runs``: simulations, with their truth
- ``log_file``: lines; ``reading_log``: the project's own format; logs of others: ``carmen``,
  ``breezyslam``, ``rplidar_grabber``, ``ros_bag`` (with ``ros_messages``, ``ros_frames``)
- ``lidar_on_robot``: ``live_devices``, ``emulated_devices``, ``raw_recordings`` of them
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".base": ["Source", "SourceError"],
        ".opener": ["open"],
        "slamlab.files.published_recordings": ["recording"],
        ".reading_log": ["write"],
        ".simulated_robot": ["simulation"],
    },
)
