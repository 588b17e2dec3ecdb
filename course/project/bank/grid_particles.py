"""A particle filter on a grid: samples of the pose, weighed by how well the scan fits the map."""

import numpy as np

from course.project.template import MySlam
from slamlab.geometry import compose, transform, wrap

SIDE, HALF = 0.05, 25.0  # of a cell, and half of the grid's width [m]
SAMPLES = 250
WHEEL_SIGMA = 0.012  # slip of a wheel after a metre [m/√m]
HIT_SIGMA = 0.06  # of a point off the map [m]
SHARPNESS = 0.3  # neighbouring beams err alike: their likelihoods count for less [1]


class GridParticles(MySlam):
    """Monte Carlo localisation in the map made so far; the mean of the samples extends the map."""

    def __init__(self):
        super().__init__()
        self._rng = np.random.default_rng(0)
        self._samples = np.zeros((SAMPLES, 3))
        width = int(2 * HALF / SIDE)
        self._field = np.zeros((width, width), dtype=np.float32)  # how likely a hit is in a cell
        reach = np.arange(-4, 5) * SIDE
        self._bump = np.exp(-0.5 * (reach[:, None] ** 2 + reach**2) / HIT_SIGMA**2)

    def step(self, reading):
        """Move the samples, weigh them, take their mean, draw the scan there, resample."""
        points = np.empty((0, 2)) if reading.scan is None else reading.scan.points()
        self._samples = compose(self._samples, self._noisy(reading.odometry))
        if self._scans and len(points) > 20:
            weights = self._weights(points)
            sines, cosines = np.sin(self._samples[:, 2]), np.cos(self._samples[:, 2])
            turn = np.arctan2(weights @ sines, weights @ cosines)
            self.pose = np.array([*(weights @ self._samples[:, :2]), turn])
            kept = np.searchsorted(
                np.cumsum(weights), (self._rng.random() + np.arange(SAMPLES)) / SAMPLES
            )
            self._samples = self._samples[np.minimum(kept, SAMPLES - 1)]
        else:
            self.pose = compose(self.pose, reading.odometry)
        self._draw(transform(self.pose, points))
        self._poses.append(self.pose)
        self._scans.append(points)

    def _noisy(self, motion):
        """The increment with slip of its wheels, for each sample."""
        way = np.hypot(*motion[:2]) + 0.15 * abs(motion[2])
        sigma = WHEEL_SIGMA * np.sqrt(way)
        spread = np.array([1.0, 0.3, 5.0]) * sigma + np.array([0, 0, 0.006 * way])
        return motion + self._rng.standard_normal((SAMPLES, 3)) * spread

    def _weights(self, points):
        """How well the scan fits at each sample; the likelihood field is flat far from walls."""
        for sharpness in (0.3 * SHARPNESS, SHARPNESS):  # first broad, then sharp: annealed
            c, s = np.cos(self._samples[:, 2]), np.sin(self._samples[:, 2])
            x = self._samples[:, :1] + np.outer(c, points[:, 0]) - np.outer(s, points[:, 1])
            y = self._samples[:, 1:2] + np.outer(s, points[:, 0]) + np.outer(c, points[:, 1])
            score = sharpness * np.log(0.1 + self._field[self._cells(x), self._cells(y)]).sum(
                axis=1
            )
            weights = np.exp(score - score.max())
            weights /= weights.sum()
            if sharpness < SHARPNESS:
                kept = self._rng.choice(SAMPLES, SAMPLES, p=weights)
                jitter = self._rng.standard_normal((SAMPLES, 3)) * np.array([0.01, 0.01, 0.004])
                self._samples = self._samples[kept] + jitter
                self._samples[:, 2] = wrap(self._samples[:, 2])
        return weights

    def _draw(self, points):
        """Put a bump into the field where the points hit."""
        rows, columns = self._cells(points[:, 0]), self._cells(points[:, 1])
        for i in range(-4, 5):
            for j in range(-4, 5):
                np.maximum.at(
                    self._field,
                    (
                        np.clip(rows + i, 0, len(self._field) - 1),
                        np.clip(columns + j, 0, len(self._field) - 1),
                    ),
                    self._bump[i + 4, j + 4],
                )

    def _cells(self, metres):
        return np.clip(((metres + HALF) / SIDE).astype(int), 0, len(self._field) - 1)
