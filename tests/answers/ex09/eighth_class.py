"""An eighth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "09-place",
        "the covariance by unscented points, the mean of them for the line",
        """
def place(x, P, z, R):
    s = np.concatenate([x, z])
    full = np.zeros((5, 5))
    full[:3, :3], full[3:, 3:] = P, R
    root = np.linalg.cholesky(5 * full)
    points = np.vstack([s + root.T, s - root.T])
    a = points[:, 2] + points[:, 4]
    lines = np.column_stack([points[:, 3] + points[:, 0] * np.cos(a) + points[:, 1] * np.sin(a), a])
    mean = lines.mean(axis=0)
    off, pose = lines - mean, points[:, :3] - x
    return mean, off.T @ off / 10, off.T @ pose / 10
""",
    ),
    (
        "09-update",
        "first the distance, then the angle, as if they did not err together",
        """
def update(x, P, z, j, R):
    k = 3 + 2 * j
    for row in range(2):
        c, s = np.cos(x[k + 1]), np.sin(x[k + 1])
        H = np.zeros(len(x))
        if row == 0:
            H[0], H[1], H[k], H[k + 1] = -c, -s, 1, x[0] * s - x[1] * c
            v = z[0] - (x[k] - x[0] * c - x[1] * s)
        else:
            H[2], H[k + 1] = -1, 1
            v = wrap(z[1] - x[k + 1] + x[2])
        K = P @ H / (H @ P @ H + R[row, row])
        x, P = x + K * v, P - np.outer(K, H @ P)
    return x, P
""",
    ),
    (
        "09-life",
        "counts kept in the book that was given",
        """
def keep_book(book, seen, N, lives):
    for id in list(book):
        times, left = book[id]
        if id in seen:
            book[id] = (times + 1, lives)
        elif left > 1:
            book[id] = (times, left - 1)
        else:
            del book[id]
    for id in seen:
        book.setdefault(id, (1, lives))
    return book, [id for id in set(seen) if book[id][0] >= N]
""",
    ),
    (
        "09-end",
        "the wall's line is known, only the robot errs",
        """
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j], x[4 + 2 * j]
    def meet(pose, b):
        phi = pose[2] + b
        r = (rho - pose[0] * np.cos(alpha) - pose[1] * np.sin(alpha)) / np.cos(phi - alpha)
        return pose[:2] + r * np.array([np.cos(phi), np.sin(phi)])
    e = 1e-6
    J = np.column_stack([(meet(x[:3] + e * d, beta) - meet(x[:3] - e * d, beta)) / 2 / e for d in np.eye(3)])
    w = J[:, 2:3] * 0 + ((meet(x[:3], beta + e) - meet(x[:3], beta - e)) / 2 / e)[:, None]
    return meet(x[:3], beta), J @ P[:3, :3] @ J.T + sigma**2 * w @ w.T, J @ P[:3]
""",
    ),
]
