"""Planar projection of 3-D poses, and checks of their orientations."""

import numpy as np

LENGTHS = 0.5, 2.0  # valid lengths of quaternions, which are normalised
LOST = 1e-3  # a shorter quaternion means a lost pose
SKEW = 0.01  # largest error of the products of a rotation matrix's rows [1]
TURNED = np.radians(5)  # a smaller mean angle to an axis is no tilt [rad]
TILT = np.radians(15)  # a larger roll or pitch is reported [rad]
HEIGHT = 0.5  # a larger range of heights is reported [m]
# from camera axes (x right, y down, z forward) to x forward, y left, z up
CAMERA = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


def orientation_faults(got):
    """Find faults of the orientations in named columns: {fault: mask (n,) of the faulty rows}."""
    if "r00" in got:
        R = _matrices(got)
        off = np.abs(R @ R.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2)) > SKEW
        return {"matrices that are not rotations": off | (np.linalg.det(R) < 0)}
    if "theta" in got:
        return {}
    length = np.linalg.norm(_quaternions(got), axis=1)
    lost = length < LOST
    wrong = ~lost & ((length < LENGTHS[0]) | (length > LENGTHS[1]))
    return {"quaternions of length 0": lost, "quaternions not of length 1": wrong}


def planar_in_other_order(got, shift):
    """Whether the poses leave the plane only because w was read at the wrong end of the
    quaternions: ``shift`` is −1 if w was read as the last component, 1 if as the first."""
    given = _quaternions(got)
    tilts = [_tilt(_rotations(q), 2).mean() for q in (given, np.roll(given, shift, axis=1))]
    return tilts[0] > TURNED > tilts[1]


def planar(got):
    """Return planar poses (n, 3) [m, m, rad] from named columns, and notes for the user."""
    if "theta" in got:
        return np.column_stack([got["x"], got["y"], got["theta"]]), []
    rotations = _matrices(got) if "r00" in got else _rotations(_quaternions(got))
    height = got.get("z", np.zeros(len(rotations)))
    return project(rotations, np.column_stack([got["x"], got["y"], height]))


def project(rotations, positions):
    """Project 3-D poses to the plane; return poses (n, 3) [m, m, rad] and notes for the user.

    ``rotations`` (n, 3, 3), ``positions`` (n, 3) [m]. The vertical axis is z or, if the poses
    rotate about y, the y axis of a camera.
    """
    notes = []
    if _are_of_a_camera(rotations, positions):
        rotations = CAMERA @ rotations @ CAMERA.T
        positions = positions @ CAMERA.T
        notes.append("read as camera axes (x right, y down, z forward)")
    tilt, height = _tilt(rotations, 2).max(), np.ptp(positions[:, 2])
    if tilt > TILT or height > HEIGHT:
        notes.append(
            f"not in a plane (tilted by up to {np.degrees(tilt):.0f}°, heights over "
            f"{height:.3g} m), projected to it"
        )
    theta = np.arctan2(rotations[:, 1, 0], rotations[:, 0, 0])
    return np.column_stack([positions[:, :2], theta]), notes


def _are_of_a_camera(rotations, positions):
    """Whether the y axis is vertical, like a camera's: by the rotations or else by the path."""
    up, down = _tilt(rotations, 2).mean(), _tilt(rotations, 1).mean()
    if max(up, down) > TURNED:
        return down < up / 2
    x, y, z = np.ptp(positions, axis=0)
    return z > 2 * max(x, y)


def _tilt(rotations, axis):
    """Return the angle (n,) between an axis of the body and the same axis of the frame [rad]."""
    return np.arccos(np.clip(rotations[:, axis, axis], -1, 1))


def _rotations(quaternions):
    """Return the rotation matrices (n, 3, 3) of nonzero quaternions x, y, z, w (n, 4)."""
    x, y, z, w = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _quaternions(got):
    return np.column_stack([got[name] for name in ("qx", "qy", "qz", "qw")])


def _matrices(got):
    return np.column_stack([got[f"r{i}{j}"] for i in range(3) for j in range(3)]).reshape(-1, 3, 3)
