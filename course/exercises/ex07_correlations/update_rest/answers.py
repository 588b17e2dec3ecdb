# %% way: block by block
def update_rest(x, P, seen, x_seen, P_seen):
    rest = np.array([k for k in range(len(x)) if k not in seen], dtype=int)
    G = P[np.ix_(rest, seen)] @ np.linalg.inv(P[np.ix_(seen, seen)])
    found, new = x.copy(), np.zeros_like(P)
    found[seen], found[rest] = x_seen, x[rest] + G @ (x_seen - x[seen])
    new[np.ix_(seen, seen)] = P_seen
    new[np.ix_(rest, seen)] = G @ P_seen
    new[np.ix_(seen, rest)] = (G @ P_seen).T
    left = P[np.ix_(rest, rest)] - G @ P[np.ix_(seen, rest)]
    new[np.ix_(rest, rest)] = left + G @ P_seen @ G.T
    return found, new

# %% way: entry by entry
def update_rest(x, P, seen, x_seen, P_seen):
    n, s = len(x), [int(k) for k in seen]
    own = P[s][:, s]
    G = [np.linalg.solve(own, P[s, k]) for k in range(n)]
    learned = own - P_seen
    moved = np.asarray(x_seen) - x[s]
    found = [x[k] + G[k] @ moved for k in range(n)]
    return found, [[P[k, l] - G[k] @ learned @ G[l] for l in range(n)] for k in range(n)]

# %% way: what follows and what stays
def update_rest(x, P, seen, x_seen, P_seen):
    G = np.linalg.solve(P[np.ix_(seen, seen)], P[seen]).T
    stays = P - G @ P[seen]
    return x - G @ x[seen] + G @ x_seen, stays + G @ P_seen @ G.T

# %% way: pinv and a selection
def update_rest(x, P, seen, x_seen, P_seen):
    E = np.eye(len(x))[seen]
    own = E @ P @ E.T
    G = P @ E.T @ np.linalg.pinv(own)
    L = np.eye(len(x)) - G @ E
    return (L @ x + G @ x_seen).tolist(), (L @ P @ L.T + G @ P_seen @ G.T).tolist()

# %% way: least squares
def update_rest(x, P, seen, x_seen, P_seen):
    G = np.linalg.lstsq(P[seen][:, seen], P[seen], rcond=None)[0]
    change = np.asarray(P_seen) - P[seen][:, seen]
    return x + (x_seen - x[seen]) @ G, P + np.einsum("ak,ab,bl->kl", G, change, G)

# %% pasted: an update with the answer as what was seen
def update_rest(x, P, seen, x_seen, P_seen):
    H = np.eye(len(x))[seen]
    S = H @ P @ H.T + P_seen
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (x_seen - H @ x), P - K @ S @ K.T

# %% pasted: an update with exact observations
def update_rest(x, P, seen, x_seen, P_seen):
    H = np.eye(len(x))[seen]
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    return x + K @ (x_seen - H @ x), (np.eye(len(x)) - K @ H) @ P @ (np.eye(len(x)) - K @ H).T

