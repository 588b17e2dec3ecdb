"""The linear Kalman filter of lesson 03: prediction and measurement update (correction)."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg.blas import dtrsm
from scipy.linalg.lapack import dpotrf

from slamlab.filters.argument_checks import covariance, matrix, vector
from slamlab.filters.update_result import UpdateResult


@dataclass(frozen=True)
class Belief:
    """A Gaussian belief (state estimate): a mean and its covariance.

    Parameters
    ----------
    x : (n,)
    P : (n, n) symmetric positive semidefinite
    """

    x: np.ndarray
    P: np.ndarray


def belief(x, P):
    """A checked Gaussian belief, such as the prior (initial state) of a filter.

    Parameters
    ----------
    x : (n,)
    P : (n, n)

    Returns
    -------
    Belief

    Raises
    ------
    ValueError : wrong shape, NaN, or P no covariance
    """
    x = vector("x", x)
    return Belief(x, covariance("P", P, len(x)))


def predict(b, F, Q, G=None, u=None):
    """Prediction (time update): x ← F x + G u,  P ← F P Fᵀ + Q (MAK thesis, chapter 2).

    Equation (03.8).

    Parameters
    ----------
    b : Belief of size n
    F : (n, n) state transition
    Q : (n, n) process noise
    G : (n, k) input matrix, or None
    u : (k,) input (control), or None

    Returns
    -------
    Belief

    Raises
    ------
    ValueError
    """
    n = len(b.x)
    F, Q = matrix("F", F, n, n), covariance("Q", Q, n)
    x = F @ b.x
    if u is not None:
        u = vector("u", u)
        x = x + matrix("G", G, n, len(u)) @ u
    P = F @ b.P @ F.T + Q
    return Belief(x, (P + P.T) / 2)


def update(b, z, H, R):
    """Measurement update; the Kalman gain K = P Hᵀ S⁻¹ minimises trace P (MAK thesis, chapter 2).

    Equation (03.16).

    Parameters
    ----------
    b : Belief of size n
    z : (m,) measurement
    H : (m, n) measurement matrix
    R : (m, m) measurement noise

    Returns
    -------
    Belief, UpdateResult

    Raises
    ------
    ValueError
    """
    z = vector("z", z)
    H, R = matrix("H", H, len(z), len(b.x)), covariance("R", R, len(z))
    return correct(b, z - H @ b.x, H, R)


def correct(b, innovation, H, R):
    """Kalman correction for a given innovation (already wrapped), in Joseph form.

    P ← (I − K H) P (I − K H)ᵀ + K R Kᵀ. Equation (03.15).

    Parameters
    ----------
    b : Belief of size n
    innovation : (m,)
    H : (m, n) measurement matrix (Jacobian)
    R : (m, m) measurement noise

    Returns
    -------
    Belief, UpdateResult

    Raises
    ------
    ValueError : S is singular
    """
    PHt = b.P @ H.T
    S = H @ PHt + R
    root, failed = dpotrf(S, lower=1, clean=1)
    if failed:
        raise ValueError("S = H P Hᵀ + R is singular: give R a positive variance")
    B = dtrsm(1.0, root, PHt, side=1, lower=1, trans_a=1)
    step = UpdateResult(innovation, S, root, B, H, np.arange(len(b.x)))
    I_KH = np.eye(len(b.x)) - step.K @ H
    P = I_KH @ b.P @ I_KH.T + step.K @ R @ step.K.T
    return Belief(b.x + step.K @ innovation, (P + P.T) / 2), step


@dataclass(frozen=True)
class FilterRuns:
    """What a filter believed in many runs of one system, after each step.

    Parameters
    ----------
    x : (runs, steps, n) estimates
    P : (steps, n, n) their covariance, the same in all runs
    innovations : (runs, steps, m), NaN where nothing was measured
    S : (steps, m, m) covariance of the innovations
    """

    x: np.ndarray
    P: np.ndarray
    innovations: np.ndarray
    S: np.ndarray


def filter_runs(b, zs, F, Q, H, R, G=None, us=None):
    """Filter many runs at once, a prediction and an update a step; what is NaN was not measured.

    P needs no measurement: gains are computed once, and serve all runs.

    Parameters
    ----------
    b : Belief of size n before the first step
    zs : (runs, steps, m) measurements; the same steps are NaN in all runs
    F, Q, H, R : as in ``predict`` and ``update``
    G : (n, k) input matrix, or None
    us : (steps, k) inputs, or None

    Returns
    -------
    FilterRuns

    Raises
    ------
    ValueError : runs that measure at different steps, and what ``predict`` and ``update`` refuse
    """
    zs = np.asarray(zs, dtype=float)
    missing = np.isnan(zs).any(axis=-1)
    if zs.ndim != 3 or (missing != missing[:1]).any():
        raise ValueError("zs: expected (runs, steps, m), NaN at the same steps of all runs")
    x, belief_now, found = np.tile(b.x, (len(zs), 1)), Belief(0 * b.x, b.P), []
    for k in range(zs.shape[1]):
        push = np.zeros(len(b.x)) if us is None else G @ us[k]
        x, belief_now = x @ F.T + push, predict(belief_now, F, Q)
        v, S = zs[:, k] - x @ H.T, H @ belief_now.P @ H.T + R
        if not np.isnan(v).any():
            belief_now, step = update(belief_now, np.zeros(len(H)), H, R)
            x = x + v @ step.K.T
        found.append((x, belief_now.P, v, S))
    x, P, v, S = (np.array(each) for each in zip(*found, strict=True))
    return FilterRuns(x.swapaxes(0, 1), P, v.swapaxes(0, 1), S)
