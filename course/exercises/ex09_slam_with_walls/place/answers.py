# %% way: in sums, α not wrapped
def place(x, P, z, R):
    a = x[2] + z[1]
    J = np.array([[np.cos(a), np.sin(a), 0], [0, 0, 1.0]])
    J[0, 2] = -x[0] * np.sin(a) + x[1] * np.cos(a)
    G = np.eye(2)
    G[0, 1] = J[0, 2]
    C = [[sum(J[i, k] * P[k, l] * J[m, l] for k in range(3) for l in range(3))
          + sum(G[i, k] * R[k, l] * G[m, l] for k in range(2) for l in range(2))
          for m in range(2)] for i in range(2)]
    return [z[0] + x[0] * J[0, 0] + x[1] * J[0, 1], a], np.array(C), (P @ J.T).T

# %% way: by complex numbers
def place(x, P, z, R):
    way = np.exp(1j * (x[2] + z[1]))
    inside = (x[0] + 1j * x[1]) * np.conj(way)
    J = np.array([[way.real, way.imag, inside.imag, 1, inside.imag], [0, 0, 1, 0, 1]])
    full = np.zeros((5, 5))
    full[:3, :3], full[3:, 3:] = P, R
    X = J @ full
    return np.array([z[0] + inside.real, np.angle(way)]), X @ J.T, X[:, :3]

# %% way: by the moved foot
def place(x, P, z, R):
    alpha = np.arctan2(np.sin(x[2] + z[1]), np.cos(x[2] + z[1]))
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    tangent = np.array([-np.sin(alpha), np.cos(alpha)])
    foot = x[:2] + z[0] * normal
    J_x = np.vstack([np.append(normal, tangent @ foot), [0, 0, 1]])
    J_z = np.eye(2)
    J_z[0, 1] = foot @ tangent
    C = np.einsum("ai,ij,bj->ab", J_x, P, J_x) + np.linalg.multi_dot([J_z, R, J_z.T])
    return (normal @ foot, alpha), C, J_x.dot(P)

# %% right: rows by hand, lists returned
def place(x, P, z, R):
    a = x[2] + z[1]
    side = -x[0] * np.sin(a) + x[1] * np.cos(a)
    Jr = [[np.cos(a), np.sin(a), side], [0, 0, 1]]
    Jz = [[1, side], [0, 1]]
    Jr, Jz = np.matrix(Jr), np.matrix(Jz)
    line = [z[0] + x[0] * np.cos(a) + x[1] * np.sin(a), a]
    return line, np.asarray(Jr * P * Jr.T + Jz * R * Jz.T), np.asarray(Jr * P)

# %% right: foot of the perpendicular: rho as a scalar product, no wrap by hand
def place(x, P, z, R):
    alpha = wrap(z[1] + x[2])
    n = np.array([np.cos(alpha), np.sin(alpha)])
    dn = np.array([-n[1], n[0]])
    rho = n @ (x[:2] + z[0] * n)
    Jx = np.zeros((2, 3))
    Jx[0, :2] = n
    Jx[0, 2] = dn @ x[:2]
    Jx[1, 2] = 1
    Jz = np.eye(2)
    Jz[0, 1] = dn @ x[:2]
    X = Jx @ P
    return np.array([rho, alpha]), X @ Jx.T + Jz @ R @ Jz.T, X

# %% right: Jacobians by a complex step
def place(x, P, z, R):
    def line(v):
        a = v[2] + v[4]
        return np.array([v[3] + v[0] * np.cos(a) + v[1] * np.sin(a), a])
    v = np.concatenate([x, z]).astype(complex)
    J = np.column_stack([line(v + 1e-30j * e).imag / 1e-30 for e in np.eye(5)])
    found = line(v).real
    found[1] = wrap(found[1])
    Jr, Jz = J[:, :3], J[:, 3:]
    return found, Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P

