"""EKF-SLAM on simulated runs, correct or with one fault (lesson 06)."""

from dataclasses import dataclass

import numpy as np

from course.studies import localisation_and_mapping
from slamlab.estimators.ekf_slam import predict
from slamlab.evaluation import nees
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import wrap

EXACT = np.zeros((3, 3))  # covariance of a start pose that defines the map's frame


class MeanOnlyUpdate(MAK):
    """EKF-SLAM whose update corrects only the mean, not P."""

    def correct(self, v, H, columns, R):
        P = self.P
        result = super().correct(v, H, columns, R)
        self._P.lower[:] = P
        return result


class PriorMeanLost(MAK):
    """EKF-SLAM with Smolec's equation (15) as printed: x = K v, without the prior mean."""

    def correct(self, v, H, columns, R):
        before = self.x.copy()
        result = super().correct(v, H, columns, R)
        self._x[: len(before)] -= before
        return result


@dataclass(frozen=True)
class FinalErrors:
    """RMS errors at the end of runs, the robot's standard deviation ``claimed`` by P [m], and the
    mean NEES, which is 3 if P is right."""

    landmarks: float
    robot: float
    claimed: float
    nees: float


def run_filter(run, filter, landmarks_first=False):
    """Run EKF-SLAM on a LandmarkRun; return poses (n, 3) and covariances (n, 3, 3).

    If ``landmarks_first``, new landmarks are added before the prediction, which is wrong.
    """
    R, poses, P = localisation_and_mapping.R(run), [], []
    for reading in run:
        seen = reading.observations
        known = np.isin(seen.ids, filter.ids)
        if landmarks_first:
            _add_new(filter, seen, R)
        predict(filter, reading, run.robot)
        if known.any():
            filter.update(seen.ids[known], seen.z[known], R)
        _add_new(filter, seen, R)
        poses.append(filter.pose)
        P.append(filter.block([0, 1, 2]))
    return np.array(poses), np.array(P)


def final_errors(runs, make=MAK, P_start=EXACT, landmarks_first=False):
    """Return the FinalErrors of LandmarkRuns; each run uses a new filter from ``make``."""
    rows = []
    for run in runs:
        filter = make(np.zeros(3), P_start)
        poses, P = run_filter(run, filter, landmarks_first)
        error, off = poses[-1] - run.truth.poses[-1], filter.landmarks() - run.landmarks[filter.ids]
        error[2] = wrap(error[2])
        squares = np.mean(np.sum(off**2, axis=1)), error[:2] @ error[:2], np.trace(P[-1, :2, :2])
        rows.append([*squares, nees(error, P[-1])])
    means = np.mean(rows, axis=0)
    return FinalErrors(*np.sqrt(means[:3]).tolist(), float(means[3]))


def _add_new(filter, seen, R):
    new = ~np.isin(seen.ids, filter.ids)
    if new.any():
        filter.add(seen.ids[new], seen.z[new], R)
