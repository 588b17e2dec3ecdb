"""EKF localisation in a known map, mapping with known poses, and their evaluation (lesson 05)."""

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.ekf_slam import Q_arc
from slamlab.evaluation import nees
from slamlab.filters import ekf_localisation
from slamlab.filters.kalman_filter import Belief
from slamlab.filters.known_pose_mapping import KnownPoseMap
from slamlab.geometry import compose, wrap
from slamlab.sources.landmark_runs import LandmarkRun
from slamlab.views.layer_drawing import SIGMAS_95


def predict(b, odometry, robot):
    """Predict: x ← x ⊕ odometry, P ← A P Aᵀ + Q. Equation (05.4)."""
    x = compose(b.x, odometry)
    dx, dy = x[:2] - b.x[:2]
    A = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1.0]])
    return ekf_localisation.predict(b, x, A, Q_arc(b.x, odometry, robot))


def locate(run, landmarks, start):
    """Localise a run with an EKF in a map (dict from id to (2,) [m]), starting from a Belief;
    return poses (n, 3) and covariances (n, 3, 3)."""
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


def localised_laps(loop, P_start, wrong_by, count):
    """Localise many laps with an EKF; each lap has its own landmarks, noise, start and map.

    Each landmark of the map has an error of ``wrong_by`` [m]. Yields run, poses, covariances.
    """
    for seed in range(count):
        run, rng = LandmarkRun(loop, np.random.default_rng(seed)), np.random.default_rng([seed, 1])
        start = Belief(rng.multivariate_normal(np.zeros(3), P_start), P_start)
        angle = rng.uniform(0, 2 * np.pi, loop.landmarks)
        wrong = run.landmarks + wrong_by * np.column_stack([np.cos(angle), np.sin(angle)])
        yield run, *locate(run, dict(enumerate(wrong)), start)


def map_from_poses(run, poses):
    """Map a run from poses (n, 3) that are assumed to be exact; return a KnownPoseMap."""
    found = KnownPoseMap()
    for x, id, z in single_observations(run, poses):
        found.update(x, id, z, R(run))
    return found


def single_observations(run, poses):
    """Yield a run's observations one by one: pose (3,), id, z (2,)."""
    for x, reading in zip(poses, run, strict=True):
        for id, z in zip(reading.observations.ids.tolist(), reading.observations.z, strict=True):
            yield x, id, z


def odometry_poses(run):
    """Return the poses of a run by dead reckoning: (n, 3) [m, m, rad]."""
    wheels = DeadReckoning()
    for reading in run:
        wheels.step(reading)
    return wheels.trajectory().poses


def pose_errors(run, poses):
    """Return estimates (n, 3) minus the truth, headings wrapped [m, m, rad]."""
    difference = poses - run.truth.poses
    difference[:, 2] = wrap(difference[:, 2])
    return difference


def rms(run, poses):
    """Return the root mean square position error over a run [m]."""
    return float(np.sqrt(np.mean(np.sum(pose_errors(run, poses)[:, :2] ** 2, axis=1))))


def mean_nees(estimates, begin=0):
    """Return the mean NEES of the pose at each step over several (run, poses, covariances)."""
    return np.mean(
        [nees(pose_errors(run, x)[begin:], P[begin:]) for run, x, P in estimates], axis=0
    )


def landmark_nees(run, poses):
    """Return the mean NEES of landmarks mapped from poses (n, 3): 2 if the covariances are
    right."""
    found = map_from_poses(run, poses).landmarks.items()
    return float(np.mean([nees(b.x - run.landmarks[id], b.P) for id, b in found]))


def ellipse_length(P):
    """Return the lengths (...) of the 95 % confidence ellipses, from end to end, of position
    covariances (..., 2, 2) or of the position in pose covariances (..., 3, 3) [m]."""
    return 2 * SIGMAS_95 * np.sqrt(np.linalg.eigvalsh(P[..., :2, :2])[..., -1])


def R(run):
    """Return the covariance of an observation in a run: (2, 2) [m², rad²]."""
    return np.diag([run.loop.range_sigma, run.loop.bearing_sigma]) ** 2


def stacked(beliefs):
    """Return the means (n, 3) and covariances (n, 3, 3) of Beliefs."""
    return np.array([b.x for b in beliefs]), np.array([b.P for b in beliefs])
