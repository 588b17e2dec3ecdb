"""Correlations of robot and landmarks in EKF-SLAM: a small example, and the limit of a map's
covariance (lesson 07)."""

import numpy as np

from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.relative_map import relative_vector
from slamlab.models import observation
from slamlab.sources.landmark_runs import LandmarkRun, Loop

POSE = np.array([0.0, 0.0, 0.4])  # of the robot in the example
LANDMARKS = np.array([[2.0, 0.6], [1.1, -1.4]])
R = np.diag([0.05, 0.03]) ** 2  # of its sensor
LAP = 84  # steps round the default loop


def two_observations(
    robot_sigma,
    motion_sigma=0.0,
    heading_sigma=0.0,
    prior_sigma=1.0,
    pose=POSE,
    landmarks=LANDMARKS,
):
    """Observe two uncorrelated landmarks in succession.

    The standard deviations are for the robot's x and y, a motion in between [m], the heading [rad],
    and each landmark's prior [m]. Returns P (7, 7) before the observations, after the first one and
    after the second one, and both UpdateResults.
    """
    P_start = np.diag([robot_sigma, robot_sigma, heading_sigma]) ** 2
    mak = MAK(pose, P_start, drop_cross_terms_for_demonstration=True)
    mak.add([1, 2], observation.h(pose, landmarks), prior_sigma**2 * np.eye(2))
    mak.drop_cross_terms = False  # only the beginning is without correlations
    stages, steps = [mak.P], []
    for id, drive in ((1, 0.0), (2, motion_sigma)):
        mak.predict(mak.pose, drive**2 * np.diag([1.0, 1.0, 0.0]))
        steps.append(mak.update([id], observation.h(pose, landmarks[[id - 1]]), R))
        stages.append(mak.P)
    return stages, steps


def rigid_motions(landmarks):
    """Return the directions (2N, 3) of rigid motions of landmarks (N, 2): along x, along y,
    rotation about the origin. Equation (07.8)."""
    x, y = np.asarray(landmarks, dtype=float).T
    none, one = np.zeros_like(x), np.ones_like(x)
    motions = [[one, none], [none, one], [-y, x]]
    return np.array([np.column_stack(each).ravel() for each in motions]).T


def rigid_share(P, landmarks):
    """Return the shares of a map's variance, P (2N, 2N), in rigid translation and rotation."""
    basis, _ = np.linalg.qr(rigid_motions(landmarks))
    shares = np.diag(basis.T @ P @ basis) / np.trace(P)
    return float(shares[:2].sum()), float(shares[2])


def long_run(turn_noise, start_sigma, laps=12):
    """Simulate many laps among eight landmarks, given σ of the turn rate [rad/s] and of the initial
    x, y [m].

    Returns the laps so far, σ per axis of a landmark and of the vector to the next landmark, (n,)
    [m], and the MAK.
    """
    noise = {"v_sigma": 0.1, "range_sigma": 0.3, "omega_sigma": turn_noise}
    loop = Loop(landmarks=8, steps=LAP * laps, **noise)
    run, history = LandmarkRun(loop, np.random.default_rng(7)), []
    slam = EkfSlam(run.robot, run.sensor)
    P_start = np.diag([start_sigma, start_sigma, 0.0]) ** 2
    # with standard Jacobians the filter would become overconfident
    slam.filter = MAK(np.zeros(3), P_start, first_estimates=True)
    for reading in run:
        slam.step(reading)
        ids = slam.filter.ids
        if len(ids) > 4:
            own = slam.filter.block(slam.filter.rows(ids[3:4]))
            _, P_vector = relative_vector(slam.filter, *ids[3:5])
            sigmas = np.sqrt([own.trace() / 2, P_vector.trace() / 2])
            history.append([reading.time / LAP, *sigmas])
    return *np.array(history).T, slam.filter
