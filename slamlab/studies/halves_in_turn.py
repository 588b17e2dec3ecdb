"""Two filters that take turns where neither pose nor map is known, and one for both beside them.

Lesson 05 shows that taking turns is overconfident: what pose and landmark share is not kept.
"""

import numpy as np

from slamlab.estimators.mak_slam import MakSlam
from slamlab.filters import ekf_localisation
from slamlab.filters.known_pose_mapping import KnownPoseMap
from slamlab.filters.linear_kalman import Belief
from slamlab.models import jacobians, observation
from slamlab.studies import two_halves


def in_turn(run, careful):
    """Pose and map by two filters that take turns, neither of which is known.

    Parameters
    ----------
    run : LandmarkRun
    careful : bool, each half adds the other's covariance to R, as in equation (05.11); False: each
        takes the other's estimate for exact

    Returns
    -------
    (n, 3) poses [m, m, rad], (n, 3, 3) covariances, after each reading
    """
    b, found, beliefs = Belief(np.zeros(3), np.zeros((3, 3))), KnownPoseMap(), []
    R = two_halves.R(run)
    for reading in run:
        if reading.time:
            b = two_halves.predict(b, reading.odometry, run.robot)
        before, z, ids = b, reading.observations.z, reading.observations.ids.tolist()
        known = [k for k, id in enumerate(ids) if id in found.landmarks]
        if known:
            seen = [found.landmarks[ids[k]] for k in known]
            p = np.array([each.x for each in seen])
            H_p = jacobians.H_landmark(b.x, p)
            doubt = H_p @ np.array([each.P for each in seen]) @ np.swapaxes(H_p, 1, 2)
            b, _ = ekf_localisation.update(b, z[known], p, _even(R + careful * doubt))
        for id, each in zip(ids, z, strict=True):
            known = found.landmarks.get(id)
            p = observation.g(before.x, each) if known is None else known.x
            H_r = jacobians.H_robot(before.x, p)
            doubt = H_r @ before.P @ H_r.T
            found.see(before.x, id, each, _even(R + careful * doubt))
        beliefs.append(b)
    return two_halves.stacked(beliefs)


def together(run):
    """Pose and map in one filter, as lesson 06 derives it (EKF-SLAM); returns what in_turn does.

    Parameters
    ----------
    run : LandmarkRun

    Returns
    -------
    (n, 3) poses [m, m, rad], (n, 3, 3) covariances, after each reading
    """
    slam, beliefs = MakSlam(run.robot, run.sensor), []
    for reading in run:
        slam.step(reading)
        beliefs.append(Belief(slam.pose, slam.filter.block([0, 1, 2])))
    return two_halves.stacked(beliefs)


def _even(covariance):
    """Symmetric to the last bit, which rounding may have taken away."""
    return (covariance + np.swapaxes(covariance, -1, -2)) / 2
