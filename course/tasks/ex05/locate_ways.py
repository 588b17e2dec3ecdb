"""Right ways of 05-locate."""

WAYS = {
    "Joseph's form": """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    keep = np.eye(3) - K @ H
    return x + K @ v, keep @ P @ keep.T + K @ R @ K.T
""",
    "information": """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
    H, weight = H_robot(x, p), np.linalg.inv(R)
    P = np.linalg.inv(np.linalg.inv(P) + H.T @ weight @ H)
    return x + P @ H.T @ weight @ v, P
""",
    "(I − K H) P, heading wrapped": """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v = np.array([v[0], np.arctan2(np.sin(v[1]), np.cos(v[1]))])
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.pinv(H @ P @ H.T + R)
    x = x + K @ v
    x[2] = wrap(x[2])
    return [x.tolist(), ((np.eye(3) - K @ H) @ P).tolist()]
""",
    "least squares": """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    belief, sight = (np.linalg.cholesky(np.linalg.inv(M)).T for M in (P, R))
    M = np.vstack([belief, sight @ H_robot(x, p)])
    step = np.linalg.lstsq(M, np.r_[np.zeros(3), sight @ v], rcond=None)[0]
    return x + step, np.linalg.inv(M.T @ M)
""",
    "H by differences": """
def locate(x, P, z, p, R):
    columns = []
    for e in 1e-6 * np.eye(3):
        d = h(x + e, p) - h(x - e, p)
        columns.append([d[0] / 2e-6, wrap(d[1]) / 2e-6])
    H = np.array(columns).T
    r, b = z - h(x, p)
    v = np.array([r, b - 2 * np.pi * np.round(b / (2 * np.pi))])
    S = H @ P @ H.T + R
    return x + P @ H.T @ np.linalg.solve(S, v), P - P @ H.T @ np.linalg.solve(S, H @ P)
""",
    "one number after the other, once they share nothing": """
def locate(x, P, z, p, R):
    L = np.linalg.cholesky(R)
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H, v, here = np.linalg.solve(L, H_robot(x, p)), np.linalg.solve(L, v), x
    for k in range(2):
        K = P @ H[k] / (H[k] @ P @ H[k] + 1)
        here = here + K * (v[k] - H[k] @ (here - x))
        P = P - np.outer(K, H[k] @ P)
    return here, P
""",
}