# %% pasted: written into the state
def update_rest(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    x[seen] = x_seen
    P[np.ix_(seen, seen)] = P_seen
    pass
    return x, P

# %% pasted: fused entry by entry
def update_rest(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    a, b = P[np.ix_(seen, seen)], P_seen
    K = a @ np.linalg.inv(a + b)
    x[seen] += K @ (x_seen - x[seen])
    P[np.ix_(seen, seen)] = a - K @ a
    return x, P

# %% right: a Kalman update by an invented measurement where it can be, else by the gain
def update_rest(x, P, seen, x_seen, P_seen):
    E = np.eye(len(x))[list(seen)]
    B = E @ P @ E.T
    G = np.linalg.solve(B, E @ P).T
    L = np.eye(len(x)) - G @ E
    return x + G @ (np.asarray(x_seen) - E @ x), L @ P @ L.T + G @ P_seen @ G.T

# %% right: rest + G P_seen G'
def update_rest(x, P, seen, x_seen, P_seen):
    seen = np.asarray(seen)
    P_ss = P[seen][:, seen]
    G = np.linalg.solve(P_ss, P[seen]).T
    rest = P - G @ P_ss @ G.T
    P_new = rest + G @ P_seen @ G.T
    return x + G @ (x_seen - x[seen]), (P_new + P_new.T) / 2

# %% right: block by block
def update_rest(x, P, seen, x_seen, P_seen):
    n = len(x)
    rest = np.array([k for k in range(n) if k not in set(int(s) for s in seen)], dtype=int)
    y, Q = np.zeros(n), np.zeros((n, n))
    y[seen], Q[np.ix_(seen, seen)] = x_seen, P_seen
    if len(rest):
        G = np.linalg.solve(P[np.ix_(seen, seen)], P[np.ix_(seen, rest)]).T
        y[rest] = x[rest] + G @ (x_seen - x[seen])
        Q[np.ix_(rest, seen)] = G @ P_seen
        Q[np.ix_(seen, rest)] = (G @ P_seen).T
        Q[np.ix_(rest, rest)] = P[np.ix_(rest, rest)] + G @ (P_seen - P[np.ix_(seen, seen)]) @ G.T
    return y, Q

# %% right: sorted: seen first, then moments of x_o = x_o + G (x_s - x_s) + rest
def update_rest(x, P, seen, x_seen, P_seen):
    n, k = len(x), len(seen)
    others = [i for i in range(n) if i not in set(np.asarray(seen).tolist())]
    order = np.array([*seen, *others], dtype=int)
    Q, y = P[order][:, order], x[order]
    G = np.linalg.solve(Q[:k, :k], Q[:k, k:]).T
    carry = np.vstack([np.eye(k), G])
    rest = np.zeros((n, n))
    rest[k:, k:] = Q[k:, k:] - G @ Q[:k, k:]
    back = np.argsort(order)
    new = y + carry @ (x_seen - y[:k])
    cov = carry @ P_seen @ carry.T + rest
    return new[back], cov[back][:, back]

# %% wrong: P_seen forgotten: as if the entries were known exactly
def update_rest(x, P, seen, x_seen, P_seen):
    G = P[:, seen] @ np.linalg.inv(P[np.ix_(seen, seen)])
    x_new = x + G @ (x_seen - x[seen])
    P_new = P - G @ P[seen, :]
    P_new[np.ix_(seen, seen)] = P_seen
    return x_new, P_new

# %% wrong: x overwritten before the difference is taken (nothing reaches the others)
def update_rest(x, P, seen, x_seen, P_seen):
    x_new = x.copy()
    x_new[seen] = x_seen
    P_ss = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(P_ss)
    x_new = x_new + G @ (x_seen - x_new[seen])
    return x_new, P - G @ (P_ss - P_seen) @ G.T

# %% wrong: right values, but x and P of the caller are changed in place
def update_rest(x, P, seen, x_seen, P_seen):
    P_ss = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(P_ss)
    x += G @ (x_seen - x[seen])
    P -= G @ (P_ss - P_seen) @ G.T
    return x, P

# %% wrong: all in sight: returned in the order of seen
def update_rest(x, P, seen, x_seen, P_seen):
    if len(seen) == len(x):
        return x_seen.copy(), P_seen.copy()
    P_ss = P[np.ix_(seen, seen)]
    G = np.linalg.solve(P_ss, P[seen, :]).T
    return x + G @ (x_seen - x[seen]), P + G @ (P_seen - P_ss) @ G.T

# %% wrong: each other entry follows only the seen entry it is most correlated with
def update_rest(x, P, seen, x_seen, P_seen):
    n = len(x)
    G = np.zeros((n, len(seen)))
    rho = correlation(P)
    for j in range(n):
        best = int(np.argmax(abs(rho[j, seen])))
        G[j, best] = P[j, seen[best]] / P[seen[best], seen[best]]
    P_ss = P[np.ix_(seen, seen)]
    return x + G @ (x_seen - x[seen]), P - G @ (P_ss - P_seen) @ G.T

# %% wrong: P_seen subtracted from the rest: sign
def update_rest(x, P, seen, x_seen, P_seen):
    S = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(S)
    rest = P - G @ S @ G.T
    return x + G @ (x_seen - x[seen]), rest - G @ P_seen @ G.T
