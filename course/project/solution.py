"""A good solution of the final project, not the best: ICP on a local map, a pose graph for loops.

Scans are matched with the points of the last keyframes, from where odometry leads. A keyframe near
an old one is matched with the scans round that one; where it fits, the two are tied, and all
keyframes are moved so that odometry, matches and ties agree in the sense of least squares.
"""

import numpy as np
from scipy.spatial import cKDTree

from slamlab.geometry import between, compose, transform, wrap

KEY_DISTANCE, KEY_TURN = 0.8, 0.6  # motion that makes a keyframe [m, rad]
RECENT = 8  # keyframes in the local map
OLD = 12  # keyframes back from which one is old enough to close a loop
NEARBY = 2.5  # how far from an old keyframe a loop is looked for [m]
STEP_SIGMA = np.array([0.03, 0.03, 0.03])  # odometry of one reading [m, m, rad]
MATCH_SIGMA = np.array([0.004, 0.004, 0.0013])  # matched motion of one reading [m, m, rad]
LOOP_SIGMA = np.array([0.03, 0.03, 0.01])  # of a loop's tie [m, m, rad]
POINT_SIGMA = 0.04  # of a point off its wall; too large for one, for neighbours err alike [m]


class MySlam:
    """Scan matching with keyframes, and loops closed by a pose graph."""

    def __init__(self):
        self.pose, self.covariance = np.zeros(3), np.zeros((3, 3))
        self._poses, self._clouds = [], []  # of the keyframes
        self._ties = []  # (i, j, pose of j seen from i, sigma) between keyframes
        self._track = []  # for each reading: its keyframe, its pose seen from there
        self._local, self._sigma2 = None, np.zeros(3)

    def step(self, reading):
        """Predict by odometry, match with the local map, keep a keyframe, look for a loop."""
        moved = np.asarray(reading.odometry)
        guess = compose(self.pose, moved)
        cloud = with_normals(reading.scan)
        fitted = None
        if self._local is not None and len(cloud) > 20:
            fitted = icp(cloud, self._local, guess, STEP_SIGMA)
        sigma = MATCH_SIGMA if fitted is not None else STEP_SIGMA
        self._grow_covariance(moved, sigma)
        self.pose = guess if fitted is None else fitted
        away = between(self._poses[-1], self.pose) if self._poses else None
        far = away is None or np.hypot(*away[:2]) > KEY_DISTANCE or abs(away[2]) > KEY_TURN
        if far and len(cloud) > 20:
            self._add_keyframe(cloud)
        key = len(self._poses) - 1
        self._track.append((key, between(self._poses[key], self.pose) if key >= 0 else self.pose))

    def trajectory(self):
        """All poses, each where its keyframe is now: (n, 3)."""
        return np.array([compose(self._poses[k], p) if k >= 0 else p for k, p in self._track])

    def map(self):
        """The points of all keyframes, one a cell of 5 cm: (n, 2)."""
        points = [transform(p, c[:, :2]) for p, c in zip(self._poses, self._clouds, strict=True)]
        points = np.concatenate([np.empty((0, 2)), *points])
        return points[np.unique(np.floor(points / 0.05), axis=0, return_index=True)[1]]

    def _grow_covariance(self, moved, sigma):
        # P = A P Aᵀ + Q, and Q turned into the map's frame
        c, s = np.cos(self.pose[2]), np.sin(self.pose[2])
        R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        A = np.eye(3)
        A[:2, 2] = -s * moved[0] - c * moved[1], c * moved[0] - s * moved[1]
        self.covariance = A @ self.covariance @ A.T + R @ np.diag(sigma**2) @ R.T
        self._sigma2 = self._sigma2 + sigma**2

    def _add_keyframe(self, cloud):
        j = len(self._poses)
        if j:
            tie = between(self._poses[-1], self.pose)
            self._ties.append((j - 1, j, tie, np.sqrt(self._sigma2) + 1e-4))
        self._poses.append(self.pose)
        self._clouds.append(cloud)
        self._sigma2 = np.zeros(3)
        if self._close_loop(j):
            self._poses = optimise(self._poses, self._ties)
            self.pose = self._poses[-1]
        self._local = Target(self._poses, self._clouds, range(max(0, j - RECENT), j + 1))

    def _close_loop(self, j):
        """Tie keyframe j to the nearest old one, if its scan fits there."""
        if j <= OLD:
            return False
        old = np.array(self._poses[: j - OLD])
        away = np.hypot(*(old[:, :2] - self.pose[:2]).T)
        i = int(np.argmin(away))
        if away[i] > NEARBY:
            return False
        target = Target(self._poses, self._clouds, range(max(0, i - 3), min(i + 4, j - OLD // 2)))
        wide = np.array([0.5, 0.5, 0.1])
        found = icp(self._clouds[j], target, self.pose, wide, reach=1.0, share=0.75)
        if found is None:
            return False
        self._ties.append((i, j, between(self._poses[i], found), LOOP_SIGMA))
        self.covariance = np.diag((LOOP_SIGMA + 0.004 * i) ** 2)
        return True


class Target:
    """The points of some keyframes with their normals, ready to be searched."""

    def __init__(self, poses, clouds, which):
        self.points = np.concatenate([transform(poses[k], clouds[k][:, :2]) for k in which])
        self.normals = np.concatenate(
            [transform([0, 0, poses[k][2]], clouds[k][:, 2:]) for k in which]
        )
        self.tree = cKDTree(self.points)


def with_normals(scan, reach=2):
    """Points of a scan on the lines fitted to their neighbours, and the lines' normals: (n, 4)."""
    points = np.empty((0, 2)) if scan is None else scan.points()
    if len(points) < 2 * reach + 1:
        return np.empty((0, 4))
    beside = np.arange(len(points))[:, None] + np.arange(-reach, reach + 1)
    groups = points[beside % len(points)]
    apart = np.hypot(*(groups - points[:, None]).transpose(2, 0, 1))
    w = (apart < 0.06 + 0.1 * np.hypot(*points.T)[:, None]).astype(float)
    middle = np.sum(w[..., None] * groups, axis=1) / w.sum(axis=1)[:, None]
    d = (groups - middle[:, None]) * w[..., None]
    values, vectors = np.linalg.eigh(d.transpose(0, 2, 1) @ d)
    normals = vectors[:, :, 0]
    flat = (w.sum(axis=1) >= 3) & (values[:, 0] < 0.15 * values[:, 1])
    off = np.sum((points - middle) * normals, axis=1)
    return np.hstack([points - off[:, None] * normals, normals])[flat]


def icp(cloud, target, guess, sigma, reach=0.5, share=0.5):
    """Point-to-line ICP with a prior: the pose, or None where too few points fit."""
    x, prior = np.array(guess, dtype=float), np.diag(1 / sigma**2)
    for gate in np.maximum(0.1, reach * 0.7 ** np.arange(12)):
        points = transform(x, cloud[:, :2])
        distance, nearest = target.tree.query(points, distance_upper_bound=gate)
        hit = np.isfinite(distance)
        if hit.sum() < 15:
            return None
        n, p, q = target.normals[nearest[hit]], points[hit], target.points[nearest[hit]]
        r = np.sum(n * (p - q), axis=1)
        lever = p - x[:2]
        J = np.column_stack([n, n[:, 1] * lever[:, 0] - n[:, 0] * lever[:, 1]])
        w = 1 / (1 + (r / 0.05) ** 2) / POINT_SIGMA**2
        off = np.array([*(x - guess)[:2], wrap(float(x[2] - guess[2]))])
        step = np.linalg.solve(J.T @ (w[:, None] * J) + prior, -J.T @ (w * r) - prior @ off)
        x = x + step
        if gate <= 0.1 and np.abs(step).max() < 1e-4:
            break
    x[2] = wrap(float(x[2]))
    fits = np.abs(r) < 0.08
    return x if fits.sum() > share * len(cloud) else None


def optimise(poses, ties, rounds=4):
    """Gauss-Newton on the keyframes' poses; far too large errors of a tie lose their weight."""
    x = np.array(poses)
    for _ in range(rounds):
        H, b = np.zeros((x.size, x.size)), np.zeros(x.size)
        H[:3, :3] += 1e9 * np.eye(3)
        for i, j, tie, sigma in ties:
            c, s = np.cos(x[i, 2]), np.sin(x[i, 2])
            R = np.array([[c, s], [-s, c]])
            d = x[j, :2] - x[i, :2]
            e = np.append(R @ d - tie[:2], wrap(float(x[j, 2] - x[i, 2] - tie[2])))
            A, B = np.zeros((3, 3)), np.eye(3)
            A[:2, :2], A[2, 2], B[:2, :2] = -R, -1, R
            A[:2, 2] = np.array([[-s, c], [-c, -s]]) @ d
            W = np.diag(1 / sigma**2) / (1 + np.sum((e / sigma) ** 2) / 50)
            both = np.hstack([A, B])
            rows = np.r_[3 * i : 3 * i + 3, 3 * j : 3 * j + 3]
            H[np.ix_(rows, rows)] += both.T @ W @ both
            b[rows] -= both.T @ W @ e
        x = x + np.linalg.solve(H, b).reshape(-1, 3)
    x[:, 2] = wrap(x[:, 2])
    return list(x)
