"""Independent answers to 07-two-updates: right ones, and students' mistakes."""

RIGHT = [
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
]

WRONG = [
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
]
