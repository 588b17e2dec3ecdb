"""Linear Kalman filter (Bayes filter of a linear Gaussian system): prediction, and correction with
the Cholesky factor of the innovation covariance."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg.blas import dtrsm, dtrsv
from scipy.linalg.lapack import dpotrf

from slamlab.filters.argument_checks import covariance, matrix, vector


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


@dataclass(frozen=True)
class UpdateResult:
    """Quantities of a measurement update: innovation v = z − h(x), wrapped; innovation covariance
    S = H P Hᵀ + R = L Lᵀ.

    root : L, Cholesky factor; B : P Hᵀ L⁻ᵀ (n, m) with P ← P − B Bᵀ; H : (m, k) over ``columns``.
    """

    innovation: np.ndarray
    S: np.ndarray
    root: np.ndarray
    B: np.ndarray
    H: np.ndarray
    columns: np.ndarray

    @cached_property
    def K(self):
        """(n, m) the Kalman gain P Hᵀ S⁻¹."""
        return dtrsm(1.0, self.root, self.B, side=1, lower=1)

    @cached_property
    def nis(self):
        """NIS, normalised innovation squared vᵀ S⁻¹ v, χ² (m degrees of freedom) if consistent."""
        white = dtrsv(self.root, self.innovation, lower=1)
        return float(white @ white)


def belief(x, P):
    """Create a Gaussian belief, such as a prior. ValueError if P is not a covariance."""
    x = vector("x", x)
    return Belief(x, covariance("P", P, len(x)))


def predict(b, F, Q, G=None, u=None):
    """Predict the state (time update, covariance propagation): x ← F x + G u, P ← F P Fᵀ + Q (MAK
    thesis, 2). Equation (03.11)."""
    n = len(b.x)
    F, Q = matrix("F", F, n, n), covariance("Q", Q, n)
    x = F @ b.x
    if u is not None:
        u = vector("u", u)
        x = x + matrix("G", G, n, len(u)) @ u
    P = F @ b.P @ F.T + Q
    return Belief(x, (P + P.T) / 2)


def update(b, z, H, R):
    """Update the state by a measurement with the Kalman gain K = P Hᵀ S⁻¹, which minimises the
    trace of P (minimum mean square error; MAK thesis, 2). Equation (03.19)."""
    z = vector("z", z)
    H, R = matrix("H", H, len(z), len(b.x)), covariance("R", R, len(z))
    return correct(b, z - H @ b.x, H, R)


def correct(b, innovation, H, R):
    """Correct the state in Joseph form: P ← (I − K H) P (I − K H)ᵀ + K R Kᵀ. Equation (03.18).

    innovation : (m,), wrapped. Returns Belief and UpdateResult. ValueError if S is singular.
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
    """A filter's estimates in all runs and steps: x (runs, steps, n), P (steps, n, n)."""

    x: np.ndarray
    P: np.ndarray
    innovations: np.ndarray
    S: np.ndarray


def filter_runs(b, zs, F, Q, H, R, G=None, us=None):
    """Filter all Monte Carlo runs zs (runs, steps, m) of one system at once. A step has no
    measurement if zs is NaN there in all runs."""
    zs = np.asarray(zs, dtype=float)
    missing = np.isnan(zs).any(axis=-1)
    if zs.ndim != 3 or (missing != missing[:1]).any():
        raise ValueError("zs must have shape (runs, steps, m), NaN at the same steps of all runs")
    x, belief_now, found = np.tile(b.x, (len(zs), 1)), Belief(0 * b.x, b.P), []
    for k in range(zs.shape[1]):
        control = np.zeros(len(b.x)) if us is None else G @ us[k]
        x, belief_now = x @ F.T + control, predict(belief_now, F, Q)
        v, S = zs[:, k] - x @ H.T, H @ belief_now.P @ H.T + R
        if not np.isnan(v).any():
            belief_now, step = update(belief_now, np.zeros(len(H)), H, R)
            x = x + v @ step.K.T
        found.append((x, belief_now.P, v, S))
    x, P, v, S = (np.array(each) for each in zip(*found, strict=True))
    return FilterRuns(x.swapaxes(0, 1), P, v.swapaxes(0, 1), S)
