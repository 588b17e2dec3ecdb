"""Walls on trial: what was seen once may be noise, what was seen N times enters the filter.

Smolec enters everything at its first sight and only waits with the update; his first scan adds
heaps of duplicates. Here a wall waits outside, and dies when it is not seen again.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import wrap

NEAR = 0.25  # m, a sighting's middle off a wall that it may still be
SLANT = np.radians(10)  # rad, between the two
APART = 0.5  # m, between the seen stretches of one wall


def stretch(line, ends):
    """Where along a line something lies: t of a point p is p·(−sin α, cos α).

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


def overlap(first, second, apart=APART):
    """Whether two stretches of a line touch, or nearly.

    Parameters
    ----------
    first, second : (2,) least and largest t [m]
    apart : float, what may lie between them [m]

    Returns
    -------
    bool
    """
    return bool(first[0] <= second[1] + apart and second[0] <= first[1] + apart)


@dataclass
class Candidate:
    """A wall on trial, in the world's frame.

    Parameters
    ----------
    line : (2,) ρ [m], α [rad], as last seen
    stretch : (2,) where along it it was seen [m]
    sightings, lives : int
    """

    line: np.ndarray
    stretch: np.ndarray
    sightings: int
    lives: int

    def fits(self, line, ends):
        """Whether a sighting, placed in the world, may be of this wall."""
        normal = np.array([np.cos(self.line[1]), np.sin(self.line[1])])
        return (
            abs(wrap(line[1] - self.line[1])) < SLANT
            and abs(ends.mean(axis=0) @ normal - self.line[0]) < NEAR
            and overlap(self.stretch, stretch(self.line, ends))
        )


class Candidates:
    """The walls on trial.

    Parameters
    ----------
    sightings : int, how often a wall has to be seen before it is used
    lives : int, how many scans it survives unseen
    """

    def __init__(self, sightings, lives):
        if sightings < 1 or lives < 1:
            raise ValueError(f"sightings and lives are at least 1, not {sightings} and {lives}")
        self.sightings, self.lives = sightings, lives
        self.waiting: list[Candidate] = []

    def sight(self, seen):
        """Take the sightings of one scan in, those that belong to no known wall.

        Parameters
        ----------
        seen : list of (line (2,), ends (2, 2)), in the world's frame

        Returns
        -------
        list of bool, for each sighting: whether its wall has now been seen often enough; it is
        then no candidate any more
        """
        for candidate in self.waiting:
            candidate.lives -= 1
        due, taken = [], set()
        for line, ends in seen:
            candidate = next(
                (c for c in self.waiting if id(c) not in taken and c.fits(line, ends)), None
            )
            if candidate is None:
                candidate = Candidate(line, stretch(line, ends), 0, self.lives)
                self.waiting.append(candidate)
            taken.add(id(candidate))
            candidate.line, candidate.stretch = line, stretch(line, ends)
            candidate.sightings, candidate.lives = candidate.sightings + 1, self.lives
            due.append(candidate.sightings >= self.sightings)
        self.waiting = [
            c for c in self.waiting if c.lives > 0 and not self.sightings <= c.sightings
        ]
        return due
