"""Localisation and mapping by two alternating filters, compared with a joint filter (lesson 05).

The alternating filters are overconfident, because they drop the correlation between pose and
landmarks.
"""

import numpy as np

from course.studies import localisation_and_mapping
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.filters import ekf_localisation
from slamlab.filters.kalman_filter import Belief
from slamlab.filters.known_pose_mapping import KnownPoseMap
from slamlab.models import jacobians, observation


def alternate(run, careful):
    """Estimate pose and map by two filters in turn; return poses (n, 3) and covariances (n, 3, 3).

    If ``careful``, each filter adds the other's covariance to R, as in equation (05.11).
    """
    b, found, beliefs = Belief(np.zeros(3), np.zeros((3, 3))), KnownPoseMap(), []
    R = localisation_and_mapping.R(run)
    for reading in run:
        if reading.time:
            b = localisation_and_mapping.predict(b, reading.odometry, run.robot)
        before, z, ids = b, reading.observations.z, reading.observations.ids.tolist()
        known = [k for k, id in enumerate(ids) if id in found.landmarks]
        if known:
            seen = [found.landmarks[ids[k]] for k in known]
            p = np.array([each.x for each in seen])
            H_p = jacobians.H_landmark(b.x, p)
            extra = H_p @ np.array([each.P for each in seen]) @ np.swapaxes(H_p, 1, 2)
            b, _ = ekf_localisation.update(b, z[known], p, _symmetric(R + careful * extra))
        for id, each in zip(ids, z, strict=True):
            known = found.landmarks.get(id)
            p = observation.g(before.x, each) if known is None else known.x
            H_r = jacobians.H_robot(before.x, p)
            extra = H_r @ before.P @ H_r.T
            found.update(before.x, id, each, _symmetric(R + careful * extra))
        beliefs.append(b)
    return localisation_and_mapping.stacked(beliefs)


def together(run):
    """Estimate pose and map by the joint filter of lesson 06; also return poses and covariances."""
    slam, beliefs = EkfSlam(run.robot, run.sensor), []
    for reading in run:
        slam.step(reading)
        beliefs.append(Belief(slam.pose, slam.filter.block([0, 1, 2])))
    return localisation_and_mapping.stacked(beliefs)


def _symmetric(covariance):
    """Return a covariance that is symmetric to the last bit."""
    return (covariance + np.swapaxes(covariance, -1, -2)) / 2
