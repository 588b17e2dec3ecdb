"""Noise covariances: C, control noise; Q, process noise (motion noise); R, measurement noise."""

import numpy as np


def C_odometry(u, distance_error, turn_error, turn_per_metre=0.0):
    """Control noise covariance C of an odometry increment: distance and turn, growing with both.

    C = diag((k_d d)², (k_θ Δθ)² + (k_s d)²)

    Parameters
    ----------
    u : (2,) distance d [m], turn Δθ [rad]
    distance_error : float k_d, share of the distance [1]
    turn_error : float k_θ, share of the turn [1]
    turn_per_metre : float k_s, turn picked up per metre driven [rad/m]

    Returns
    -------
    (2, 2) [m², rad²]
    """
    d, turn = u
    return np.diag(
        [(distance_error * d) ** 2, (turn_error * turn) ** 2 + (turn_per_metre * d) ** 2]
    )


def C_wheels(u, slip, base):
    """Control noise covariance C of a differential drive whose wheels slip at random.

    d = (l + r)/2 and Δθ = (r − l)/b, l and r having the variances s² |l| and s² |r|

    Parameters
    ----------
    u : (2,) distance d [m], turn Δθ [rad]
    slip : float s, standard deviation of a wheel's way after 1 m [m/√m]
    base : float b, distance of the wheels [m]

    Returns
    -------
    (2, 2) [m², rad²]
    """
    d, turn = u
    left, right = slip**2 * abs(d - turn * base / 2), slip**2 * abs(d + turn * base / 2)
    both, apart = left + right, right - left
    return np.array([[both / 4, apart / (2 * base)], [apart / (2 * base), both / base**2]])


def Q(W, C):
    """Process noise covariance of a motion with control noise C: Q = W C Wᵀ (Smolec (8), mended).

    Equation (04.7).

    Parameters
    ----------
    W : (3, 2) ∂f/∂u, from :mod:`slamlab.models.jacobians`
    C : (2, 2) covariance of the controls

    Returns
    -------
    (3, 3) [m², m², rad²]
    """
    return W @ C @ W.T


def R(r, range_error, bearing_sigma, range_sigma=0.0, range_curvature=0.0):
    """Measurement noise covariance of a range and bearing, growing with range (Smolec (9), mended).

    R = diag((c_1 r)² + σ_0² + (c_2 r²)², σ_β²): variances, not standard deviations.
    Equation (04.15).

    Parameters
    ----------
    r : float, range [m]
    range_error : float c_1, standard deviation as a share of the range [1]
    bearing_sigma : float σ_β [rad]
    range_sigma : float σ_0, standard deviation at range zero [m]
    range_curvature : float c_2, standard deviation per range squared [1/m]

    Returns
    -------
    (2, 2) [m², rad²]
    """
    along = (range_error * r) ** 2 + range_sigma**2 + (range_curvature * r**2) ** 2
    return np.diag([along, bearing_sigma**2])
