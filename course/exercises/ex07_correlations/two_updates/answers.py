# %% way: information
def two_updates(P, H_1, H_2, R):
    I = np.linalg.inv(P)
    W = np.linalg.inv(R)
    first = I + H_1.T @ W @ H_1
    return np.linalg.inv(first), np.linalg.inv(first + H_2.T @ W @ H_2)

# %% way: one number after the other
def two_updates(P, H_1, H_2, R):
    P = P.copy()
    L = np.linalg.cholesky(R)
    out = []
    for H in (H_1, H_2):
        for row in np.linalg.solve(L, H):
            PH = P @ row
            P -= np.outer(PH, PH) / (row @ PH + 1)
        out.append(P.copy())
    return out

# %% way: block by block
def two_updates(P, H_1, H_2, R):
    P = [[P[a, b] for b in SLICES] for a in SLICES]
    first = seen(P, H_1[:, :3], H_1[:, 3:5], 1, R)
    both = seen(first, H_2[:, :3], H_2[:, 5:], 2, R)
    return np.block(first), np.block(both)

SLICES = slice(0, 3), slice(3, 5), slice(5, 7)

def seen(P, H_r, H_p, k, R):
    S = H_r @ P[0][0] @ H_r.T + H_r @ P[0][k] @ H_p.T + H_p @ P[k][0] @ H_r.T
    S = S + H_p @ P[k][k] @ H_p.T + R
    W = [(P[i][0] @ H_r.T + P[i][k] @ H_p.T) @ np.linalg.inv(S) for i in range(3)]
    return [[P[i][j] - W[i] @ S @ W[j].T for j in range(3)] for i in range(3)]

# %% way: joseph
def two_updates(P, H_1, H_2, R):
    found = []
    for H in (H_1, H_2):
        S = H @ P @ H.T + R
        K = np.linalg.solve(S.T, H @ P).T
        L = np.eye(len(P)) - K @ H
        P = L @ P @ L.T + K @ R @ K.T
        found.append(P)
    return found[0], found[1]

# %% way: short
def two_updates(P, H_1, H_2, R):
    K = P @ H_1.T @ np.linalg.inv(H_1 @ P @ H_1.T + R)
    P_first = (np.eye(7) - K @ H_1) @ P
    K = P_first @ H_2.T @ np.linalg.inv(H_2 @ P_first @ H_2.T + R)
    P_both = P_first - K @ H_2 @ P_first
    return P_first.tolist(), P_both.tolist()

# %% way: both at once
def two_updates(P, H_1, H_2, R):
    H = np.vstack([H_1, H_2])
    noise = np.kron(np.eye(2), R)
    P_first = P - P @ H_1.T @ np.linalg.solve(H_1 @ P @ H_1.T + R, H_1 @ P)
    return P_first, P - P @ H.T @ np.linalg.solve(H @ P @ H.T + noise, H @ P)

# %% right: Joseph's form
def two_updates(P, H_1, H_2, R):
    out = []
    for H in (H_1, H_2):
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        A = np.eye(7) - K @ H
        P = A @ P @ A.T + K @ R @ K.T
        out.append(P)
    return tuple(out)

# %% right: information form: adds H' R^-1 H to the inverse of P, in units of the standard deviations
def two_updates(P, H_1, H_2, R):
    D = np.sqrt(np.diag(P))
    L = np.linalg.inv(np.linalg.cholesky(R))
    A_1, A_2 = L @ H_1 * D, L @ H_2 * D
    Y = np.linalg.inv(P / np.outer(D, D))
    Y_1 = Y + A_1.T @ A_1
    Y_2 = Y_1 + A_2.T @ A_2
    return np.linalg.inv(Y_1) * np.outer(D, D), np.linalg.inv(Y_2) * np.outer(D, D)

# %% right: information form
def two_updates(P, H_1, H_2, R):
    R_inv = np.linalg.inv(R)
    info = np.linalg.inv(P)
    info_first = info + H_1.T @ R_inv @ H_1
    info_both = info_first + H_2.T @ R_inv @ H_2
    return np.linalg.inv(info_first), np.linalg.inv(info_both)

# %% right: both observations in one stacked update
def two_updates(P, H_1, H_2, R):
    def without(H, noise):
        PHt = P @ H.T
        return P - PHt @ np.linalg.solve(H @ PHt + noise, PHt.T)

    zero = np.zeros((2, 2))
    return without(H_1, R), without(np.vstack([H_1, H_2]), np.block([[R, zero], [zero, R]]))

# %% wrong: R is forgotten the second time
def two_updates(P, H_1, H_2, R):
    S = H_1 @ P @ H_1.T + R
    P1 = P - P @ H_1.T @ np.linalg.inv(S) @ H_1 @ P
    S = H_2 @ P1 @ H_2.T
    return P1, P1 - P1 @ H_2.T @ np.linalg.inv(S) @ H_2 @ P1

# %% wrong: only P_both
def two_updates(P, H_1, H_2, R):
    for H in (H_1, H_2):
        S = H @ P @ H.T + R
        P = P - P @ H.T @ np.linalg.inv(S) @ H @ P
    return P

# %% wrong: K R Kᵀ instead of K S Kᵀ
def two_updates(P, H_1, H_2, R):
    out = []
    for H in (H_1, H_2):
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        P = P - K @ R @ K.T
        out.append(P)
    return out[0], out[1]

# %% wrong: small numbers rounded off
def two_updates(P, H_1, H_2, R):
    out = []
    for H in (H_1, H_2):
        S = H @ P @ H.T + R + 1e-9 * np.eye(2)
        K = P @ H.T @ np.linalg.inv(S)
        P = P - K @ S @ K.T
        P[np.abs(P) < 1e-6] = 0
        out.append(P)
    return out[0], out[1]

# %% wrong: both observations in one, with the noise of one spread the wrong way
def two_updates(P, H_1, H_2, R):
    def update(P, H, R):
        S = H @ P @ H.T + R
        K = np.linalg.solve(S, H @ P).T
        return P - K @ S @ K.T
    return update(P, H_1, R), update(P, np.vstack([H_1, H_2]), np.kron(R, np.eye(2)))

# %% wrong: information form with R instead of its inverse
def two_updates(P, H_1, H_2, R):
    Y = np.linalg.inv(P)
    Y1 = Y + H_1.T @ R @ H_1
    Y2 = Y1 + H_2.T @ R @ H_2
    return np.linalg.inv(Y1), np.linalg.inv(Y2)
