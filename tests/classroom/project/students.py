"""Estimators as students write them who have read the exercise, from scratch: good, poor and wrong.

None has been used to find the scale, which is what they try.
"""

import numpy as np
from scipy.spatial import cKDTree

from slamlab.geometry import between, compose, transform


class Wheels:
    """Adds up the increments; what the others build on."""

    def __init__(self):
        self.pose = np.zeros(3)
        self.poses, self.scans = [], []

    def step(self, reading):
        points = reading.scan.points()
        self.pose = self.locate(compose(self.pose, reading.odometry), points)
        self.poses.append(self.pose)
        self.scans.append(points)

    def locate(self, guess, points):
        return guess

    def trajectory(self):
        return np.array(self.poses)

    def map(self):
        return np.concatenate(
            [transform(p, s)[::4] for p, s in zip(self.poses, self.scans, strict=True)]
        )


class CorrelativeGrid(Wheels):
    """Tries poses round the wheels' guess on a grid of what was seen, coarse to fine."""

    SIDE, HALF = 0.1, 25.0

    def __init__(self):
        super().__init__()
        width = int(2 * self.HALF / self.SIDE)
        self.grid = np.zeros((width, width))

    def locate(self, guess, points):
        if self.scans and len(points):
            for reach, turn in ((0.1, 0.04), (0.04, 0.015)):
                offsets = np.array(
                    [[x, y, t] for x in (-1, 0, 1) for y in (-1, 0, 1) for t in (-1, 0, 1)]
                ) * [reach, reach, turn]
                tried = compose(guess, offsets)
                guess = tried[np.argmax([self.fit(transform(pose, points)) for pose in tried])]
        i, j = self.cells(transform(guess, points))
        for a in (-1, 0, 1):
            for b in (-1, 0, 1):
                value = 1.0 if a == b == 0 else 0.5
                at = np.clip(i + a, 0, len(self.grid) - 1), np.clip(j + b, 0, len(self.grid) - 1)
                self.grid[at] = np.maximum(self.grid[at], value)
        return guess

    def fit(self, points):
        return self.grid[self.cells(points)].sum()

    def cells(self, points):
        return tuple(np.clip((points + self.HALF) / self.SIDE, 0, len(self.grid) - 1).astype(int).T)


class KeyframeIcp(Wheels):
    """Point-to-line ICP with the last five keyframes; the lines join neighbouring points."""

    def __init__(self):
        super().__init__()
        self.keys = []

    def locate(self, guess, points):
        x = np.array(guess, dtype=float)
        if self.keys and len(points) > 30:
            target = np.concatenate([p for _, p, _ in self.keys[-5:]])
            normals = np.concatenate([n for _, _, n in self.keys[-5:]])
            tree = cKDTree(target)
            for gate in (0.5, 0.4, 0.3, 0.2, 0.2, 0.1, 0.1):
                p = transform(x, points)
                away, near = tree.query(p)
                near, p = near[away < gate], p[away < gate]
                n, lever = normals[near], p - x[:2]
                A = np.column_stack([n, n[:, 1] * lever[:, 0] - n[:, 0] * lever[:, 1]])
                r = np.sum(n * (target[near] - p), axis=1)
                x = x + np.linalg.lstsq(A, r, rcond=None)[0] if len(p) > 20 else x
        if not self.keys or np.hypot(*between(self.keys[-1][0], x)[:2]) > 0.7:
            self.keys.append((x, *self.lines(x, points)))
        return x

    def lines(self, x, points):
        along = np.roll(points, -1, axis=0) - points
        length = np.hypot(*along.T)
        good = (length > 1e-6) & (length < 0.4)
        normal = np.column_stack([-along[:, 1], along[:, 0]])[good] / length[good, None]
        return transform(x, points[good]), transform([0, 0, x[2]], normal)


class WallHeading(Wheels):
    """Uses odometry except for the heading, which perpendicular walls determine."""

    def __init__(self):
        super().__init__()
        self.first = None

    def locate(self, guess, points):
        along = np.diff(points, axis=0)
        near = np.hypot(*along.T) < 0.3
        if near.sum() < 20:
            return guess
        direction = np.angle(np.exp(4j * np.arctan2(*along[near].T[::-1])).sum()) / 4
        if self.first is None:
            self.first = direction + guess[2]
        off = (self.first - direction - guess[2] + np.pi / 4) % (np.pi / 2) - np.pi / 4
        return guess + np.array([0, 0, 0.5 * off]) if abs(off) < 0.2 else guess


class Diverges(Wheels):
    """Adds increments without turning them, and doubles what it adds: it runs off ever faster."""

    def step(self, reading):
        super().step(reading)
        self.pose = self.pose * 1.5 + reading.odometry
        self.poses[-1] = self.pose
