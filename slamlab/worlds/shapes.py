"""Shapes (polygons, boxes) that worlds are put together from, as rows of walls."""

import numpy as np


def ring(corners):
    """The walls of a closed polygon (a ring).

    Parameters
    ----------
    corners : (n, 2) [m], in order

    Returns
    -------
    (n, 4) rows x1 y1 x2 y2 [m]
    """
    corners = np.asarray(corners, dtype=float)
    return np.hstack([corners, np.roll(corners, -1, axis=0)])


def box(centre, size, turn=0.0):
    """The four walls of a box, a rotated rectangle.

    Parameters
    ----------
    centre : (2,) [m]
    size : (2,) length and width [m]
    turn : float [rad]

    Returns
    -------
    (4, 4) rows x1 y1 x2 y2 [m]
    """
    c, s = np.cos(turn), np.sin(turn)
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.asarray(size) / 2
    return ring(half @ np.array([[c, s], [-s, c]]) + np.asarray(centre))
