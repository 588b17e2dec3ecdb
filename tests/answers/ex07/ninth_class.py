"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "07-two-updates",
        "information form: adds H' R^-1 H to the inverse of P, in units of the standard deviations",
        """
def two_updates(P, H_1, H_2, R):
    D = np.sqrt(np.diag(P))
    L = np.linalg.inv(np.linalg.cholesky(R))
    A_1, A_2 = L @ H_1 * D, L @ H_2 * D
    Y = np.linalg.inv(P / np.outer(D, D))
    Y_1 = Y + A_1.T @ A_1
    Y_2 = Y_1 + A_2.T @ A_2
    return np.linalg.inv(Y_1) * np.outer(D, D), np.linalg.inv(Y_2) * np.outer(D, D)
""",
    ),
    (
        "07-fuse",
        "generalised least squares of both estimates stacked, with the joint 4x4 covariance",
        """
def fuse(a, P_a, b, P_b, P_ab):
    joint = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    A = np.vstack([np.eye(2), np.eye(2)])
    W = np.linalg.inv(joint)
    P = np.linalg.inv(A.T @ W @ A)
    return P @ A.T @ W @ np.concatenate([a, b]), P
""",
    ),
]

WRONG = [
    (
        "07-two-updates",
        "second sighting starts from the first P again instead of P_first",
        """
def two_updates(P, H_1, H_2, R):
    out = []
    for H in (H_1, H_2):
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        out.append((np.eye(7) - K @ H) @ P)
    return tuple(out)
""",
    ),
    (
        "07-two-updates",
        "updates only robot and the landmark in sight: in the second update the first landmark learns nothing",
        """
def two_updates(P, H_1, H_2, R):
    def see(P, H, rows):
        part, h_ = P[np.ix_(rows, rows)], H[:, rows]
        S = h_ @ part @ h_.T + R
        K = part @ h_.T @ np.linalg.inv(S)
        new = P.copy()
        new[np.ix_(rows, rows)] = part - K @ S @ K.T
        return new
    first = see(P, H_1, [0, 1, 2, 3, 4])
    return first, see(first, H_2, [0, 1, 2, 5, 6])
""",
    ),
    (
        "07-two-updates",
        "S of the first sighting is used again for the gain of the second",
        """
def two_updates(P, H_1, H_2, R):
    S_inv = np.linalg.inv(H_1 @ P @ H_1.T + R)
    P_first = P - P @ H_1.T @ S_inv @ H_1 @ P
    P_both = P_first - P_first @ H_2.T @ S_inv @ H_2 @ P_first
    return P_first, P_both
""",
    ),
    (
        "07-two-updates",
        "only the variances of R are used, a full R is cut to its diagonal",
        """
def two_updates(P, H_1, H_2, R):
    results = []
    for H in (H_1, H_2):
        for row, r in zip(H, np.diag(R)):
            k = P @ row
            P = P - np.outer(k, k) / (row @ k + r)
        results.append(P)
    return results[0], results[1]
""",
    ),
    (
        "07-hearsay",
        "takes x_seen for a measurement of noise P_seen: what was known before counts twice",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    H = np.eye(len(x))[seen]
    S = H @ P @ H.T + P_seen
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (x_seen - H @ x), P - K @ S @ K.T
""",
    ),
    (
        "07-hearsay",
        "as if the seen entries were now known exactly: G P_seen G' is missing for the others",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = np.linalg.solve(P[np.ix_(seen, seen)], P[seen]).T
    new_x = x + G @ (x_seen - x[seen])
    new_P = P - G @ P[seen]
    new_P[np.ix_(seen, seen)] = P_seen
    return new_x, new_P
""",
    ),
    (
        "07-hearsay",
        "entries in sight are overwritten, the others and the blocks between stay as they were",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    x[seen] = x_seen
    for a, k in enumerate(seen):
        for b, l in enumerate(seen):
            P[k, l] = P_seen[a, b]
    return x, P
""",
    ),
    (
        "07-hearsay",
        "a boolean mask forgets the order of seen: entries not in ascending order are mixed up",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    mask = np.zeros(len(x), dtype=bool)
    mask[seen] = True
    G = P[:, mask] @ np.linalg.inv(P[mask][:, mask])
    return x + G @ (x_seen - x[mask]), P + G @ (P_seen - P[mask][:, mask]) @ G.T
""",
    ),
    (
        "07-hearsay",
        "others move rightly, but the blocks between them and those in sight keep their old values",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    rest = np.setdiff1d(np.arange(len(x)), seen)
    x, P = x.copy(), P.copy()
    P_ss, P_rs = P[np.ix_(seen, seen)], P[np.ix_(rest, seen)]
    G = P_rs @ np.linalg.inv(P_ss)
    x[rest] = x[rest] + G @ (x_seen - x[seen])
    x[seen] = x_seen
    P[np.ix_(rest, rest)] = P[np.ix_(rest, rest)] - G @ (P_ss - P_seen) @ G.T
    P[np.ix_(seen, seen)] = P_seen
    return x, P
""",
    ),
    (
        "07-fuse",
        "shared error ignored: weights by the two inverses as if independent",
        """
def fuse(a, P_a, b, P_b, P_ab):
    W_a, W_b = np.linalg.inv(P_a), np.linalg.inv(P_b)
    P = np.linalg.inv(W_a + W_b)
    return P @ (W_a @ a + W_b @ b), P
""",
    ),
    (
        "07-fuse",
        "S = P_a + P_b - 2 P_ab, without the transpose: only right when P_ab is symmetric",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - 2 * P_ab
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "gain with P_a alone: S_xv without the shared part",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a - P_ab - P_ab.T + P_b
    K = np.linalg.solve(S.T, P_a.T).T
    x = a + K @ (b - a)
    return x, P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "plus signs: S as for the sum of the two errors, not for their difference",
        """
def fuse(a, P_a, b, P_b, P_ab):
    J = np.hstack([np.eye(2), np.eye(2)])
    joint = np.vstack([np.hstack([P_a, P_ab]), np.hstack([P_ab.T, P_b])])
    S = J @ joint @ J.T
    K = (P_a + P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-corridor",
        "only robot and the door seen are corrected, other doors learn nothing",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    two = np.ix_([0, i], [0, i])
    h = np.array([-1.0, 1.0])
    s = h @ P[two] @ h + r
    k = P[two] @ h / s
    v = z - (x[i] - x[0])
    x[0] += k[0] * v
    x[i] += k[1] * v
    P[two] = P[two] - s * np.outer(k, k)
    return x, P
""",
    ),
    (
        "07-corridor",
        "S from the variances only: the covariance of robot and door is left out of it",
        """
def step(x, P, d, q, i, z, r):
    x, P = np.array(x, dtype=float), np.array(P, dtype=float)
    x[0] = x[0] + d
    P[0, 0] = P[0, 0] + q
    S = P[0, 0] + P[i, i] + r
    K = (P[:, i] - P[:, 0]) / S
    return x + K * (z - x[i] + x[0]), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "changes the state and covariance it was given",
        """
def step(x, P, d, q, i, z, r):
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    x += K * (z - (x[i] - x[0]))
    P -= np.outer(K, K) * S
    return x, P
""",
    ),
    (
        "07-corridor",
        "squares q and r as if they were standard deviations",
        """
def step(x, P, d, q, i, z, r):
    n = len(x)
    move, Q = np.zeros(n), np.zeros((n, n))
    move[0], Q[0, 0] = d, q**2
    x, P = x + move, P + Q
    H = np.zeros((1, n))
    H[0, 0], H[0, i] = -1, 1
    S = H @ P @ H.T + r**2
    K = P @ H.T / S
    return x + K[:, 0] * (z - x[i] + x[0]), P - K @ S @ K.T
""",
    ),
    (
        "07-corridor",
        "sees before it drives",
        """
def step(x, P, d, q, i, z, r):
    H = np.zeros(len(x))
    H[i] += 1
    H[0] -= 1
    S = H @ P @ H + r
    K = P @ H / S
    x = x + K * (z - H @ x)
    P = P - np.outer(K, H @ P)
    x[0] += d
    P[0, 0] += q
    return x, P
""",
    ),
    (
        "07-mornings",
        "the plain way: mean of each door's readings, sigma squared over their number",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    return np.bincount(door, weights=z) / n, np.diag(sigma**2 / n)
""",
    ),
    (
        "07-mornings",
        "size of the morning's error taken as 10 sigma once and never looked for",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    A = np.eye(m)[door]
    same = morning[:, None] == morning[None, :]
    V = sigma**2 * np.eye(len(z)) + (10 * sigma) ** 2 * same
    W = np.linalg.inv(V)
    P = np.linalg.inv(A.T @ W @ A)
    return P @ A.T @ W @ z, P
""",
    ),
    (
        "07-mornings",
        "plain means as the map; the mornings' variance is estimated and added, but P is diagonal: doors of one morning counted as independent",
        """
def survey(morning, door, z, sigma):
    p = np.bincount(door, z) / np.bincount(door)
    rest = z - p[door]
    off = np.bincount(morning, rest) / np.bincount(morning)
    big = np.var(off)
    n = np.bincount(door)
    return p, np.diag((sigma**2 + big) / n)
""",
    ),
    (
        "07-mornings",
        "mornings' errors free (no prior) with the first morning fixed at zero: the map is that of the first morning, and P does not say how far that was off",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    A = np.hstack([np.eye(m)[door], np.eye(n)[morning][:, 1:]])
    C = sigma**2 * np.linalg.inv(A.T @ A)
    state = C @ A.T @ z / sigma**2
    return state[:m], C[:m, :m]
""",
    ),
    (
        "07-hearsay",
        "finds the sighting behind it by subtracting informations, which needs the inverse of P_seen: fails when P_seen is 0",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    k = len(seen)
    H = np.zeros((k, len(x)))
    H[np.arange(k), seen] = 1
    old = np.linalg.inv(H @ P @ H.T)
    gained = np.linalg.inv(P_seen) - old
    info = np.linalg.inv(P) + H.T @ gained @ H
    new = np.linalg.inv(info)
    right = np.linalg.inv(P) @ x + H.T @ (np.linalg.inv(P_seen) @ x_seen - old @ x[seen])
    return new @ right, new
""",
    ),
    (
        "07-corridor",
        "sign: takes the door's distance for x_0 - x_i in the innovation, but not in H",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    e = np.eye(len(x))
    H = e[i] - e[0]
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - (x[0] - x[i])), P - np.outer(K, K) * S
""",
    ),
    (
        "07-mornings",
        "takes each morning's mean residual off its readings, then means and sigma squared over the number: shared doubt is not in P",
        """
def survey(morning, door, z, sigma):
    count = np.bincount(door)
    p = np.bincount(door, z) / count
    for _ in range(20):
        off = np.bincount(morning, z - p[door]) / np.bincount(morning)
        p = np.bincount(door, z - off[morning]) / count
    return p, np.diag(sigma**2 / count)
""",
    ),
]
