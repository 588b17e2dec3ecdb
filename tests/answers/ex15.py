"""Independent answers to exercise 15: right ones and wrong ones, as students would type them."""

RIGHT = []
WRONG = []


def right(task, what, source):
    RIGHT.append((task, what, source.strip("\n") + "\n"))


def wrong(task, what, source):
    WRONG.append((task, what, source.strip("\n") + "\n"))


# ------------------------------------------------------------------ RIGHT: 1 error
right(
    "15-error",
    "between twice",
    """
def error(x_i, x_j, z):
    return between(z, between(x_i, x_j))
""",
)

right(
    "15-error",
    "homogeneous matrices, atan2",
    """
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.inv(T(z)) @ np.linalg.inv(T(x_i)) @ T(x_j)
    return np.array([E[0, 2], E[1, 2], np.arctan2(E[1, 0], E[0, 0])])
""",
)

right(
    "15-error",
    "complex numbers",
    """
def error(x_i, x_j, z):
    p_i, p_j, p_z = (complex(p[0], p[1]) for p in (x_i, x_j, z))
    seen = (p_j - p_i) * np.exp(-1j * x_i[2])
    way = (seen - p_z) * np.exp(-1j * z[2])
    turn = np.angle(np.exp(1j * (x_j[2] - x_i[2] - z[2])))
    return np.array([way.real, way.imag, turn])
""",
)

# ------------------------------------------------------------------ RIGHT: 2 jacobians
right(
    "15-jacobians",
    "blocks, chain rule through seen = between(x_i, x_j)",
    """
def jacobians(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    seen = R(x_i[2]).T @ (x_j[:2] - x_i[:2])
    A, B = np.zeros((3, 3)), np.zeros((3, 3))
    back = (R(x_i[2]) @ R(z[2])).T
    A[:2, :2] = -back
    A[:2, 2] = R(z[2]).T @ np.array([seen[1], -seen[0]])
    A[2, 2] = -1
    B[:2, :2] = back
    B[2, 2] = 1
    return A, B
""",
)

right(
    "15-jacobians",
    "central differences, the angle wrapped",
    """
def jacobians(x_i, x_j, z):
    x_i, x_j = np.array(x_i, dtype=float), np.array(x_j, dtype=float)
    h, A, B = 1e-5, np.empty((3, 3)), np.empty((3, 3))
    for k in range(3):
        d = np.zeros(3)
        d[k] = h
        a = error(x_i + d, x_j, z) - error(x_i - d, x_j, z)
        b = error(x_i, x_j + d, z) - error(x_i, x_j - d, z)
        a[2], b[2] = wrap(a[2]), wrap(b[2])
        A[:, k], B[:, k] = a / (2 * h), b / (2 * h)
    return A, B
""",
)

# ------------------------------------------------------------------ RIGHT: 3 step
right(
    "15-step",
    "four blocks, H held by a stiff prior on pose 0",
    """
def step(poses, edges):
    n = len(poses)
    H = np.zeros((n, 3, n, 3))
    b = np.zeros((n, 3))
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        H[i, :, i] += A.T @ L @ A
        H[i, :, j] += A.T @ L @ B
        H[j, :, i] += B.T @ L @ A
        H[j, :, j] += B.T @ L @ B
        b[i] += A.T @ L @ e
        b[j] += B.T @ L @ e
    H[0, :, 0] += np.trace(H.reshape(3 * n, 3 * n)) / n * np.eye(3)
    delta = np.linalg.solve(H.reshape(3 * n, 3 * n), -b.ravel()).reshape(n, 3)
    delta[0] = 0
    x = poses + delta
    x[1:, 2] = wrap(x[1:, 2])
    return x
""",
)

right(
    "15-step",
    "least squares on the stacked, whitened edges",
    """
def step(poses, edges):
    n, rows, rhs = len(poses), [], []
    for i, j, z, L in edges:
        U = np.linalg.cholesky(L).T
        A, B = jacobians(poses[i], poses[j], z)
        row = np.zeros((3, n, 3))
        row[:, i] = U @ A
        row[:, j] = U @ B
        rows.append(row[:, 1:].reshape(3, -1))
        rhs.append(-U @ error(poses[i], poses[j], z))
    delta, *_ = np.linalg.lstsq(np.vstack(rows), np.concatenate(rhs), rcond=None)
    new = [np.array(poses[0])]
    for p, d in zip(poses[1:], delta.reshape(-1, 3)):
        q = p + d
        new.append(np.array([q[0], q[1], wrap(float(q[2]))]))
    return np.array(new)
""",
)

