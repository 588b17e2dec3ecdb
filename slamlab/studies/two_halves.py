"""The two halves of lesson 05: laps in a known map, maps from known poses; how they are judged."""

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.mak_slam import Q_arc
from slamlab.evaluation import nees
from slamlab.filters import ekf_localisation
from slamlab.filters.known_pose_mapping import KnownPoseMap
from slamlab.filters.linear_kalman import Belief
from slamlab.geometry import compose, wrap
from slamlab.sources.landmark_runs import LandmarkRun


def predict(b, odometry, robot):
    """Drive: x ← x ⊕ odometry, P ← A P Aᵀ + Q. Equation (05.4).

    Parameters
    ----------
    b : Belief of the pose
    odometry : (3,) motion in the frame of that pose [m, m, rad]
    robot : RobotModel, how wrong the odometry is

    Returns
    -------
    Belief
    """
    x = compose(b.x, odometry)
    dx, dy = x[:2] - b.x[:2]
    A = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1.0]])
    return ekf_localisation.predict(b, x, A, Q_arc(b.x, odometry, robot))


def locate(run, landmarks, start):
    """EKF localisation over a run: drive, look, drive, look.

    Parameters
    ----------
    run : LandmarkRun
    landmarks : dict, id to (2,): the map; what is not in it is not used [m]
    start : Belief of the first pose

    Returns
    -------
    (n, 3) poses [m, m, rad], (n, 3, 3) covariances, after each reading
    """
    b, beliefs = start, []
    for reading in run:
        if reading.time:
            b = predict(b, reading.odometry, run.robot)
        seen = reading.observations
        known = [k for k, id in enumerate(seen.ids.tolist()) if id in landmarks]
        if known:
            p = [landmarks[id] for id in seen.ids[known].tolist()]
            b, _ = ekf_localisation.update(b, seen.z[known], p, R(run))
        beliefs.append(b)
    return stacked(beliefs)


def laps_located(loop, P_start, wrong_by, count):
    """EKF localisation on many laps, each with its own landmarks, noise, start and wrong map.

    Parameters
    ----------
    loop : Loop
    P_start : (3, 3) covariance of the first pose
    wrong_by : float, how far each landmark stands from where the map says, any direction [m]
    count : int, laps

    Yields
    ------
    run, (n, 3) poses, (n, 3, 3) covariances
    """
    for seed in range(count):
        run, rng = LandmarkRun(loop, np.random.default_rng(seed)), np.random.default_rng([seed, 1])
        start = Belief(rng.multivariate_normal(np.zeros(3), P_start), P_start)
        way = rng.uniform(0, 2 * np.pi, loop.landmarks)
        believed = run.landmarks + wrong_by * np.column_stack([np.cos(way), np.sin(way)])
        yield run, *locate(run, dict(enumerate(believed)), start)


def draw_map(run, poses):
    """Mapping from given poses over a run: a little filter a landmark.

    Parameters
    ----------
    run : LandmarkRun
    poses : (n, 3), taken for exact [m, m, rad]

    Returns
    -------
    KnownPoseMap
    """
    found = KnownPoseMap()
    for x, id, z in sights(run, poses):
        found.see(x, id, z, R(run))
    return found


def sights(run, poses):
    """Everything seen in a run, one after the other, and from where.

    Parameters
    ----------
    run : LandmarkRun
    poses : (n, 3) [m, m, rad]

    Yields
    ------
    (3,) pose, int id, (2,) z
    """
    for x, reading in zip(poses, run, strict=True):
        for id, z in zip(reading.observations.ids.tolist(), reading.observations.z, strict=True):
            yield x, id, z


def by_wheels(run):
    """Poses of a run by dead reckoning: (n, 3) [m, m, rad].

    Parameters
    ----------
    run : LandmarkRun
    """
    wheels = DeadReckoning()
    for reading in run:
        wheels.step(reading)
    return wheels.trajectory().poses


def off(run, poses):
    """Estimates minus the truth, headings wrapped: (n, 3) [m, m, rad].

    Parameters
    ----------
    run : LandmarkRun
    poses : (n, 3) [m, m, rad]
    """
    difference = poses - run.truth.poses
    difference[:, 2] = wrap(difference[:, 2])
    return difference


def rms(run, poses):
    """Root mean square of the error of position over a run [m].

    Parameters
    ----------
    run : LandmarkRun
    poses : (n, 3) [m, m, rad]

    Returns
    -------
    float
    """
    return float(np.sqrt(np.mean(np.sum(off(run, poses)[:, :2] ** 2, axis=1))))


def mean_nees(estimates, begin=0):
    """NEES of the pose, step by step: its mean over runs.

    Parameters
    ----------
    estimates : iterable of (run, poses, covariances)
    begin : int, the first step

    Returns
    -------
    (n - begin,)
    """
    return np.mean([nees(off(run, x)[begin:], P[begin:]) for run, x, P in estimates], axis=0)


def landmark_nees(run, poses):
    """NEES of the landmarks that are mapped from given poses: its mean over the map.

    Parameters
    ----------
    run : LandmarkRun
    poses : (n, 3), taken for exact [m, m, rad]

    Returns
    -------
    float, 2 on average where the covariances are right
    """
    found = draw_map(run, poses).landmarks.items()
    return float(np.mean([nees(b.x - run.landmarks[id], b.P) for id, b in found]))


def R(run):
    """Covariance of a sight in a run: (2, 2) [m², rad²]."""
    return np.diag([run.loop.range_sigma, run.loop.bearing_sigma]) ** 2


def stacked(beliefs):
    """Beliefs as (n, 3) means and (n, 3, 3) covariances."""
    return np.array([b.x for b in beliefs]), np.array([b.P for b in beliefs])
