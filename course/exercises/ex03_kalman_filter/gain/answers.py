# %% way: inverse
def gain(P, H, R):
    return P @ H.T @ np.linalg.inv(H @ P @ H.T + R)

# %% way: solve
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S, H @ P).T

# %% way: Cholesky
def gain(P, H, R):
    S = H @ P @ H.T + R
    L = np.linalg.cholesky(S)
    return np.linalg.solve(L.T, np.linalg.solve(L, H @ P)).T

# %% way: pseudo-inverse
def gain(P, H, R):
    shared = np.dot(P, H.T)
    return np.matmul(shared, np.linalg.pinv(np.dot(H, shared) + R)).tolist()

# %% way: information
def gain(P, H, R):
    weight = H.T @ np.linalg.inv(R)
    return np.linalg.inv(np.linalg.inv(P) + weight @ H) @ weight

# %% way: matrix power
def gain(P, H, R):
    S = R.copy()
    S += H @ P @ H.T
    return P @ H.T @ np.linalg.matrix_power(S, -1)

# %% way: column by column
def gain(P, H, R):
    n, m = len(P), len(H)
    shared, S = np.zeros((n, m)), np.zeros((m, m))
    for j in range(m):
        for i in range(n):
            shared[i, j] = sum(P[i, k] * H[j, k] for k in range(n))
    for i in range(m):
        for j in range(m):
            S[i, j] = R[i, j] + sum(H[i, k] * shared[k, j] for k in range(n))
    return np.array([np.linalg.solve(S.T, row) for row in shared])

# %% way: one number after the other
def gain(P, H, R):
    white = np.linalg.inv(np.linalg.cholesky(R))
    left, rows, K = P, white @ H, np.zeros((len(P), len(H)))
    for k in range(len(rows)):
        row = rows[k]
        one = left @ row / (row @ left @ row + 1)
        K = K - np.outer(one, row @ K)
        K[:, k] = one
        left = left - np.outer(one, row @ left)
    return K @ white

# %% right: least squares by the joint covariance, lstsq of the transpose
def gain(P, H, R):
    S = H @ P @ H.T + R
    Kt, *_ = np.linalg.lstsq(S, H @ P, rcond=None)
    return Kt.T

# %% right: solve instead of inv, transposed twice
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S.T, H @ P.T).T

# %% right: information form: K = P⁺ Hᵀ R⁻¹
def gain(P, H, R):
    information = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    return np.linalg.inv(information) @ H.T @ np.linalg.inv(R)

# %% right: information form: (P^-1 + H' R^-1 H)^-1 H' R^-1
def gain(P, H, R):
    weight = np.linalg.inv(R)
    after = np.linalg.inv(np.linalg.inv(P) + H.T @ weight @ H)
    return after @ H.T @ weight

# %% wrong: elementwise division by S
def gain(P, H, R):
    S = H @ P @ H.T + R
    return P @ H.T / S

# %% wrong: solve without the last transpose: K is (m, n)
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S, H @ P)

# %% wrong: R forgotten in S (pinv hides the trouble)
def gain(P, H, R):
    PHt = P @ H.T
    return PHt @ np.linalg.pinv(H @ PHt)

# %% wrong: one measured number: returns (n,) instead of (n, 1)
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return K.squeeze()

# %% wrong: adds to R in place: the caller's R is spoiled
def gain(P, H, R):
    R += H @ P @ H.T
    return np.linalg.solve(R, H @ P).T

# %% wrong: weighs in the state's space: P (P + HᵀRH)⁻¹ Hᵀ, R carried back by Hᵀ instead of an inverse
def gain(P, H, R):
    my_doubt, all_doubt = P, P + H.T @ R @ H
    return my_doubt @ np.linalg.inv(all_doubt) @ H.T

# %% wrong: information form, P for its inverse
def gain(P, H, R):
    W = np.linalg.inv(R)
    return np.linalg.inv(P + H.T @ W @ H) @ H.T @ W
