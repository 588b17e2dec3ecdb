"""Layers of an estimator's drawing: named plain arrays that :mod:`slamlab.views` draws."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Points:
    """Point cloud (n, 2) [m], such as a map or the current scan."""

    name: str
    xy: np.ndarray


@dataclass(frozen=True)
class Segments:
    """Line segments, (n, 4) rows x1 y1 x2 y2 [m], such as walls or loop closures."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Poses:
    """Poses (n, 3) [m, m, rad]: a robot (one row) or its trajectory (many)."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Ellipses:
    """Covariance ellipses: centres (n, 2) [m], covariances (n, 2, 2) [m²]."""

    name: str
    centres: np.ndarray
    covariances: np.ndarray


@dataclass(frozen=True)
class Boxes:
    """Bounding boxes, (n, 4) rows x_min x_max y_min y_max [m]."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Particles:
    """Particles (n, 2) or (n, 3), with normalised weights (n,)."""

    name: str
    rows: np.ndarray
    weights: np.ndarray


OCCUPIED = 0.65
"""Occupancy probability above which a grid cell is occupied, as in ROS map_server."""


@dataclass(frozen=True)
class Grid:
    """Occupancy grid: (rows, columns) occupancy probabilities of cells with a side [m].

    0.5 means unknown. ``origin`` (2,) is the lower left corner of cell (0, 0) [m]; row 0 is lowest.
    """

    name: str
    cells: np.ndarray
    origin: np.ndarray
    side: float


Layer = Points | Segments | Poses | Ellipses | Boxes | Particles | Grid
