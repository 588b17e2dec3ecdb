"""EKF-SLAM over simulated runs, and the same with one thing wrong: what lesson 06 breaks."""

from dataclasses import dataclass

import numpy as np

from slamlab.estimators.mak_slam import predict
from slamlab.evaluation import nees
from slamlab.filters.mak import MAK
from slamlab.geometry import wrap
from slamlab.studies import two_halves

EXACT = np.zeros((3, 3))  # the covariance of a robot that stands where its map begins


class NeverSurer(MAK):
    """EKF-SLAM that corrects its mean and leaves P as it was."""

    def correct(self, v, H, columns, R):
        """Update of the mean alone; arguments and result as those of :class:`MAK`."""
        P = self.P
        result = super().correct(v, H, columns, R)
        self._P.lower[:] = P
        return result


class Forgetful(MAK):
    """EKF-SLAM with Smolec's (15) as printed: x = K v, without the x that was."""

    def correct(self, v, H, columns, R):
        """Update that forgets the mean; arguments and result as those of :class:`MAK`."""
        before = self.x.copy()
        result = super().correct(v, H, columns, R)
        self._x[: len(before)] -= before
        return result


@dataclass(frozen=True)
class AtTheEnd:
    """Errors at the end of runs: root mean squares over the runs, and the mean NEES.

    Parameters
    ----------
    landmarks : float, error of the landmarks [m]
    robot : float, error of the robot's position [m]
    claimed : float, what P says of that error [m]
    nees : float, of the pose, 3 where P is right [1]
    """

    landmarks: float
    robot: float
    claimed: float
    nees: float


def drive(run, filter, places_first=False):
    """EKF-SLAM over a run whose landmarks carry their ids: predict, update, augment.

    Parameters
    ----------
    run : LandmarkRun
    filter : MAK, or one with something wrong; it is changed
    places_first : bool, new landmarks enter before the drive is predicted, which is wrong

    Returns
    -------
    (n, 3) poses [m, m, rad], (n, 3, 3) covariances, after each reading
    """
    R, poses, P = two_halves.R(run), [], []
    for reading in run:
        seen = reading.observations
        known = np.isin(seen.ids, filter.ids)
        if places_first:
            _add_new(filter, seen, R)
        predict(filter, reading, run.robot)
        if known.any():
            filter.update(seen.ids[known], seen.z[known], R)
        _add_new(filter, seen, R)
        poses.append(filter.pose)
        P.append(filter.block([0, 1, 2]))
    return np.array(poses), np.array(P)


def at_the_end(runs, make=MAK, P_start=EXACT, places_first=False):
    """How far off robot and map are at the end of runs, and what P says of it.

    Parameters
    ----------
    runs : list of LandmarkRun
    make : class of the filter
    P_start : (3, 3) covariance of the first pose
    places_first : bool, see :func:`drive`

    Returns
    -------
    AtTheEnd
    """
    rows = []
    for run in runs:
        filter = make(np.zeros(3), P_start)
        poses, P = drive(run, filter, places_first)
        error, off = poses[-1] - run.truth.poses[-1], filter.landmarks() - run.landmarks[filter.ids]
        error[2] = wrap(error[2])
        squares = np.mean(np.sum(off**2, axis=1)), error[:2] @ error[:2], np.trace(P[-1, :2, :2])
        rows.append([*squares, nees(error, P[-1])])
    means = np.mean(rows, axis=0)
    return AtTheEnd(*np.sqrt(means[:3]).tolist(), float(means[3]))


def _add_new(filter, seen, R):
    new = ~np.isin(seen.ids, filter.ids)
    if new.any():
        filter.add(seen.ids[new], seen.z[new], R)