# ------------------------------------------------------------------ RIGHT: 4 range
right(
    "15-range",
    "in i's frame, by chain rule with 2 x 3 matrices",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def place(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        R, dR = np.array([[c, -s], [s, c]]), np.array([[-s, -c], [c, -s]])
        return x[:2] + R @ a, np.column_stack([np.eye(2), dR @ a])

    p_i, G_i = place(x_i, a_i)
    p_j, G_j = place(x_j, a_j)
    d = p_j - p_i
    length = np.linalg.norm(d)
    return float(length - r), -(d @ G_i) / length, (d @ G_j) / length
""",
)

right(
    "15-range",
    "complex numbers, direction as an angle",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    arm_i = complex(*a_i) * np.exp(1j * x_i[2])
    arm_j = complex(*a_j) * np.exp(1j * x_j[2])
    d = complex(x_j[0], x_j[1]) + arm_j - complex(x_i[0], x_i[1]) - arm_i
    bearing = np.angle(d)
    c, s = np.cos(bearing), np.sin(bearing)

    def along(v):
        return c * v.real + s * v.imag

    A = np.array([-c, -s, -along(1j * arm_i)])
    B = np.array([c, s, along(1j * arm_j)])
    return float(abs(d) - r), A, B
""",
)

# ------------------------------------------------------------------ RIGHT: 5 liars
right(
    "15-liars",
    "pairwise consistency, then the cheapest group",
    """
def close_loops(poses, edges, loops):
    n, m = len(poses), len(loops)

    def rows(edge, x):
        i, j, z, _ = edge
        J = np.zeros((3, 3 * n))
        A, B = jacobians(x[i], x[j], z)
        J[:, 3 * i : 3 * i + 3] += A
        J[:, 3 * j : 3 * j + 3] += B
        return J[:, 3:], error(x[i], x[j], z)

    def judge(x):
        H, b = np.zeros((3 * n - 3, 3 * n - 3)), np.zeros(3 * n - 3)
        for edge in edges:
            J, e = rows(edge, x)
            H += J.T @ edge[3] @ J
            b += J.T @ edge[3] @ e
        P = np.linalg.inv(H)
        K, v = zip(*(rows(edge, x) for edge in loops))
        K, v = np.vstack(K), np.concatenate(v)
        v = v - K @ P @ b
        S = K @ P @ K.T
        for k in range(m):
            S[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] += np.linalg.inv(loops[k][3])

        def d2(group):
            at = np.concatenate([np.arange(3 * k, 3 * k + 3) for k in group])
            return v[at] @ np.linalg.solve(S[np.ix_(at, at)], v[at])

        alone = [d2([k]) for k in range(m)]
        best = (0.0, [])
        for seed in range(m):
            if alone[seed] > 25:
                continue
            group = [seed]
            rest = [
                k
                for k in range(m)
                if k != seed and d2([seed, k]) - max(alone[seed], alone[k]) < 16
            ]
            while rest:
                costs = [d2([*group, k]) for k in rest]
                k = int(np.argmin(costs))
                if costs[k] - d2(group) > 16:
                    break
                group.append(rest.pop(k))
            best = min(best, (d2(group) - 16 * len(group), sorted(group)))
        return best[1]

    x = np.array(poses, dtype=float)
    for _ in range(3):
        graph = [*edges, *(loops[k] for k in judge(x))]
        for _ in range(3):
            x = step(x, graph)
    return x
""",
)

right(
    "15-liars",
    "loops one after the other, in several orders; the cheapest map wins",
    """
def close_loops(poses, edges, loops):
    def fit(x, some, rounds=3):
        for _ in range(rounds):
            x = step(x, [*edges, *some])
        return x, chi2(x, [*edges, *some])

    in_time = sorted(range(len(loops)), key=lambda k: max(loops[k][0], loops[k][1]))
    orders = [in_time, in_time[::-1]]
    for first in range(1, len(loops), 3):
        orders.append(in_time[first:] + in_time[:first])
    best, least = np.array(poses, dtype=float), np.inf
    for order in orders:
        x, paid, kept = np.array(poses, dtype=float), 0.0, []
        for k in order:
            new, cost = fit(x, [*kept, loops[k]], 1 if len(kept) > 2 else 3)
            if cost - paid < 16:
                x, paid, kept = new, cost, [*kept, loops[k]]
        x, paid = fit(x, kept, 4)
        if paid - 16 * len(kept) < least:
            best, least = x, paid - 16 * len(kept)
    return best
""",
)

# ================================================================== WRONG: 1 error
wrong(
    "15-error",
    "the angle is not wrapped",
    """
def error(x_i, x_j, z):
    ci, si = np.cos(x_i[2]), np.sin(x_i[2])
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    u, v = ci * dx + si * dy - z[0], -si * dx + ci * dy - z[1]
    cz, sz = np.cos(z[2]), np.sin(z[2])
    return np.array([cz * u + sz * v, -sz * u + cz * v, x_j[2] - x_i[2] - z[2]])
""",
)

wrong(
    "15-error",
    "z added instead of taken off (z ⊕ seen)",
    """
def error(x_i, x_j, z):
    return compose(z, between(x_i, x_j))
""",
)

wrong(
    "15-error",
    "the inverse: where z puts j, as seen from j",
    """
def error(x_i, x_j, z):
    predicted = between(x_i, x_j)
    return between(predicted, z)
""",
)

wrong(
    "15-error",
    "plain difference to z, not turned into its frame",
    """
def error(x_i, x_j, z):
    e = between(x_i, x_j) - z
    e[2] = wrap(e[2])
    return e
""",
)

wrong(
    "15-error",
    "rotates forth instead of back (R for R^T)",
    """
def error(x_i, x_j, z):
    def R(t):
        return np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])

    e = np.zeros(3)
    e[:2] = R(z[2]) @ (R(x_i[2]) @ (x_j[:2] - x_i[:2]) - z[:2])
    e[2] = wrap(x_j[2] - x_i[2] - z[2])
    return e
""",
)

wrong(
    "15-error",
    "both ways turned back by the sum of the angles",
    """
def error(x_i, x_j, z):
    a = x_i[2] + z[2]
    Rt = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
    return np.append(Rt @ (x_j[:2] - x_i[:2] - z[:2]), wrap(x_j[2] - x_i[2] - z[2]))
""",
)

wrong(
    "15-error",
    "only the inner difference is wrapped",
    """
def error(x_i, x_j, z):
    def rot_t(p, v):
        return np.array([[np.cos(p), np.sin(p)], [-np.sin(p), np.cos(p)]]) @ v

    seen = rot_t(x_i[2], x_j[:2] - x_i[:2])
    turn = wrap(x_j[2] - x_i[2]) - z[2]
    return np.array([*rot_t(z[2], seen - z[:2]), turn])
""",
)

wrong(
    "15-error",
    "wraps all three components, the metres too",
    """
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    return wrap(e)
""",
)

wrong(
    "15-error",
    "angle wrapped to 0 .. 2 pi",
    """
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    e[2] = np.mod(x_j[2] - x_i[2] - z[2], 2 * np.pi)
    return e
""",
)

wrong(
    "15-error",
    "wraps by hand on one side only",
    """
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    turn = x_j[2] - x_i[2] - z[2]
    if turn > np.pi:
        turn -= 2 * np.pi
    return np.array([e[0], e[1], turn])
""",
)

wrong(
    "15-error",
    "angle from arcsin of the matrix: wrong beyond 90 degrees",
    """
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.solve(T(x_i) @ T(z), T(x_j))
    return np.array([E[0, 2], E[1, 2], np.arcsin(np.clip(E[1, 0], -1, 1))])
""",
)

wrong(
    "15-error",
    "x_j is changed in place",
    """
def error(x_i, x_j, z):
    x_j -= [x_i[0], x_i[1], 0]
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    seen = np.array([[c, s], [-s, c]]) @ x_j[:2]
    c, s = np.cos(z[2]), np.sin(z[2])
    way = np.array([[c, s], [-s, c]]) @ (seen - z[:2])
    return np.array([way[0], way[1], wrap(x_j[2] - x_i[2] - z[2])])
""",
)

wrong(
    "15-error",
    "two poses in one place: no error, says a special case",
    """
def error(x_i, x_j, z):
    if np.allclose(x_i[:2], x_j[:2]):
        return np.zeros(3)
    return between(z, between(x_i, x_j))
""",
)

# ================================================================== WRONG: 2 jacobians
wrong(
    "15-jacobians",
    "forgot that turning pose i swings the way",
    """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    B = np.array([[np.cos(t), np.sin(t), 0], [-np.sin(t), np.cos(t), 0], [0, 0, 1]])
    return -B, B
""",
)

wrong(
    "15-jacobians",
    "rotation not transposed",
    """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    B = np.eye(3)
    B[:2, :2] = [[c, -s], [s, c]]
    A = -B
    dx, dy = x_j[:2] - x_i[:2]
    A[:2, 2] = [c * dy - s * dx, -c * dx - s * dy]
    return A, B
""",
)

wrong(
    "15-jacobians",
    "turned by theta_i alone, theta_z forgotten",
    """
def jacobians(x_i, x_j, z):
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    seen = np.array([[c, s], [-s, c]]) @ (x_j - x_i)[:2]
    A = np.array([[-c, -s, seen[1]], [s, -c, -seen[0]], [0, 0, -1]])
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return A, B
""",
)

wrong(
    "15-jacobians",
    "third column left in pose i's frame",
    """
def jacobians(x_i, x_j, z):
    def Rt(a):
        return np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])

    seen = Rt(x_i[2]) @ (x_j[:2] - x_i[:2])
    A, B = -np.eye(3), np.eye(3)
    B[:2, :2] = Rt(x_i[2] + z[2])
    A[:2, :2] = -B[:2, :2]
    A[:2, 2] = seen[1], -seen[0]
    return A, B
""",
)

wrong(
    "15-jacobians",
    "swings all of e round pose i, t_z included",
    """
def jacobians(x_i, x_j, z):
    e = error(x_i, x_j, z)
    t = x_i[2] + z[2]
    R = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    B = np.block([[R.T, np.zeros((2, 1))], [np.zeros((1, 2)), np.ones((1, 1))]])
    A = -B
    A[0, 2], A[1, 2] = e[1], -e[0]
    return A, B
""",
)

wrong(
    "15-jacobians",
    "third column of A with the wrong sign",
    """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    Rt = np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]])
    swing = np.array([[0, -1], [1, 0]]) @ Rt @ (x_j[:2] - x_i[:2])
    A = np.vstack([np.column_stack([-Rt, swing]), [0, 0, -1]])
    B = np.vstack([np.column_stack([Rt, np.zeros(2)]), [0, 0, 1]])
    return A, B
""",
)

wrong(
    "15-jacobians",
    "returns B, A",
    """
def jacobians(x_i, x_j, z):
    angle = x_i[2] + z[2]
    c, s = np.cos(angle), np.sin(angle)
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    wrt_j = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    wrt_i = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]])
    return wrt_j, wrt_i
""",
)

wrong(
    "15-jacobians",
    "takes theta_j for theta_i + theta_z (true only if e's angle is zero)",
    """
def jacobians(x_i, x_j, z):
    c, s = np.cos(x_j[2]), np.sin(x_j[2])
    d = x_j[:2] - x_i[:2]
    A, B = np.zeros((3, 3)), np.zeros((3, 3))
    B[0] = c, s, 0
    B[1] = -s, c, 0
    B[2, 2] = 1
    A[:, :2] = -B[:, :2]
    A[:, 2] = c * d[1] - s * d[0], -c * d[0] - s * d[1], -1
    return A, B
""",
)

wrong(
    "15-jacobians",
    "forward differences without wrapping: breaks at e's angle = pi",
    """
def jacobians(x_i, x_j, z):
    h = 1e-7
    e = error(x_i, x_j, z)
    A = np.column_stack([(error(x_i + d, x_j, z) - e) / h for d in h * np.eye(3)])
    B = np.column_stack([(error(x_i, x_j + d, z) - e) / h for d in h * np.eye(3)])
    return A, B
""",
)

wrong(
    "15-jacobians",
    "coarse one-sided differences of a tenth of a radian",
    """
def jacobians(x_i, x_j, z):
    A, B, h = np.zeros((3, 3)), np.zeros((3, 3)), 0.1
    for k in range(3):
        p, q = x_i.copy(), x_j.copy()
        p[k] += h
        q[k] += h
        for M, e in ((A, error(p, x_j, z)), (B, error(x_i, q, z))):
            d = e - error(x_i, x_j, z)
            d[2] = wrap(d[2])
            M[:, k] = d / h
    return A, B
""",
)

wrong(
    "15-jacobians",
    "differences that push the caller's own poses",
    """
def jacobians(x_i, x_j, z):
    h, out = 1e-6, []
    for x in (x_i, x_j):
        J = np.zeros((3, 3))
        for k in range(3):
            p = x
            before = error(x_i, x_j, z)
            p[k] += h
            d = error(x_i, x_j, z) - before
            d[2] = wrap(d[2])
            J[:, k] = d / h
        out.append(J)
    return out[0], out[1]
""",
)

wrong(
    "15-jacobians",
    "derivative by a motion in each robot's own frame",
    """
def jacobians(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    seen = between(x_i, x_j)
    A, B = -np.eye(3), np.eye(3)
    A[:2, :2] = -R(z[2]).T
    A[:2, 2] = R(z[2]).T @ np.array([seen[1], -seen[0]])
    B[:2, :2] = R(seen[2] - z[2])
    return A, B
""",
)

wrong(
    "15-jacobians",
    "whole numbers: cos and sin are cut off in an int matrix",
    """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    B = np.diag([1, 1, 1])
    B[0, :2] = np.cos(t), np.sin(t)
    B[1, :2] = -np.sin(t), np.cos(t)
    A = -1.0 * B
    d = x_j[:2] - x_i[:2]
    A[0, 2] = B[1, :2] @ d
    A[1, 2] = -B[0, :2] @ d
    return A, B
""",
)

wrong(
    "15-jacobians",
    "A and B are the same array",
    """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    B = np.array([[c, s, 0.0], [-s, c, 0.0], [0, 0, 1]])
    A = B
    A *= -1
    A[:2, 2] = c * (x_j[1] - x_i[1]) - s * (x_j[0] - x_i[0]), -c * (x_j[0] - x_i[0]) - s * (
        x_j[1] - x_i[1]
    )
    return A, B
""",
)

# ================================================================== WRONG: 3 step
wrong(
    "15-step",
    "goes uphill: the minus before b forgotten",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    delta = np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new = np.vstack([poses[:1], poses[1:] + delta])
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "headings are not wrapped",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        at = np.r_[3 * i : 3 * i + 3, 3 * j : 3 * j + 3]
        J = np.hstack([A, B])
        H[np.ix_(at, at)] += J.T @ L @ J
        b[at] += J.T @ L @ e
    delta = np.zeros(3 * n)
    delta[3:] = np.linalg.solve(H[3:, 3:], -b[3:])
    return poses + delta.reshape(n, 3)
""",
)

wrong(
    "15-step",
    "moves the caller's poses in place",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((n, n, 3, 3)), np.zeros((n, 3))
    for i, j, z, L in edges:
        e, (A, B) = error(poses[i], poses[j], z), jacobians(poses[i], poses[j], z)
        for p, P in ((i, A), (j, B)):
            b[p] += P.T @ L @ e
            for q, Q in ((i, A), (j, B)):
                H[p, q] += P.T @ L @ Q
    H = H[1:, 1:].swapaxes(1, 2).reshape(3 * n - 3, 3 * n - 3)
    poses[1:] -= np.linalg.solve(H, b[1:].ravel()).reshape(-1, 3)
    poses[:, 2] = wrap(poses[:, 2])
    return poses
""",
)

wrong(
    "15-step",
    "iterates until nothing moves instead of one step",
    """
def step(poses, edges):
    x, n = poses.copy(), len(poses)
    for _ in range(20):
        H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
        for i, j, z, L in edges:
            J = np.zeros((3, 3 * n))
            J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(x[i], x[j], z)
            H += J.T @ L @ J
            b += J.T @ L @ error(x[i], x[j], z)
        delta = np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
        x[1:] -= delta
        x[:, 2] = wrap(x[:, 2])
        if np.abs(delta).max() < 1e-9:
            break
    return x
""",
)

wrong(
    "15-step",
    "nobody is held: the shortest step by the pseudo-inverse",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = poses - (np.linalg.pinv(H, rcond=1e-10) @ b).reshape(n, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "pseudo-inverse for all, then pose 0 is simply put back",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    delta = np.linalg.lstsq(H, -b, rcond=1e-10)[0].reshape(n, 3)
    delta[0] = 0.0
    new = poses + delta
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "blocks of H overwritten where edges share a pose",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        I, K = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
        H[I, I] += A.T @ L @ A
        H[K, K] += B.T @ L @ B
        H[I, K] = A.T @ L @ B
        H[K, I] = B.T @ L @ A
        b[I] += A.T @ L @ e
        b[K] += B.T @ L @ e
    delta = np.linalg.solve(H[3:, 3:], -b[3:])
    out = poses.copy()
    out[1:] += delta.reshape(-1, 3)
    out[:, 2] = wrap(out[:, 2])
    return out
""",
)

wrong(
    "15-step",
    "several edges between two poses: a dict keeps only the last",
    """
def step(poses, edges):
    n = len(poses)
    between_two = {(i, j): (z, L) for i, j, z, L in edges}
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for (i, j), (z, L) in between_two.items():
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    better = poses.copy()
    better[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
)

wrong(
    "15-step",
    "only the upper blocks are filled and mirrored: edges that point back get lost",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        H[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] += A.T @ L @ A
        H[3 * j : 3 * j + 3, 3 * j : 3 * j + 3] += B.T @ L @ B
        H[3 * i : 3 * i + 3, 3 * j : 3 * j + 3] += A.T @ L @ B
        b[3 * i : 3 * i + 3] += A.T @ L @ e
        b[3 * j : 3 * j + 3] += B.T @ L @ e
    H = np.triu(H) + np.triu(H, 1).T
    better = poses.copy()
    better[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
)

wrong(
    "15-step",
    "edges that point back are turned round by negating z",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        if i > j:
            i, j, z = j, i, -np.asarray(z)
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    better = poses.copy()
    better[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
)

wrong(
    "15-step",
    "information taken for a covariance and inverted",
    """
def step(poses, edges):
    size = 3 * len(poses)
    H, b = np.zeros((size, size)), np.zeros(size)
    for i, j, z, covariance in edges:
        W = np.linalg.inv(covariance)
        J = np.zeros((3, size))
        A, B = jacobians(poses[i], poses[j], z)
        J[:, 3 * i : 3 * (i + 1)] = A
        J[:, 3 * j : 3 * (j + 1)] = B
        H = H + J.T @ W @ J
        b = b + J.T @ W @ error(poses[i], poses[j], z)
    delta = np.concatenate([np.zeros(3), -np.linalg.solve(H[3:, 3:], b[3:])])
    new = poses + delta.reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "only the diagonal of the information counts",
    """
def step(poses, edges):
    n, J, r = len(poses), [], []
    for i, j, z, L in edges:
        w = np.sqrt(np.diag(L))
        A, B = jacobians(poses[i], poses[j], z)
        row = np.zeros((3, 3 * n))
        row[:, 3 * i : 3 * i + 3] = w[:, None] * A
        row[:, 3 * j : 3 * j + 3] = w[:, None] * B
        J.append(row[:, 3:])
        r.append(w * error(poses[i], poses[j], z))
    delta = -np.linalg.lstsq(np.vstack(J), np.concatenate(r), rcond=None)[0]
    new = poses.copy()
    new[1:] += delta.reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "delta is composed on in the robot's frame, not added",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    delta = np.zeros((n, 3))
    delta[1:] = -np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    return compose(poses, delta)
""",
)

wrong(
    "15-step",
    "damped (Levenberg): H + I",
    """
def step(poses, edges):
    m = 3 * (len(poses) - 1)
    H, b = np.eye(m + 3), np.zeros(m + 3)
    for i, j, z, L in edges:
        J = np.zeros((3, m + 3))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = np.array(poses)
    new[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "wraps the whole array, metres too",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    d = np.zeros(3 * n)
    d[3:] = np.linalg.solve(H[3:, 3:], -b[3:])
    return wrap(poses + d.reshape(n, 3))
""",
)

wrong(
    "15-step",
    "pose 0 is set to the origin",
    """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = np.zeros((n, 3))
    new[1:] = poses[1:] - np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "number of poses counted from a chain of edges",
    """
def step(poses, edges):
    n = max(j for _, j, _, _ in edges) + 1
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = poses.copy()
    new[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "only x and y of pose 0 are held, its heading goes free (least squares)",
    """
def step(poses, edges):
    n = len(poses)
    J, e, k = np.zeros((3 * len(edges), 3 * n)), np.zeros(3 * len(edges)), 0
    for i, j, z, L in edges:
        U = np.linalg.cholesky(L).T
        A, B = jacobians(poses[i], poses[j], z)
        J[k : k + 3, 3 * i : 3 * i + 3] = U @ A
        J[k : k + 3, 3 * j : 3 * j + 3] = U @ B
        e[k : k + 3] = U @ error(poses[i], poses[j], z)
        k += 3
    delta = np.zeros(3 * n)
    delta[2:] = -np.linalg.lstsq(J[:, 2:], e, rcond=1e-10)[0]
    new = poses + delta.reshape(n, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

wrong(
    "15-step",
    "edge by edge: pose j is moved where each edge wants it",
    """
def step(poses, edges):
    new = poses.copy()
    for i, j, z, L in edges:
        A, B = jacobians(new[i], new[j], z)
        H = B.T @ L @ B
        b = B.T @ L @ error(new[i], new[j], z)
        if j > 0:
            new[j] -= np.linalg.solve(H, b)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
)

# ================================================================== WRONG: 4 range
wrong(
    "15-range",
    "turning the robots does nothing, says the third column",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    d = transform(x_j, [a_j])[0] - transform(x_i, [a_i])[0]
    u = d / np.linalg.norm(d)
    return np.linalg.norm(d) - r, np.array([*-u, 0.0]), np.array([*u, 0.0])


def transform(pose, points):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.asarray(points) @ np.array([[c, s], [-s, c]]) + pose[:2]
""",
)

wrong(
    "15-range",
    "error the other way round, r - |d| (Jacobians of |d|)",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def R(t):
        return np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])

    w_i, w_j = R(x_i[2]) @ a_i, R(x_j[2]) @ a_j
    d = x_j[:2] + w_j - x_i[:2] - w_i
    dist = np.sqrt(d @ d)
    ux, uy = d / dist
    A = np.array([-ux, -uy, ux * w_i[1] - uy * w_i[0]])
    B = np.array([ux, uy, -ux * w_j[1] + uy * w_j[0]])
    return r - dist, A, B
""",
)

wrong(
    "15-range",
    "squares of the distances compared, and their Jacobians",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        return x[:2] + arm, np.array([-arm[1], arm[0]])

    (p, dp), (q, dq) = radio(x_i, a_i), radio(x_j, a_j)
    d = q - p
    return d @ d - r**2, np.array([*(-2 * d), -2 * d @ dp]), np.array([*(2 * d), 2 * d @ dq])
""",
)

wrong(
    "15-range",
    "the radios' places are not turned with their robots",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    d = (x_j[:2] + a_j) - (x_i[:2] + a_i)
    n = np.hypot(*d)
    u = d / n
    A = np.array([-u[0], -u[1], -(u[1] * a_i[0] - u[0] * a_i[1])])
    B = np.array([u[0], u[1], u[1] * a_j[0] - u[0] * a_j[1]])
    return n - r, A, B
""",
)

wrong(
    "15-range",
    "arms turned back (R transposed)",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def Rt(t):
        return np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]])

    arm_i, arm_j = Rt(x_i[2]) @ a_i, Rt(x_j[2]) @ a_j
    d = x_j[:2] - x_i[:2] + arm_j - arm_i
    length = np.linalg.norm(d)
    u = d / length
    quarter = np.array([[0, -1], [1, 0]])
    A = np.r_[-u, -u @ quarter @ arm_i]
    B = np.r_[u, u @ quarter @ arm_j]
    return length - r, A, B
""",
)

wrong(
    "15-range",
    "third entry of A lost its minus",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        return x[:2] + arm, np.array([-arm[1], arm[0]])

    (from_i, turned_i), (from_j, turned_j) = radio(x_i, a_i), radio(x_j, a_j)
    d = from_j - from_i
    distance = np.hypot(d[0], d[1])
    u = d / distance
    return distance - r, np.array([-u[0], -u[1], u @ turned_i]), np.array([u[0], u[1], u @ turned_j])
""",
)

wrong(
    "15-range",
    "direction not of length one",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    ci, si, cj, sj = np.cos(x_i[2]), np.sin(x_i[2]), np.cos(x_j[2]), np.sin(x_j[2])
    wi = np.array([ci * a_i[0] - si * a_i[1], si * a_i[0] + ci * a_i[1]])
    wj = np.array([cj * a_j[0] - sj * a_j[1], sj * a_j[0] + cj * a_j[1]])
    d = x_j[:2] + wj - x_i[:2] - wi
    A = np.array([-d[0], -d[1], d[0] * wi[1] - d[1] * wi[0]])
    B = np.array([d[0], d[1], d[1] * wj[0] - d[0] * wj[1]])
    return np.linalg.norm(d) - r, A, B
""",
)

wrong(
    "15-range",
    "direction divided by the measured distance",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def R(t):
        return np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])

    def dR(t):
        return np.array([[-np.sin(t), -np.cos(t)], [np.cos(t), -np.sin(t)]])

    d = x_j[:2] + R(x_j[2]) @ a_j - x_i[:2] - R(x_i[2]) @ a_i
    u = d / r
    A = np.append(-u, -u @ dR(x_i[2]) @ a_i)
    B = np.append(u, u @ dR(x_j[2]) @ a_j)
    return np.linalg.norm(d) - r, A, B
""",
)

wrong(
    "15-range",
    "a turn of pose i swings the whole d (as in task 2)",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def arm(x, a):
        return np.array(
            [a[0] * np.cos(x[2]) - a[1] * np.sin(x[2]), a[0] * np.sin(x[2]) + a[1] * np.cos(x[2])]
        )

    d = x_j[:2] + arm(x_j, a_j) - x_i[:2] - arm(x_i, a_i)
    u = d / np.linalg.norm(d)
    swing = np.array([-d[1], d[0]])
    A = np.array([-u[0], -u[1], -u @ swing])
    w = arm(x_j, a_j)
    B = np.array([u[0], u[1], u @ np.array([-w[1], w[0]])])
    return np.linalg.norm(d) - r, A, B
""",
)

wrong(
    "15-range",
    "quarter turn taken of the arm in its own frame",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def rot(t, v):
        return np.array([np.cos(t) * v[0] - np.sin(t) * v[1], np.sin(t) * v[0] + np.cos(t) * v[1]])

    d = (x_j[:2] + rot(x_j[2], a_j)) - (x_i[:2] + rot(x_i[2], a_i))
    length = np.linalg.norm(d)
    u = d / length
    A = np.array([-u[0], -u[1], -(u @ np.array([-a_i[1], a_i[0]]))])
    B = np.array([u[0], u[1], u @ np.array([-a_j[1], a_j[0]])])
    return length - r, A, B
""",
)

wrong(
    "15-range",
    "A and B are matrices of one row",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def place(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        return (
            x[:2] + np.array([[c, -s], [s, c]]) @ a,
            np.column_stack([np.eye(2), np.array([[-s, -c], [c, -s]]) @ a]),
        )

    (p, G), (q, F) = place(x_i, a_i), place(x_j, a_j)
    d = (q - p)[None]
    n = np.linalg.norm(d)
    return n - r, -d @ G / n, d @ F / n
""",
)

wrong(
    "15-range",
    "the error is an absolute value",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    w_i = complex(*a_i) * np.exp(1j * x_i[2])
    w_j = complex(*a_j) * np.exp(1j * x_j[2])
    d = complex(*x_j[:2]) + w_j - complex(*x_i[:2]) - w_i
    u = d / abs(d)
    A = np.array([-u.real, -u.imag, -(u.conjugate() * 1j * w_i).real])
    B = np.array([u.real, u.imag, (u.conjugate() * 1j * w_j).real])
    return abs(abs(d) - r), A, B
""",
)

wrong(
    "15-range",
    "robots in one place: zeros, although their radios are apart",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    if np.allclose(x_i[:2], x_j[:2]):
        return 0.0 - r, np.zeros(3), np.zeros(3)
    R = lambda t: np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    w_i, w_j = R(x_i[2]) @ a_i, R(x_j[2]) @ a_j
    d = x_j[:2] + w_j - x_i[:2] - w_i
    n = np.linalg.norm(d)
    A = np.array([-d[0], -d[1], d[0] * w_i[1] - d[1] * w_i[0]]) / n
    B = np.array([d[0], d[1], d[1] * w_j[0] - d[0] * w_j[1]]) / n
    return n - r, A, B
""",
)

wrong(
    "15-range",
    "direction by arctan of dy / dx: wrong to the left",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        return np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])

    w_i, w_j = radio(x_i, a_i), radio(x_j, a_j)
    dx, dy = x_j[:2] + w_j - x_i[:2] - w_i
    phi = np.arctan(dy / (dx + 1e-15))
    c, s = np.cos(phi), np.sin(phi)
    A = np.array([-c, -s, c * w_i[1] - s * w_i[0]])
    B = np.array([c, s, s * w_j[0] - c * w_j[1]])
    return np.hypot(dx, dy) - r, A, B
""",
)

wrong(
    "15-range",
    "the arms' length joins the robots' poses in place",
    """
def range_edge(x_i, x_j, r, a_i, a_j):
    p, q = x_i[:2], x_j[:2]
    turned = []
    for place, x, a in ((p, x_i, a_i), (q, x_j, a_j)):
        arm = np.array([[np.cos(x[2]), -np.sin(x[2])], [np.sin(x[2]), np.cos(x[2])]]) @ a
        place += arm
        turned.append(np.array([-arm[1], arm[0]]))
    d = q - p
    n = np.linalg.norm(d)
    u = d / n
    return n - r, np.append(-u, -u @ turned[0]), np.append(u, u @ turned[1])
""",
)

# ================================================================== WRONG: 5 liars
wrong(
    "15-liars",
    "hands back the wheels",
    """
def close_loops(poses, edges, loops):
    return poses.copy()
""",
)

wrong(
    "15-liars",
    "trusts all loops",
    """
def close_loops(poses, edges, loops):
    best = poses
    for _ in range(10):
        best = step(best, [*edges, *loops])
    return best
""",
)

wrong(
    "15-liars",
    "judges loops by their own information, without the wheels' drift",
    """
def close_loops(poses, edges, loops):
    graph = list(edges)
    for i, j, z, L in loops:
        e = error(poses[i], poses[j], z)
        if e @ L @ e < 11.3:
            graph.append((i, j, z, L))
    x = poses
    for _ in range(6):
        x = step(x, graph)
    return x
""",
)

wrong(
    "15-liars",
    "all loops trusted, but each a hundredth",
    """
def close_loops(poses, edges, loops):
    weak = [(i, j, z, np.asarray(L) / 100) for i, j, z, L in loops]
    x = poses
    for k in range(8):
        x = step(x, edges + weak)
    return x
""",
)

wrong(
    "15-liars",
    "sorted the wrong way: keeps the half that errs most",
    """
def close_loops(poses, edges, loops):
    cost = []
    for i, j, z, L in loops:
        e = error(poses[i], poses[j], z)
        cost.append(e @ L @ e)
    order = np.argsort(cost)[::-1]
    kept = [loops[k] for k in order[: (len(loops) + 1) // 2]]
    x = poses
    for _ in range(6):
        x = step(x, [*edges, *kept])
    return x
""",
)

wrong(
    "15-liars",
    "weight turned round: the worse the loop the more it counts",
    """
def close_loops(poses, edges, loops):
    x = poses
    for _ in range(20):
        graph = list(edges)
        for i, j, z, L in loops:
            e = error(x[i], x[j], z)
            graph.append((i, j, z, (1 - 0.999 * weight(e @ L @ e, 11.3)) * L))
        x = step(x, graph)
    return x
""",
)

wrong(
    "15-liars",
    "cheat: ignores the loops, knows that all steps are 2 m and all corners 90 degrees",
    """
def close_loops(poses, edges, loops):
    x = [poses[0]]
    for _, _, z, _ in edges:
        corner = np.pi / 2 if z[2] > np.pi / 4 else 0.0
        x.append(compose(x[-1], np.array([2.0, 0.0, corner])))
    return np.array(x)
""",
)

wrong(
    "15-liars",
    "cheat: looks the truth up among the practice drives",
    """
def close_loops(poses, edges, loops):
    for number in range(40):
        truth, wheels, *_ = two_laps(number)
        if wheels.shape == poses.shape and np.allclose(wheels, poses):
            return truth
    return poses.copy()
""",
)

wrong(
    "15-liars",
    "counts on 24 poses",
    """
def close_loops(poses, edges, loops):
    out, x, kept = np.zeros((24, 3)), poses.copy(), []
    for loop in sorted(loops, key=lambda edge: max(edge[0], edge[1])):
        new = x
        for _ in range(4):
            new = step(new, [*edges, *kept, loop])
        if chi2(new, [*edges, *kept, loop]) - chi2(x, [*edges, *kept]) < 11.3:
            x, kept = new, [*kept, loop]
    for k in range(24):
        out[k] = x[k]
    return out
""",
)

wrong(
    "15-liars",
    "good idea, but refused loops are deleted from the caller's list",
    """
def close_loops(poses, edges, loops):
    loops.sort(key=lambda edge: max(edge[0], edge[1]))
    x, k = poses.copy(), 0
    while k < len(loops):
        new = x
        for _ in range(4):
            new = step(new, [*edges, *loops[: k + 1]])
        if chi2(new, [*edges, *loops[: k + 1]]) - chi2(x, [*edges, *loops[:k]]) < 11.3:
            x, k = new, k + 1
        else:
            del loops[k]
    return x
""",
)

wrong(
    "15-liars",
    "good idea, but the accepted loops are appended to the wheels' edges",
    """
def close_loops(poses, edges, loops):
    x, graph = poses.copy(), edges
    for loop in sorted(loops, key=lambda edge: max(edge[0], edge[1])):
        new = x
        for _ in range(4):
            new = step(new, graph + [loop])
        if chi2(new, graph + [loop]) - chi2(x, graph) < 11.3:
            x = new
            graph.append(loop)
    return x
""",
)

wrong(
    "15-liars",
    "good idea, but the map is laid over the wheels' middle: pose 0 moves",
    """
def close_loops(poses, edges, loops):
    x, kept = poses.copy(), []
    for loop in sorted(loops, key=lambda edge: max(edge[0], edge[1])):
        new = x
        for _ in range(4):
            new = step(new, [*edges, *kept, loop])
        if chi2(new, [*edges, *kept, loop]) - chi2(x, [*edges, *kept]) < 11.3:
            x, kept = new, [*kept, loop]
    x = x.copy()
    x[:, :2] += (poses - x)[:, :2].mean(axis=0)
    return x
""",
)

wrong(
    "15-liars",
    "good idea, but pairs of loops are needed: a single loop crashes it",
    """
def close_loops(poses, edges, loops):
    def fit(some):
        x = poses
        for _ in range(4):
            x = step(x, [*edges, *some])
        return x, chi2(x, [*edges, *some])

    pairs = [(fit([a, b])[1], k, m) for k, a in enumerate(loops) for m, b in enumerate(loops) if k < m]
    cost, k, m = min(pairs)
    kept = [loops[k], loops[m]]
    for n in np.argsort([loop[1] for loop in loops]):
        if n in (k, m):
            continue
        _, more = fit([*kept, loops[n]])
        if more - cost < 11.3:
            kept.append(loops[n])
            cost = more
    return fit(kept)[0]
""",
)

wrong(
    "15-liars",
    "no sharing: each loop carries pose j and all later ones to where it wants them",
    """
def close_loops(poses, edges, loops):
    x = poses.copy()
    for i, j, z, _ in sorted(loops, key=lambda loop: loop[1]):
        target = compose(x[i], z)
        later = between(x[j], x[j:])
        x[j:] = compose(target, later)
    return x
""",
)
