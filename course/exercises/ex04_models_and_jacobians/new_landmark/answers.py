# %% way: one product of blocks, as a list
def new_landmark(x, P, z, R):
    G = np.block([[np.eye(3), np.zeros((3, 2))], [J_xr(x, z), J_z(x, z)]])
    joint = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    joint = G @ joint @ G.T
    return [joint[3:, 3:], joint[:3, 3:]]

# %% way: Cholesky factors
def new_landmark(x, P, z, R):
    pose, noise = J_xr(x, z) @ np.linalg.cholesky(P), J_z(x, z) @ np.linalg.cholesky(R)
    return pose @ pose.T + noise @ noise.T, np.einsum("ij,kj->ik", P, J_xr(x, z))

# %% way: loops
def new_landmark(x, P, z, R):
    A, B = np.asarray(J_xr(x, z)), np.asarray(J_z(x, z))
    P_nn, P_rn = np.zeros((2, 2)), np.zeros((3, 2))
    for i in range(2):
        for j in range(2):
            P_nn[i, j] = sum(A[i, k] * P[k, l] * A[j, l] for k in range(3) for l in range(3))
            P_nn[i, j] += sum(B[i, k] * R[k, l] * B[j, l] for k in range(2) for l in range(2))
        for k in range(3):
            P_rn[k, i] = A[i] @ P[:, k]
    return P_nn, P_rn

# %% way: cross first
def new_landmark(x, P, z, R):
    J = J_xr(x, z)
    P_rn = (J @ P).T
    return J @ P_rn + np.linalg.multi_dot([J_z(x, z), R, np.transpose(J_z(x, z))]), P_rn

# %% way: sigma points
def new_landmark(x, P, z, R):
    joint = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    at, root = np.concatenate([x, z]), 1e-2 * np.linalg.cholesky(joint).T
    points = np.vstack([at + root, at - root])
    places = np.array([g(v[:3], v[3:]) for v in points])
    off, moved = places - places.mean(axis=0), points[:, :3] - x
    return off.T @ off / 2e-4, moved.T @ off / 2e-4

# %% way: differences
def new_landmark(x, P, z, R):
    def slopes(f, v):
        return np.array([(f(v + step) - f(v - step)) / 2e-6 for step in 1e-6 * np.eye(len(v))])
    A, B = slopes(lambda v: g(v, z), x), slopes(lambda v: g(x, v), z)
    return A.T @ P @ A + B.T @ R @ B, P @ A

# %% right: one big Jacobian and a block covariance
def new_landmark(x, P, z, R):
    J = np.hstack([J_xr(x, z), J_z(x, z)])
    B = np.zeros((5, 5))
    B[:3, :3] = P
    B[3:, 3:] = R
    return J @ B @ J.T, (B @ J.T)[:3]

# %% right: one big block matrix
def new_landmark(x, P, z, R):
    big = np.zeros((5, 5))
    big[:3, :3] = P
    big[3:, 3:] = R
    G = np.eye(5)
    G[3:, :3] = J_xr(x, z)
    G[3:, 3:] = J_z(x, z)
    out = G @ big @ G.T
    return out[3:, 3:], out[:3, 3:]

# %% right: einsum and own Jacobians
def new_landmark(x, P, z, R):
    a = x[2] + z[1]
    e, n = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
    A = np.c_[np.eye(2), z[0] * n]
    B = np.c_[e, z[0] * n]
    P_nn = np.einsum("ik,kl,jl->ij", A, P, A) + np.einsum("ik,kl,jl->ij", B, R, B)
    return P_nn, np.einsum("ik,jk->ij", P, A)

# %% right: one big Jacobian
def new_landmark(x, P, z, R):
    both = np.zeros((5, 5))
    both[:3, :3], both[3:, 3:] = P, R
    J = np.hstack([J_xr(x, z), J_z(x, z)])
    whole = np.vstack([np.eye(3, 5), J])
    S = whole @ both @ whole.T
    return S[3:, 3:], S[:3, 3:]

# %% wrong: P_rn transposed
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P

# %% wrong: returned in the other order
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = P @ Jr.T
    P_nn = Jr @ P_rn + Jz @ R @ Jz.T
    return P_rn, P_nn

# %% wrong: adds the bearing's variance to the heading's in P, in place
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = P @ Jr.T
    cross = R[0, 1] * (np.outer(Jz[:, 0], Jz[:, 1]) + np.outer(Jz[:, 1], Jz[:, 0]))
    P[2, 2] += R[1, 1]
    P_nn = Jr @ P @ Jr.T + R[0, 0] * np.outer(Jz[:, 0], Jz[:, 0]) + cross
    return P_nn, P_rn

# %% wrong: 400 samples
def new_landmark(x, P, z, R):
    rng = np.random.default_rng(0)
    poses = rng.multivariate_normal(x, P, 400)
    seen = rng.multivariate_normal(z, R, 400)
    both = np.hstack([poses, np.array([g(a, b) for a, b in zip(poses, seen)])])
    S = np.cov(both.T)
    return S[3:, 3:], S[:3, 3:]

# %% wrong: counts P through the measurement as well (H P H^T added to R)
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    H = H_robot(x, g(x, z))
    S = H @ P @ H.T + R
    return Jr @ P @ Jr.T + Jz @ S @ Jz.T, P @ Jr.T

# %% wrong: the position's block only
def new_landmark(x, P, z, R):
    A, B = J_xr(x, z), J_z(x, z)
    Q = np.zeros((3, 3))
    Q[:2, :2] = P[:2, :2]
    Q[2, 2] = P[2, 2]
    return A @ Q @ A.T + B @ R @ B.T, Q @ A.T
