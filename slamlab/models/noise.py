"""Noise covariances: control C (odometry noise), process noise Q (covariance propagation),
measurement noise R."""

import numpy as np


def C_odometry(u, distance_error, turn_error, turn_per_metre=0.0):
    """Control noise covariance of an odometry increment: C = diag((k_d d)², (k_θ Δθ)² + (k_s d)²).
    Returns (2, 2) [m², rad²].

    Parameters
    ----------
    u : (2,) d [m], Δθ [rad]
    distance_error, turn_error : float k_d, k_θ [1]
    turn_per_metre : float k_s [rad/m]
    """
    d, turn = u
    return np.diag(
        [(distance_error * d) ** 2, (turn_error * turn) ** 2 + (turn_per_metre * d) ** 2]
    )


def C_wheels(u, slip, base):
    """Control noise covariance C of a differential drive with random wheel slip.

    Equation (02.16): d = (l + r)/2, Δθ = (r − l)/b; the variances of l, r are s² |l|, s² |r|

    Returns (2, 2) [m², rad²].

    Parameters
    ----------
    u : (2,) d [m], Δθ [rad]
    slip : float s [m/√m]
    base : float b, distance between the wheels [m]
    """
    d, turn = u
    left, right = slip**2 * abs(d - turn * base / 2), slip**2 * abs(d + turn * base / 2)
    both, apart = left + right, right - left
    return np.array([[both / 4, apart / (2 * base)], [apart / (2 * base), both / base**2]])


def Q(W, C):
    """Process noise covariance of a motion: Q = W C Wᵀ (Smolec (8), corrected). Equation (04.7).
    Returns (3, 3) [m², m², rad²].

    Parameters
    ----------
    W : (3, 2) ∂f/∂u
    C : (2, 2) control noise covariance
    """
    return W @ C @ W.T


def R(r, range_error, bearing_sigma, range_sigma=0.0, range_curvature=0.0):
    """Measurement noise covariance of range and bearing (Smolec (9), corrected). Equation (04.15).

    R = diag((c_1 r)² + σ_0² + (c_2 r²)², σ_β²)

    Returns (2, 2) [m², rad²].

    Parameters
    ----------
    r : float [m]
    range_error : float c_1 [1]
    bearing_sigma : float σ_β [rad]
    range_sigma : float σ_0 [m]
    range_curvature : float c_2 [1/m]
    """
    along = (range_error * r) ** 2 + range_sigma**2 + (range_curvature * r**2) ** 2
    return np.diag([along, bearing_sigma**2])
