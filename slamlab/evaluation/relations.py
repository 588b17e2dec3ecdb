"""Relations error (Kümmerle et al. 2009), a metric of relative poses. A line of a file is ``t1 t2 x
y z roll pitch yaw``: the pose at t2 relative to the pose at t1 [s, s, m, m, m, rad, rad, rad]."""

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from slamlab.evaluation.text_table import TextTable, named_columns
from slamlab.evaluation.time_association import explanation, nearest_timestamps
from slamlab.files import SourceError
from slamlab.geometry import between, wrap
from slamlab.sources.public_datasets import resolve

TIME_TOLERANCE = 0.002  # largest difference of the timestamps of a relation and a pose [s]
NAMES = {name: (name,) for name in ("t1", "t2", "x", "y", "z", "roll", "pitch", "yaw")}
ROW = f"relation: a row has 8 numbers, {' '.join(NAMES)} [s, m, rad]"


@dataclass(frozen=True)
class Relations:
    """Ground-truth relations: ``poses`` (n, 3) at t2 relative to those at t1 [m, m, rad], with
    ``stamps`` (n, 2) t1 and t2 [s]; ``damage`` counts unusable rows by kind."""

    stamps: np.ndarray
    poses: np.ndarray
    damage: Counter = field(default_factory=Counter)


@dataclass(frozen=True)
class RelationsError:
    """Relations error of a trajectory: mean and standard deviation [m, rad] over the ``count``
    relations whose timestamps both have a pose."""

    count: int
    translation: float
    translation_std: float
    rotation: float
    rotation_std: float


def load_relations(path):
    """Load relations from rows t1 t2 x y z roll pitch yaw or from columns that a header names.

    path : str or Path, plain or gzip, or a recording's name. Returns a Relations. Raises
    SourceError if there is no relation, or for headings in degrees.
    """
    table = TextTable(resolve(path), ROW)
    columns = {name: (i, None) for i, name in enumerate(NAMES)}
    for header in table.headers:
        found = named_columns(header, NAMES)
        if {"t1", "t2", "x", "y", "yaw"} <= set(found) and len(header.names) == table.width:
            columns = found
    if max(i for i, _ in columns.values()) >= table.width:
        raise SourceError(f"{path}, {table.width} numbers in a row, contains no {ROW}")
    numbers, values = table.read((i for i, _ in columns.values()), "rows that are not relations")
    if not len(values):
        raise SourceError(f"{path} ({table.damage_summary()}) contains no {ROW}")
    values = values * [factor or 1.0 for _, factor in columns.values()]
    got = dict(zip(columns, values.T, strict=True))
    turned = np.flatnonzero(np.abs(got["yaw"]) > 2 * np.pi)
    if len(turned):
        raise SourceError(
            f"{path}, read as relations, line {numbers[turned[0]]}: a yaw of "
            f"{got['yaw'][turned[0]]:.4g} is not an angle in radians; if it is in degrees, "
            "multiply it by π/180"
        )
    stamps = np.column_stack([got["t1"], got["t2"]])
    poses = np.column_stack([got["x"], got["y"], got["yaw"]])
    return Relations(stamps, poses, table.damage)


def relations_error(trajectory, relations, tolerance=TIME_TOLERANCE):
    """Compute the mean translation and rotation of e = δ* ⊖ (x_2 ⊖ x_1) over relations δ* (Kümmerle
    et al. 2009, equation 3). Returns a RelationsError. Raises ValueError if no relation has both
    timestamps in the trajectory.

    ``tolerance`` is the largest difference of the timestamps of a relation and a pose [s].
    """
    pairs, wanted = usable_relations(trajectory.times, relations, tolerance)
    error = relation_residuals(trajectory.poses, pairs, wanted)
    distance, turn = np.hypot(error[:, 0], error[:, 1]), np.abs(wrap(error[:, 2]))
    return RelationsError(
        len(pairs), *(float(v) for e in (distance, turn) for v in (e.mean(), e.std()))
    )


def usable_relations(times, relations, tolerance=TIME_TOLERANCE, what="a pose"):
    """Select the relations whose timestamps are both near ``times`` (n,) [s] of ``what``: return
    (k, 2) indices of times, and the relations (k, 3). Raises ValueError if none is usable."""
    index, gap = nearest_timestamps(times, relations.stamps)
    # half a microsecond more, because timestamps have six decimals
    usable = (gap <= tolerance + 5e-7).all(axis=1)
    if not usable.any():
        # unique: many relations share timestamps
        series = np.unique(times), np.unique(relations.stamps)
        why = explanation(*series, tolerance, ("the log", "the file of relations"))
        raise ValueError(
            f"none of the {len(usable)} relations has both timestamps within {1e3 * tolerance:g} "
            f"ms of {what}: do they belong to this log?{why and f' If so, {why}'}"
        )
    return index[usable], relations.poses[usable]


def relation_residuals(poses, pairs, relations):
    """Return residuals (k, 3) δ* ⊖ (x_j ⊖ x_i) of relations (k, 3); ``pairs`` (k, 2) are i, j."""
    first, second = poses[pairs].transpose(1, 0, 2)
    return between(relations, between(first, second))
