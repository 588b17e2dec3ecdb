"""World (ground-truth map of a simulation) of wall segments and circles; shapes of walls."""

from dataclasses import dataclass, field

import numpy as np

from slamlab.simulation.worlds.ray_casting import cast

CHORDS = 48  # sides of the polygon that approximates a circle in drawings


@dataclass(frozen=True)
class World:
    """Ground-truth map: straight walls and circles in the plane. Raises ValueError if a row is not
    a wall or a circle; the message contains the row.

    Parameters
    ----------
    walls : (n, 4) rows x1 y1 x2 y2 [m]
    circles : (m, 3) rows x y radius [m]
    name : str
    """

    walls: np.ndarray = field(default_factory=lambda: np.empty((0, 4)))
    circles: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    name: str = "world"

    def __post_init__(self):
        walls = _rows(self.walls, 4, "walls", "x1 y1 x2 y2")
        circles = _rows(self.circles, 3, "circles", "x y radius")
        _reject(walls, np.all(walls[:, :2] == walls[:, 2:], axis=1), "walls", "has no length")
        _reject(circles, circles[:, 2] <= 0, "circles", "must have a radius greater than zero")
        object.__setattr__(self, "walls", walls)
        object.__setattr__(self, "circles", circles)

    def cast(self, position, directions):
        """Cast rays from (2,) along absolute directions (k,); return ranges [m], inf: no hit."""
        return cast(position, directions, self.walls, self.circles)

    def outline(self):
        """Return walls, and circles as polygons, for drawing: (k, 4) rows x1 y1 x2 y2 [m]."""
        angles = np.linspace(0, 2 * np.pi, CHORDS + 1)
        rim = np.column_stack([np.cos(angles), np.sin(angles)])
        rims = self.circles[:, None, :2] + self.circles[:, None, 2:] * rim
        chords = np.concatenate([rims[:, :-1], rims[:, 1:]], axis=2).reshape(-1, 4)
        return np.concatenate([self.walls, chords])


def ring(corners):
    """Create the walls of a closed polygon.

    corners : (n, 2) in order [m]. Returns (n, 4) rows x1 y1 x2 y2 [m].
    """
    corners = np.asarray(corners, dtype=float)
    return np.hstack([corners, np.roll(corners, -1, axis=0)])


def box(centre, size, turn=0.0):
    """Create the walls of a rotated rectangle. Returns (4, 4) rows x1 y1 x2 y2 [m].

    Parameters
    ----------
    centre, size : (2,) [m]
    turn : float [rad]
    """
    c, s = np.cos(turn), np.sin(turn)
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.asarray(size) / 2
    return ring(half @ np.array([[c, s], [-s, c]]) + np.asarray(centre))


def _rows(values, width, name, columns):
    """Return a read-only copy as an (n, width) float array. Raises ValueError."""
    try:
        rows = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is not a table of numbers; use rows {columns}") from None
    if rows.size == 0:
        rows = rows.reshape(0, width)
    if rows.ndim != 2 or rows.shape[1] != width:
        raise ValueError(
            f"{name} has the shape {rows.shape}; use rows {columns} of shape (n, {width})"
        )
    _reject(rows, ~np.isfinite(rows).all(axis=1), name, "contains a number that is not finite")
    rows.flags.writeable = False
    return rows


def _reject(rows, bad, name, why):
    if bad.any():
        i = int(np.argmax(bad))
        raise ValueError(f"{name}: row {i} {why}: {rows[i].tolist()}")
