"""What an estimator shows: named layers of plain arrays, drawn by :mod:`slamlab.views`."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Points:
    """(n, 2) points [m], such as a map or the present scan."""

    name: str
    xy: np.ndarray


@dataclass(frozen=True)
class Segments:
    """(n, 4) rows x1 y1 x2 y2 [m], such as walls."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Poses:
    """(n, 3) poses [m, m, rad]: a robot (one row) or its track (many)."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Ellipses:
    """(n, 2) centres [m] and (n, 2, 2) covariances [m²]."""

    name: str
    centres: np.ndarray
    covariances: np.ndarray


@dataclass(frozen=True)
class Boxes:
    """(n, 4) rows x_min x_max y_min y_max [m]."""

    name: str
    rows: np.ndarray


@dataclass(frozen=True)
class Samples:
    """(n, 2) or (n, 3) samples with (n,) weights that sum to one."""

    name: str
    rows: np.ndarray
    weights: np.ndarray


OCCUPIED = 0.65
"""Probability beyond which a cell of a grid is called a wall, as by ROS' map_server."""


@dataclass(frozen=True)
class Grid:
    """(rows, columns) probabilities that cells of a side [m] are occupied; row 0 lies lowest.

    ``origin`` (2,) is the lower left corner of the cell in row 0, column 0 [m]; 0.5 is unknown.
    """

    name: str
    cells: np.ndarray
    origin: np.ndarray
    side: float


Layer = Points | Segments | Poses | Ellipses | Boxes | Samples | Grid
