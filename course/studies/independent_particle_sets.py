"""SLAM with independent particle sets for robot and landmarks (lesson 11): overconfidence from lost
correlations, and drift of an unobserved set by resampling."""

from functools import partial

import numpy as np
from scipy.special import gammaincinv

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.estimators.particle_filter_slam import fastslam, montecarlo
from slamlab.evaluation import nees
from slamlab.geometry import wrap
from slamlab.sources.landmark_runs import LandmarkRun, Loop

LAP = Loop(landmarks=10, steps=100, range_max=3.0, v_sigma=0.03, omega_sigma=0.02)
CLOSE = (0.1, 0.3, 0.8)  # radius below which a set is frozen [m]
WHEELS, EKF, SETS, ONE = "odometry", "EKF", "sets", "sets, one partner"
FAST = {n: f"FastSLAM, {n}" for n in (100, 1000)}
FROZEN = {distance: f"sets, frozen at {distance} m" for distance in CLOSE}
MAKERS = {
    WHEELS: lambda run: DeadReckoning(),
    EKF: lambda run: EkfSlam(run.robot, run.sensor),
    SETS: partial(montecarlo, freeze_distance=0),
    ONE: partial(montecarlo, freeze_distance=0, partners=1),
    **{name: partial(montecarlo, freeze_distance=distance) for distance, name in FROZEN.items()},
    **{name: partial(fastslam, particles=n) for n, name in FAST.items()},
}
MIN_COVARIANCE = 1e-8 * np.eye(3)  # equal particles have a zero covariance
# 95 % quantile of a consistent pose's NEES, χ² with 3 degrees of freedom
LIMIT = 2 * gammaincinv(3 / 2, 0.95)


def lap(seed):
    """Return a run of one lap among ten landmarks."""
    return LandmarkRun(LAP, np.random.default_rng(seed))


def judged(run, slam):
    """Return the RMS position error on a lap [m], and the share of readings whose true pose is
    outside the 95 % region (NaN for odometry)."""
    squared, outside = [], []
    for reading, truth in zip(run, run.truth.poses, strict=True):
        slam.step(reading)
        off = slam.pose - truth
        off[2] = wrap(off[2])
        squared.append(off[0] ** 2 + off[1] ** 2)
        # at the start P is zero, and NEES is undefined
        if hasattr(slam, "filter") and reading.time:
            outside.append(nees(off, _covariance(slam.filter) + MIN_COVARIANCE) > LIMIT)
    return float(np.sqrt(np.mean(squared))), float(np.mean(outside)) if outside else np.nan


def _covariance(filter):
    return filter.robot.moments.P if hasattr(filter, "robot") else filter.block([0, 1, 2])


def resampled_drift(n, steps, sigma, rng, sets=100):
    """Resample the n particles of an unobserved landmark in each step; initial σ per axis [m].

    Returns the RMS drift of the mean and the RMS radius, (steps,) [m]. Equation (11.10).
    """
    places, every = rng.normal(0, sigma, (sets, n, 2)), np.arange(sets)[:, None]
    first, walked, width = places.mean(axis=1), [], []
    for _ in range(steps):
        places = places[every, rng.integers(n, size=(sets, n))]  # n draws from n equal weights
        walked.append(np.mean(np.sum((places.mean(axis=1) - first) ** 2, axis=1)))
        width.append(2 * places.var(axis=1).mean())
    return np.sqrt(walked), np.sqrt(width)
