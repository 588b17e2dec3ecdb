# %% way: differentiated by hand
def end_point(x, P, j, beta, sigma):
    px, py, theta = x[:3]
    rho, alpha = x[3 + 2 * j], x[4 + 2 * j]
    c, s, cp, sp = np.cos(alpha), np.sin(alpha), np.cos(theta + beta), np.sin(theta + beta)
    D = c * cp + s * sp
    r = (rho - px * c - py * s) / D
    r_phi = r * np.sin(theta + beta - alpha) / D
    r_alpha = (px * s - py * c) / D - r_phi
    u, w = np.array([cp, sp]), np.array([-sp, cp])
    J = np.zeros((2, len(x)))
    J[:, 0] = np.array([1, 0]) - u * c / D
    J[:, 1] = np.array([0, 1]) - u * s / D
    J[:, 2] = r_phi * u + r * w
    J[:, 3 + 2 * j] = u / D
    J[:, 4 + 2 * j] = r_alpha * u
    C = J @ P @ J.T + sigma**2 * np.outer(J[:, 2], J[:, 2])
    return np.array([px, py]) + r * u, C, J @ P

# %% way: by a complex step
def end_point(x, P, j, beta, sigma):
    def f(s, beta):
        a, b = s[3 + 2 * j], s[4 + 2 * j]
        t = np.array([-np.sin(b), np.cos(b)])
        n = np.array([np.cos(b), np.sin(b)])
        ahead = a - n @ s[:2]
        return a * n + (t @ s[:2] + ahead * np.tan(s[2] + beta - b)) * t
    step = 1e-30j * np.eye(len(x) + 1)
    J = np.array([f(x + e[:-1], beta + e[-1]).imag / 1e-30 for e in step]).T
    X = J[:, :-1] @ P
    return f(x, beta), X @ J[:, :-1].T + sigma**2 * np.outer(J[:, -1], J[:, -1]), X

# %% way: five numbers, the cross of two lines
def end_point(x, P, j, beta, sigma):
    at = [0, 1, 2, 3 + 2 * j, 4 + 2 * j]
    px, py, theta, rho, alpha = x[at]
    phi = theta + beta
    A = np.array([[np.cos(alpha), np.sin(alpha)], [-np.sin(phi), np.cos(phi)]])
    p = np.linalg.inv(A) @ [rho, px * A[1, 0] + py * A[1, 1]]
    along = np.array([-np.sin(alpha), np.cos(alpha)]) @ p
    r = np.hypot(p[0] - px, p[1] - py)
    J = np.linalg.inv(A) @ [[0, 0, 0, 1, -along], [A[1, 0], A[1, 1], r, 0, 0]]
    C = P[np.ix_(at, at)].copy()
    C[2, 2] += sigma**2
    return list(p), J @ C @ J.T, J @ P[at]

# %% pasted: place, of the wall as it is expected
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j : 5 + 2 * j]
    z = np.array([rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha), beta])
    line, C, X = place(x[:3], P[:3, :3], z, np.diag([0, sigma**2]))
    return line, C, np.hstack([X, np.zeros((2, len(x) - 3))])

# %% pasted: a point landmark, of lesson 06
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j : 5 + 2 * j]
    a = x[2] + beta
    r = (rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)) / np.cos(a - alpha)
    J = np.array([[1, 0, -r * np.sin(a)], [0, 1, r * np.cos(a)]])
    J_z = np.array([[np.cos(a), -r * np.sin(a)], [np.sin(a), r * np.cos(a)]])
    C = J @ P[:3, :3] @ J.T + J_z @ np.diag([0, sigma**2]) @ J_z.T
    return x[:2] + r * np.array([np.cos(a), np.sin(a)]), C, J @ P[:3]

# %% right: complex-step differentiation
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j

    def meet(y):
        x_, b = y[:-1], y[-1]
        c, s = np.cos(x_[at + 1]), np.sin(x_[at + 1])
        u = np.array([np.cos(x_[2] + b), np.sin(x_[2] + b)])
        r = (x_[at] - c * x_[0] - s * x_[1]) / (c * u[0] + s * u[1])
        return x_[:2] + r * u

    y = np.append(x, beta)
    J = np.zeros((2, len(y)))
    for i in range(len(y)):
        step = y.astype(complex)
        step[i] += 1e-30j
        J[:, i] = meet(step).imag / 1e-30
    A, b = J[:, :-1], J[:, -1:]
    return meet(y), A @ P @ A.T + sigma ** 2 * b @ b.T, A @ P

