"""Independent answers to 06-augment: right ones, and students' mistakes."""

RIGHT = [
    (
        "06-augment",
        "one big Jacobian, G P G' + J R J'",
        """
def augment(x, P, z, R):
    n = len(x)
    G = np.vstack([np.eye(n), np.zeros((2, n))])
    G[n:, :3] = J_xr(x[:3], z)
    N = np.zeros((n + 2, 2))
    N[n:] = J_z(x[:3], z)
    return np.concatenate([x, g(x[:3], z)]), G @ P @ G.T + N @ R @ N.T
""",
    ),
    (
        "06-augment",
        "block after block, landmarks in a loop, by hand",
        """
def augment(x, P, z, R):
    r, a = z[0], x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    n = x.size
    Jx = np.array([[1.0, 0.0, -r * s], [0.0, 1.0, r * c]])
    Jm = np.array([[c, -r * s], [s, r * c]])
    x_new = np.empty(n + 2)
    x_new[:n] = x
    x_new[n], x_new[n + 1] = x[0] + r * c, x[1] + r * s
    P_new = np.zeros((n + 2, n + 2))
    P_new[:n, :n] = P
    P_new[n:, n:] = Jx @ P[:3, :3] @ Jx.T + Jm @ R @ Jm.T
    P_new[n:, :3] = Jx @ P[:3, :3]
    for k in range(3, n, 2):
        P_new[n:, k:k + 2] = Jx @ P[:3, k:k + 2]
    for k in range(n):
        P_new[k, n:] = P_new[n:, k]
    return x_new, P_new
""",
    ),
    (
        "06-augment",
        "state [x, z] with block-diagonal covariance, mapped",
        """
def augment(x, P, z, R):
    n = x.shape[0]
    big = np.pad(P, (0, 2))
    big[n:, n:] = R
    T = np.eye(n + 2)
    T[n:, n:] = J_z(x[:3], z)
    T[n:, 0:3] = J_xr(x[:3], z)
    return np.r_[x, g(x[:3], z)], T @ big @ T.T
""",
    ),
]

