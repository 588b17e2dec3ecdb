"""A good solution of the final project, but not the best: ICP with a local map and a pose graph.

Each scan is matched with the points of the last keyframes; odometry gives the initial guess. A
keyframe near an old one is matched with the scans around that one. If the match is good, an edge
closes the loop, and the pose graph is optimised by least squares. If a scan matches nothing nearby,
the robot was kidnapped: a second map begins, and the robot is relocalised in the first one.
"""

import numpy as np
from scipy.spatial import cKDTree

from slamlab.geometry import between, compose, transform, wrap

KEY_DISTANCE, KEY_TURN = 0.8, 0.6  # motion between keyframes [m, rad]
RECENT = 8  # keyframes in the local map
OLD = 12  # least number of keyframes between the two of a loop closure
NEARBY = 2.5  # largest distance of a loop-closure candidate [m]
STEP_SIGMA = np.array([0.03, 0.03, 0.03])  # odometry of one reading [m, m, rad]
MATCH_SIGMA = np.array([0.004, 0.004, 0.0013])  # matched motion of one reading [m, m, rad]
LOOP_SIGMA = np.array([0.03, 0.03, 0.01])  # of a loop closure [m, m, rad]
POINT_SIGMA = 0.04  # of a point from its wall, enlarged because neighbours are correlated [m]
FEW = 20  # a scan with fewer points is not matched
LOST, KNOWN = 0.25, 0.8  # inlier share of a scan: below the first lost, above the second found [1]
LOST_SIGMA = np.array([5.0, 5.0, 2.0])  # of the unknown motion while carried [m, m, rad]
TRIES = 12  # keyframes after which relocalisation is given up
HEADINGS, POINTS, BEST = 24, 40, 25  # per old keyframe; points of the scan; candidates refined


