# %% way: by an SVD
def robust_icp(source, target, T, iterations, c):
    for _ in range(iterations):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        w = (c**2 / (c**2 + distances**2)) ** 2
        w = (w / w.sum())[:, None]
        a, b = np.sum(w * moved, axis=0), np.sum(w * target[rows], axis=0)
        U, _, Vt = np.linalg.svd((w * (moved - a)).T @ (target[rows] - b))
        Vt[1] *= np.linalg.det(Vt.T @ U.T)
        step = np.eye(3)
        step[:2, :2] = Vt.T @ U.T
        step[:2, 2] = b - step[:2, :2] @ a
        T = step @ T
    return T

# %% way: with complex numbers, from the source as given
def robust_icp(source, target, T, iterations, c):
    a = source @ [1, 1j]
    for _ in range(iterations):
        distances, rows = nearest(carry(T, source), target)
        b, w = target[rows] @ [1, 1j], 1 / (c**2 + distances**2) ** 2
        mean_a, mean_b = np.average(a, weights=w), np.average(b, weights=w)
        turn = np.sum(w * (b - mean_b) * np.conj(a - mean_a))
        turn /= abs(turn)
        t = mean_b - turn * mean_a
        T = np.array([[turn.real, -turn.imag, t.real], [turn.imag, turn.real, t.imag], [0, 0, 1]])
    return T

# %% way: by best_motion and mirrored copies
def robust_icp(source, target, T, iterations, c):
    for _ in range(iterations):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        w = (1 + (distances / c) ** 2) ** -2.0
        a, b = np.average(moved, 0, w), np.average(target[rows], 0, w)
        p, q = np.sqrt(w)[:, None] * (moved - a), np.sqrt(w)[:, None] * (target[rows] - b)
        step = best_motion(np.vstack([p, -p]), np.vstack([q, -q]))
        step[:2, 2] = b - step[:2, :2] @ a
        T = step @ T
    return T

# %% pasted: the lesson's trimmed ICP
def robust_icp(source, target, T, iterations, c):
    for _ in range(iterations):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        kept = np.argsort(distances)[: max(int(0.8 * len(source)), 2)]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T

# %% right: sums pair by pair, derivative of the kernel by the quotient rule
def robust_icp(source, target, T, iterations, c):
    T = np.array(T, dtype=float)
    for _ in range(iterations):
        moved = carry(T, source)
        e, j = nearest(moved, target)
        W, A, B = 0.0, np.zeros(2), np.zeros(2)
        ws = []
        for k in range(len(moved)):
            bottom = c**2 + e[k] ** 2
            slope_over_e = (2 * c**2 * bottom - 2 * c**2 * e[k] ** 2) / bottom**2
            ws.append(slope_over_e / 2)
            W, A, B = W + ws[-1], A + ws[-1] * moved[k], B + ws[-1] * target[j[k]]
        A, B = A / W, B / W
        S = C = 0.0
        for k, w in enumerate(ws):
            (x, y), (u, v) = moved[k] - A, target[j[k]] - B
            S, C = S + w * (x * v - y * u), C + w * (x * u + y * v)
        h = np.hypot(S, C)
        R = np.array([[C, -S], [S, C]]) / h
        T = np.vstack([np.c_[R @ T[:2, :2], R @ (T[:2, 2] - A) + B], [0, 0, 1]])
    return T

# %% right: least squares for scaled rotation, then normalised
def robust_icp(source, target, T, iterations, c):
    for _ in range(iterations):
        m = carry(T, source)
        d, rows = nearest(m, target)
        s = 1 / (1 + d * d / c**2)  # the square root of the weight
        q = target[rows]
        one, nil = np.ones(len(m)), np.zeros(len(m))
        A = np.vstack([np.c_[m[:, 0], -m[:, 1], one, nil], np.c_[m[:, 1], m[:, 0], nil, one]])
        two = np.concatenate([s, s])
        co, si, _, _ = np.linalg.lstsq(A * two[:, None], np.concatenate(q.T) * two, rcond=None)[0]
        R = np.array([[co, -si], [si, co]]) / np.hypot(co, si)
        D = np.eye(3)
        D[:2, :2] = R
        D[:2, 2] = np.average(q - m @ R.T, axis=0, weights=s**2)
        T = D @ T
    return T

# %% wrong: Cauchy's weight as in the lesson
def robust_icp(source, target, T, iterations, c):
    for _ in range(iterations):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        w = 1 / (1 + d**2 / c**2)
        a, b = np.average(moved, 0, w), np.average(target[rows], 0, w)
        M = ((moved - a) * w[:, None]).T @ (target[rows] - b)
        U, _, Vt = np.linalg.svd(M)
        D = np.eye(3)
        D[:2, :2] = Vt.T @ U.T
        D[:2, 2] = b - D[:2, :2] @ a
        T = D @ T
    return T

# %% wrong: slope divided by 2e numerically: NaN at length zero
def robust_icp(source, target, T, iterations, c):
    for _ in range(iterations):
        moved = carry(T, source)
        e, rows = nearest(moved, target)
        slope = 2 * c**4 * e / (c**2 + e**2) ** 2
        w = slope / (2 * e)
        a, b = w @ moved / w.sum(), w @ target[rows] / w.sum()
        U, _, Vt = np.linalg.svd((w[:, None] * (moved - a)).T @ (target[rows] - b))
        D = np.eye(3)
        D[:2, :2], D[:2, 2] = Vt.T @ U.T, b - Vt.T @ U.T @ a
        T = D @ T
    return T
