"""Filters: Kalman filter, EKF-SLAM (MAK), set-membership filter (BOR) and particle filters.

Read in this order:

- ``linear_kalman``; ``ekf_localisation`` and ``known_pose_mapping``, the two halves of SLAM
- ``mak``: EKF-SLAM, on ``augmented_state``, ``landmark_models``, ``update_result``
- ``data_association``: which landmark was seen; ``merging``: two that are one; ``relative_map``,
  ``triangular_covariance``
- ``compressed_ekf``, ``submaps`` (map joining): the same belief at less cost
- ``bor``: set-membership filtering with boxes; ``montecarlo``: particle filters
- ``argument_checks``: what a filter refuses
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".bor": ["BOR", "EmptyIntersection"],
        ".compressed_ekf": ["CompressedMAK"],
        ".linear_kalman": ["Belief"],
        ".known_pose_mapping": ["KnownPoseMap"],
        ".landmark_models": ["LandmarkModel"],
        ".mak": ["MAK"],
        ".montecarlo.fastslam": ["FastSLAM"],
        ".montecarlo.mcl": ["MCL"],
        ".montecarlo.particles": ["ParticleSet"],
        ".montecarlo.sample_sets": ["SampleSets"],
        ".submaps": ["JoinedMap"],
    },
)
