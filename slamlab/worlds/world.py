"""World, the ground-truth map of a simulation: wall segments and circles, for ray casting."""

from dataclasses import dataclass, field

import numpy as np

from slamlab.worlds.ray_casting import cast

CHORDS = 48  # sides of the polygon that a circle is drawn as


@dataclass(frozen=True)
class World:
    """Ground-truth map: straight walls and circles in the plane; checked when it is made.

    Parameters
    ----------
    walls : (n, 4) rows x1 y1 x2 y2 [m]
    circles : (m, 3) rows x y radius [m]
    name : str

    Raises
    ------
    ValueError : a row of the wrong length, a number that is not finite, a wall without length, a
        circle without radius; the text names the row
    """

    walls: np.ndarray = field(default_factory=lambda: np.empty((0, 4)))
    circles: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    name: str = "world"

    def __post_init__(self):
        walls = _rows(self.walls, 4, "walls", "x1 y1 x2 y2")
        circles = _rows(self.circles, 3, "circles", "x y radius")
        _reject(walls, np.all(walls[:, :2] == walls[:, 2:], axis=1), "walls", "has no length")
        _reject(circles, circles[:, 2] <= 0, "circles", "needs a radius above zero")
        object.__setattr__(self, "walls", walls)
        object.__setattr__(self, "circles", circles)

    def cast(self, position, directions):
        """Ray casting: exact distance to the nearest wall or circle in each direction.

        Parameters
        ----------
        position : (2,) [m]
        directions : (k,) absolute, counter-clockwise from +x [rad]

        Returns
        -------
        (k,) ranges [m]; inf where there is nothing
        """
        return cast(position, directions, self.walls, self.circles)

    def outline(self):
        """Outline as line segments: each wall, each circle as chords, for drawing.

        Returns
        -------
        (k, 4) rows x1 y1 x2 y2 [m]
        """
        angles = np.linspace(0, 2 * np.pi, CHORDS + 1)
        rim = np.column_stack([np.cos(angles), np.sin(angles)])
        rims = self.circles[:, None, :2] + self.circles[:, None, 2:] * rim
        chords = np.concatenate([rims[:, :-1], rims[:, 1:]], axis=2).reshape(-1, 4)
        return np.concatenate([self.walls, chords])


def _rows(values, width, name, columns):
    """A read-only copy as an (n, width) float array, or a ValueError."""
    try:
        rows = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: not a table of numbers; give rows {columns}") from None
    if rows.size == 0:
        rows = rows.reshape(0, width)
    if rows.ndim != 2 or rows.shape[1] != width:
        raise ValueError(f"{name}: shape {rows.shape}; give rows {columns}, shape (n, {width})")
    _reject(rows, ~np.isfinite(rows).all(axis=1), name, "holds a number that is not finite")
    rows.flags.writeable = False
    return rows


def _reject(rows, bad, name, why):
    if bad.any():
        i = int(np.argmax(bad))
        raise ValueError(f"{name}: row {i} {why}: {rows[i].tolist()}")
