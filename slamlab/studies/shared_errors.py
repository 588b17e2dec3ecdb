"""What robot and landmarks err by together: lesson 07's example, and a map in the long run."""

import numpy as np

from slamlab.estimators.mak_slam import MakSlam
from slamlab.filters.mak import MAK
from slamlab.filters.relative_map import relative_vector
from slamlab.models import observation
from slamlab.sources.landmark_runs import LandmarkRun, Loop

POSE = np.array([0.0, 0.0, 0.4])  # of the robot in the example
LANDMARKS = np.array([[2.0, 0.6], [1.1, -1.4]])
R = np.diag([0.05, 0.03]) ** 2  # of its sensor
LAP = 84  # steps round the default loop


def two_sightings(
    robot_sigma, drive_sigma=0.0, heading_sigma=0.0, prior_sigma=1.0, pose=POSE, landmarks=LANDMARKS
):
    """Two landmarks, of which little is known and nothing is shared, are seen one after the other.

    Parameters
    ----------
    robot_sigma : float, what is known of the robot's x and y at first [m]
    drive_sigma : float, what a drive between the two sightings adds to it [m]
    heading_sigma : float, what is known of the heading [rad]
    prior_sigma : float, what is known of each landmark beforehand: range [m] and bearing [rad]
    pose : (3,) of the robot; it comes back to where it was [m, m, rad]
    landmarks : (2, 2) [m]

    Returns
    -------
    list of three P (7, 7): before, after the first sighting, after the second;
    list of two UpdateResult
    """
    P_start = np.diag([robot_sigma, robot_sigma, heading_sigma]) ** 2
    mak = MAK(pose, P_start, drop_cross_terms_for_demonstration=True)
    mak.add([1, 2], observation.h(pose, landmarks), prior_sigma**2 * np.eye(2))
    mak.drop_cross_terms = False  # only the beginning is without correlations
    stages, steps = [mak.P], []
    for id, drive in ((1, 0.0), (2, drive_sigma)):
        mak.predict(mak.pose, drive**2 * np.diag([1.0, 1.0, 0.0]))
        steps.append(mak.update([id], observation.h(pose, landmarks[[id - 1]]), R))
        stages.append(mak.P)
    return stages, steps


def rigid_motions(landmarks):
    """Directions in which a map moves as a whole: along x, along y, a turn about the origin.

    Equation (07.8).

    Parameters
    ----------
    landmarks : (N, 2) [m]

    Returns
    -------
    (2N, 3) : displacement of each coordinate per metre, metre, radian
    """
    x, y = np.asarray(landmarks, dtype=float).T
    none, one = np.zeros_like(x), np.ones_like(x)
    motions = [[one, none], [none, one], [-y, x]]
    return np.array([np.column_stack(each).ravel() for each in motions]).T


def rigid_share(P, landmarks):
    """Which share of a map's variance lies in its moving as a whole.

    Parameters
    ----------
    P : (2N, 2N) covariance of the landmarks [m²]
    landmarks : (N, 2) [m]

    Returns
    -------
    shifts, turn : float, shares of the trace; the turn is that about the landmarks' middle
    """
    basis, _ = np.linalg.qr(rigid_motions(landmarks))
    shares = np.diag(basis.T @ P @ basis) / np.trace(P)
    return float(shares[:2].sum()), float(shares[2])


def long_run(turn_noise, start_sigma, rounds=12):
    """A robot drives round and round among eight landmarks; how sure it is of one, and of a vector.

    First estimates, for else the filter would gain a certainty that nothing gave it.

    Parameters
    ----------
    turn_noise : float, standard deviation of the measured turn rate; 0 is a perfect compass [rad/s]
    start_sigma : float, how well x and y are known at the start; the heading is exact [m]
    rounds : int

    Returns
    -------
    (n,) rounds driven, (n,) σ of a landmark per axis, (n,) the same of its vector to the next [m],
    MAK at the end
    """
    noise = {"v_sigma": 0.1, "range_sigma": 0.3, "omega_sigma": turn_noise}
    loop = Loop(landmarks=8, steps=LAP * rounds, **noise)
    run, history = LandmarkRun(loop, np.random.default_rng(7)), []
    slam = MakSlam(run.robot, run.sensor)
    P_start = np.diag([start_sigma, start_sigma, 0.0]) ** 2
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
