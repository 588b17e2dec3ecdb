"""Independent answers to 13-overlap: right ones, and students' mistakes."""

RIGHT = [
    (
        "13-overlap",
        "starts from many turns, votes for the shift, trimmed ICP, counts close pairs",
        """
def match(source, target, T):
    tree = cKDTree(target)
    n = normals_of(target)
    found = []
    for angle in np.radians(np.arange(0, 360, 8)):
        R = turned(angle)
        shifts = (target[None, :, :] - (source[::2] @ R.T)[:, None, :]).reshape(-1, 2)
        H, ex, ey = np.histogram2d(shifts[:, 0], shifts[:, 1], bins=(60, 60), range=((-9, 9), (-9, 9)))
        i, j = np.unravel_index(np.argmax(H), H.shape)
        found.append((H[i, j], angle, (ex[i] + ex[i + 1]) / 2, (ey[j] + ey[j + 1]) / 2))
    found.sort(reverse=True)

    def refine(R, t, gates):
        for gate in gates:
            moved = source @ R.T + t
            d, rows = tree.query(moved)
            ok = d < gate
            if ok.sum() < 6:
                break
            m, q, nn = moved[ok], target[rows[ok]], n[rows[ok]]
            arm = m - t
            r = np.sum(nn * (m - q), axis=1)
            J = np.c_[nn, arm[:, 0] * nn[:, 1] - arm[:, 1] * nn[:, 0]]
            delta = np.linalg.solve(J.T @ J + 1e-3 * np.eye(3), -J.T @ r)
            R, t = turned(delta[2]) @ R, t + delta[:2]
        return R, t

    best = None
    for votes, angle, x, y in found[:10]:
        R, t = refine(turned(angle), np.array([x, y]), (0.6, 0.5, 0.4, 0.3, 0.25, 0.2))
        good = np.sum(tree.query(source @ R.T + t)[0] < 0.1)
        if best is None or good > best[0]:
            best = good, R, t
    R, t = refine(best[1], best[2], [0.15] * 3 + [0.1] * 8)
    out = np.eye(3)
    out[:2, :2], out[:2, 2] = R, t
    return out
""",
    ),
]

WRONG = [
    (
        "13-overlap",
        "trimmed ICP from the guess",
        """
def match(source, target, T):
    return trimmed_icp(source, target, T, 60, 0.6)
""",
    ),
    (
        "13-overlap",
        "returns the guess",
        """
def match(source, target, T):
    return T
""",
    ),
    (
        "13-overlap",
        "many turns; the best has the smallest mean distance of all pairs",
        """
def match(source, target, T):
    best, best_score = T, np.inf
    for angle in np.radians(np.arange(0, 360, 30)):
        S = np.eye(3)
        S[:2, :2] = turned(angle)
        S[:2, 2] = T[:2, 2]
        S = icp(source, target, S, 25)
        score = nearest(carry(S, source), target)[0].mean()
        if score < best_score:
            best, best_score = S, score
    return best
""",
    ),
    (
        "13-overlap",
        "plain ICP, more rounds",
        """
def match(source, target, T):
    return icp(source, target, T, 300)
""",
    ),
    (
        "13-overlap",
        "centroids over each other, then ICP",
        """
def match(source, target, T):
    S = T.copy()
    S[:2, 2] = target.mean(axis=0) - S[:2, :2] @ source.mean(axis=0)
    return trimmed_icp(source, target, S, 80, 0.7)
""",
    ),
    (
        "13-overlap",
        "beam k pairs with beam k",
        """
def match(source, target, T):
    n = min(len(source), len(target))
    return best_motion(source[:n], target[:n])
""",
    ),
    (
        "13-overlap",
        "many turns; the best is where few pairs lie very near (share 0.1)",
        """
def match(source, target, T):
    best, best_score = T, np.inf
    for angle in np.radians(np.arange(-180, 180, 45)):
        S = T.copy()
        S[:2, :2] = turned(angle)
        S = trimmed_icp(source, target, S, 20, 0.1)
        d = np.sort(nearest(carry(S, source), target)[0])
        score = d[: len(d) // 10].mean()
        if score < best_score:
            best, best_score = S, score
    return best
""",
    ),
    (
        "13-overlap",
        "vote for the shift, but with the guess's turn",
        """
def match(source, target, T):
    R = T[:2, :2]
    shifts = (target[:, None] - source @ R.T).reshape(-1, 2)
    cells, votes = np.unique(np.floor(shifts / 0.3), axis=0, return_counts=True)
    S = T.copy()
    S[:2, 2] = (cells[np.argmax(votes)] + 0.5) * 0.3
    return trimmed_icp(source, target, S, 60, 0.5)
""",
    ),
    (
        "13-overlap",
        "changes the guess in place",
        """
def match(source, target, T):
    for share in (0.9, 0.7, 0.5):
        T[:] = trimmed_icp(source, target, T, 20, share)
    return T
""",
    ),
    (
        "13-overlap",
        "a hundred random starts with long ICPs: far too slow",
        """
def match(source, target, T):
    rng, best, most = np.random.default_rng(0), T, -1
    for _ in range(150):
        S = np.eye(3)
        S[:2, :2] = turned(rng.uniform(-np.pi, np.pi))
        S[:2, 2] = T[:2, 2] + rng.uniform(-1.2, 1.2, 2)
        S = trimmed_icp(source, target, S, 60, 0.6)
        good = np.sum(nearest(carry(S, source), target)[0] < 0.05)
        if good > most:
            best, most = S, good
    return best
""",
    ),
    (
        "13-overlap",
        "best of the voted turns, but the inverse motion is returned",
        """
def match(source, target, T):
    best = (-1, None, None)
    for angle in np.radians(np.arange(0, 360, 6)):
        R = turned(angle)
        shifts = (target[:, None] - source[::2] @ R.T).reshape(-1, 2)
        H, ex, ey = np.histogram2d(*shifts.T, bins=60, range=((-9, 9), (-9, 9)))
        i, j = np.unravel_index(H.argmax(), H.shape)
        if H[i, j] > best[0]:
            best = (H[i, j], R, np.array([ex[i] + 0.15, ey[j] + 0.15]))
    S = np.eye(3)
    S[:2, :2], S[:2, 2] = best[1], best[2]
    return np.linalg.inv(trimmed_icp(source, target, S, 40, 0.5))
""",
    ),
    (
        "13-overlap",
        "main directions of the clouds over each other",
        """
def match(source, target, T):
    def frame(c):
        w, v = np.linalg.eigh(np.cov(c.T))
        v = v[:, ::-1]
        if np.linalg.det(v) < 0:
            v[:, 1] *= -1
        return v
    R = frame(target) @ frame(source).T
    S = np.eye(3)
    S[:2, :2], S[:2, 2] = R, target.mean(axis=0) - R @ source.mean(axis=0)
    return icp(source, target, S, 40)
""",
    ),
]
