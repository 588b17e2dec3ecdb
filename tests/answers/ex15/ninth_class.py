"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "15-error",
        "pose j seen from compose(x_i, z), by homogeneous matrices",
        """
def error(x_i, x_j, z):
    def matrix(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.inv(matrix(x_i) @ matrix(z)) @ matrix(x_j)
    return np.array([E[0, 2], E[1, 2], np.arctan2(E[1, 0], E[0, 0])])
""",
    ),
    (
        "15-jacobians",
        "complex-step derivative of the unwrapped error",
        """
def jacobians(x_i, x_j, z):
    def e(v):
        a = v[2] + z[2]
        c, s, ci, si = np.cos(a), np.sin(a), np.cos(z[2]), np.sin(z[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return np.array([
            c * dx + s * dy - (ci * z[0] + si * z[1]),
            c * dy - s * dx - (ci * z[1] - si * z[0]),
            v[5] - v[2] - z[2],
        ])

    v = np.concatenate([x_i, x_j]).astype(complex)
    J = np.zeros((3, 6))
    for k in range(6):
        w = v.copy()
        w[k] += 1e-20j
        J[:, k] = e(w).imag / 1e-20
    return J[:, :3], J[:, 3:]
""",
    ),
    (
        "15-step",
        "whitened by the Cholesky factor of each information, one least-squares problem without pose 0",
        """
def step(poses, edges):
    n = len(poses)
    rows, rhs = [], []
    for i, j, z, information in edges:
        A, B = jacobians(poses[i], poses[j], z)
        U = np.linalg.cholesky(information).T
        J = np.zeros((3, n, 3))
        J[:, i] += A
        J[:, j] += B
        rows.append(U @ J.reshape(3, -1)[:, 3:])
        rhs.append(-U @ error(poses[i], poses[j], z))
    delta = np.linalg.lstsq(np.vstack(rows), np.concatenate(rhs), rcond=None)[0]
    new = np.array(poses, dtype=float)
    new[1:] += delta.reshape(-1, 3)
    new[:, 2] = np.arctan2(np.sin(new[:, 2]), np.cos(new[:, 2]))
    return new
""",
    ),
]

