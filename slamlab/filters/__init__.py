"""Filters: Kalman filter, EKF-SLAM (MAK), set-membership filter (BOR) and particle filters.

Read in this order:

- ``kalman_filter``; ``ekf_localisation`` and ``known_pose_mapping``: the two halves of SLAM
- ``ekf_slam_filter``: EKF-SLAM, on ``augmented_state``, ``triangular_covariance`` (packed
  covariance) and ``landmark_models``; ``data_association``: validation gate
- ``landmark_merging``: duplicates; ``relative_map``; ``compressed_ekf`` and ``submap_joining``
- ``set_membership``: boxes; ``particle_filters``; ``argument_checks``: validation of arguments
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".set_membership": ["BOR", "EmptyIntersection"],
        ".compressed_ekf": ["CompressedEKF"],
        ".kalman_filter": ["Belief"],
        ".known_pose_mapping": ["KnownPoseMap"],
        ".landmark_models": ["LandmarkModel"],
        ".ekf_slam_filter": ["MAK"],
        ".particle_filters.fastslam": ["FastSLAM"],
        ".particle_filters.monte_carlo_localisation": ["MCL"],
        ".particle_filters.particle_set": ["ParticleSet"],
        ".particle_filters.independent_particle_sets": ["IndependentParticleSets"],
        ".submap_joining": ["JoinedMap"],
    },
)