class MySlam:
    """Scan matching with keyframes, and loops closed by a pose graph."""

    def __init__(self):
        self.pose, self.covariance = np.zeros(3), np.zeros((3, 3))
        self._poses, self._clouds = [], []  # of the keyframes
        self._edges = []  # (i, j, pose of j seen from i, sigma) between keyframes
        self._track = []  # for each reading: its keyframe, its pose relative to it
        self._local, self._sigma2 = None, np.zeros(3)
        self._had_scan = False  # whether the last reading had a scan
        self._first = 0  # first keyframe of the current map
        self._old_map, self._guess = None, None  # the old map; a candidate in it: (j, pose)

    def step(self, reading):
        """Predict by odometry, match with the local map, add a keyframe, and search for a loop."""
        increment = np.asarray(reading.odometry)
        guess = compose(self.pose, increment)
        cloud = with_normals(reading.scan)
        has_scan, matched, inliers = len(cloud) > FEW, guess, np.nan
        if self._local is not None and has_scan:
            matched, inliers = icp(cloud, self._local, guess, STEP_SIGMA)
        # after lost scans the robot may be in a new room: then odometry is used
        is_matched, is_lost = inliers > 0.5, inliers < LOST and self._had_scan
        self._had_scan = has_scan
        sigma = MATCH_SIGMA if is_matched else LOST_SIGMA if is_lost else STEP_SIGMA
        self._grow_covariance(increment, sigma)
        self.pose = matched if is_matched else guess
        if is_lost:
            self._begin_map()
        offset = between(self._poses[-1], self.pose) if self._poses else None
        far = offset is None or np.hypot(*offset[:2]) > KEY_DISTANCE or abs(offset[2]) > KEY_TURN
        if (far or is_lost) and has_scan:
            self._add_keyframe(cloud)
        key = len(self._poses) - 1
        self._track.append((key, between(self._poses[key], self.pose) if key >= 0 else self.pose))

    def trajectory(self):
        """Return all poses (n, 3), computed from the current estimates of their keyframes."""
        return np.array([compose(self._poses[k], p) if k >= 0 else p for k, p in self._track])

    def map(self):
        """Return the points of all keyframes, one per cell of 5 cm: (n, 2)."""
        points = [transform(p, c[:, :2]) for p, c in zip(self._poses, self._clouds, strict=True)]
        points = np.concatenate([np.empty((0, 2)), *points])
        return points[np.unique(np.floor(points / 0.05), axis=0, return_index=True)[1]]

    def _grow_covariance(self, increment, sigma):
        # P = A P Aᵀ + Q, with Q rotated into the frame of the map
        c, s = np.cos(self.pose[2]), np.sin(self.pose[2])
        R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        A = np.eye(3)
        A[:2, 2] = -s * increment[0] - c * increment[1], c * increment[0] - s * increment[1]
        self.covariance = A @ self.covariance @ A.T + R @ np.diag(sigma**2) @ R.T
        self._sigma2 = self._sigma2 + sigma**2

    def _add_keyframe(self, cloud):
        j = len(self._poses)
        if j:
            motion = between(self._poses[-1], self.pose)
            self._edges.append((j - 1, j, motion, np.sqrt(self._sigma2) + 1e-4))
        self._poses.append(self.pose)
        self._clouds.append(cloud)
        self._sigma2 = np.zeros(3)
        if self._close_loop(j) or self._relocalise(j):
            self._poses = optimise(self._poses, self._edges)
            self.pose = self._poses[-1]
        recent = range(max(self._first, j - RECENT), j + 1)
        self._local = Target(self._poses, self._clouds, recent)

    def _close_loop(self, j):
        """Match keyframe j with the nearest old keyframe of its map; a good match closes a loop."""
        first = self._first if self._old_map else 0
        if j - first <= OLD:
            return False
        old = np.array(self._poses[first : j - OLD])
        offset = np.hypot(*(old[:, :2] - self.pose[:2]).T)
        i = first + int(np.argmin(offset))
        if offset[i - first] > NEARBY:
            return False
        around = range(max(first, i - 3), min(i + 4, j - OLD // 2))
        prior_sigma = np.array([0.5, 0.5, 0.1])
        target = Target(self._poses, self._clouds, around)
        found, inliers = icp(self._clouds[j], target, self.pose, prior_sigma, reach=1.0)
        if inliers > 0.75:
            self._add_loop_edge(i, j, found)
        return inliers > 0.75

    def _add_loop_edge(self, i, j, found):
        """Add an edge for the pose of keyframe j that was found with the scans around keyframe i."""
        self._edges.append((i, j, between(self._poses[i], found), LOOP_SIGMA))
        self.covariance = np.diag((LOOP_SIGMA + 0.004 * i) ** 2)

    def _begin_map(self):
        """Begin a second map, because the motion since the last pose is unknown."""
        self._first, self._guess = len(self._poses), None
        self._old_map = Target(self._poses, self._clouds, range(self._first))

    def _relocalise(self, j):
        """Relocalise keyframe j in the old map; two keyframes must agree."""
        if self._old_map is None or j - self._first > TRIES:
            return False
        found, inliers = search(self._clouds[j], self._old_map, self._poses[: self._first])
        if inliers < KNOWN:
            return False
        before, self._guess = self._guess, (j, found)
        if before is None:
            return False
        k, there = before
        off = between(compose(there, between(self._poses[k], self._poses[j])), found)
        if np.hypot(*off[:2]) > 0.3 or abs(off[2]) > 0.1:
            return False
        # move the second map so that its last keyframe has the pose that was found
        steps = [between(self._poses[j], self._poses[m]) for m in range(self._first, j + 1)]
        self._poses[self._first :] = [compose(found, step) for step in steps]
        offset = np.hypot(*(np.array(self._poses[: self._first])[:, :2] - found[:2]).T)
        self._add_loop_edge(int(np.argmin(offset)), j, found)
        self._old_map = None
        return True


class Target:
    """Points of some keyframes with their normals and a k-d tree."""

    def __init__(self, poses, clouds, which):
        self.points = np.concatenate([transform(poses[k], clouds[k][:, :2]) for k in which])
        self.normals = np.concatenate(
            [transform([0, 0, poses[k][2]], clouds[k][:, 2:]) for k in which]
        )
        self.tree = cKDTree(self.points)


def with_normals(scan, reach=2):
    """Return a scan's points, projected onto lines through their neighbours, and normals: (n, 4)."""
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


def search(cloud, target, guesses):
    """Find a scan in a map from initial guesses in all directions; return pose and inlier share."""
    headings = np.arange(HEADINGS) * 2 * np.pi / HEADINGS
    tried = np.array([[x, y, turn] for x, y, _ in guesses for turn in headings])
    subset = cloud[:: max(1, len(cloud) // POINTS), :2]
    c, s = np.cos(tried[:, 2:]), np.sin(tried[:, 2:])
    x, y = (
        c * subset[:, 0] - s * subset[:, 1] + tried[:, :1],
        s * subset[:, 0] + c * subset[:, 1] + tried[:, 1:2],
    )
    offset, _ = target.tree.query(np.stack([x, y], axis=-1), distance_upper_bound=0.6)
    likelihood = np.exp(-((offset / 0.25) ** 2)).mean(axis=1)
    prior_sigma = np.array([1.0, 1.0, 0.5])
    best = np.argsort(-likelihood)[:BEST]
    refined = (icp(cloud, target, tried[k], prior_sigma, reach=1.0) for k in best)
    return max(refined, key=lambda found: found[1])


def icp(cloud, target, guess, sigma, reach=0.5):
    """Run point-to-line ICP with a prior; return the pose and the share of inliers."""
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


def optimise(poses, edges, iterations=4):
    """Optimise the keyframes' poses by Gauss-Newton; a robust kernel reduces outliers' weights."""
    x = np.array(poses)
    i, j, motion, sigma = (np.array(each) for each in zip(*edges, strict=True))
    rows = (3 * np.column_stack([i, i, i, j, j, j])) + np.array([0, 1, 2, 0, 1, 2])
    for _ in range(iterations):
        c, s = np.cos(x[i, 2]), np.sin(x[i, 2])
        R = np.array([[c, s], [-s, c]]).transpose(2, 0, 1)
        turned = np.array([[-s, c], [-c, -s]]).transpose(2, 0, 1)  # ∂R/∂θ
        d = (x[j, :2] - x[i, :2])[..., None]
        e = np.column_stack([(R @ d)[..., 0], x[j, 2] - x[i, 2]]) - motion
        e[:, 2] = wrap(e[:, 2])
        J = np.zeros((len(edges), 3, 6))
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