WRONG = [
    (
        "15-error",
        "the angle is not wrapped",
        """
def error(x_i, x_j, z):
    def back(angle):
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[c, s], [-s, c]])

    t = back(z[2]) @ (back(x_i[2]) @ (x_j[:2] - x_i[:2]) - z[:2])
    return np.array([t[0], t[1], x_j[2] - x_i[2] - z[2]])
""",
    ),
    (
        "15-error",
        "the difference from z is left in the frame of pose i: not turned by theta_z",
        """
def error(x_i, x_j, z):
    e = between(x_i, x_j) - z
    e[2] = wrap(e[2])
    return e
""",
    ),
    (
        "15-error",
        "rotations instead of their transposes",
        """
def error(x_i, x_j, z):
    def rot(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    d = rot(z[2]) @ (rot(x_i[2]) @ (x_j[:2] - x_i[:2]) - z[:2])
    return np.append(d, wrap(x_j[2] - x_i[2] - z[2]))
""",
    ),
    (
        "15-error",
        "the other way round: where z puts pose j, as seen from pose j",
        """
def error(x_i, x_j, z):
    return between(x_j, compose(x_i, z))
""",
    ),
    (
        "15-error",
        "turned by theta_i and theta_z at once, and p_z subtracted afterwards without being turned",
        """
def error(x_i, x_j, z):
    a = x_i[2] + z[2]
    c, s = np.cos(a), np.sin(a)
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    return np.array([c * dx + s * dy - z[0], -s * dx + c * dy - z[1], wrap(x_j[2] - x_i[2] - z[2])])
""",
    ),
    (
        "15-error",
        "all three components are wrapped, so metres beyond pi are wrapped, too",
        """
def error(x_i, x_j, z):
    return wrap(np.asarray(between(compose(x_i, z), x_j)))
""",
    ),
    (
        "15-error",
        "the angle is brought to 0 ... 2 pi (modulo) instead of -pi ... pi",
        """
def error(x_i, x_j, z):
    e = np.array(between(compose(x_i, z), x_j))
    e[2] = (x_j[2] - x_i[2] - z[2]) % (2 * np.pi)
    return e
""",
    ),
    (
        "15-jacobians",
        "the swing is missing: 0 in the third column of J_i",
        """
def jacobians(x_i, x_j, z):
    a = x_i[2] + z[2]
    B = np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])
    return -B, B
""",
    ),
    (
        "15-jacobians",
        "the swing has the wrong sign",
        """
def jacobians(x_i, x_j, z):
    a = x_i[2] + z[2]
    c, s = np.cos(a), np.sin(a)
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]])
    A = -B
    dx, dy = x_j[:2] - x_i[:2]
    A[:2, 2] = [s * dx - c * dy, c * dx + s * dy]
    return A, B
""",
    ),
    (
        "15-jacobians",
        "theta_z is forgotten: everything is turned by theta_i alone",
        """
def jacobians(x_i, x_j, z):
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    A = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]])
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return A, B
""",
    ),
    (
        "15-jacobians",
        "the swing is derived in the frame of pose i and not turned by theta_z",
        """
def jacobians(x_i, x_j, z):
    def rot_t(a):
        return np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])

    both = rot_t(x_i[2] + z[2])
    arm = rot_t(x_i[2]) @ (x_j[:2] - x_i[:2])
    A, B = np.zeros((3, 3)), np.eye(3)
    A[:2, :2], B[:2, :2] = -both, both
    A[:2, 2] = arm[1], -arm[0]
    A[2, 2] = -1
    return A, B
""",
    ),
    (
        "15-jacobians",
        "the swing is that of the error (p_z taken off) instead of the way from i to j",
        """
def jacobians(x_i, x_j, z):
    a = x_i[2] + z[2]
    c, s = np.cos(a), np.sin(a)
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    A = -B
    e = error(x_i, x_j, z)
    A[0, 2], A[1, 2] = e[1], -e[0]
    return A, B
""",
    ),
    (
        "15-jacobians",
        "difference quotients of the wrapped error: enormous where the angle jumps at pi",
        """
def jacobians(x_i, x_j, z):
    h = 1e-6
    A, B = np.zeros((3, 3)), np.zeros((3, 3))
    for k in range(3):
        d = np.zeros(3)
        d[k] = h
        A[:, k] = (error(x_i + d, x_j, z) - error(x_i - d, x_j, z)) / (2 * h)
        B[:, k] = (error(x_i, x_j + d, z) - error(x_i, x_j - d, z)) / (2 * h)
    return A, B
""",
    ),
    (
        "15-jacobians",
        "J_j swings as well: a third column in J_j that belongs to J_i alone",
        """
def jacobians(x_i, x_j, z):
    angle = x_i[2] + z[2]
    c, s = np.cos(angle), np.sin(angle)
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    A = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]])
    return A, -A
""",
    ),
    (
        "15-step",
        "the minus sign is missing: delta goes uphill",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        si, sj = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
        H[si, si] += A.T @ L @ A
        H[si, sj] += A.T @ L @ B
        H[sj, si] += B.T @ L @ A
        H[sj, sj] += B.T @ L @ B
        b[si] += A.T @ L @ e
        b[sj] += B.T @ L @ e
    new = poses.copy()
    new[1:] += np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "pose 0 is not held: the pseudo-inverse of the singular matrix moves all poses",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = poses - (np.linalg.pinv(H) @ b).reshape(n, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "information is ignored: every edge counts alike",
        """
def step(poses, edges):
    n = len(poses)
    J, e = np.zeros((3 * len(edges), 3 * n)), np.zeros(3 * len(edges))
    for k, (i, j, z, _) in enumerate(edges):
        A, B = jacobians(poses[i], poses[j], z)
        J[3 * k : 3 * k + 3, 3 * i : 3 * i + 3] = A
        J[3 * k : 3 * k + 3, 3 * j : 3 * j + 3] = B
        e[3 * k : 3 * k + 3] = error(poses[i], poses[j], z)
    delta = np.linalg.lstsq(J[:, 3:], -e, rcond=None)[0]
    new = poses.copy()
    new[1:] += delta.reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "the off-diagonal block is added at (i, j) only: the matrix is not symmetric",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((n, n, 3, 3)), np.zeros((n, 3))
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        H[i, i] += A.T @ L @ A
        H[j, j] += B.T @ L @ B
        H[i, j] += A.T @ L @ B
        b[i] += A.T @ L @ e
        b[j] += B.T @ L @ e
    M = H.transpose(0, 2, 1, 3).reshape(3 * n, 3 * n)
    new = poses.copy()
    new[1:] -= np.linalg.solve(M[3:, 3:], b.ravel()[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "blocks of two poses are set, not added: of several edges between the same two only the last counts there",
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
    delta = np.linalg.solve(H[3:, 3:], -b[3:]).reshape(-1, 3)
    better = np.vstack([poses[:1], poses[1:] + delta])
    better[:, 2] = wrap(better[:, 2])
    return better
""",
    ),
    (
        "15-step",
        "delta is composed onto the poses (in their own frames) instead of added number by number",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, information in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ information @ J
        b += J.T @ information @ error(poses[i], poses[j], z)
    delta = -np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    return np.array([poses[0]] + [compose(p, d) for p, d in zip(poses[1:], delta)])
""",
    ),
    (
        "15-step",
        "goes on until nothing changes instead of one step",
        """
def step(poses, edges):
    x = poses.copy()
    for _ in range(20):
        n = len(x)
        H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
        for i, j, z, L in edges:
            J = np.zeros((3, 3 * n))
            J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(x[i], x[j], z)
            H += J.T @ L @ J
            b += J.T @ L @ error(x[i], x[j], z)
        delta = -np.linalg.solve(H[3:, 3:], b[3:])
        x[1:] += delta.reshape(-1, 3)
        x[:, 2] = wrap(x[:, 2])
        if np.abs(delta).max() < 1e-9:
            break
    return x
""",
    ),
    (
        "15-step",
        "new headings are not wrapped",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, information in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        W = J.T @ information
        H, b = H + W @ J, b + W @ error(poses[i], poses[j], z)
    out = poses.copy()
    out[1:] = out[1:] - np.linalg.solve(H[3:, 3:], b[3:]).reshape(n - 1, 3)
    return out
""",
    ),
    (
        "15-step",
        "damped: a tenth of the diagonal is added before solving (Levenberg), so the step is too short",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, information in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ information @ J
        b += J.T @ information @ error(poses[i], poses[j], z)
    H += 0.1 * np.diag(np.diag(H))
    delta = -np.linalg.solve(H[3:, 3:], b[3:])
    better = poses.copy()
    better[1:] += delta.reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
    ),
    (
        "15-range",
        "headings never matter: third entries of both rows are 0",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def place(x, a):
        return compose(x, np.array([a[0], a[1], 0.0]))[:2]

    d = place(x_j, a_j) - place(x_i, a_i)
    length = np.linalg.norm(d)
    u = d / length
    return length - r, np.append(-u, 0), np.append(u, 0)
""",
    ),
    (
        "15-range",
        "d itself instead of its unit vector in the rows: not divided by the distance",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def rot(t):
        return np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])

    S = np.array([[0, -1], [1, 0]])
    ri, rj = rot(x_i[2]) @ a_i, rot(x_j[2]) @ a_j
    d = x_j[:2] + rj - x_i[:2] - ri
    A = np.array([-d[0], -d[1], -d @ (S @ ri)])
    B = np.array([d[0], d[1], d @ (S @ rj)])
    return np.sqrt(d @ d) - r, A, B
""",
    ),
    (
        "15-range",
        "the heading's entry takes the arm in the robot's frame, not turned by its heading",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def at(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        return np.array([x[0] + c * a[0] - s * a[1], x[1] + s * a[0] + c * a[1]])

    d = at(x_j, a_j) - at(x_i, a_i)
    dist = np.hypot(*d)
    u = d / dist
    A = np.array([-u[0], -u[1], u[0] * a_i[1] - u[1] * a_i[0]])
    B = np.array([u[0], u[1], u[1] * a_j[0] - u[0] * a_j[1]])
    return dist - r, A, B
""",
    ),
    (
        "15-range",
        "the radios are taken to sit at the centres: arms left out everywhere",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    d = x_j[:2] - x_i[:2]
    n = np.linalg.norm(d)
    u = d / n
    return n - r, np.array([-u[0], -u[1], 0.0]), np.array([u[0], u[1], 0.0])
""",
    ),
    (
        "15-range",
        "derivative of the heading along the arm instead of across it (Rot a, not its perpendicular)",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    ci, si, cj, sj = np.cos(x_i[2]), np.sin(x_i[2]), np.cos(x_j[2]), np.sin(x_j[2])
    arm_i = np.array([[ci, -si], [si, ci]]) @ a_i
    arm_j = np.array([[cj, -sj], [sj, cj]]) @ a_j
    d = x_j[:2] + arm_j - (x_i[:2] + arm_i)
    rho = np.sqrt(d[0] ** 2 + d[1] ** 2)
    u = d / rho
    return rho - r, np.array([*-u, -u @ arm_i]), np.array([*u, u @ arm_j])
""",
    ),
    (
        "15-range",
        "error as r - |d|, rows to match: all signs the other way round",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def f(v):
        ci, si, cj, sj = np.cos(v[2]), np.sin(v[2]), np.cos(v[5]), np.sin(v[5])
        dx = v[3] + cj * a_j[0] - sj * a_j[1] - v[0] - ci * a_i[0] + si * a_i[1]
        dy = v[4] + sj * a_j[0] + cj * a_j[1] - v[1] - si * a_i[0] - ci * a_i[1]
        return r - np.sqrt(dx**2 + dy**2)

    v = np.concatenate([x_i, x_j]).astype(float)
    g = np.zeros(6)
    for k in range(6):
        e = np.zeros(6)
        e[k] = 1e-5
        g[k] = (f(v + e) - f(v - e)) / 2e-5
    return f(v), g[:3], g[3:]
""",
    ),
    (
        "15-range",
        "sign of pose i's heading entry: its arm is taken with a plus",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        return x[:2] + arm, np.array([-arm[1], arm[0]])

    (pi, ti), (pj, tj) = radio(x_i, a_i), radio(x_j, a_j)
    d = pj - pi
    dist = np.linalg.norm(d)
    u = d / dist
    return dist - r, np.hstack([-u, u @ ti]), np.hstack([u, u @ tj])
""",
    ),
    (
        "15-liars",
        "all loops are refused: the wheels alone",
        """
def close_loops(poses, edges, loops):
    return poses.copy()
""",
    ),
    (
        "15-liars",
        "all loops are trusted",
        """
def close_loops(poses, edges, loops):
    found = poses
    for _ in range(5):
        found = step(found, [*edges, *loops])
    return found
""",
    ),
    (
        "15-liars",
        "loops are only weighed as in the hall, beginning with all of them: the six that agree win",
        """
def close_loops(poses, edges, loops):
    x = poses
    for k in range(15):
        phi = max(11.3, 1e5 / 2**k)
        graph = list(edges)
        for i, j, z, L in loops:
            e = error(x[i], x[j], z)
            graph.append((i, j, z, weight(e @ L @ e, phi) * L))
        x = step(x, graph)
    return x
""",
    ),
    (
        "15-liars",
        "a fixed gate: loops that claim more than a metre or 0.5 rad off the wheels are refused, whatever way lies between",
        """
def close_loops(poses, edges, loops):
    good = []
    for i, j, z, L in loops:
        e = error(poses[i], poses[j], z)
        if np.hypot(e[0], e[1]) < 1.0 and abs(e[2]) < 0.5:
            good.append((i, j, z, L))
    x = poses
    for _ in range(4):
        x = step(x, list(edges) + good)
    return x
""",
    ),
    (
        "15-liars",
        "trusts all and throws out the loop with the largest chi2, one after the other: honest loops go first where the liars agree",
        """
def close_loops(poses, edges, loops):
    kept = list(loops)
    while True:
        x = poses
        for _ in range(3):
            x = step(x, list(edges) + kept)
        if not kept:
            return x
        costs = []
        for i, j, z, L in kept:
            e = error(x[i], x[j], z)
            costs.append(e @ L @ e)
        worst = int(np.argmax(costs))
        if costs[worst] < 11.3:
            return x
        kept.pop(worst)
""",
    ),
]
