# %% way: least squares
def fuse(a, P_a, b, P_b, P_ab):
    J = np.vstack([np.eye(2), np.eye(2)])
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    P = np.linalg.inv(J.T @ W @ J)
    return P @ J.T @ W @ np.concatenate([a, b]), P

# %% way: from b
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = np.linalg.solve(S.T, (P_b - P_ab.T).T).T
    b = b + K @ (a - b)
    return [b.tolist(), (P_b - K @ (P_b - P_ab)).tolist()]

# %% way: mixed terms
def fuse(a, P_a, b, P_b, P_ab):
    K = np.linalg.lstsq(P_a + P_b - P_ab - P_ab.T, P_a - P_ab.T, rcond=None)[0].T
    L = np.eye(2) - K
    P = L @ P_a @ L.T + K @ P_b @ K.T + L @ P_ab @ K.T + K @ P_ab.T @ L.T
    return L @ a + K @ b, P

# %% way: two observations of one state
def fuse(a, P_a, b, P_b, P_ab):
    P = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    H = np.hstack([np.eye(2), -np.eye(2)])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    x = np.concatenate([a, b]) - K @ (a - b)
    return x[:2], (P - K @ H @ P)[:2, :2]

# %% way: b without its share
def fuse(a, P_a, b, P_b, P_ab):
    # what b says beyond a: its error less what follows that of a
    F = P_ab.T @ np.linalg.inv(P_a)
    H, news, R = np.eye(2) - F, b - F @ a, P_b - F @ P_ab
    P = np.linalg.inv(np.linalg.inv(P_a) + H.T @ np.linalg.inv(R) @ H)
    return a + P @ H.T @ np.linalg.inv(R) @ (news - H @ a), P

# %% wrong: K from b's side
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_b - P_ab.T) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T

# %% wrong: returns the information matrix, not the covariance
def fuse(a, P_a, b, P_b, P_ab):
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    A = np.vstack([np.eye(2)] * 2)
    Y = A.T @ W @ A
    return np.linalg.solve(Y, A.T @ W @ np.r_[a, b]), Y

# %% wrong: changes P_a in place
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    P_a -= K @ S @ K.T
    return a + K @ (b - a), P_a

# %% wrong: K of the independent case
def fuse(a, P_a, b, P_b, P_ab):
    K = P_a @ np.linalg.inv(P_a + P_b)
    S = P_a + P_b - P_ab - P_ab.T
    return a + K @ (b - a), P_a - K @ S @ K.T

# %% wrong: covariance intersection
def fuse(a, P_a, b, P_b, P_ab):
    best = None
    for w in np.linspace(0, 1, 201):
        P = np.linalg.inv(w * np.linalg.inv(P_a) + (1 - w) * np.linalg.inv(P_b))
        if best is None or np.trace(P) < np.trace(best[1]):
            best = P @ (w * np.linalg.inv(P_a) @ a + (1 - w) * np.linalg.inv(P_b) @ b), P
    return best

# %% wrong: right x, P of independent errors
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), np.linalg.inv(np.linalg.inv(P_a) + np.linalg.inv(P_b))

# %% wrong: each coordinate by itself
def fuse(a, P_a, b, P_b, P_ab):
    va, vb, c = np.diag(P_a), np.diag(P_b), np.diag(P_ab)
    k = (va - c) / (va + vb - 2 * c)
    return a + k * (b - a), np.diag(va - k * (va - c))
