# %% way: one Jacobian
def augment(x, P, z, R):
    n = len(x)
    G = np.zeros((n + 2, n + 2))
    G[:n, :n], G[n:, :3], G[n:, n:] = np.eye(n), J_xr(x, z), J_z(x, z)
    full = np.zeros((n + 2, n + 2))
    full[:n, :n], full[n:, n:] = P, R
    return np.concatenate([x, g(x, z)]), G @ full @ G.T

# %% way: block by block
def augment(x, P, z, R):
    n = len(x)
    new = np.zeros((n + 2, n + 2))
    new[:n, :n] = P
    for rows in [slice(0, 3)] + [slice(k, k + 2) for k in range(3, n, 2)]:
        new[rows, n:] = P[rows, :3] @ J_xr(x, z).T
        new[n:, rows] = new[rows, n:].T
    new[n:, n:] = J_xr(x, z) @ P[:3, :3] @ J_xr(x, z).T + J_z(x, z) @ R @ J_z(x, z).T
    return [list(x) + list(g(x, z)), new]

# %% way: differences
def augment(x, P, z, R):
    place = lambda s: g(s[:3], s[3:])
    s, e = np.append(x[:3], z), 1e-6
    J = np.column_stack([(place(s + d) - place(s - d)) / (2 * e) for d in e * np.eye(5)])
    cross = P[:, :3] @ J[:, :3].T
    corner = J[:, :3] @ P[:3, :3] @ J[:, :3].T + J[:, 3:] @ R @ J[:, 3:].T
    return np.append(x, place(s)), np.vstack([np.hstack([P, cross]), np.hstack([cross.T, corner])])

# %% way: sines and cosines
def augment(x, P, z, R):
    c, s = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    A = np.array([[1, 0, -z[0] * s], [0, 1, z[0] * c]])
    B = np.array([[c, -z[0] * s], [s, z[0] * c]])
    new = np.pad(P, (0, 2))
    new[-2:, :-2] = A @ P[:3, :]
    new[:-2, -2:] = P[:, :3] @ A.T
    new[-2:, -2:] = A @ P[:3, :3] @ A.T + B @ R @ B.T
    return np.append(x, [x[0] + z[0] * c, x[1] + z[0] * s]), new

# %% right: state [x, z] with block-diagonal covariance, mapped
def augment(x, P, z, R):
    n = x.shape[0]
    big = np.pad(P, (0, 2))
    big[n:, n:] = R
    T = np.eye(n + 2)
    T[n:, n:] = J_z(x[:3], z)
    T[n:, 0:3] = J_xr(x[:3], z)
    return np.r_[x, g(x[:3], z)], T @ big @ T.T

# %% wrong: a little jitter written into the caller's P so that it is not singular
def augment(x, P, z, R):
    if np.linalg.det(P[:3, :3]) == 0:
        P[:3, :3] += 1e-6 * np.eye(3)
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    row = Jxr @ P[:3]
    P_nn = row[:, :3] @ Jxr.T + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])

# %% wrong: forgets the heading when placing the landmark
def augment(x, P, z, R):
    r, b = z
    p = x[:2] + r * np.array([np.cos(b), np.sin(b)])
    Jx = np.array([[1, 0, -r * np.sin(b)], [0, 1, r * np.cos(b)]])
    Jz = np.array([[np.cos(b), -r * np.sin(b)], [np.sin(b), r * np.cos(b)]])
    row = Jx @ P[:3]
    return np.append(x, p), np.block([[P, row.T], [row, row[:, :3] @ Jx.T + Jz @ R @ Jz.T]])

# %% wrong: bearing taken as degrees
def augment(x, P, z, R):
    z = np.array([z[0], np.deg2rad(z[1])])
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    top = P[:, :3] @ A.T
    corner = A @ P[:3, :3] @ A.T + B @ R @ B.T
    return np.append(x, g(x[:3], z)), np.vstack([np.hstack([P, top]), np.hstack([top.T, corner])])

# %% wrong: for a map of two landmarks: sizes fixed at seven
def augment(x, P, z, R):
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    Q = np.zeros((7, 7))
    n = len(x)
    Q[:n, :n] = P
    Q[n:, n:] = A @ P[:3, :3] @ A.T + B @ R @ B.T
    Q[n:, :n] = A @ P[:3]
    Q[:n, n:] = Q[n:, :n].T
    return np.append(x, g(x[:3], z)), Q

# %% wrong: the landmark in front of the pose
def augment(x, P, z, R):
    n = len(x)
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    Q = np.block([[P, P[:, :3] @ A.T], [A @ P[:3], A @ P[:3, :3] @ A.T + B @ R @ B.T]])
    order = [n, n + 1, *range(n)]
    return np.append(x, g(x[:3], z))[order], Q[np.ix_(order, order)]

# %% wrong: map of landmarks needed
def augment(x, P, z, R):
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    cross = np.vstack([A @ P[:3, k : k + 1] for k in range(0, 0)]) if len(x) == 3 else A @ P[:3]
    row = cross if len(x) > 3 else A @ P
    new = A @ P[:3, :3] @ A.T + B @ R @ B.T
    new = new + 1e-3 * np.eye(2)
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, new]])
