"""TUM trajectory files, which evo and others read: ``stamp tx ty tz qx qy qz qw`` a line.

A pose in the plane has tz = 0 and the quaternion [0, 0, sin θ/2, cos θ/2] [s, m, m, m, 1 …].
"""

from pathlib import Path

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.files.text_files import lines, read_bytes, reason
from slamlab.readings import Trajectory


def save_tum(trajectory, path):
    """Save a trajectory as a TUM file; times and positions come back exactly.

    Parameters
    ----------
    trajectory : Trajectory
    path : str or Path

    Raises
    ------
    SourceError : the file cannot be written
    """
    x, y, theta = trajectory.poses.T
    zero = np.zeros(len(trajectory))
    half = theta / 2
    table = [trajectory.times, x, y, zero, zero, zero, np.sin(half), np.cos(half)]
    rows = np.column_stack(table).tolist()
    text = "".join(" ".join(map(repr, row)) + "\n" for row in rows)
    try:
        Path(path).write_text(text, encoding="ascii")
    except OSError as error:
        raise SourceError(f"{path} cannot be written: {reason(error)}") from None


def load_tum(path):
    """Load a planar trajectory from a TUM file: x, y and the yaw of each pose; plain or gzip.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Trajectory

    Raises
    ------
    SourceError : the file cannot be read, or what is wrong in which line
    """
    content, truncated = read_bytes(path)
    rows = []
    for number, (line, _) in enumerate(lines(content), 1):
        if not line.strip() or line.lstrip().startswith(b"#"):
            continue
        try:
            rows.append([float(word) for word in line.replace(b",", b" ").split()])
        except ValueError:
            rows.append([])
        if len(rows[-1]) != 8 or not np.isfinite(rows[-1]).all() or not any(rows[-1][4:]):
            raise SourceError(
                f"{path}, line {number}: a line reads stamp tx ty tz qx qy qz qw, finite numbers, "
                "the last four a turn"
            )
    if truncated or not rows:
        raise SourceError(f"{path} {'is truncated' if truncated else 'holds no pose'}")
    stamp, tx, ty, _, qx, qy, qz, qw = np.array(rows).T
    # of a quaternion of any length
    theta = np.arctan2(2 * (qw * qz + qx * qy), qw**2 + qx**2 - qy**2 - qz**2)
    return Trajectory(stamp, np.column_stack([tx, ty, theta]))
