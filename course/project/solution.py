"""A good solution of the final project, not the best: ICP on a local map, a pose graph for loops.

Scans are matched with the points of the last keyframes, from where odometry leads. A keyframe near
an old one is matched with the scans round that one; where it fits, the two are tied, and all
keyframes are moved so that odometry, matches and ties agree in the sense of least squares. Where a
scan fits nowhere near, the robot has been carried: it begins a second map, and looks for itself in
the first one.
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
FEW = 20  # points, too few to match with
LOST, KNOWN = 0.25, 0.8  # share of a scan that fits: below it is lost, above it knows the place [1]
LOST_SIGMA = np.array([5.0, 5.0, 2.0])  # of the way that it was carried [m, m, rad]
TRIES = 12  # keyframes with which it looks for itself
HEADINGS, POINTS, BEST = 24, 40, 25  # tried at each old keyframe; of the scan; looked at closely


class MySlam:
    """Scan matching with keyframes, and loops closed by a pose graph."""

    def __init__(self):
        self.pose, self.covariance = np.zeros(3), np.zeros((3, 3))
        self._poses, self._clouds = [], []  # of the keyframes
        self._ties = []  # (i, j, pose of j seen from i, sigma) between keyframes
        self._track = []  # for each reading: its keyframe, its pose seen from there
        self._local, self._sigma2 = None, np.zeros(3)
        self._saw = False  # whether there was a scan last time
        self._first = 0  # keyframe with which the present map began
        self._old, self._guess = None, None  # the map before; where it may be there: (j, pose)

    def step(self, reading):
        """Predict by odometry, match with the local map, keep a keyframe, look for a loop."""
        moved = np.asarray(reading.odometry)
        guess = compose(self.pose, moved)
        cloud = with_normals(reading.scan)
        sees, fitted, fits = len(cloud) > FEW, guess, np.nan
        if self._local is not None and sees:
            fitted, fits = icp(cloud, self._local, guess, STEP_SIGMA)
        # after lost scans it may be in a room not seen before: then the wheels are believed
        sure, lost = fits > 0.5, fits < LOST and self._saw
        self._saw = sees
        sigma = MATCH_SIGMA if sure else LOST_SIGMA if lost else STEP_SIGMA
        self._grow_covariance(moved, sigma)
        self.pose = fitted if sure else guess
        if lost:
            self._begin_again()
        away = between(self._poses[-1], self.pose) if self._poses else None
        far = away is None or np.hypot(*away[:2]) > KEY_DISTANCE or abs(away[2]) > KEY_TURN
        if (far or lost) and sees:
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
        if self._close_loop(j) or self._find_itself(j):
            self._poses = optimise(self._poses, self._ties)
            self.pose = self._poses[-1]
        recent = range(max(self._first, j - RECENT), j + 1)
        self._local = Target(self._poses, self._clouds, recent)

    def _close_loop(self, j):
        """Tie keyframe j to the nearest old one of its map, if its scan fits there."""
        first = self._first if self._old else 0
        if j - first <= OLD:
            return False
        old = np.array(self._poses[first : j - OLD])
        away = np.hypot(*(old[:, :2] - self.pose[:2]).T)
        i = first + int(np.argmin(away))
        if away[i - first] > NEARBY:
            return False
        around = range(max(first, i - 3), min(i + 4, j - OLD // 2))
        wide = np.array([0.5, 0.5, 0.1])
        target = Target(self._poses, self._clouds, around)
        found, fits = icp(self._clouds[j], target, self.pose, wide, reach=1.0)
        if fits > 0.75:
            self._tie(i, j, found)
        return fits > 0.75

    def _tie(self, i, j, found):
        """Keyframe j was found to be at a pose, by the scans round keyframe i."""
        self._ties.append((i, j, between(self._poses[i], found), LOOP_SIGMA))
        self.covariance = np.diag((LOOP_SIGMA + 0.004 * i) ** 2)

    def _begin_again(self):
        """Where it is now has nothing to do with where it was: a second map begins."""
        self._first, self._guess = len(self._poses), None
        self._old = Target(self._poses, self._clouds, range(self._first))

    def _find_itself(self, j):
        """Look for keyframe j in the old map; two of them have to agree."""
        if self._old is None or j - self._first > TRIES:
            return False
        found, fits = search(self._clouds[j], self._old, self._poses[: self._first])
        if fits < KNOWN:
            return False
        before, self._guess = self._guess, (j, found)
        if before is None:
            return False
        k, there = before
        off = between(compose(there, between(self._poses[k], self._poses[j])), found)
        if np.hypot(*off[:2]) > 0.3 or abs(off[2]) > 0.1:
            return False
        # all of the second map goes where its last keyframe was found
        steps = [between(self._poses[j], self._poses[m]) for m in range(self._first, j + 1)]
        self._poses[self._first :] = [compose(found, step) for step in steps]
        away = np.hypot(*(np.array(self._poses[: self._first])[:, :2] - found[:2]).T)
        self._tie(int(np.argmin(away)), j, found)
        self._old = None
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


def search(cloud, target, places):
    """Where in a map a scan fits best, tried at some places in all directions: pose, share."""
    turns = np.arange(HEADINGS) * 2 * np.pi / HEADINGS
    tried = np.array([[x, y, turn] for x, y, _ in places for turn in turns])
    few = cloud[:: max(1, len(cloud) // POINTS), :2]
    c, s = np.cos(tried[:, 2:]), np.sin(tried[:, 2:])
    x, y = (
        c * few[:, 0] - s * few[:, 1] + tried[:, :1],
        s * few[:, 0] + c * few[:, 1] + tried[:, 1:2],
    )
    away, _ = target.tree.query(np.stack([x, y], axis=-1), distance_upper_bound=0.6)
    likely = np.exp(-((away / 0.25) ** 2)).mean(axis=1)
    wide = np.array([1.0, 1.0, 0.5])
    best = np.argsort(-likely)[:BEST]
    return max((icp(cloud, target, tried[k], wide, reach=1.0) for k in best), key=lambda f: f[1])


def icp(cloud, target, guess, sigma, reach=0.5):
    """Point-to-line ICP with a prior: the pose, and the share of the points that fit."""
    x, prior = np.array(guess, dtype=float), np.diag(1 / sigma**2)
    for gate in np.maximum(0.1, reach * 0.7 ** np.arange(12)):
        points = transform(x, cloud[:, :2])
        distance, nearest = target.tree.query(points, distance_upper_bound=gate)
        hit = np.isfinite(distance)
        if hit.sum() < 15:
            return x, 0.0
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
    return x, np.sum(np.abs(r) < 0.08) / len(cloud)


def optimise(poses, ties, rounds=4):
    """Gauss-Newton on the keyframes' poses; far too large errors of a tie lose their weight."""
    x = np.array(poses)
    i, j, tie, sigma = (np.array(each) for each in zip(*ties, strict=True))
    rows = (3 * np.column_stack([i, i, i, j, j, j])) + np.array([0, 1, 2, 0, 1, 2])
    for _ in range(rounds):
        c, s = np.cos(x[i, 2]), np.sin(x[i, 2])
        R = np.array([[c, s], [-s, c]]).transpose(2, 0, 1)
        turned = np.array([[-s, c], [-c, -s]]).transpose(2, 0, 1)  # ∂R/∂θ
        d = (x[j, :2] - x[i, :2])[..., None]
        e = np.column_stack([(R @ d)[..., 0], x[j, 2] - x[i, 2]]) - tie
        e[:, 2] = wrap(e[:, 2])
        J = np.zeros((len(ties), 3, 6))
        J[:, :2, :2], J[:, :2, 2:3], J[:, 2, 2] = -R, turned @ d, -1
        J[:, :2, 3:5], J[:, 2, 5] = R, 1
        w = 1 / sigma**2 / (1 + np.sum((e / sigma) ** 2, axis=1) / 50)[:, None]
        weighted = J.transpose(0, 2, 1) * w[:, None]
        H, b = np.zeros((x.size, x.size)), np.zeros(x.size)
        H[:3, :3] = 1e9 * np.eye(3)
        np.add.at(H, (rows[:, :, None], rows[:, None]), weighted @ J)
        np.add.at(b, rows, -(weighted @ e[..., None])[..., 0])
        x = x + np.linalg.solve(H, b).reshape(-1, 3)
    x[:, 2] = wrap(x[:, 2])
    return list(x)
