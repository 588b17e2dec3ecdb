"""Sources of readings (sensor data): simulations, logs, ROS bags, recordings, live devices.

Read in this order:

- ``base``: Source; ``disk_buffer``: parsed readings in memory or on disk; ``log_units``
- ``opener``: open; ``unsupported_formats``; ``public_datasets`` and their
  ``downloading``; ``calibration_overrides``: mounting, field of view and units set by the user
- ``simulated_robot``, ``landmark_runs``, ``arena_runs``, ``handheld_lidar``: simulations with
  ground truth
- ``reading_log``: the library's own format; other formats: ``carmen``, ``breezyslam``,
  ``rplidar_text``, ``ros_bag``
- ``gtsam_text``: odometry and landmark measurements of a graph
- for CARMEN logs: ``carmen_messages``, ``carmen_lasers``, ``carmen_geometry``,
  ``carmen_beam_angles``; for RPLIDAR text: ``rplidar_text_formats``
- for ROS bags: ``ros_bag_files``, ``ros_bag_reader``, ``ros_decoding``, ``ros_topics``;
  ``ros_messages``, ``ros_scans``; ``ros_time_synchronisation``, ``ros_pose_interpolation``,
  ``ros_tf_tree``, ``ros_odometry``; ``ros_beam_order``
- ``lidar_on_robot``: deskewed scans for ``live_devices``, ``emulated_devices``, ``raw_recordings``
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".calibration_overrides": ["CalibrationOverrides", "override_calibration"],
        ".base": ["Source", "SourceError"],
        ".opener": ["open"],
        ".public_datasets": ["recording"],
        ".reading_log": ["write"],
        ".simulated_robot": ["simulation"],
    },
)
