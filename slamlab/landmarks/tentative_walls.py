"""Tentative landmarks (walls): N sightings make a confirmed landmark, unseen ones are deleted.

Smolec enters everything at its first sight and only waits with the update; his first scan adds
heaps of duplicates. Here a wall waits outside of the filter (track initiation) and is dropped when
its lives run out.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import wrap

MAX_DISTANCE = 0.25  # gate: of a sighting's middle from the wall that it may be [m]
MAX_ANGLE = np.radians(10)  # gate: between their normals [rad]
MAX_GAP = 0.5  # between the seen extents of one wall [m]


def extent(line, ends):
    """Extent of points along a line: t of a point p is p·(−sin α, cos α).

    Parameters
    ----------
    line : (2,) ρ [m], α [rad]
    ends : (k, 2) points [m]

    Returns
    -------
    (2,) least and largest t [m]
    """
    t = ends @ [-np.sin(line[1]), np.cos(line[1])]
    return np.array([t.min(), t.max()])


def overlap(first, second, gap=MAX_GAP):
    """Whether two extents along a line overlap, or nearly.

    Parameters
    ----------
    first, second : (2,) least and largest t [m]
    gap : float, what may lie between them [m]

    Returns
    -------
    bool
    """
    return bool(first[0] <= second[1] + gap and second[0] <= first[1] + gap)


@dataclass
class TentativeWall:
    """A tentative landmark: a wall seen, but too seldom to be confirmed, in the world's frame.

    Parameters
    ----------
    line : (2,) ρ [m], α [rad], as last seen
    extent : (2,) where along it it was seen [m]
    sightings, lives : int, how often it was seen; how many scans it survives unseen
    """

    line: np.ndarray
    extent: np.ndarray
    sightings: int
    lives: int

    def fits(self, line, ends):
        """Data association: whether a sighting, placed in the world, is within this wall's gate."""
        normal = np.array([np.cos(self.line[1]), np.sin(self.line[1])])
        return (
            abs(wrap(line[1] - self.line[1])) < MAX_ANGLE
            and abs(ends.mean(axis=0) @ normal - self.line[0]) < MAX_DISTANCE
            and overlap(self.extent, extent(self.line, ends))
        )

    stretch = property(lambda self: self.extent)  # name in the first edition


class TentativeWalls:
    """The tentative walls, until they are confirmed or dropped.

    Parameters
    ----------
    sightings : int, how often a wall has to be seen to be confirmed
    lives : int, how many scans it survives unseen
    """

    def __init__(self, sightings, lives):
        if sightings < 1 or lives < 1:
            raise ValueError(f"sightings and lives are at least 1, not {sightings} and {lives}")
        self.sightings, self.lives = sightings, lives
        self.tentative: list[TentativeWall] = []

    def sight(self, seen):
        """Associate one scan's sightings of no known wall; tell which walls are now confirmed.

        Parameters
        ----------
        seen : list of (line (2,), ends (2, 2)), in the world's frame

        Returns
        -------
        list of bool, for each sighting: whether its wall is now confirmed; it is then no tentative
        one any more
        """
        for wall in self.tentative:
            wall.lives -= 1
        confirmed, taken = [], set()
        for line, ends in seen:
            wall = next(
                (w for w in self.tentative if id(w) not in taken and w.fits(line, ends)), None
            )
            if wall is None:
                wall = TentativeWall(line, extent(line, ends), 0, self.lives)
                self.tentative.append(wall)
            taken.add(id(wall))
            wall.line, wall.extent = line, extent(line, ends)
            wall.sightings, wall.lives = wall.sightings + 1, self.lives
            confirmed.append(wall.sightings >= self.sightings)
        self.tentative = [
            w for w in self.tentative if w.lives > 0 and not self.sightings <= w.sightings
        ]
        return confirmed


# names in the first edition
Candidate, Candidates, stretch = TentativeWall, TentativeWalls, extent
