"""Independent answers to exercise 07 (stand-in for a class): right ones and wrong ones."""

RIGHT = [
    # ---------------------------------------------------------------- 1
    (
        "07-two-updates",
        "Joseph's form, gain by solve",
        """
def two_updates(P, H_1, H_2, R):
    results = []
    current = P
    for H in (H_1, H_2):
        S = H.dot(current).dot(H.T) + R
        K = np.linalg.solve(S.T, H.dot(current.T)).T
        A = np.eye(7) - K.dot(H)
        current = A.dot(current).dot(A.T) + K.dot(R).dot(K.T)
        results.append(current)
    return results[0], results[1]
""",
    ),
    (
        "07-two-updates",
        "information form",
        """
def two_updates(P, H_1, H_2, R):
    R_inv = np.linalg.inv(R)
    info = np.linalg.inv(P)
    info_first = info + H_1.T @ R_inv @ H_1
    info_both = info_first + H_2.T @ R_inv @ H_2
    return np.linalg.inv(info_first), np.linalg.inv(info_both)
""",
    ),
    (
        "07-two-updates",
        "both sights in one stacked update",
        """
def two_updates(P, H_1, H_2, R):
    def without(H, noise):
        PHt = P @ H.T
        return P - PHt @ np.linalg.solve(H @ PHt + noise, PHt.T)

    zero = np.zeros((2, 2))
    return without(H_1, R), without(np.vstack([H_1, H_2]), np.block([[R, zero], [zero, R]]))
""",
    ),
    (
        "07-two-updates",
        "R whitened, one row at a time",
        """
def two_updates(P, H_1, H_2, R):
    L = np.linalg.cholesky(R)

    def see(C, H):
        C = C.copy()
        for h in np.linalg.solve(L, H):      # rows with independent noise of variance 1
            u = C @ h
            C -= np.outer(u, u) / (h @ u + 1.0)
        return C

    one = see(P, H_1)
    return one, see(one, H_2)
""",
    ),
    # ---------------------------------------------------------------- 2
    (
        "07-hearsay",
        "rest + G P_seen G'",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    seen = np.asarray(seen)
    P_ss = P[seen][:, seen]
    G = np.linalg.solve(P_ss, P[seen]).T
    rest = P - G @ P_ss @ G.T
    P_new = rest + G @ P_seen @ G.T
    return x + G @ (x_seen - x[seen]), (P_new + P_new.T) / 2
""",
    ),
    (
        "07-hearsay",
        "block by block with the others listed",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    n = len(x)
    others = [j for j in range(n) if j not in list(seen)]
    x_new = np.array(x, dtype=float)
    P_new = np.array(P, dtype=float)
    x_new[seen] = x_seen
    P_new[np.ix_(seen, seen)] = P_seen
    if len(others) > 0:
        P_ss = P[np.ix_(seen, seen)]
        P_os = P[np.ix_(others, seen)]
        G = P_os @ np.linalg.inv(P_ss)
        x_new[others] = x[others] + G @ (x_seen - x[seen])
        P_new[np.ix_(others, seen)] = G @ P_seen
        P_new[np.ix_(seen, others)] = (G @ P_seen).T
        P_new[np.ix_(others, others)] = P[np.ix_(others, others)] - G @ P_os.T + G @ P_seen @ G.T
    return x_new, P_new
""",
    ),
    # ---------------------------------------------------------------- 3
    (
        "07-fuse",
        "weighted least squares on the stacked pair",
        """
def fuse(a, P_a, b, P_b, P_ab):
    joint = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    A = np.vstack([np.eye(2), np.eye(2)])
    N = A.T @ np.linalg.solve(joint, A)
    P = np.linalg.inv(N)
    return P @ A.T @ np.linalg.solve(joint, np.concatenate([a, b])), P
""",
    ),
    (
        "07-fuse",
        "weights of a and b, covariance by propagation",
        """
def fuse(a, P_a, b, P_b, P_ab):
    D = P_a + P_b - (P_ab + P_ab.T)
    W_b = np.linalg.solve(D.T, (P_a - P_ab).T).T
    W_a = np.eye(2) - W_b
    x = W_a @ a + W_b @ b
    cross = W_a @ P_ab @ W_b.T
    P = W_a @ P_a @ W_a.T + W_b @ P_b @ W_b.T + cross + cross.T
    return x, P
""",
    ),
    # ---------------------------------------------------------------- 4
    (
        "07-corridor",
        "text-book matrices and Joseph's form",
        """
def step(x, P, d, q, i, z, r):
    n = x.size
    u = np.zeros(n)
    u[0] = d
    Q = np.zeros((n, n))
    Q[0, 0] = q
    x_bar, P_bar = x + u, P + Q
    H = np.zeros((1, n))
    H[0, 0] = -1.0
    H[0, i] = 1.0
    S = H @ P_bar @ H.T + r
    K = P_bar @ H.T / S
    A = np.eye(n) - K @ H
    return x_bar + K[:, 0] * (z - (x_bar[i] - x_bar[0])), A @ P_bar @ A.T + r * K @ K.T
""",
    ),
    (
        "07-corridor",
        "columns of P, loops",
        """
def step(x, P, d, q, i, z, r):
    n = len(x)
    new_x = [float(v) for v in x]
    new_x[0] += d
    C = [[float(P[a, b]) for b in range(n)] for a in range(n)]
    C[0][0] += q
    col = [C[a][i] - C[a][0] for a in range(n)]
    S = col[i] - col[0] + r
    nu = z - (new_x[i] - new_x[0])
    for a in range(n):
        new_x[a] += col[a] / S * nu
        for b in range(n):
            C[a][b] -= col[a] * col[b] / S
    return np.array(new_x), np.array(C)
""",
    ),
    # ---------------------------------------------------------------- 5
    (
        "07-mornings",
        "restricted likelihood on a grid of sizes",
        """
def survey(morning, door, z, sigma):
    A = np.eye(door.max() + 1)[door]
    same = (morning[:, None] == morning[None, :]).astype(float)
    best = None
    for size in sigma * np.geomspace(0.5, 20, 60):
        V = sigma**2 * np.eye(len(z)) + size**2 * same
        V_inv = np.linalg.inv(V)
        N = A.T @ V_inv @ A
        P = np.linalg.inv(N)
        p = P @ A.T @ V_inv @ z
        e = z - A @ p
        cost = np.linalg.slogdet(V)[1] + np.linalg.slogdet(N)[1] + e @ V_inv @ e
        if best is None or cost < best[0]:
            best = cost, p, P
    return best[1], best[2]
""",
    ),
    (
        "07-mornings",
        "average over the grid of sizes, by their likelihood",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    A, B = np.eye(m)[door], np.eye(n)[morning]
    logs, means, covs = [], [], []
    for size in sigma * np.geomspace(0.5, 20, 50):
        V = sigma**2 * np.eye(len(z)) + size**2 * B @ B.T
        N = A.T @ np.linalg.solve(V, A)
        P = np.linalg.inv(N)
        p = P @ (A.T @ np.linalg.solve(V, z))
        e = z - A @ p
        logs.append(-0.5 * (np.linalg.slogdet(V)[1] + np.linalg.slogdet(N)[1] + e @ np.linalg.solve(V, e)))
        means.append(p)
        covs.append(P)
    w = np.exp(np.array(logs) - max(logs))
    w /= w.sum()
    means = np.array(means)
    p = w @ means
    P = np.einsum("g,gij->ij", w, np.array(covs))
    spread = means - p
    return p, P + np.einsum("g,gi,gj->ij", w, spread, spread)
""",
    ),
]

WRONG = [
    # ================================================================ 1 two_updates
    (
        "07-two-updates",
        "second update starts from P again (stale)",
        """
def two_updates(P, H_1, H_2, R):
    out = []
    for H in [H_1, H_2]:
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        out.append((np.eye(len(P)) - K @ H) @ P)
    return tuple(out)
""",
    ),
    (
        "07-two-updates",
        "W S^-1 W' as the thesis prints it",
        """
def two_updates(P, H_1, H_2, R):
    S_1 = H_1 @ P @ H_1.T + R
    W_1 = P @ H_1.T @ np.linalg.inv(S_1)
    P_first = P - W_1 @ np.linalg.inv(S_1) @ W_1.T
    S_2 = H_2 @ P_first @ H_2.T + R
    W_2 = P_first @ H_2.T @ np.linalg.inv(S_2)
    return P_first, P_first - W_2 @ np.linalg.inv(S_2) @ W_2.T
""",
    ),
    (
        "07-two-updates",
        "only R's diagonal is used",
        """
def two_updates(P, H_1, H_2, R):
    covs = []
    for H in (H_1, H_2):
        P = P.copy()
        for row in range(2):
            h = H[row]
            s = h @ P @ h + R[row, row]
            k = P @ h / s
            P = P - np.outer(k, h @ P)
        covs.append(P)
    return covs[0], covs[1]
""",
    ),
    (
        "07-two-updates",
        "takes R for standard deviations and squares it",
        """
def two_updates(P, H_1, H_2, R):
    Rn = R @ R.T
    def upd(C, H):
        PHt = C @ H.T
        return C - PhT_term(PHt, H @ PHt + Rn)
    def PhT_term(A, S):
        return A @ np.linalg.solve(S, A.T)
    first = upd(P, H_1)
    return first, upd(first, H_2)
""",
    ),
    (
        "07-two-updates",
        "block formulas of the lesson that assume a block-diagonal start",
        """
def two_updates(P, H_1, H_2, R):
    r, a, b = slice(0, 3), slice(3, 5), slice(5, 7)
    Prr, P11, P22 = P[r, r], P[a, a], P[b, b]
    Hr, Hp = H_1[:, r], H_1[:, a]
    S = Hr @ Prr @ Hr.T + Hp @ P11 @ Hp.T + R
    Si = np.linalg.inv(S)
    F = np.zeros((7, 7))
    F[r, r] = Prr - Prr @ Hr.T @ Si @ Hr @ Prr
    F[r, a] = -Prr @ Hr.T @ Si @ Hp @ P11
    F[a, r] = F[r, a].T
    F[a, a] = P11 - P11 @ Hp.T @ Si @ Hp @ P11
    F[b, b] = P22
    S2 = H_2 @ F @ H_2.T + R
    K2 = F @ H_2.T @ np.linalg.inv(S2)
    return F, F - K2 @ S2 @ K2.T
""",
    ),
    (
        "07-two-updates",
        "p1 is left alone in the second update: not in sight",
        """
def two_updates(P, H_1, H_2, R):
    S = H_1 @ P @ H_1.T + R
    K = P @ H_1.T @ np.linalg.inv(S)
    first = P - K @ S @ K.T
    S = H_2 @ first @ H_2.T + R
    K = first @ H_2.T @ np.linalg.inv(S)
    K[3:5] = 0
    return first, first - K @ S @ K.T
""",
    ),
    (
        "07-two-updates",
        "updates P in place; both results are the same array",
        """
def two_updates(P, H_1, H_2, R):
    def update(H):
        nonlocal P
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        P -= K @ S @ K.T
        return P

    P_first = update(H_1)
    P_both = update(H_2)
    return P_first, P_both
""",
    ),
    (
        "07-two-updates",
        "forgets P behind (I - K H): P - K H",
        """
def two_updates(P, H_1, H_2, R):
    K1 = P @ H_1.T @ np.linalg.inv(H_1 @ P @ H_1.T + R)
    P1 = P - K1 @ H_1
    K2 = P1 @ H_2.T @ np.linalg.inv(H_2 @ P1 @ H_2.T + R)
    P2 = P1 - K2 @ H_2
    return P1, P2
""",
    ),
    (
        "07-two-updates",
        "stacked update: the two noises taken as one and the same",
        """
def two_updates(P, H_1, H_2, R):
    def update(H, R_all):
        S = H @ P @ H.T + R_all
        return P - P @ H.T @ np.linalg.inv(S) @ H @ P
    H_12 = np.concatenate([H_1, H_2])
    return update(H_1, R), update(H_12, np.tile(R, (2, 2)) + 1e-9 * np.eye(4))
""",
    ),
    (
        "07-two-updates",
        "Joseph's form without K R K'",
        """
def two_updates(P, H_1, H_2, R):
    I = np.eye(P.shape[0])
    def joseph(P, H):
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        return (I - K @ H) @ P @ (I - K @ H).T
    a = joseph(P, H_1)
    b = joseph(a, H_2)
    return a, b
""",
    ),
    (
        "07-two-updates",
        "information form with R instead of its inverse",
        """
def two_updates(P, H_1, H_2, R):
    Y = np.linalg.inv(P)
    Y1 = Y + H_1.T @ R @ H_1
    Y2 = Y1 + H_2.T @ R @ H_2
    return np.linalg.inv(Y1), np.linalg.inv(Y2)
""",
    ),
    (
        "07-two-updates",
        "robot did not move, so the first H_r is used for p2 as well",
        """
def two_updates(P, H_1, H_2, R):
    H_r = H_1[:, :3]
    H_p2 = H_2[:, 5:]
    H2 = np.hstack([H_r, np.zeros((2, 2)), H_p2])
    P_now, all_P = P, []
    for H in (H_1, H2):
        S = H @ P_now @ H.T + R
        K = P_now @ H.T @ np.linalg.inv(S)
        P_now = P_now - K @ H @ P_now
        all_P.append(P_now)
    return all_P[0], all_P[1]
""",
    ),
    (
        "07-two-updates",
        "noise added only once: second S lacks R",
        """
def two_updates(P, H_1, H_2, R):
    S1 = H_1 @ P @ H_1.T + R
    K1 = P @ H_1.T @ np.linalg.inv(S1)
    P1 = P - K1 @ S1 @ K1.T
    S2 = H_2 @ P1 @ H_2.T
    K2 = P1 @ H_2.T @ np.linalg.inv(S2)
    return P1, P1 - K2 @ S2 @ K2.T
""",
    ),
    (
        "07-two-updates",
        "tiny entries 'cleaned' to zero",
        """
def two_updates(P, H_1, H_2, R):
    def update(P, H):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        P_new = P - K @ S @ K.T
        P_new[np.abs(P_new) < 1e-4] = 0.0     # numerical noise
        return P_new
    P_first = update(P, H_1)
    return P_first, update(P_first, H_2)
""",
    ),
    # ================================================================ 2 hearsay
    (
        "07-hearsay",
        "only the seen entries are written, nobody else learns",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    x[seen] = x_seen
    P[np.ix_(seen, seen)] = P_seen
    return x, P
""",
    ),
    (
        "07-hearsay",
        "P_seen forgotten: as if the entries were known exactly",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = P[:, seen] @ np.linalg.inv(P[np.ix_(seen, seen)])
    x_new = x + G @ (x_seen - x[seen])
    P_new = P - G @ P[seen, :]
    P_new[np.ix_(seen, seen)] = P_seen
    return x_new, P_new
""",
    ),
    (
        "07-hearsay",
        "what was told is taken for an independent measurement",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    H = np.eye(len(x))[seen]
    S = H @ P @ H.T + P_seen
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (x_seen - H @ x), (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
        "07-hearsay",
        "P[seen, seen]: only the diagonal of the seen block",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    P_ss = np.diag(P[seen, seen])
    G = P[:, seen] @ np.linalg.inv(P_ss)
    return x + G @ (x_seen - x[seen]), P - G @ (P_ss - P_seen) @ G.T
""",
    ),
    (
        "07-hearsay",
        "boolean mask loses the order of seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    mask = np.zeros(len(x), dtype=bool)
    mask[seen] = True
    Pss, Pos = P[mask][:, mask], P[~mask][:, mask]
    Poo = P[~mask][:, ~mask]
    G = Pos @ np.linalg.inv(Pss)
    dx = x_seen - x[mask]
    x_new = np.empty(len(x))
    x_new[mask] = x_seen
    x_new[~mask] = x[~mask] + G @ dx
    P_new = np.empty_like(P)
    P_new[np.ix_(mask, mask)] = P_seen
    P_new[np.ix_(~mask, mask)] = G @ P_seen
    P_new[np.ix_(mask, ~mask)] = P_seen @ G.T
    P_new[np.ix_(~mask, ~mask)] = Poo - G @ (Pss - P_seen) @ G.T
    return x_new, P_new
""",
    ),
    (
        "07-hearsay",
        "assumes that the entries in sight come first",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    k = len(seen)
    P_ss, P_sk, P_kk = P[:k, :k], P[:k, k:], P[k:, k:]
    G = P_sk.T @ np.linalg.inv(P_ss)
    x_k = x[k:] + G @ (x_seen - x[:k])
    P_k = P_kk - G @ (P_ss - P_seen) @ G.T
    return (np.concatenate([x_seen, x_k]),
            np.block([[P_seen, P_seen @ G.T], [G @ P_seen, P_k]]))
""",
    ),
    (
        "07-hearsay",
        "cross block between seen and unseen left as it was",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    rest = np.setdiff1d(np.arange(x.size), seen)
    Pss = P[np.ix_(seen, seen)]
    G = P[np.ix_(rest, seen)] @ np.linalg.inv(Pss)
    xn, Pn = x.astype(float).copy(), P.copy()
    xn[rest] += G @ (x_seen - x[seen])
    xn[seen] = x_seen
    Pn[np.ix_(seen, seen)] = P_seen
    Pn[np.ix_(rest, rest)] -= G @ (Pss - P_seen) @ G.T
    return xn, Pn
""",
    ),
    (
        "07-hearsay",
        "x overwritten before the difference is taken (nothing reaches the others)",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    x_new = x.copy()
    x_new[seen] = x_seen
    P_ss = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(P_ss)
    x_new = x_new + G @ (x_seen - x_new[seen])
    return x_new, P - G @ (P_ss - P_seen) @ G.T
""",
    ),
    (
        "07-hearsay",
        "right values, but x and P of the caller are changed in place",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    P_ss = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(P_ss)
    x += G @ (x_seen - x[seen])
    P -= G @ (P_ss - P_seen) @ G.T
    return x, P
""",
    ),
    (
        "07-hearsay",
        "all in sight: returned in the order of seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    if len(seen) == len(x):
        return x_seen.copy(), P_seen.copy()
    P_ss = P[np.ix_(seen, seen)]
    G = np.linalg.solve(P_ss, P[seen, :]).T
    return x + G @ (x_seen - x[seen]), P + G @ (P_seen - P_ss) @ G.T
""",
    ),
    (
        "07-hearsay",
        "information form: breaks down at P_seen = 0",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    Y, P_ss = np.linalg.inv(P), P[np.ix_(seen, seen)]
    y = Y @ x
    Y_told, Y_old = np.linalg.inv(P_seen), np.linalg.inv(P_ss)
    Y_new = Y.copy()
    Y_new[np.ix_(seen, seen)] += Y_told - Y_old
    y[seen] += Y_told @ x_seen - Y_old @ x[seen]
    P_new = np.linalg.inv(Y_new)
    return P_new @ y, P_new
""",
    ),
    (
        "07-hearsay",
        "gain from the new P_seen (pinv) instead of the old block",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = P[:, seen] @ np.linalg.pinv(P_seen)
    dP = P[np.ix_(seen, seen)] - P_seen
    return x + G @ (x_seen - x[seen]), P - G @ dP @ G.T
""",
    ),
    (
        "07-hearsay",
        "each other entry follows only the seen entry it is most correlated with",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    n = len(x)
    G = np.zeros((n, len(seen)))
    rho = correlation(P)
    for j in range(n):
        best = int(np.argmax(abs(rho[j, seen])))
        G[j, best] = P[j, seen[best]] / P[seen[best], seen[best]]
    P_ss = P[np.ix_(seen, seen)]
    return x + G @ (x_seen - x[seen]), P - G @ (P_ss - P_seen) @ G.T
""",
    ),
    (
        "07-hearsay",
        "P_seen subtracted from the rest: sign",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    S = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(S)
    rest = P - G @ S @ G.T
    return x + G @ (x_seen - x[seen]), rest - G @ P_seen @ G.T
""",
    ),
    (
        "07-hearsay",
        "difference wrapped as if it were an angle",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    from slamlab.geometry import wrap
    P_ss = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(P_ss)
    nu = wrap(x_seen - x[seen])
    return x + G @ nu, P - G @ (P_ss - P_seen) @ G.T
""",
    ),
    (
        "07-hearsay",
        "only variances of the others updated, what they share among themselves stale",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    others = np.array([j for j in range(len(x)) if j not in set(seen.tolist())], dtype=int)
    A = np.linalg.inv(P[np.ix_(seen, seen)])
    new_x, new_P = x.copy(), P.copy()
    new_x[seen], new_P[np.ix_(seen, seen)] = x_seen, P_seen
    for j in others:
        g = P[j, seen] @ A
        new_x[j] = x[j] + g @ (x_seen - x[seen])
        new_P[j, seen] = new_P[seen, j] = g @ P_seen
        # variance only; what the others share among themselves stays
        new_P[j, j] = P[j, j] - g @ (P[np.ix_(seen, seen)] - P_seen) @ g
    return new_x, new_P
""",
    ),
    # ================================================================ 3 fuse
    (
        "07-fuse",
        "P_ab ignored (information filter)",
        """
def fuse(a, P_a, b, P_b, P_ab):
    Y_a, Y_b = np.linalg.inv(P_a), np.linalg.inv(P_b)
    P = np.linalg.inv(Y_a + Y_b)
    return P @ (Y_a @ a + Y_b @ b), P
""",
    ),
    (
        "07-fuse",
        "2 P_ab instead of P_ab + P_ab'",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - 2 * P_ab
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "P_ab transposed in the gain",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a - P_ab - P_ab.T + P_b
    S_xv = P_a - P_ab.T
    K = np.linalg.solve(S, S_xv.T).T
    return a + K @ (b - a), P_a - S_xv @ np.linalg.solve(S, S_xv.T)
""",
    ),
    (
        "07-fuse",
        "shared error adds to S",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b + P_ab + P_ab.T
    K = (P_a + P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "gain P_a S^-1 although the innovation shares b's error",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = P_a @ np.linalg.inv(S)
    P = P_a - K @ S @ K.T
    return a + K @ (b - a), (P + P.T) / 2
""",
    ),
    (
        "07-fuse",
        "covariance (I - K) P_a, true only if nothing is shared",
        """
def fuse(a, P_a, b, P_b, P_ab):
    innovation = b - a
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ innovation, (np.eye(2) - K) @ P_a
""",
    ),
    (
        "07-fuse",
        "covariance intersection: careful, but not the best",
        """
def fuse(a, P_a, b, P_b, P_ab):
    A, B = np.linalg.inv(P_a), np.linalg.inv(P_b)
    best = None
    for w in np.linspace(0, 1, 101):
        P = np.linalg.inv(w * A + (1 - w) * B)
        if best is None or np.trace(P) < np.trace(best[1]):
            best = P @ (w * A @ a + (1 - w) * B @ b), P
    return best
""",
    ),
    (
        "07-fuse",
        "common part taken off and put back: needs P_ab symmetric",
        """
def fuse(a, P_a, b, P_b, P_ab):
    common = (P_ab + P_ab.T) / 2
    U, V = P_a - common, P_b - common
    K = U @ np.linalg.inv(U + V)
    return a + K @ (b - a), common + U - K @ U
""",
    ),
    (
        "07-fuse",
        "x and y fused one by one, off-diagonals ignored",
        """
def fuse(a, P_a, b, P_b, P_ab):
    x, P = np.zeros(2), np.zeros((2, 2))
    for j in range(2):
        s = P_a[j, j] + P_b[j, j] - 2 * P_ab[j, j]
        k = (P_a[j, j] - P_ab[j, j]) / s
        x[j] = a[j] + k * (b[j] - a[j])
        P[j, j] = P_a[j, j] - k * s * k
    return x, P
""",
    ),
    (
        "07-fuse",
        "innovation the wrong way round",
        """
def fuse(a, P_a, b, P_b, P_ab):
    v = a - b
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ v, P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "plain mean with its honest covariance",
        """
def fuse(a, P_a, b, P_b, P_ab):
    return (a + b) / 2, (P_a + P_b + P_ab + P_ab.T) / 4
""",
    ),
    (
        "07-fuse",
        "gain clipped to 0..1: an estimate must lie between a and b",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = np.clip((P_a - P_ab) @ np.linalg.inv(S), 0, 1)
    I = np.eye(2)
    P = (I-K) @ P_a @ (I-K).T + K @ P_b @ K.T + (I-K) @ P_ab @ K.T + K @ P_ab.T @ (I-K).T
    return a + K @ (b - a), P
""",
    ),
    (
        "07-fuse",
        "joint matrix with P_ab in both corners, not transposed",
        """
def fuse(a, P_a, b, P_b, P_ab):
    C = np.vstack([np.hstack([P_a, P_ab]), np.hstack([P_ab, P_b])])
    W = np.linalg.inv(C)
    A = np.tile(np.eye(2), (2, 1))
    P = np.linalg.inv(A.T @ W @ A)
    return P @ A.T @ W @ np.hstack([a, b]), P
""",
    ),
    (
        "07-fuse",
        "returns the information matrix, not the covariance",
        """
def fuse(a, P_a, b, P_b, P_ab):
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    A = np.vstack([np.eye(2)] * 2)
    Y = A.T @ W @ A
    return np.linalg.solve(Y, A.T @ W @ np.r_[a, b]), Y
""",
    ),
    (
        "07-fuse",
        "changes P_a in place",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    P_a -= K @ S @ K.T
    return a + K @ (b - a), P_a
""",
    ),
    (
        "07-fuse",
        "errors in opposite directions treated as sharing nothing",
        """
def fuse(a, P_a, b, P_b, P_ab):
    if np.trace(P_ab) < 0:
        P_ab = np.zeros((2, 2))
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "best x, but the P of the filter without P_ab",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    x = a + (P_a - P_ab) @ np.linalg.solve(S, b - a)
    P = np.linalg.inv(np.linalg.inv(P_a) + np.linalg.inv(P_b))
    return x, P
""",
    ),
    (
        "07-fuse",
        "scalar weights from the traces",
        """
def fuse(a, P_a, b, P_b, P_ab):
    t_a, t_b, t_ab = np.trace(P_a), np.trace(P_b), np.trace(P_ab)
    k = (t_a - t_ab) / (t_a + t_b - 2 * t_ab)
    P = (1 - k)**2 * P_a + k**2 * P_b + k * (1 - k) * (P_ab + P_ab.T)
    return (1 - k) * a + k * b, P
""",
    ),
    # ================================================================ 4 corridor
    (
        "07-corridor",
        "sign of H against that of the innovation",
        """
def step(x, P, d, q, i, z, r):
    x = x.copy(); P = P.copy()
    x[0] = x[0] + d
    P[0, 0] = P[0, 0] + q
    h = np.zeros(len(x)); h[0] = 1; h[i] = -1
    s = h @ P @ h + r
    k = P @ h / s
    nu = z - (x[i] - x[0])
    return x + k * nu, P - np.outer(k, k) * s
""",
    ),
    (
        "07-corridor",
        "only robot and seen door are updated, the others' correlations kept stale",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    idx = [0, i]
    sub = P[np.ix_(idx, idx)]
    h = np.array([-1.0, 1.0])
    s = h @ sub @ h + r
    k = sub @ h / s
    x[idx] += k * (z - x[i] + x[0])
    P[np.ix_(idx, idx)] = sub - s * np.outer(k, k)
    return x, P
""",
    ),
    (
        "07-corridor",
        "forgets the correlations: diagonal only",
        """
def step(x, P, d, q, i, z, r):
    v = np.diag(P).copy()
    v[0] += q
    y = x.copy()
    y[0] += d
    s = v[0] + v[i] + r
    nu = z - (y[i] - y[0])
    k0, ki = -v[0] / s, v[i] / s
    y[0] += k0 * nu
    y[i] += ki * nu
    v[0] -= k0 * k0 * s
    v[i] -= ki * ki * s
    return y, np.diag(v)
""",
    ),
    (
        "07-corridor",
        "S without the -2 P_0i",
        """
def step(x, P, d, q, i, z, r):
    F = P.copy()
    F[0, 0] += q
    y = x.copy()
    y[0] += d
    S = F[0, 0] + F[i, i] + r
    K = (F[:, i] - F[:, 0]) / S
    return y + K * (z - y[i] + y[0]), F - np.outer(K, K) * S
""",
    ),
    (
        "07-corridor",
        "r taken for a standard deviation",
        """
def step(x, P, d, q, i, z, r):
    n = len(x)
    H = np.zeros((1, n)); H[0, [0, i]] = -1, 1
    x1 = x + d * np.eye(n)[0]
    P1 = P + q * np.outer(np.eye(n)[0], np.eye(n)[0])
    S = H @ P1 @ H.T + r**2
    K = P1 @ H.T @ np.linalg.inv(S)
    return x1 + (K @ (z - H @ x1)), (np.eye(n) - K @ H) @ P1
""",
    ),
    (
        "07-corridor",
        "q taken for a standard deviation",
        """
def step(x, P, d, q, i, z, r):
    x, P = np.array(x, float), np.array(P, float)
    x[0] += d
    P[0, 0] += q**2
    c = P[:, i] - P[:, 0]
    S = c[i] - c[0] + r
    return x + c / S * (z - x[i] + x[0]), P - np.outer(c, c) / S
""",
    ),
    (
        "07-corridor",
        "the drive is added after the sight",
        """
def step(x, P, d, q, i, z, r):
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    x = x + K * (z - H @ x)
    P = P - np.outer(K, K) * S
    x[0] += d
    P[0, 0] += q
    return x, P
""",
    ),
    (
        "07-corridor",
        "the caller's x and P are driven in place",
        """
def step(x, P, d, q, i, z, r):
    x[0] += d
    P[0, 0] += q
    H = np.zeros(x.size)
    H[0], H[i] = -1, 1
    K = P @ H / (H @ P @ H + r)
    return x + K * (z - x[i] + x[0]), P - np.outer(K, H @ P)
""",
    ),
    (
        "07-corridor",
        "hard-coded for three doors",
        """
def step(x, P, d, q, i, z, r):
    Q = np.diag([q, 0, 0, 0])
    H = np.array([-1, 0, 0, 0])
    H[i] = 1
    x = x + np.array([d, 0, 0, 0])
    P = P + Q
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - np.outer(K, K) * S
""",
    ),
    (
        "07-corridor",
        "distance taken as positive always",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x))
    sign = 1 if x[i] >= x[0] else -1
    H[0], H[i] = -sign, sign
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - abs(x[i] - x[0])), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "doors numbered from 0: entry i + 1",
        """
def step(x, P, d, q, i, z, r):
    j = (i + 1) if i + 1 < len(x) else i
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    col = P[:, j] - P[:, 0]
    S = col[j] - col[0] + r
    K = col / S
    return x + K * (z - (x[j] - x[0])), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "no drive, no noise: q skipped where d is 0",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    if d:
        x[0] += d
        P[0, 0] += q
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "only the robot is corrected, doors count as fixed marks",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    k = P[0, 0] / (P[0, 0] + r)
    x[0] += k * ((x[i] - z) - x[0])
    P[0, :] *= 1 - k
    P[:, 0] *= 1 - k
    P[0, 0] /= 1 - k
    return x, P
""",
    ),
    (
        "07-corridor",
        "a door that shares nothing yet is set anew, its prior thrown away",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    if np.all(P[i, np.arange(len(x)) != i] == 0):      # first time in sight
        x[i] = x[0] + z
        P[i, :] = P[0, :]
        P[:, i] = P[:, 0]
        P[i, i] = P[0, 0] + r
        return x, P
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "information form: a variance of 0 cannot be inverted",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    Y = np.linalg.inv(P)
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    P_new = np.linalg.inv(Y + np.outer(H, H) / r)
    return P_new @ (Y @ x + H * z / r), P_new
""",
    ),
    (
        "07-corridor",
        "the drive carries the doors along",
        """
def step(x, P, d, q, i, z, r):
    x = x + d
    P = P + q
    H = np.zeros(len(x))
    H[0], H[i] = -1.0, 1.0
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - np.outer(K, H @ P)
""",
    ),
    # ================================================================ 5 mornings
    (
        "07-mornings",
        "the plain way: mean and sigma^2 / count",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    return np.bincount(door, z) / n, np.diag(sigma**2 / n)
""",
    ),
    (
        "07-mornings",
        "size of the shared error fixed at 10 sigma",
        """
def survey(morning, door, z, sigma):
    A = np.eye(door.max() + 1)[door]
    V = sigma**2 * (np.eye(len(z)) + 100.0 * (morning[:, None] == morning))
    W = np.linalg.inv(V)
    P = np.linalg.inv(A.T @ W @ A)
    return P @ A.T @ W @ z, P
""",
    ),
    (
        "07-mornings",
        "size of the shared error fixed at sigma",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    prior = np.diag(np.r_[np.zeros(m), np.ones(n)]) / sigma**2
    C = np.linalg.inv(J.T @ J / sigma**2 + prior)
    return (C @ J.T @ z / sigma**2)[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "mornings' errors free but summing to zero: absolute place too sure",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.zeros((len(z) + 1, m + n))
    J[np.arange(len(z)), door] = 1
    J[np.arange(len(z)), m + morning] = 1
    J[-1, m:] = 1
    N = np.linalg.inv(J.T @ J)
    state = N @ J.T @ np.append(z, 0)
    return state[:m], sigma**2 * N[:m, :m]
""",
    ),
    (
        "07-mornings",
        "first morning taken as exact",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning][:, 1:]])
    C = np.linalg.inv(J.T @ J)
    return (C @ J.T @ z)[:m], sigma**2 * C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "good p, but P cut down to its diagonal",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    size = 10 * sigma
    for _ in range(10):
        C = np.linalg.inv(J.T @ J / sigma**2 + np.diag([0.0] * m + [size**-2] * n))
        s = C @ J.T @ z / sigma**2
        size = np.sqrt(np.mean(s[m:] ** 2 + np.diag(C)[m:]))
    return s[:m], np.diag(np.diag(C)[:m])
""",
    ),
    (
        "07-mornings",
        "shared error taken as more noise of each reading",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    p = np.bincount(door, z) / n
    rest = z - p[door]
    free = max(len(z) - len(n), 1)
    total = max(np.sum(rest**2) / free, sigma**2)
    return p, np.diag(total / n)
""",
    ),
    (
        "07-mornings",
        "size from the estimated errors alone, their doubt forgotten: it shrinks",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    var = (3 * sigma) ** 2
    for _ in range(30):
        Y = J.T @ J / sigma**2
        Y[m:, m:] += np.eye(n) / var
        C = np.linalg.inv(Y)
        s = C @ (J.T @ z) / sigma**2
        var = max(np.mean(s[m:] ** 2), 1e-6 * sigma**2)
    return s[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "mornings aligned one after the other to the map so far, sigma^2 / count",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    total, count = np.zeros(m), np.zeros(m)
    waiting = list(range(morning.max() + 1))
    k = waiting.pop(0)
    sel = morning == k
    total[door[sel]] += z[sel]
    count[door[sel]] += 1
    while waiting:
        k = next(w for w in waiting if np.any(count[door[morning == w]] > 0))
        waiting.remove(k)
        sel = morning == k
        dd, zz = door[sel], z[sel]
        known = count[dd] > 0
        off = np.mean(zz[known] - total[dd[known]] / count[dd[known]])
        total[dd] += zz - off
        count[dd] += 1
    return total / count, np.diag(sigma**2 / count)
""",
    ),
    (
        "07-mornings",
        "sigma taken for a variance",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    v = 100 * sigma
    for _ in range(8):
        C = np.linalg.inv(J.T @ J / sigma + np.diag(np.r_[np.zeros(m), np.full(n, 1 / v)]))
        s = C @ J.T @ z / sigma
        v = np.mean(s[m:] ** 2 + np.diag(C)[m:])
    return s[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "the doors get a prior at 0 as well",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    size = 10 * sigma
    for _ in range(8):
        C = np.linalg.inv(J.T @ J / sigma**2 + np.eye(m + n) / size**2)
        state = C @ J.T @ z / sigma**2
        size = np.sqrt(np.mean(state[m:] ** 2 + np.diag(C)[m:]))
    return state[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "works for the example only: 3 readings each morning, 8 doors",
        """
def survey(morning, door, z, sigma):
    A = np.eye(8)[door]
    best = (np.inf,)
    for size in np.geomspace(0.5, 20, 40) * sigma:
        block = sigma**2 * np.eye(3) + size**2 * np.ones((3, 3))
        V = np.kron(np.eye(len(z) // 3), block)
        W = np.linalg.inv(V)
        P = np.linalg.inv(A.T @ W @ A)
        p = P @ A.T @ W @ z
        e = z - A @ p
        cost = e @ W @ e + np.linalg.slogdet(V)[1] - np.linalg.slogdet(P)[1]
        if cost < best[0]:
            best = cost, p, P
    return best[1:]
""",
    ),
    (
        "07-mornings",
        "means of the readings, with a huge covariance to be safe",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    p = np.array([z[door == j].mean() for j in range(m)])
    return p, (20 * sigma) ** 2 * np.eye(m)
""",
    ),
    (
        "07-mornings",
        "each morning's mean subtracted, then the doors' means",
        """
def survey(morning, door, z, sigma):
    off = np.array([z[morning == k].mean() for k in range(morning.max() + 1)])
    centred = z - off[morning] + z.mean()
    n = np.bincount(door)
    return np.bincount(door, centred) / n, np.diag(sigma**2 / n)
""",
    ),
    (
        "07-mornings",
        "one pass: size from residuals against plain means, doors' part not taken out",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    p0 = np.bincount(door, z) / np.bincount(door)
    off = np.bincount(morning, z - p0[door]) / np.bincount(morning)
    size = max(np.std(off), 0.5 * sigma)
    A = np.eye(m)[door]
    V = sigma**2 * np.eye(len(z)) + size**2 * (morning[:, None] == morning[None])
    P = np.linalg.inv(A.T @ np.linalg.solve(V, A))
    return P @ A.T @ np.linalg.solve(V, z), P
""",
    ),
    (
        "07-mornings",
        "filter with the correlations between doors dropped after each morning",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    size = 5 * sigma
    p, v = np.zeros(m), np.full(m, 1e6)
    for k in range(morning.max() + 1):
        d = door[morning == k]
        R = sigma**2 * np.eye(len(d)) + size**2
        Pd = np.diag(v[d])
        K = Pd @ np.linalg.inv(Pd + R)
        p[d] = p[d] + K @ (z[morning == k] - p[d])
        v[d] = np.diag(Pd - K @ Pd)
    return p, np.diag(v)
""",
    ),
    (
        "07-mornings",
        "wrong block of C returned (the mornings' when their number fits)",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(n)[morning], np.eye(m)[door]])
    size = 10 * sigma
    for _ in range(8):
        known = np.r_[np.full(n, 1 / size**2), np.zeros(m)]
        C = np.linalg.inv(J.T @ J / sigma**2 + np.diag(known))
        s = C @ J.T @ z / sigma**2
        size = np.sqrt(np.mean(s[:n] ** 2 + np.diag(C)[:n]))
    return s[-m:], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "cheat: says that it knows nothing",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    return np.full(m, z.mean()), np.eye(m) * 1e6
""",
    ),
    (
        "07-mornings",
        "good ways between doors, size treated as infinite (tiny prior): absolute claims useless",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    weak = np.r_[np.zeros(m), np.full(n, 1 / (1000 * sigma) ** 2)]
    C = np.linalg.inv(J.T @ J / sigma**2 + np.diag(weak))
    return (C @ J.T @ z / sigma**2)[:m], C[:m, :m]
""",
    ),
]
