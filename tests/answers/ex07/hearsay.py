"""Independent answers to 07-hearsay: right ones, and students' mistakes."""

RIGHT = [
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
]

WRONG = [
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
]
