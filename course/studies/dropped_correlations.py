"""EKF-SLAM that drops the cross-covariances (correlations) of its estimates (lesson 07)."""

from dataclasses import dataclass

import numpy as np

from course.studies import localisation_and_mapping
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.evaluation import nees
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.sources.landmark_runs import LandmarkRun

BEGIN = 10  # the start is exact: NEES means nothing in the first steps
CHI2_95 = 5.991  # 95 % of χ² with two degrees of freedom


class DroppedCorrelations(MAK):
    """EKF-SLAM filter that keeps a ``share`` (0 to 1) of every cross-covariance after each step.

    P is multiplied elementwise by a covariance, so it remains a covariance.
    """

    def __init__(self, share):
        forgets = share < 1
        super().__init__(np.zeros(3), np.zeros((3, 3)), drop_cross_terms_for_demonstration=forgets)
        self.share = share

    def _drop_cross_covariances(self):
        L, own = self._P.lower, np.repeat(np.arange((self._P.n - 3) // 2), 2)
        L[3:, :3] *= self.share
        L[3:, 3:][own[:, None] > own] *= self.share  # above the diagonal is unused memory


@dataclass(frozen=True)
class Lap:
    """A run, its EkfSlam, NEES of the pose (steps - BEGIN,), and RMS errors of the filter and of
    odometry [m]."""

    run: LandmarkRun
    slam: EkfSlam
    nees: np.ndarray
    rms: float
    wheels_rms: float

    @property
    def inside(self):
        """The share of the landmarks that are inside their 95 % ellipses."""
        off = self.slam.filter.landmarks() - self.run.landmarks[self.slam.filter.ids]
        return float(np.mean(nees(off, self.slam.filter.blocks()[2]) < CHI2_95))


def laps(loop, share, count):
    """Run a filter that keeps a share of its correlations, for seeds 0 to count − 1."""
    return [_lap(LandmarkRun(loop, np.random.default_rng(seed)), share) for seed in range(count)]


def _lap(run, share):
    slam, P = EkfSlam(run.robot, run.sensor), []
    slam.filter = DroppedCorrelations(share)
    for reading in run:
        slam.step(reading)
        P.append(slam.filter.block([0, 1, 2]))
    poses = slam.trajectory().poses
    of_pose = nees(localisation_and_mapping.pose_errors(run, poses)[BEGIN:], np.array(P)[BEGIN:])
    rms = [
        localisation_and_mapping.rms(run, each)
        for each in (poses, localisation_and_mapping.odometry_poses(run))
    ]
    return Lap(run, slam, of_pose, *rms)
