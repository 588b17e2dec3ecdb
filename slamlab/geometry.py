"""Poses in the plane, SE(2): angle wrapping, composition, rigid transformations.

A pose is ``[x, y, theta]`` [m, m, rad]; poses (..., 3) broadcast.
"""

import numpy as np


def wrap(angle):
    """Wrap an angle or an array of angles [rad] to (−π, π] (normalise an angle)."""
    if not isinstance(angle, float):
        angle = np.asarray(angle, dtype=float)
    wrapped = np.pi - (np.pi - angle) % (2 * np.pi)
    # just above pi, the remainder may round to 2 pi, which gives -pi
    if isinstance(wrapped, float):
        return np.pi if wrapped <= -np.pi else wrapped
    wrapped[wrapped <= -np.pi] = np.pi
    return wrapped


def compose(a, b):
    """Pose composition a ⊕ b: pose b, given in a's frame, in a's parent frame. Equation (01.1)."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    if a.ndim == b.ndim == 1:  # Python's floats are faster than numpy's
        (x, y, theta), (dx, dy, turn) = a.tolist(), b.tolist()
        c, s = np.cos(theta), np.sin(theta)
        return np.array([x + c * dx - s * dy, y + s * dx + c * dy, wrap(theta + turn)])
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    out = np.empty((*np.broadcast(a[..., 0], b[..., 0]).shape, 3))
    out[..., 0] = a[..., 0] + c * b[..., 0] - s * b[..., 1]
    out[..., 1] = a[..., 1] + s * b[..., 0] + c * b[..., 1]
    out[..., 2] = wrap(a[..., 2] + b[..., 2])
    return out


def inverse(a):
    """Return the inverse pose: a ⊕ inverse(a) = 0."""
    a = np.asarray(a, dtype=float)
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    x, y = a[..., 0], a[..., 1]
    out = np.empty((*a.shape[:-1], 3))
    out[..., 0] = -c * x - s * y
    out[..., 1] = s * x - c * y
    out[..., 2] = wrap(-a[..., 2])
    return out


def between(a, b):
    """Return the relative pose (increment) from a to b: inverse(a) ⊕ b."""
    return compose(inverse(a), b)


def transform(pose, points):
    """Transform points (n, 2) [m] rigidly: p = (x, y) + Rot(θ) p_r. Equation (01.3)."""
    x, y, theta = pose
    c, s = np.cos(theta), np.sin(theta)
    return np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]]) + np.array([x, y])


def matrix(pose):
    """Return the homogeneous 3 × 3 transformation matrix of a pose (3,), for column vectors."""
    x, y, theta = pose
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, x], [s, c, y], [0.0, 0.0, 1.0]])


def from_matrix(T):
    """Return the pose (3,) of a homogeneous 3 × 3 transformation matrix."""
    return np.array([T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0])])
