"""A particle filter on a likelihood field: each weight is the likelihood of the scan in the map."""

import numpy as np

from course.project.template import MySlam
from slamlab.geometry import compose, transform, wrap

SIDE, HALF = 0.05, 25.0  # of a cell, and half of the grid's width [m]
PARTICLES = 250
WHEEL_SIGMA = 0.012  # slip of a wheel after a metre [m/√m]
HIT_SIGMA = 0.06  # of a point off the map [m]
SHARPNESS = 0.3  # exponent of the likelihood, because errors of neighbouring beams are correlated


class GridParticles(MySlam):
    """Monte Carlo localisation in the current map, which is extended at the particles' mean."""

    def __init__(self):
        super().__init__()
        self._rng = np.random.default_rng(0)
        self._particles = np.zeros((PARTICLES, 3))
        width = int(2 * HALF / SIDE)
        self._field = np.zeros((width, width), dtype=np.float32)  # likelihood of a hit in a cell
        reach = np.arange(-4, 5) * SIDE
        self._bump = np.exp(-0.5 * (reach[:, None] ** 2 + reach**2) / HIT_SIGMA**2)

    def step(self, reading):
        """Predict, compute importance weights and the mean, map the scan at the mean, and
        resample."""
        points = np.empty((0, 2)) if reading.scan is None else reading.scan.points()
        self._particles = compose(self._particles, self._noisy(reading.odometry))
        if self._scans and len(points) > 20:
            weights = self._weights(points)
            sines, cosines = np.sin(self._particles[:, 2]), np.cos(self._particles[:, 2])
            turn = np.arctan2(weights @ sines, weights @ cosines)
            self.pose = np.array([*(weights @ self._particles[:, :2]), turn])
            kept = np.searchsorted(
                np.cumsum(weights), (self._rng.random() + np.arange(PARTICLES)) / PARTICLES
            )
            self._particles = self._particles[np.minimum(kept, PARTICLES - 1)]
        else:
            self.pose = compose(self.pose, reading.odometry)
        self._draw(transform(self.pose, points))
        self._poses.append(self.pose)
        self._scans.append(points)

    def _noisy(self, motion):
        """Return the odometry increment with random wheel slip for each particle."""
        distance = np.hypot(*motion[:2]) + 0.15 * abs(motion[2])
        sigma = WHEEL_SIGMA * np.sqrt(distance)
        sigmas = np.array([1.0, 0.3, 5.0]) * sigma + np.array([0, 0, 0.006 * distance])
        return motion + self._rng.standard_normal((PARTICLES, 3)) * sigmas

    def _weights(self, points):
        """Return the scan's likelihood for each particle; the field is constant far from walls."""
        for sharpness in (0.3 * SHARPNESS, SHARPNESS):  # annealing: first broad, then sharp
            c, s = np.cos(self._particles[:, 2]), np.sin(self._particles[:, 2])
            x = self._particles[:, :1] + np.outer(c, points[:, 0]) - np.outer(s, points[:, 1])
            y = self._particles[:, 1:2] + np.outer(s, points[:, 0]) + np.outer(c, points[:, 1])
            score = sharpness * np.log(0.1 + self._field[self._cells(x), self._cells(y)]).sum(
                axis=1
            )
            weights = np.exp(score - score.max())
            weights /= weights.sum()
            if sharpness < SHARPNESS:
                kept = self._rng.choice(PARTICLES, PARTICLES, p=weights)
                jitter = self._rng.standard_normal((PARTICLES, 3)) * np.array([0.01, 0.01, 0.004])
                self._particles = self._particles[kept] + jitter
                self._particles[:, 2] = wrap(self._particles[:, 2])
        return weights

    def _draw(self, points):
        """Add a Gaussian to the field at each point."""
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
