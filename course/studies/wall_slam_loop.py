"""Small EKF-SLAM with walls, one method per step, so that each step can be replaced (lesson 09).

The estimates equal those of ``estimators.wall_slam.WallSlam``, which adds relocalisation, doors,
status and drawing.
"""

from collections import Counter

import numpy as np

from slamlab.estimators.ekf_slam import Q_arc
from slamlab.estimators.wall_merging import ends_of, same_wall_landmarks
from slamlab.estimators.wall_slam import AMBIGUITY_GATE, GATE
from slamlab.filters.data_association import squared_distances
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_merging import merge
from slamlab.filters.landmark_models import LINES
from slamlab.geometry import compose, transform
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.track_management import TrackManager, extent, overlap
from slamlab.models.observation import g_line


class WallLoop:
    """EKF-SLAM with walls, which are confirmed after several observations.

    The validation ``gate`` of an association is a squared Mahalanobis distance.
    """

    def __init__(self, source, min_observations=3, gate=GATE, kind=LINES):
        self.robot, self.sensor = source.robot, source.sensor
        self.gate, self.ambiguity_gate = gate, max(gate, AMBIGUITY_GATE)
        self.rng = np.random.default_rng(0)  # of RANSAC
        self.mak = MAK(np.zeros(3), np.zeros((3, 3)), kind=kind, first_estimates=True)
        self.tentative, self.seen = TrackManager(min_observations, max_misses=3), {}
        self._first, self._next = True, 0

    def step(self, odometry, found):
        """Process odometry (3,) [m, m, rad] and the Lines of the next scan."""
        self.predict(odometry)
        known, new = self.associate(found)
        self.update(known)
        self.initialise(new, known)
        self.merge()

    def extract(self, scan):
        return lines(scan, self.sensor, self.rng)

    def predict(self, odometry):
        """Predict the pose; P grows."""
        if odometry.any():
            pose = self.mak.pose
            self.mak.predict(compose(pose, odometry), Q_arc(pose, odometry, self.robot))

    def near(self, line, d2):
        """Return the candidate walls for a line: list of (squared distance, id)."""
        ends, walls = transform(self.mak.pose, line.ends), self.walls()
        pairs = [(d, i) for d, i in zip(d2, walls, strict=True) if d < self.ambiguity_gate]
        return [(d, i) for d, i in pairs if overlap(self.seen[i], extent(walls[i], ends))]

    def associate(self, found):
        """Associate lines with walls; return a dict of id to Line, and a list of new lines."""
        known, new = {}, []
        if not found or not self.mak.ids:
            return known, found
        d2 = squared_distances(self.mak, *measured(found))
        for k in np.argsort(d2.min(axis=1), kind="stable"):  # the nearest first
            distance, i = self.choice(self.near(found[k], d2[k]))
            if i is None:
                new.append(found[k])
            elif distance <= self.gate and i not in known:
                known[i] = found[k]
        return known, new

    def choice(self, near):
        """Return the nearest candidate wall; the id is None if there are no candidates."""
        return min(near, default=(np.inf, None))

    def update(self, known):
        """Update robot and walls with the observed known walls."""
        if known:
            self.mak.update(list(known), *measured(known.values()))

    def initialise(self, new, known):
        """Add new lines when they are confirmed; add lines of the first scan immediately."""
        pose = self.mak.pose
        placed = [(g_line(pose, line.z), transform(pose, line.ends)) for line in new]
        confirmed = [True] * len(new) if self._first else self.tentative.update(placed)
        for line, due in zip(new, confirmed, strict=True):
            if due:
                i, self._next = self._next, self._next + 1
                self.mak.add([i], line.z[None], line.R)
                self.seen[i], known[i] = np.array([np.inf, -np.inf]), line
        self._first, walls = False, self.walls()
        for i, line in known.items():
            self.extend(i, extent(walls[i], transform(pose, line.ends)))

    def extend(self, i, piece):
        """Extend a wall by another observed piece of its line [m]."""
        low, high = self.seen[i]
        self.seen[i] = np.array([min(low, piece[0]), max(high, piece[1])])

    def merge(self):
        """Merge landmarks that belong to the same wall."""
        while pair := same_wall_landmarks(self.mak, self.seen):
            kept, gone = pair
            ends = ends_of(self.walls()[gone], self.seen.pop(gone))
            merge(self.mak, kept, gone)
            self.extend(kept, extent(self.walls()[kept], ends))

    def walls(self):
        """Return the map: each wall's id to its ρ [m] and α [rad]."""
        return dict(zip(self.mak.ids, self.mak.landmarks(), strict=True))

    def segments(self):
        """Return the observed pieces of the walls: (k, 4) x1 y1 x2 y2 [m]."""
        pieces = [ends_of(line, self.seen[i]).ravel() for i, line in self.walls().items()]
        return np.array(pieces).reshape(-1, 4)


def tally(source, found):
    """Count for a run, given each scan's lines: steps, ranges, lines; known, new and ambiguous
    lines (which are dropped); walls added, merged and in the final map."""
    loop, counts = WallLoop(source), Counter()
    for reading, lines_ in zip(source, found, strict=True):
        loop.predict(reading.odometry)
        known, new = loop.associate(lines_)
        loop.update(known)
        paired, before = len(known), len(loop.mak.ids)
        loop.initialise(new, known)
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
    """Return the measurements of Lines: z (m, 2) ρ' [m], α' [rad], and R (m, 2, 2)."""
    return np.array([line.z for line in found]), np.array([line.R for line in found])