# %% wrong: by differences
def place(x, P, z, R):
    def f(s):
        n = np.array([np.cos(s[2] + s[4]), np.sin(s[2] + s[4])])
        return np.array([(s[:2] + s[3] * n) @ n, s[2] + s[4]])
    s = np.concatenate([x, z])
    J = np.column_stack([(f(s + e) - f(s - e)) / 2e-6 for e in 1e-6 * np.eye(5)])
    full = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    return f(s), J @ full @ J.T, J[:, :3] @ P

# %% wrong: by seven-point differences with a step of 0.08
def place(x, P, z, R):
    def line(q):
        a = q[2] + q[4]
        return np.array([q[3] + q[0] * np.cos(a) + q[1] * np.sin(a), a])
    q, J = np.append(x, z), np.zeros((2, 5))
    for k, e in enumerate(0.08 * np.eye(5)):
        for times, weight in ((1, 0.75), (2, -0.15), (3, 1 / 60)):
            J[:, k] += weight * (line(q + times * e) - line(q - times * e)) / 0.08
    X = J[:, :3] @ P
    return line(q), X @ J[:, :3].T + J[:, 3:] @ R @ J[:, 3:].T, X

# %% wrong: the covariance by unscented points, the mean of them for the line
def place(x, P, z, R):
    s = np.concatenate([x, z])
    full = np.zeros((5, 5))
    full[:3, :3], full[3:, 3:] = P, R
    root = np.linalg.cholesky(5 * full)
    points = np.vstack([s + root.T, s - root.T])
    a = points[:, 2] + points[:, 4]
    lines = np.column_stack([points[:, 3] + points[:, 0] * np.cos(a) + points[:, 1] * np.sin(a), a])
    mean = lines.mean(axis=0)
    off, pose = lines - mean, points[:, :3] - x
    return mean, off.T @ off / 10, off.T @ pose / 10

# %% wrong: makes rho positive: flips the normal by pi where rho comes out negative
def place(x, P, z, R):
    alpha = x[2] + z[1]
    c, s = np.cos(alpha), np.sin(alpha)
    rho = z[0] + x[0] * c + x[1] * s
    k = -x[0] * s + x[1] * c
    Jr = np.array([[c, s, k], [0, 0, 1.0]])
    Jz = np.array([[1, k], [0, 1.0]])
    if rho < 0:
        rho, alpha = -rho, alpha + np.pi
        Jr[0], Jz[0] = -Jr[0], -Jz[0]
    return np.array([rho, wrap(alpha)]), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P

# %% wrong: uses the heading theta instead of alpha in rho and in its derivatives
def place(x, P, z, R):
    def line_of(v):
        px, py, th, r, a = v
        return np.array([r + px * np.cos(th) + py * np.sin(th), th + a])

    v = np.concatenate([x, z])
    J = np.zeros((2, 5))
    for k in range(5):
        d = np.zeros(5)
        d[k] = 1e-6
        J[:, k] = (line_of(v + d) - line_of(v - d)) / 2e-6
    big = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    line = line_of(v)
    line[1] = wrap(line[1])
    return line, J @ big @ J.T, J[:, :3] @ P

# %% wrong: alpha' without theta in the cosine
def place(x, P, z, R):
    c, s = np.cos(z[1]), np.sin(z[1])
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, wrap(x[2] + z[1])])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P

# %% wrong: X is P J_x', shape (3, 2)
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, alpha])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, P @ J_x.T

# %% wrong: only the diagonal of P
def place(x, P, z, R):
    a = wrap(x[2] + z[1])
    c, s = np.cos(a), np.sin(a)
    d = -x[0] * s + x[1] * c
    var = np.diag(np.diag(P))
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, a])
    return line, J_x @ var @ J_x.T + J_z @ R @ J_z.T, J_x @ var

# %% wrong: alpha wrapped by mod pi: a line has no direction
def place(x, P, z, R):
    a = (x[2] + z[1]) % np.pi
    c, s = np.cos(a), np.sin(a)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, a])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
