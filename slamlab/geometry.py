"""Poses in the plane, SE(2): wrap angles (angle wrapping), compose poses, rigid transforms.

A pose is ``[x, y, theta]`` in metres and radians; a homogeneous 3x3 matrix acts on column vectors.
Leading dimensions broadcast: ``(..., 3)`` poses are handled at once.
"""

import numpy as np


def wrap(angle):
    """Wrap an angle to (-pi, pi] (normalise); the only place in the package where this is done.

    Parameters
    ----------
    angle : float or (...,) array [rad]

    Returns
    -------
    float or (...,) array [rad]
    """
    if not isinstance(angle, float):
        angle = np.asarray(angle, dtype=float)
    wrapped = np.pi - (np.pi - angle) % (2 * np.pi)
    # the remainder may round up to 2 pi just above pi, which would give -pi
    if isinstance(wrapped, float):
        return np.pi if wrapped <= -np.pi else wrapped
    wrapped[wrapped <= -np.pi] = np.pi
    return wrapped


def compose(a, b):
    """Pose composition a ⊕ b: pose b, given in the frame of pose a, in a's own reference frame.

    Equation (01.1).

    Parameters
    ----------
    a, b : (..., 3) [m, m, rad]

    Returns
    -------
    (..., 3) [m, m, rad], heading wrapped
    """
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    out = np.empty((*np.broadcast(a[..., 0], b[..., 0]).shape, 3))
    out[..., 0] = a[..., 0] + c * b[..., 0] - s * b[..., 1]
    out[..., 1] = a[..., 1] + s * b[..., 0] + c * b[..., 1]
    out[..., 2] = wrap(a[..., 2] + b[..., 2])
    return out


def inverse(a):
    """Inverse pose, which undoes a: a ⊕ inverse(a) = 0.

    Parameters
    ----------
    a : (..., 3) [m, m, rad]

    Returns
    -------
    (..., 3) [m, m, rad]
    """
    a = np.asarray(a, dtype=float)
    c, s = np.cos(a[..., 2]), np.sin(a[..., 2])
    x, y = a[..., 0], a[..., 1]
    out = np.empty((*a.shape[:-1], 3))
    out[..., 0] = -c * x - s * y
    out[..., 1] = s * x - c * y
    out[..., 2] = wrap(-a[..., 2])
    return out


def between(a, b):
    """Relative pose (increment) from a to b: b as seen from a, inverse(a) ⊕ b.

    Parameters
    ----------
    a, b : (..., 3) [m, m, rad]

    Returns
    -------
    (..., 3) [m, m, rad]
    """
    return compose(inverse(a), b)


def transform(pose, points):
    """Transform points (a point cloud) from the pose's frame to its reference frame.

    p = (x, y) + Rot(theta) p_r. Equation (01.3).

    Parameters
    ----------
    pose : (3,) [m, m, rad]
    points : (n, 2) [m]

    Returns
    -------
    (n, 2) [m]
    """
    x, y, theta = pose
    c, s = np.cos(theta), np.sin(theta)
    return np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]]) + np.array([x, y])


def matrix(pose):
    """The homogeneous 3x3 transformation matrix T of a pose.

    Parameters
    ----------
    pose : (3,) [m, m, rad]

    Returns
    -------
    (3, 3)
    """
    x, y, theta = pose
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, x], [s, c, y], [0.0, 0.0, 1.0]])


def from_matrix(T):
    """The pose of a homogeneous 3x3 transformation matrix.

    Parameters
    ----------
    T : (3, 3)

    Returns
    -------
    (3,) [m, m, rad]
    """
    return np.array([T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0])])
