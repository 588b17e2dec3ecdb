"""Relations error (Kümmerle et al. 2009), a relative pose error against ground-truth relations.

A file of relations has one a line: ``t1 t2 x y z roll pitch yaw``, the pose at t2 seen from that at
t1 [s, s, m, m, m, rad, rad, rad]. No frame has to be aligned and no old error is counted twice.
"""

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from slamlab.files.errors import SourceError
from slamlab.files.published_recordings import resolve
from slamlab.files.text_files import lines, read_bytes
from slamlab.geometry import between, wrap

TIME_TOLERANCE = 0.002  # most that a relation's stamp and a pose's differ [s]


@dataclass(frozen=True)
class Relations:
    """Ground-truth relations: trusted relative poses between two timestamps.

    Parameters
    ----------
    stamps : (n, 2) t1 and t2 [s]
    poses : (n, 3) the pose at t2 seen from that at t1 [m, m, rad]
    damage : Counter, lines that could not be used, by kind
    """

    stamps: np.ndarray
    poses: np.ndarray
    damage: Counter = field(default_factory=Counter)


@dataclass(frozen=True)
class RelationsError:
    """Relations error of a trajectory: mean and standard deviation over relations.

    Parameters
    ----------
    count : int, relations that could be used
    translation, translation_std : float [m]
    rotation, rotation_std : float [rad]
    """

    count: int
    translation: float
    translation_std: float
    rotation: float
    rotation_std: float


def load_relations(path):
    """Load relations from a file, plain or gzip.

    Parameters
    ----------
    path : str or Path, or a recording's name

    Returns
    -------
    Relations

    Raises
    ------
    SourceError : the file cannot be read or holds no relation
    """
    content, truncated = read_bytes(resolve(path))
    damage, rows = Counter({"file torn": 1} if truncated else {}), []
    for line, ended in lines(content):
        if not line.strip() or line.lstrip().startswith(b"#"):
            continue
        try:
            row = [float(word) for word in line.split()]
        except ValueError:
            row = []
        if len(row) != 8 or not np.isfinite(row).all() or (truncated and not ended):
            damage["lines that are no relation"] += 1
        else:
            rows.append(row)
    if not rows:
        raise SourceError(f"{path} holds no relation: a line reads t1 t2 x y z roll pitch yaw")
    table = np.array(rows)
    return Relations(table[:, :2], table[:, [2, 3, 7]], damage)


def relations_error(trajectory, relations, tolerance=TIME_TOLERANCE):
    """Relations error (Kümmerle): mean translational and rotational relative pose error.

    e = δ* ⊖ (x_2 ⊖ x_1) for each relation δ*, its length [m] and its turn [rad]
    (Kümmerle et al. 2009, "On measuring the accuracy of SLAM algorithms", equation 3).

    Parameters
    ----------
    trajectory : Trajectory
    relations : Relations
    tolerance : float, largest difference between a relation's stamp and a pose's [s]

    Returns
    -------
    RelationsError

    Raises
    ------
    ValueError : no relation has both stamps in the trajectory
    """
    pairs, wanted = usable_relations(trajectory.times, relations, tolerance)
    error = relation_residuals(trajectory.poses, pairs, wanted)
    distance, turn = np.hypot(error[:, 0], error[:, 1]), np.abs(wrap(error[:, 2]))
    return RelationsError(
        len(pairs), *(float(v) for e in (distance, turn) for v in (e.mean(), e.std()))
    )


def usable_relations(times, relations, tolerance=TIME_TOLERANCE, what="a pose"):
    """Relations both of whose stamps have a pose or a reading near.

    Parameters
    ----------
    times : (n,) [s]
    relations : Relations
    tolerance : float, largest difference of a stamp and its time [s]
    what : str, what the times are of, for the error

    Returns
    -------
    (k, 2) int, which poses each is of, and (k, 3) the relations [m, m, rad]

    Raises
    ------
    ValueError : there is none
    """
    index, gap = nearest_in_time(times, relations.stamps)
    # half a microsecond more: stamps have six decimals
    usable = (gap <= tolerance + 5e-7).all(axis=1)
    if not usable.any():
        raise ValueError(
            f"none of the {len(usable)} relations has both stamps within {1e3 * tolerance:g} ms of "
            f"{what}: do they belong to this log?"
        )
    return index[usable], relations.poses[usable]


def relation_residuals(poses, pairs, relations):
    """Residuals δ* ⊖ (x_j ⊖ x_i) of relations δ*.

    Parameters
    ----------
    poses : (n, 3) [m, m, rad]
    pairs : (k, 2) int, i and j
    relations : (k, 3) [m, m, rad]

    Returns
    -------
    (k, 3) [m, m, rad]
    """
    first, second = poses[pairs].transpose(1, 0, 2)
    return between(relations, between(first, second))


def nearest_in_time(times, stamps):
    """Timestamp association: index of the time nearest to each stamp, and how far off it is.

    Parameters
    ----------
    times : (n,) [s], in any order, n >= 1
    stamps : (...) [s]

    Returns
    -------
    (...) int, (...) [s]
    """
    order = np.argsort(times, kind="stable")
    ordered = times[order]
    right = np.clip(np.searchsorted(ordered, stamps), 1, max(1, len(times) - 1))
    left = right - 1
    right = np.minimum(right, len(times) - 1)
    nearer = np.where(
        np.abs(ordered[left] - stamps) <= np.abs(ordered[right] - stamps), left, right
    )
    return order[nearer], np.abs(ordered[nearer] - stamps)
