"""EKF-SLAM that forgets what its estimates share: the experiment of lesson 07."""

from dataclasses import dataclass

import numpy as np

from slamlab.estimators.mak_slam import MakSlam
from slamlab.evaluation import nees
from slamlab.filters.mak import MAK
from slamlab.sources.landmark_runs import LandmarkRun
from slamlab.studies import two_halves

BEGIN = 10  # the start is exact: NEES means nothing in the first steps
CHI2_95 = 5.991  # 95 % of χ² with two degrees of freedom


class Forgetful(MAK):
    """MAK that keeps a share of every cross-covariance after each step.

    P stays a covariance: it is multiplied, entry by entry, by one.

    Parameters
    ----------
    share : float from 0, only the diagonal blocks, to 1, everything
    """

    def __init__(self, share):
        forgets = share < 1
        super().__init__(np.zeros(3), np.zeros((3, 3)), drop_cross_terms_for_demonstration=forgets)
        self.share = share

    def _drop_cross_covariances(self):
        L, own = self._P.lower, np.repeat(np.arange((self._P.n - 3) // 2), 2)
        L[3:, :3] *= self.share
        L[3:, 3:][own[:, None] > own] *= self.share  # what lies above is unused memory


@dataclass(frozen=True)
class Lap:
    """A run, and what a filter made of it.

    Parameters
    ----------
    run : LandmarkRun
    slam : MakSlam, at the end
    nees : (steps - BEGIN,) of the pose
    rms : float, error of position [m]
    wheels_rms : float, the same by odometry alone [m]
    """

    run: LandmarkRun
    slam: MakSlam
    nees: np.ndarray
    rms: float
    wheels_rms: float

    @property
    def inside(self):
        """float, share of the landmarks that lie in their 95 % ellipses."""
        off = self.slam.filter.landmarks() - self.run.landmarks[self.slam.filter.ids]
        return float(np.mean(nees(off, self.slam.filter.blocks()[2]) < CHI2_95))


def laps(loop, share, count):
    """Drive seeds 0 to count − 1 with a filter that keeps a share of its cross-covariances.

    Parameters
    ----------
    loop : Loop
    share : float, see :class:`Forgetful`
    count : int

    Returns
    -------
    list of Lap
    """
    return [_lap(LandmarkRun(loop, np.random.default_rng(seed)), share) for seed in range(count)]


def _lap(run, share):
    slam, P = MakSlam(run.robot, run.sensor), []
    slam.filter = Forgetful(share)
    for reading in run:
        slam.step(reading)
        P.append(slam.filter.block([0, 1, 2]))
    poses = slam.trajectory().poses
    of_pose = nees(two_halves.off(run, poses)[BEGIN:], np.array(P)[BEGIN:])
    rms = [two_halves.rms(run, each) for each in (poses, two_halves.by_wheels(run))]
    return Lap(run, slam, of_pose, *rms)
