"""EKF-SLAM with line landmarks: the state consists of the pose and the lines n·p = d."""

import numpy as np

from course.project.solution import with_normals
from course.project.template import MySlam
from slamlab.geometry import compose, wrap

MIN_POINTS, MIN_LENGTH = 8, 0.7  # of a line in a scan [1, m]
LINE_SIGMA = np.array([0.012, 0.02])  # measurement noise of direction and distance [rad, m]
GATE = 9.2  # χ² of 2 degrees of freedom, 99 %
NEW_GATE = 40.0  # a line beyond this gate of every landmark is a new landmark
WHEEL_SIGMA = 0.012  # slip of a wheel after a metre [m/√m]


class WallEkf(MySlam):
    """EKF-SLAM whose map consists of the scans at the estimated poses."""

    def __init__(self):
        super().__init__()
        self._x, self._P = np.zeros(3), np.zeros((3, 3))

    def step(self, reading):
        """Predict by odometry, update with known lines, and add new lines."""
        self._predict(np.asarray(reading.odometry))
        for direction, distance in lines(reading.scan):
            self._update_or_add(np.array([direction, distance]))
        self.pose, self.covariance = self._x[:3].copy(), self._P[:3, :3].copy()
        self._poses.append(self.pose)
        self._scans.append(np.empty((0, 2)) if reading.scan is None else reading.scan.points())

    def _predict(self, motion):
        x, P = self._x, self._P
        c, s = np.cos(x[2]), np.sin(x[2])
        A = np.eye(3)
        A[:2, 2] = -s * motion[0] - c * motion[1], c * motion[0] - s * motion[1]
        R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        distance = np.hypot(*motion[:2]) + 0.15 * abs(motion[2])
        sigma = WHEEL_SIGMA * np.sqrt(distance) * np.array([1, 0.5, 5]) + distance * np.array(
            [0, 0, 0.01]
        )
        x[:3] = compose(x[:3], motion)
        P[:3] = A @ P[:3]
        P[:, :3] = P[:, :3] @ A.T
        P[:3, :3] += R @ np.diag(sigma**2) @ R.T

    def _update_or_add(self, z):
        """Update with a known line, or add a new line to the state."""
        lines = self._x[3:].reshape(-1, 2)
        best, least = None, np.inf
        for k, line in enumerate(lines):
            v = z - self._expected_measurement(line)
            v[0] = wrap(float(v[0]))
            if abs(v[0]) > 0.4 or abs(v[1]) > 1.0:
                continue
            H = self._jacobian(k, line)
            S = H @ self._P @ H.T + np.diag(LINE_SIGMA**2)
            d2 = v @ np.linalg.solve(S, v)
            if d2 < least:
                best, least = (v, H, S), d2
        if least < GATE:
            v, H, S = best
            K = np.linalg.solve(S, H @ self._P).T
            self._x = self._x + K @ v
            self._x[2] = wrap(float(self._x[2]))
            self._P = self._P - K @ S @ K.T
        elif least > NEW_GATE:
            self._add(z)

    def _expected_measurement(self, line):
        """Return the expected measurement of a line: h(x) = (α − θ, d − n·t)."""
        x, y, theta = self._x[:3]
        return np.array(
            [wrap(float(line[0] - theta)), line[1] - x * np.cos(line[0]) - y * np.sin(line[0])]
        )

    def _jacobian(self, k, line):
        c, s = np.cos(line[0]), np.sin(line[0])
        H = np.zeros((2, len(self._x)))
        H[0, 2], H[0, 3 + 2 * k] = -1, 1
        H[1, :2], H[1, 4 + 2 * k] = (-c, -s), 1
        H[1, 3 + 2 * k] = self._x[0] * s - self._x[1] * c
        return H

    def _add(self, z):
        x, y, theta = self._x[:3]
        alpha = wrap(float(z[0] + theta))
        c, s = np.cos(alpha), np.sin(alpha)
        G = np.array([[0, 0, 1], [c, s, -x * s + y * c]])
        Gz = np.array([[1, 0], [-x * s + y * c, 1]])
        n = len(self._x)
        P = np.zeros((n + 2, n + 2))
        P[:n, :n] = self._P
        P[n:, :n] = G @ self._P[:3]
        P[:n, n:] = P[n:, :n].T
        P[n:, n:] = G @ self._P[:3, :3] @ G.T + Gz @ np.diag(LINE_SIGMA**2) @ Gz.T
        self._x = np.append(self._x, [alpha, z[1] + x * c + y * s])
        self._P = P


def lines(scan):
    """Return the lines of a scan: direction of the normal and distance, (α, d) with d > 0."""
    cloud = with_normals(scan)
    if len(cloud) < MIN_POINTS:
        return
    points = cloud[:, :2]
    facing = np.sign(np.sum(cloud[:, 2:] * points, axis=1, keepdims=True))
    normals = cloud[:, 2:] * np.where(facing == 0, 1, facing)
    same = np.sum(normals[1:] * normals[:-1], axis=1) > 0.94
    level = np.abs(np.sum(normals[1:] * (points[1:] - points[:-1]), axis=1)) < 0.08
    near = np.hypot(*(points[1:] - points[:-1]).T) < 0.15 + 0.12 * np.hypot(*points[1:].T)
    for group in np.split(np.arange(len(cloud)), np.flatnonzero(~(same & level & near)) + 1):
        p = points[group]
        if len(group) < MIN_POINTS or np.hypot(*(p[-1] - p[0])) < MIN_LENGTH:
            continue
        middle = p.mean(axis=0)
        values, vectors = np.linalg.eigh((p - middle).T @ (p - middle))
        n = vectors[:, 0]
        d = n @ middle
        n, d = (n, d) if d > 0 else (-n, -d)
        if values[0] / len(p) < 0.03**2:
            yield float(np.arctan2(n[1], n[0])), float(d)
