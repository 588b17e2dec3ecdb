# %% way: anew
def update(x, P, z, H, R):
    v = z - H @ x
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T

# %% way: Joseph
def update(x, P, z, H, R):
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    rest = np.eye(len(x)) - K @ H
    return x + K @ (z - H @ x), rest @ P @ rest.T + K @ R @ K.T

# %% way: short
def update(x, P, z, H, R):
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return [K @ z + x - K @ H @ x, (np.eye(len(P)) - K @ H) @ P]

# %% way: shared
def update(x, P, z, H, R):
    shared = P @ H.T
    K = shared @ np.linalg.inv(H @ shared + R)
    return x - K @ (H @ x - z), P - K @ shared.T

# %% way: information
def update(x, P, z, H, R):
    before, weight = np.linalg.inv(P), H.T @ np.linalg.inv(R)
    P = np.linalg.inv(before + weight @ H)
    return P @ (before @ x + weight @ z), P

# %% way: new P as a gain
def update(x, P, z, H, R):
    after = P - P @ H.T @ np.linalg.solve(H @ P @ H.T + R, H @ P)
    return x + after @ H.T @ np.linalg.inv(R) @ (z - H @ x), after

# %% way: least squares
def update(x, P, z, H, R):
    A, B = np.linalg.inv(np.linalg.cholesky(P)), np.linalg.inv(np.linalg.cholesky(R))
    M = np.vstack([A, B @ H])
    x = np.linalg.lstsq(M, np.concatenate([A @ x, B @ z]), rcond=None)[0]
    return x, np.linalg.inv(M.T @ M)

# %% way: one number after the other
def update(x, P, z, H, R):
    white = np.linalg.inv(np.linalg.cholesky(R))
    for row, seen in zip(white @ H, white @ z):
        K = P @ row / (row @ P @ row + 1)
        x, P = x + K * (seen - row @ x), P - np.outer(K, row @ P)
    return tuple(x), P.tolist()

# %% way: on copies
def update(x, P, z, H, R):
    x, P = x.copy(), P.copy()
    K = P @ H.T @ np.linalg.pinv(H @ P @ H.T + R)
    x += K @ (z - H @ x)
    P -= K @ H @ P
    return x, (P + P.T) / 2

# %% right: information form
def update(x, P, z, H, R):
    I = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    i = np.linalg.solve(P, x) + H.T @ np.linalg.solve(R, z)
    C = np.linalg.inv(I)
    return C @ i, C

# %% right: whitens the measurement with Cholesky of R and takes it in number by number
def update(x, P, z, H, R):
    L = np.linalg.cholesky(R)
    Hw, zw = np.linalg.solve(L, H), np.linalg.solve(L, z)
    for row, value in zip(Hw, zw):
        Pr = P @ row
        s = row @ Pr + 1.0
        x = x + Pr * (value - row @ x) / s
        P = P - np.outer(Pr, Pr) / s
    return x, P

# %% right: Joseph's form, symmetrised
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    rest = np.eye(x.size) - K @ H
    new = rest @ P @ rest.T + K @ R @ K.T
    return x + K @ v, (new + new.T) / 2

# %% right: information adds up
def update(x, P, z, H, R):
    before = np.linalg.inv(P)
    weight = np.linalg.inv(R)
    after = np.linalg.inv(before + H.T @ weight @ H)
    return after @ (before @ x + H.T @ weight @ z), after

# %% wrong: P by K S without transpose of K
def update(x, P, z, H, R):
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    v, S = innovation(x, P, z, H, R)
    return x + K @ v, P - K @ S @ K

# %% wrong: x in place
def update(x, P, z, H, R):
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    v, S = innovation(x, P, z, H, R)
    x += K @ v
    P -= K @ S @ K.T
    return x, P

# %% wrong: returned the other way round
def update(x, P, z, H, R):
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    v, S = innovation(x, P, z, H, R)
    return P - K @ S @ K.T, x + K @ v

# %% wrong: P − K S
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ S @ K.T / 2

# %% wrong: numbers one after the other, R's diagonal only
def update(x, P, z, H, R):
    for k in range(len(z)):
        h, r = H[k : k + 1], R[k : k + 1, k : k + 1]
        K = P @ h.T / (h @ P @ h.T + r)
        x = x + K @ (z[k : k + 1] - h @ x)
        P = P - K @ h @ P
    return x, P

# %% wrong: symmetrised without dividing by two
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    P = P - K @ S @ K.T
    return x + K @ v, P + P.T

# %% wrong: unit matrix of hard-coded size
def update(x, P, z, H, R):
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    I = np.eye(2)
    return x + K @ (z - H @ x), (I - K @ H) @ P

# %% wrong: innovation cut off at three sigma
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    limit = 3 * np.sqrt(np.diag(S))
    v = np.clip(v, -limit, limit)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ S @ K.T

# %% wrong: whitened with the transposed root of R
def update(x, P, z, H, R):
    W = np.linalg.inv(np.linalg.cholesky(R).T)
    h, y = W @ H, W @ z
    information = np.linalg.inv(P) + h.T @ h
    x_new = np.linalg.solve(information, np.linalg.inv(P) @ x + h.T @ y)
    return x_new, np.linalg.inv(information)
