"""Maps by samples, for lesson 11: what sets kept apart forget, and how a set drifts unseen."""

from functools import partial

import numpy as np
from scipy.special import gammaincinv

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.mak_slam import MakSlam
from slamlab.estimators.montecarlo_slam import fastslam, montecarlo
from slamlab.evaluation import nees
from slamlab.geometry import wrap
from slamlab.sources.landmark_runs import LandmarkRun, Loop

LAP = Loop(landmarks=10, steps=100, range_max=3.0, v_sigma=0.03, omega_sigma=0.02)
CLOSE = (0.1, 0.3, 0.8)  # sets within this are frozen [m]
WHEELS, EKF, SETS, ONE = "odometry", "EKF", "sets", "sets, one partner"
FAST = {n: f"FastSLAM, {n}" for n in (100, 1000)}
FROZEN = {close: f"sets, frozen at {close} m" for close in CLOSE}
MAKERS = {
    WHEELS: lambda run: DeadReckoning(),
    EKF: lambda run: MakSlam(run.robot, run.sensor),
    SETS: partial(montecarlo, close=0),
    ONE: partial(montecarlo, close=0, partners=1),
    **{name: partial(montecarlo, close=close) for close, name in FROZEN.items()},
    **{name: partial(fastslam, samples=n) for n, name in FAST.items()},
}
HAIR = 1e-8 * np.eye(3)  # a cloud of equal samples has no width at all
# of the NEES of a pose, χ² of 3: an honest one is above it in one case of twenty
LIMIT = 2 * gammaincinv(3 / 2, 0.95)


def lap(seed):
    """A lap among ten landmarks.

    Parameters
    ----------
    seed : int

    Returns
    -------
    LandmarkRun
    """
    return LandmarkRun(LAP, np.random.default_rng(seed))


def judged(run, slam):
    """How far a pose is off on a lap, and how often farther than its belief allows.

    Parameters
    ----------
    run : LandmarkRun
    slam : Estimator; it is changed

    Returns
    -------
    float, root mean square error of the position [m]
    float, share of the readings with the true pose outside of the 95 % region [1]; NaN of
        odometry, which believes nothing
    """
    squared, outside = [], []
    for reading, truth in zip(run, run.truth.poses, strict=True):
        slam.step(reading)
        off = slam.pose - truth
        off[2] = wrap(off[2])
        squared.append(off[0] ** 2 + off[1] ** 2)
        # at the start P is zero, and nothing can be said
        if hasattr(slam, "filter") and reading.time:
            outside.append(nees(off, _covariance(slam.filter) + HAIR) > LIMIT)
    return float(np.sqrt(np.mean(squared))), float(np.mean(outside)) if outside else np.nan


def _covariance(filter):
    return filter.robot.moments.P if hasattr(filter, "robot") else filter.block([0, 1, 2])


def drawn_anew(n, steps, sigma, rng, sets=100):
    """An object that nobody looks at: its set is drawn anew in each step. Equation (11.10).

    Parameters
    ----------
    n : int, samples of a set
    steps : int
    sigma : float, standard deviation of a set at first, in x and in y [m]
    rng : numpy.random.Generator
    sets : int, how many are tried

    Returns
    -------
    (steps,) root mean square way of the sets' mean [m], (steps,) what the sets believe of it: their
    root mean square radius [m]
    """
    places, every = rng.normal(0, sigma, (sets, n, 2)), np.arange(sets)[:, None]
    first, walked, width = places.mean(axis=1), [], []
    for _ in range(steps):
        places = places[every, rng.integers(n, size=(sets, n))]  # n draws from n equal weights
        walked.append(np.mean(np.sum((places.mean(axis=1) - first) ** 2, axis=1)))
        width.append(2 * places.var(axis=1).mean())
    return np.sqrt(walked), np.sqrt(width)
