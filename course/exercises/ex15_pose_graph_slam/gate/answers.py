# %% way: blocks of the inverse
def gate_loop(poses, H, loop, gates):
    i, j, z, information = loop
    A, B = jacobians(poses[i], poses[j], z)
    P = np.zeros((3 * len(poses), 3 * len(poses)))
    P[3:, 3:] = np.linalg.inv(H)
    I, J = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
    P_ii, P_ij, P_jj = P[I, I], P[I, J], P[J, J]
    S = A @ P_ii @ A.T + A @ P_ij @ B.T + B @ P_ij.T @ A.T + B @ P_jj @ B.T
    S = S + np.linalg.inv(information)
    e = error(poses[i], poses[j], z)
    d2 = e @ np.linalg.inv(S) @ e
    return d2, d2 <= gates[3]

# %% way: the cost that the loop adds after one linear step
def gate_loop(poses, H, loop, gates):
    i, j, z, L = loop
    A, B = jacobians(poses[i], poses[j], z)
    K = np.zeros((3, len(poses), 3))
    K[:, i] += A
    K[:, j] += B
    K = K.reshape(3, -1)[:, 3:]
    e = error(poses[i], poses[j], z)
    delta = -np.linalg.solve(H + K.T @ L @ K, K.T @ L @ e)
    left = e + K @ delta
    d2 = delta @ H @ delta + left @ L @ left
    return d2, d2 <= gates[3]

# %% way: whitened, six columns of the inverse
def gate_loop(poses, H, loop, gates):
    i, j, z, information = loop
    rows = np.concatenate([np.arange(3 * k, 3 * k + 3) - 3 for k in (i, j)])
    known = rows < 0
    X = np.linalg.solve(H, np.eye(len(H))[:, rows])
    P = X[rows]
    P[known], P[:, known] = 0, 0
    J = np.hstack(jacobians(poses[i], poses[j], z))
    root = np.linalg.cholesky(J @ P @ J.T + np.linalg.inv(information))
    white = np.linalg.solve(root, error(poses[i], poses[j], z))
    return np.sum(white**2), bool(np.sum(white**2) <= gates[len(white)])

# %% right: the residual in the frame of pose i, with Λ turned into it
def gate_loop(poses, H, loop, gates):
    i, j, z, L = loop
    c, s = np.cos(z[2]), np.sin(z[2])
    T = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    v = between(poses[i], poses[j]) - z
    v[2] = wrap(v[2])
    A, B = jacobians(poses[i], poses[j], np.zeros(3))
    n = len(poses) - 1
    P = np.linalg.inv(H).reshape(n, 3, n, 3)
    S = T @ np.linalg.inv(L) @ T.T
    for a, K in ((i, A), (j, B)):
        for b, M in ((i, A), (j, B)):
            if a and b:
                S += K @ P[a - 1, :, b - 1] @ M.T
    d2 = v @ np.linalg.solve(S, v)
    return float(d2), int(d2 <= gates[3])

# %% right: difference quotients of the residual
def gate_loop(poses, H, loop, gates):
    i, j, z, L = loop
    def residual(x):
        every = np.vstack([poses[:1], poses[1:] + x.reshape(-1, 3)])
        return error(every[i], every[j], z)
    v = residual(np.zeros(len(H)))
    J = np.array([(residual(h) - residual(-h)) / 2e-5 for h in 1e-5 * np.eye(len(H))]).T
    U = np.linalg.cholesky(H)
    half = np.linalg.solve(U, J.T)
    S = half.T @ half + np.linalg.inv(L)
    d2 = v.dot(np.linalg.inv(S)).dot(v)
    return [d2, not d2 > gates[3]]

# %% wrong: two marginal covariances, and the gate of position only
def gate_loop(poses, H, loop, gates):
    i, j, z, L = loop
    A, B = jacobians(poses[i], poses[j], z)
    P = np.linalg.inv(H)
    S = np.linalg.inv(L)
    if i > 0:
        S = S + A @ P[3 * i - 3 : 3 * i, 3 * i - 3 : 3 * i] @ A.T
    if j > 0:
        S = S + B @ P[3 * j - 3 : 3 * j, 3 * j - 3 : 3 * j] @ B.T
    v = error(poses[i], poses[j], z)
    d2 = v @ np.linalg.solve(S, v)
    return d2, d2 <= gates[2]

# %% wrong: the lesson's case: pose j alone, its block where pose 0 still counts
def gate_loop(poses, H, loop, gates):
    i, j, z, L = loop
    P = np.linalg.inv(H)
    P = P[3 * (j - 1) : 3 * j, 3 * (j - 1) : 3 * j] if j else np.zeros((3, 3))
    J = jacobians(poses[i], poses[j], z)[1]
    S = J @ P @ J.T + np.linalg.inv(L)
    v = error(poses[i], poses[j], z)
    d2 = v @ np.linalg.solve(S, v)
    return d2, d2 <= gates[3]

# %% wrong: the loop is optimised in first, then its χ²
def gate_loop(poses, H, loop, gates):
    i, j, z, L = loop
    A, B = jacobians(poses[i], poses[j], z)
    J = np.zeros((3, 3 * len(poses)))
    J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = A, B
    J = J[:, 3:]
    e = error(poses[i], poses[j], z)
    left = e - J @ np.linalg.solve(H + J.T @ L @ J, J.T @ L @ e)
    d2 = left @ L @ left
    return d2, d2 <= gates[3]
