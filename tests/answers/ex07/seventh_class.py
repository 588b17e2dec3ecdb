"""A seventh class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "07-two-updates",
        "one number after the other, decorrelated by Cholesky",
        """
def two_updates(P, H_1, H_2, R):
    L = np.linalg.inv(np.linalg.cholesky(R))
    out = []
    for H in (L @ H_1, L @ H_2):
        for row in H:
            k = P @ row
            P = P - np.outer(k, k) / (row @ k + 1)
        out.append(P)
    return out[0], out[1]
""",
    ),
    (
        "07-corridor",
        "as the conditional of a joint normal",
        """
def step(x, P, d, q, i, z, r):
    n = len(x)
    x, P = x.astype(float), P.astype(float)
    x[0] += d
    P[0, 0] += q
    M = np.vstack([np.eye(n), np.eye(n)[i] - np.eye(n)[0]])
    joint = M @ P @ M.T
    joint[n, n] += r
    gain = joint[:n, n] / joint[n, n]
    return x + gain * (z - x[i] + x[0]), joint[:n, :n] - np.outer(gain, joint[n, :n])
""",
    ),
]

WRONG = [
    (
        "07-two-updates",
        "P_first is changed in place, so both come out as the last one",
        """
def two_updates(P, H_1, H_2, R):
    P = P.copy()
    results = []
    for H in (H_1, H_2):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        P -= K @ S @ K.T
        results.append(P)
    return tuple(results)
""",
    ),
    (
        "07-two-updates",
        "only the block of the robot and of the landmark seen",
        """
def two_updates(P, H_1, H_2, R):
    def see(P, H, rows):
        P = P.copy()
        small, H = P[np.ix_(rows, rows)], H[:, rows]
        S = H @ small @ H.T + R
        K = small @ H.T @ np.linalg.inv(S)
        P[np.ix_(rows, rows)] = (np.eye(5) - K @ H) @ small
        return P
    first = see(P, H_1, [0, 1, 2, 3, 4])
    return first, see(first, H_2, [0, 1, 2, 5, 6])
""",
    ),
    (
        "07-hearsay",
        "the measurement that must have been made, by differences of information, and pinv of P_seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    before = P[np.ix_(seen, seen)]
    gained = np.linalg.pinv(P_seen) - np.linalg.inv(before)
    L = np.linalg.inv(P)
    b = L @ x
    L[np.ix_(seen, seen)] += gained
    b[seen] += np.linalg.pinv(P_seen) @ x_seen - np.linalg.inv(before) @ x[seen]
    new = np.linalg.inv(L)
    return new @ b, new
""",
    ),
    (
        "07-hearsay",
        "by a mask, which forgets the order of seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    mask = np.zeros(len(x), dtype=bool)
    mask[seen] = True
    P_ss, P_os = P[mask][:, mask], P[~mask][:, mask]
    G = P_os @ np.linalg.inv(P_ss)
    x, Q = x.copy(), P.copy()
    x[~mask] += G @ (x_seen - x[mask])
    x[mask] = x_seen
    Q[np.ix_(mask, mask)] = P_seen
    Q[np.ix_(~mask, mask)] = G @ P_seen
    Q[np.ix_(mask, ~mask)] = P_seen @ G.T
    Q[np.ix_(~mask, ~mask)] += G @ (P_seen - P_ss) @ G.T
    return x, Q
""",
    ),
    (
        "07-fuse",
        "the mean, weighted by the traces",
        """
def fuse(a, P_a, b, P_b, P_ab):
    w = np.trace(P_a - P_ab) / np.trace(P_a + P_b - P_ab - P_ab.T)
    x = (1 - w) * a + w * b
    return x, (1 - w) ** 2 * P_a + w**2 * P_b + w * (1 - w) * (P_ab + P_ab.T)
""",
    ),
    (
        "07-corridor",
        "drive and sight at once, the sight expected from before the drive",
        """
def step(x, P, d, q, i, z, r):
    n = len(x)
    H = np.zeros(n)
    H[i], H[0] = 1, -1
    Q = np.zeros((n, n))
    Q[0, 0] = q
    P = P + Q
    S = H @ P @ H + r
    K = P @ H / S
    v = z - (x[i] - x[0])
    x = x + K * v
    x[0] = x[0] + d
    return x, P - np.outer(K, K) * S
""",
    ),
    (
        "07-corridor",
        "the door is set where it is seen, when it is less sure than the sight",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    if P[i, i] > P[0, 0] + r:
        x[i] = x[0] + z
        P[i] = P[0]
        P[:, i] = P[:, 0]
        P[i, i] = P[0, 0] + r
        return x, P
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - x[i] + x[0]), P - np.outer(K, H @ P)
""",
    ),
    (
        "07-mornings",
        "neighbours by their differences only, chained from the first door",
        """
def survey(morning, door, z, sigma):
    n = door.max() + 1
    rows, values = [], []
    for k in range(morning.max() + 1):
        here = np.flatnonzero(morning == k)
        for i, j in zip(here[:-1], here[1:]):
            row = np.zeros(n)
            row[door[j]], row[door[i]] = 1, -1
            rows.append(row)
            values.append(z[j] - z[i])
    first = np.zeros(n)
    first[0] = 1
    rows.append(first)
    values.append(z[door == 0].mean())
    A = np.array(rows)
    p, *_ = np.linalg.lstsq(A, np.array(values), rcond=None)
    return p, 2 * sigma**2 * np.linalg.inv(A.T @ A)
""",
    ),
]
