"""Monte Carlo studies: tables of many runs. Most modules are commands that write a table.

- ``study_command``, ``paired_statistics``: shared by all; ``arena_logs``: data sets as files
- ``rplidar_a2_noise`` (lesson 02), ``intel_maps`` (01, 13, 15): a real lidar, a real log
- ``error_propagation`` (04), ``localisation_and_mapping``, ``alternating_filters``,
  ``pose_posterior_samples`` (05)
- ``ekf_slam_faults`` (06), ``landmark_correlations``, ``dropped_correlations``,
  ``observability``, ``victoria_park`` (07), ``consistency``, ``ideal_ekf_slam``: EKF-SLAM
- ``line_extraction_recall``, ``wall_confirmation`` (08): line extraction, track management
- ``wall_slam_variants``, ``foot_point_ablation``, ``wall_slam_loop``, ``wall_slam_faults``,
  ``corridor``, ``ultrasound_walls``, ``line_extraction_errors`` (09): SLAM with walls
- ``box_containment``, ``bound_violations`` (10): set-membership estimation (BOR)
- ``particle_filters``, ``global_localisation``, ``particle_filter_1d``,
  ``independent_particle_sets`` (11): particle filters
- ``filter_comparison``, ``filter_records``, ``filter_comparison_table``, ``filter_costs``,
  ``arena_corners``, ``filter_consistency`` (12): three filters compared
- ``emir_trials``, ``published_drivers`` (14): devices
- ``odometry_graphs``, ``edge_covariance_frames``, ``false_loop_closures`` (15): pose graphs
"""
