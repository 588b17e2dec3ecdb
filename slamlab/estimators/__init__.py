"""Estimators, every SLAM of the course: readings go in one at a time, pose and map come out.

Read in this order:

- ``base``: Estimator, what all offer; ``by_name``: make, ``options``: what it takes; ``runner``:
  run, over a whole source
- ``dead_reckoning``: odometry alone
- ``mak_slam``: EKF-SLAM, on ``landmark_observations``; ``wall_slam``, on ``wall_observations``,
  ``wall_merging`` and ``wall_relocalisation`` (after slip, by ``wall_map_fit``): with walls;
  ``foot_slam`` is Smolec's listing, with ``foot_mends`` and ``foot_formulas``
- ``bor_slam``: boxes (set membership); ``montecarlo_slam``: particles, FastSLAM; both take the
  names of corners from ``corner_names``
- ``icp_slam``: scan matching, its map in ``growing_rows``; ``graph_slam``: with keyframes, submaps
  and a pose graph, ``odometry_drift``, ``odometry_calibration``, ``loop_closure`` and
  ``relocalisation``
- ``timestamps``, ``odometry_jumps``: anomalies of a log's clock, of its wheels;
  ``sufficiency``: who works on too little says so
"""

from slamlab._lazy import exports

__all__ = exports(
    __name__,
    {
        ".base": ["Estimator"],
        ".by_name": ["NAMES", "make"],
        ".runner": ["Run", "run"],
        ".bor_slam": ["BorSlam"],
        ".dead_reckoning": ["DeadReckoning", "Odometry"],
        ".foot_mends": ["MENDS"],
        ".foot_slam": ["FootSlam"],
        ".graph_slam": ["GraphSlam"],
        ".icp_slam": ["IcpSlam"],
        ".mak_slam": ["MakSlam"],
        ".montecarlo_slam": ["ParticleSlam"],
        ".wall_slam": ["WallSlam"],
    },
)