# %% wrong: differences over five points
def end_point(x, P, j, beta, sigma):
    x = np.array(x, dtype=float)
    n = len(x)
    a = 3 + 2 * j

    def end(s):
        phi = s[2] + s[n]
        r = (s[a] - s[0] * np.cos(s[a + 1]) - s[1] * np.sin(s[a + 1])) / np.cos(phi - s[a + 1])
        return np.array([s[0] + r * np.cos(phi), s[1] + r * np.sin(phi)])

    full = np.append(x, beta)
    J = np.zeros((2, n + 1))
    for k in range(n + 1):
        h = np.zeros(n + 1)
        h[k] = 1e-5
        J[:, k] = (8 * (end(full + h) - end(full - h)) - (end(full + 2 * h) - end(full - 2 * h))) / 12e-5
    big = np.zeros((n + 1, n + 1))
    big[:n, :n] = P
    big[n, n] = sigma**2
    return end(full), J @ big @ J.T, J[:, :n] @ P

# %% wrong: X is (n, 2)
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), P @ J.T

# %% wrong: wall j begins at 3 + j
def end_point(x, P, j, beta, sigma):
    k = 3 + j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P

# %% wrong: half-finished: a round ellipse of r sigma, X zero
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    c, s = np.cos(x[k + 1]), np.sin(x[k + 1])
    u = np.array([np.cos(x[2] + beta), np.sin(x[2] + beta)])
    r = (x[k] - c * x[0] - s * x[1]) / (c * u[0] + s * u[1])
    return x[:2] + r * u, P[:2, :2] + (r * sigma) ** 2 * np.eye(2), np.zeros((2, len(x)))

# %% wrong: β from the world's x
def end_point(x, P, j, beta, sigma):
    def f(s, b):
        rho, a = s[3 + 2 * j], s[4 + 2 * j]
        n, u = np.array([np.cos(a), np.sin(a)]), np.array([np.cos(b), np.sin(b)])
        return s[:2] + (rho - n @ s[:2]) / (n @ u) * u
    J = np.column_stack([(f(x + e, beta) - f(x - e, beta)) / 2e-6 for e in 1e-6 * np.eye(len(x))])
    b = (f(x, beta + 1e-6) - f(x, beta - 1e-6)) / 2e-6
    return f(x, beta), J @ P @ J.T + sigma ** 2 * np.outer(b, b), J @ P

# %% wrong: divides by cos(alpha - beta): the angle between normal and beam without the heading
def end_point(x, P, j, beta, sigma):
    i = 3 + 2 * j

    def hit(v):
        r = (v[i] - v[0] * np.cos(v[i + 1]) - v[1] * np.sin(v[i + 1])) / np.cos(v[i + 1] - v[-1])
        return np.array([v[0] + r * np.cos(v[2] + v[-1]), v[1] + r * np.sin(v[2] + v[-1])])

    v = np.append(x, beta)
    J = np.empty((2, v.size))
    for k in range(v.size):
        step = np.zeros(v.size)
        step[k] = 1e-6
        J[:, k] = (hit(v + step) - hit(v - step)) / 2e-6
    C = J[:, :-1] @ P @ J[:, :-1].T + sigma**2 * np.outer(J[:, -1], J[:, -1])
    return hit(v), C, J[:, :-1] @ P

# %% wrong: the end's place measured as range and bearing, as a landmark is placed
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j : 5 + 2 * j]
    c, s = np.cos(x[2] + beta), np.sin(x[2] + beta)
    away = rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)
    r = away / np.cos(x[2] + beta - alpha)
    p = x[:2] + r * np.array([c, s])
    J = np.array([[1, 0, -r * s], [0, 1, r * c]])
    Jz = np.array([[c, -r * s], [s, r * c]])
    var_r = P[3 + 2 * j, 3 + 2 * j]
    C = J @ P[:3, :3] @ J.T + Jz @ np.diag([var_r, sigma**2]) @ Jz.T
    return p, C, J @ P[:3]

# %% wrong: pose and wall as if they erred on their own
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    def point(v, b):
        phi = v[2] + b
        r = (v[3] - v[0] * np.cos(v[4]) - v[1] * np.sin(v[4])) / np.cos(phi - v[4])
        return v[:2] + r * np.array([np.cos(phi), np.sin(phi)])
    v = np.concatenate([x[:3], x[k : k + 2]])
    e = 1e-6
    J = np.column_stack(
        [(point(v + e * d, beta) - point(v - e * d, beta)) / (2 * e) for d in np.eye(5)]
    )
    w = ((point(v, beta + e) - point(v, beta - e)) / (2 * e))[:, None]
    Jr, Jl = J[:, :3], J[:, 3:]
    C = Jr @ P[:3, :3] @ Jr.T + Jl @ P[k : k + 2, k : k + 2] @ Jl.T + sigma**2 * w @ w.T
    X = np.zeros((2, len(x)))
    X[:, :3] = Jr @ P[:3, :3]
    X[:, k : k + 2] = Jl @ P[k : k + 2, k : k + 2]
    return point(v, beta), C, X
