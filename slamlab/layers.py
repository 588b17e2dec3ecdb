"""Layers, what an estimator shows: named plain arrays for :mod:`slamlab.views` to draw."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Points:
    """A point cloud, (n, 2) points [m], such as a map or the present scan."""

    name: str
    xy: np.ndarray


@dataclass(frozen=True)
class Segments:
    """Line segments, (n, 4) rows x1 y1 x2 y2 [m], such as walls or loop closures."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Poses:
    """Poses, (n, 3) [m, m, rad]: a robot (one row) or its trajectory (many)."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Ellipses:
    """Covariance ellipses: (n, 2) centres [m] and (n, 2, 2) covariances [m²]."""

    name: str
    centres: np.ndarray
    covariances: np.ndarray


@dataclass(frozen=True)
class Boxes:
    """Bounding boxes, (n, 4) rows x_min x_max y_min y_max [m]."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Samples:
    """Particles (samples): (n, 2) or (n, 3) with (n,) weights that sum to one."""

    name: str
    rows: np.ndarray
    weights: np.ndarray


OCCUPIED = 0.65
"""Occupancy probability beyond which a grid cell is called occupied, as by ROS' map_server."""


@dataclass(frozen=True)
class Grid:
    """An occupancy grid: (rows, columns) probabilities that cells of a side [m] are occupied.

    0.5 is unknown. ``origin`` (2,) is the lower left corner of cell (0, 0) [m]; row 0 lies lowest.
    """

    name: str
    cells: np.ndarray
    origin: np.ndarray
    side: float


Layer = Points | Segments | Poses | Ellipses | Boxes | Samples | Grid
