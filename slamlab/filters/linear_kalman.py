"""The linear Kalman filter: prediction and measurement update (correction), as in lesson 03."""

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

    P ← (I − K H) P (I − K H)ᵀ + K R Kᵀ

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
