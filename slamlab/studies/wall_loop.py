"""Smolec's loop in small: a step a method, so that one at a time can be spoilt. Lesson 09.

What it believes is what :class:`slamlab.estimators.wall_slam.WallSlam` believes; that adds a robot
found again after a slip, doors, status lines and drawing.
"""

from collections import Counter

import numpy as np

from slamlab.estimators.mak_slam import Q_arc
from slamlab.estimators.wall_merging import ends_of, pieces_of_one_wall
from slamlab.estimators.wall_slam import AMBIGUITY_GATE, GATE
from slamlab.filters.data_association import squared_distances
from slamlab.filters.landmark_models import LINES
from slamlab.filters.mak import MAK
from slamlab.filters.merging import merge
from slamlab.geometry import compose, transform
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.tentative_walls import TentativeWalls, extent, overlap
from slamlab.models.observation import g_line


class WallLoop:
    """EKF-SLAM with walls: predict, pair, update, welcome, merge.

    Parameters
    ----------
    source : Source, for its robot and its sensor
    sightings : int, how often a wall is seen before it enters the map
    gate : float, squared Mahalanobis distance up to which a line is paired with a wall [1]
    kind : LandmarkModel of the walls
    """

    def __init__(self, source, sightings=3, gate=GATE, kind=LINES):
        self.robot, self.sensor = source.robot, source.sensor
        self.gate, self.doubt = gate, max(gate, AMBIGUITY_GATE)
        self.rng = np.random.default_rng(0)  # RANSAC guesses
        self.mak = MAK(np.zeros(3), np.zeros((3, 3)), kind=kind, first_estimates=True)
        self.tentative, self.seen = TentativeWalls(sightings, lives=3), {}
        self._first, self._next = True, 0

    def step(self, odometry, found):
        """Take in what the wheels say, and the lines of the scan that follows.

        Parameters
        ----------
        odometry : (3,) motion in the frame of the last pose [m, m, rad]
        found : list of Line
        """
        self.predict(odometry)
        known, new = self.pair(found)
        self.update(known)
        self.welcome(new, known)
        self.merge()

    def extract(self, scan):
        """The lines of a scan: list of Line."""
        return lines(scan, self.sensor, self.rng)

    def predict(self, odometry):
        """Drive: the pose moves, P grows."""
        if odometry.any():
            pose = self.mak.pose
            self.mak.predict(compose(pose, odometry), Q_arc(pose, odometry, self.robot))

    def near(self, line, d2):
        """Walls of the map that a line may be: list of (squared distance, id)."""
        ends, walls = transform(self.mak.pose, line.ends), self.walls()
        pairs = [(d, i) for d, i in zip(d2, walls, strict=True) if d < self.doubt]
        return [(d, i) for d, i in pairs if overlap(self.seen[i], extent(walls[i], ends))]

    def pair(self, found):
        """Which line is which wall: dict of id to Line, and a list of those that are none."""
        known, new = {}, []
        if not found or not self.mak.ids:
            return known, found
        d2 = squared_distances(self.mak, *measured(found))
        for k in np.argsort(d2.min(axis=1), kind="stable"):  # the surest first
            distance, i = self.choice(self.near(found[k], d2[k]))
            if i is None:
                new.append(found[k])
            elif distance <= self.gate and i not in known:
                known[i] = found[k]
        return known, new

    def choice(self, near):
        """Which of several walls it is: the nearest; id None where there is none."""
        return min(near, default=(np.inf, None))

    def update(self, known):
        """Walls that are seen again correct the robot and all other walls."""
        if known:
            self.mak.update(list(known), *measured(known.values()))

    def welcome(self, new, known):
        """New lines wait until they are confirmed; the first scan's do not: it lays the frame."""
        pose = self.mak.pose
        placed = [(g_line(pose, line.z), transform(pose, line.ends)) for line in new]
        confirmed = [True] * len(new) if self._first else self.tentative.sight(placed)
        for line, due in zip(new, confirmed, strict=True):
            if due:
                i, self._next = self._next, self._next + 1
                self.mak.add([i], line.z[None], line.R)
                self.seen[i], known[i] = np.array([np.inf, -np.inf]), line
        self._first, walls = False, self.walls()
        for i, line in known.items():
            self.extend(i, extent(walls[i], transform(pose, line.ends)))

    def extend(self, i, piece):
        """A wall has been seen along another piece of its line, from where to where [m]."""
        low, high = self.seen[i]
        self.seen[i] = np.array([min(low, piece[0]), max(high, piece[1])])

    def merge(self):
        """Walls that have turned out to be one become one."""
        while pair := pieces_of_one_wall(self.mak, self.seen):
            kept, gone = pair
            ends = ends_of(self.walls()[gone], self.seen.pop(gone))
            merge(self.mak, kept, gone)
            self.extend(kept, extent(self.walls()[kept], ends))

    def walls(self):
        """The map: each wall's id to its ρ [m] and α [rad]."""
        return dict(zip(self.mak.ids, self.mak.landmarks(), strict=True))

    def segments(self):
        """The map as line segments, as far as the walls were seen: (k, 4) x1 y1 x2 y2 [m]."""
        pieces = [ends_of(line, self.seen[i]).ravel() for i, line in self.walls().items()]
        return np.array(pieces).reshape(-1, 4)


def tally(source, found):
    """Count what flows through the loop on a drive.

    Parameters
    ----------
    source : Source
    found : list of the lines of each scan

    Returns
    -------
    Counter : steps, ranges (of the lidar), lines; of these known, new and unclear ones, which are
        dropped; walls that entered the map, those merged into others, and walls at the end
    """
    loop, counts = WallLoop(source), Counter()
    for reading, lines_ in zip(source, found, strict=True):
        loop.predict(reading.odometry)
        known, new = loop.pair(lines_)
        loop.update(known)
        paired, before = len(known), len(loop.mak.ids)
        loop.welcome(new, known)
        entered = len(loop.mak.ids) - before
        loop.merge()
        counts.update(
            steps=1,
            ranges=len(reading.scan.points()),
            lines=len(lines_),
            known=paired,
            new=len(new),
            unclear=len(lines_) - paired - len(new),
            entered=entered,
            merged=before + entered - len(loop.mak.ids),
        )
    counts["walls"] = len(loop.mak.ids)
    return counts


def measured(found):
    """What the filter takes of lines.

    Parameters
    ----------
    found : collection of Line

    Returns
    -------
    z : (m, 2) ρ' [m], α' [rad]
    R : (m, 2, 2) their covariances
    """
    return np.array([line.z for line in found]), np.array([line.R for line in found])