WRONG = [
    (
        "06-augment",
        "no covariance with the old landmarks",
        """
def augment(x, P, z, R):
    n = len(x)
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    Pn = np.zeros((n + 2, n + 2))
    Pn[:n, :n] = P
    Pn[n:, n:] = Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T
    Pn[n:, :3] = Jx @ P[:3, :3]
    Pn[:3, n:] = Pn[n:, :3].T
    return np.append(x, g(x[:3], z)), Pn
""",
    ),
    (
        "06-augment",
        "block diagonal: related to nobody",
        """
def augment(x, P, z, R):
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    n = len(x)
    new = Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T
    return (
        np.hstack([x, g(x[:3], z)]),
        np.block([[P, np.zeros((n, 2))], [np.zeros((2, n)), new]]),
    )
""",
    ),
    (
        "06-augment",
        "only the sensor's noise in P_nn",
        """
def augment(x, P, z, R):
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    cross = P[:, :3] @ Jx.T
    return np.append(x, g(x[:3], z)), np.block([[P, cross], [cross.T, Jz @ R @ Jz.T]])
""",
    ),
    (
        "06-augment",
        "R added as it is, in range and bearing",
        """
def augment(x, P, z, R):
    n = len(x)
    G = np.zeros((n + 2, n))
    G[:n, :n] = np.eye(n)
    G[n:, :3] = J_xr(x[:3], z)
    P = G @ P @ G.T
    P[n:, n:] += R
    return np.append(x, g(x[:3], z)), P
""",
    ),
    (
        "06-augment",
        "J_z transposed",
        """
def augment(x, P, z, R):
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    row = Jxr @ P[:3]
    P_nn = Jxr @ P[:3, :3] @ Jxr.T + Jz.T @ R @ Jz
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])
""",
    ),
    (
        "06-augment",
        "new landmark is put in front of the others",
        """
def augment(x, P, z, R):
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    n = len(x)
    G = np.zeros((n + 2, n))
    G[:3, :3] = np.eye(3)
    G[3:5, :3] = Jxr
    G[5:, 3:] = np.eye(n - 3)
    Q = np.zeros((n + 2, n + 2))
    Q[3:5, 3:5] = Jz @ R @ Jz.T
    return np.concatenate([x[:3], g(x[:3], z), x[3:]]), G @ P @ G.T + Q
""",
    ),
    (
        "06-augment",
        "a little jitter written into the caller's P so that it is not singular",
        """
def augment(x, P, z, R):
    if np.linalg.det(P[:3, :3]) == 0:
        P[:3, :3] += 1e-6 * np.eye(3)
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    row = Jxr @ P[:3]
    P_nn = row[:, :3] @ Jxr.T + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])
""",
    ),
    (
        "06-augment",
        "forgets the heading when placing the landmark",
        """
def augment(x, P, z, R):
    r, b = z
    p = x[:2] + r * np.array([np.cos(b), np.sin(b)])
    Jx = np.array([[1, 0, -r * np.sin(b)], [0, 1, r * np.cos(b)]])
    Jz = np.array([[np.cos(b), -r * np.sin(b)], [np.sin(b), r * np.cos(b)]])
    row = Jx @ P[:3]
    return np.append(x, p), np.block([[P, row.T], [row, row[:, :3] @ Jx.T + Jz @ R @ Jz.T]])
""",
    ),
    (
        "06-augment",
        "bearing taken as degrees",
        """
def augment(x, P, z, R):
    z = np.array([z[0], np.deg2rad(z[1])])
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    top = P[:, :3] @ A.T
    corner = A @ P[:3, :3] @ A.T + B @ R @ B.T
    return np.append(x, g(x[:3], z)), np.vstack([np.hstack([P, top]), np.hstack([top.T, corner])])
""",
    ),
    (
        "06-augment",
        "lower left filled, upper right forgotten",
        """
def augment(x, P, z, R):
    n = len(x)
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    big = np.zeros((n + 2, n + 2))
    big[:n, :n] = P
    big[n:, :n] = Jx @ P[:3, :]
    big[n:, n:] = Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), big
""",
    ),
    (
        "06-augment",
        "empty map treated as exactly known pose",
        """
def augment(x, P, z, R):
    Jz = J_z(x[:3], z)
    p = g(x[:3], z)
    if len(x) == 3:                       # first landmark: nothing to be related to
        Pn = np.zeros((5, 5))
        Pn[:3, :3] = P
        Pn[3:, 3:] = Jz @ R @ Jz.T
        return np.append(x, p), Pn
    Jx = J_xr(x[:3], z)
    row = Jx @ P[:3]
    return np.append(x, p), np.block([[P, row.T], [row, Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T]])
""",
    ),
    (
        "06-augment",
        "only the place of the robot, not its heading, hands on doubt",
        """
def augment(x, P, z, R):
    Jz = J_z(x[:3], z)
    row = P[:2]
    P_nn = P[:2, :2] + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])
""",
    ),
    (
        "06-augment",
        "sampled covariance instead of Jacobians",
        """
def augment(x, P, z, R):
    rng = np.random.default_rng(0)
    states = rng.multivariate_normal(x, P, 2000)
    sights = rng.multivariate_normal(z, R, 2000)
    marks = np.array([g(s[:3], w) for s, w in zip(states, sights)])
    return np.append(x, g(x[:3], z)), np.cov(np.hstack([states, marks]).T)
""",
    ),
    (
        "06-augment",
        "returned in the wrong order",
        """
def augment(x, P, z, R):
    n = len(x)
    T = np.eye(n + 2)
    T[n:, :3], T[n:, n:] = J_xr(x[:3], z), J_z(x[:3], z)
    full = np.zeros((n + 2, n + 2))
    full[:n, :n], full[n:, n:] = P, R
    return T @ full @ T.T, np.append(x, g(x[:3], z))
""",
    ),
    (
        "06-augment",
        "minus on the row (as if H were used instead of J_xr)",
        """
def augment(x, P, z, R):
    p = g(x[:3], z)
    Hp_inv = np.linalg.inv(H_landmark(x[:3], p))
    J = Hp_inv @ H_robot(x[:3], p)        # chain rule, sign forgotten
    row = J @ P[:3]
    P_nn = J @ P[:3, :3] @ J.T + Hp_inv @ R @ Hp_inv.T
    return np.append(x, p), np.block([[P, row.T], [row, P_nn]])
""",
    ),
]
