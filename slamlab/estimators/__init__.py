"""Estimators (SLAM algorithms), which process one reading at a time and estimate pose and map.

Read in this order:

- ``base``: the base class, with ``plausibility_check``; ``factory``: creation from a name, with
  ``options``; ``runner``, with ``odometry_check``; ``dead_reckoning``: odometry alone
- ``ekf_slam``, with ``landmark_observations``; ``set_membership_slam`` and
  ``particle_filter_slam``, with ``corner_association``: data association by an EKF-SLAM
- ``wall_slam``: line landmarks, with ``wall_merging``, ``slip_relocalisation``, ``wall_map_fit``
- ``foot_point_slam``: Smolec's system, with ``foot_point_corrections``, ``foot_point_formulas``
- ``icp_slam``: scan-to-scan matching, with ``growable_array``; ``laser_odometry``: scans alone
- ``graph_slam``: pose graph, with ``odometry_drift``, ``odometry_calibration``: gains,
  ``loop_closure``: loop-closure candidates and their verification, ``relocalisation``
- ``estimate_warnings``: warnings about a poor estimate
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".base": ["Estimator"],
        ".factory": ["NAMES", "make"],
        ".runner": ["Run", "run"],
        ".set_membership_slam": ["SetMembershipSlam"],
        ".dead_reckoning": ["DeadReckoning"],
        ".foot_point_corrections": ["CORRECTIONS"],
        ".foot_point_slam": ["FootPointSlam"],
        ".graph_slam": ["GraphSlam"],
        ".icp_slam": ["IcpSlam"],
        ".ekf_slam": ["EkfSlam"],
        ".particle_filter_slam": ["ParticleFilterSlam"],
        ".wall_slam": ["WallSlam"],
    },
)
