"""Track management: a tentative landmark enters the filter once it is confirmed."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import wrap

MAX_DISTANCE = 0.25  # gate: distance of an observation's midpoint from the wall [m]
MAX_ANGLE = np.radians(10)  # gate: angle between their normals [rad]
MAX_GAP = 0.5  # gate: gap between the observed extents [m]


def extent(line, ends):
    """Return the extremes of t = p·(−sin α, cos α) [m] of points (k, 2) on a line (ρ, α)."""
    t = ends @ [-np.sin(line[1]), np.cos(line[1])]
    return np.array([t.min(), t.max()])


def overlap(first, second, gap=MAX_GAP):
    """Whether two extents (2,) overlap or are at most ``gap`` [m] apart."""
    return bool(first[0] <= second[1] + gap and second[0] <= first[1] + gap)


@dataclass
class TentativeWall:
    """A tentative wall: line (ρ, α) and extent (2,) at its last observation, in the world frame."""

    line: np.ndarray
    extent: np.ndarray
    observations: int
    misses_left: int

    def fits(self, line, ends):
        """Whether an observation is inside the gate of this wall."""
        normal = np.array([np.cos(self.line[1]), np.sin(self.line[1])])
        return (
            abs(wrap(line[1] - self.line[1])) < MAX_ANGLE
            and abs(ends.mean(axis=0) @ normal - self.line[0]) < MAX_DISTANCE
            and overlap(self.extent, extent(self.line, ends))
        )


class TrackManager:
    """Track management of tentative walls, until they are confirmed or deleted. Raises ValueError.

    Parameters
    ----------
    min_observations : int, number of observations that confirms a wall
    max_misses : int, number of scans in a row without an observation that deletes a wall
    """

    def __init__(self, min_observations, max_misses):
        if min_observations < 1 or max_misses < 1:
            raise ValueError(
                "min_observations and max_misses must be at least 1, not "
                f"{min_observations} and {max_misses}"
            )
        self.min_observations, self.max_misses = min_observations, max_misses
        self.tentative: list[TentativeWall] = []

    def update(self, observed):
        """Associate the observations [(line (2,), ends (2, 2))] of a scan in the world frame, and
        return for each observation whether its wall is now confirmed."""
        for wall in self.tentative:
            wall.misses_left -= 1
        confirmed, taken = [], set()
        for line, ends in observed:
            wall = next(
                (w for w in self.tentative if id(w) not in taken and w.fits(line, ends)), None
            )
            if wall is None:
                wall = TentativeWall(line, extent(line, ends), 0, self.max_misses)
                self.tentative.append(wall)
            taken.add(id(wall))
            wall.line, wall.extent = line, extent(line, ends)
            wall.observations, wall.misses_left = wall.observations + 1, self.max_misses
            confirmed.append(wall.observations >= self.min_observations)
        self.tentative = [
            w
            for w in self.tentative
            if w.misses_left > 0 and not self.min_observations <= w.observations
        ]
        return confirmed
