"""Independent answers to 04-new-landmark: right ones, and students' mistakes."""

RIGHT = [
    (
        "04-new-landmark",
        "one big block matrix",
        """
def new_landmark(x, P, z, R):
    big = np.zeros((5, 5))
    big[:3, :3] = P
    big[3:, 3:] = R
    G = np.eye(5)
    G[3:, :3] = J_xr(x, z)
    G[3:, 3:] = J_z(x, z)
    out = G @ big @ G.T
    return out[3:, 3:], out[:3, 3:]
""",
    ),
    (
        "04-new-landmark",
        "einsum and own Jacobians",
        """
def new_landmark(x, P, z, R):
    a = x[2] + z[1]
    e, n = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
    A = np.c_[np.eye(2), z[0] * n]
    B = np.c_[e, z[0] * n]
    P_nn = np.einsum("ik,kl,jl->ij", A, P, A) + np.einsum("ik,kl,jl->ij", B, R, B)
    return P_nn, np.einsum("ik,jk->ij", P, A)
""",
    ),
]

WRONG = [
    (
        "04-new-landmark",
        "P_rn transposed (2, 3)",
        """
def new_landmark(x, P, z, R):
    A, B = J_xr(x, z), J_z(x, z)
    P_nr = A @ P
    return P_nr @ A.T + B @ R @ B.T, P_nr
""",
    ),
    (
        "04-new-landmark",
        "measurement's noise forgotten",
        """
def new_landmark(x, P, z, R):
    A = J_xr(x, z)
    return A @ P @ A.T, P @ A.T
""",
    ),
    (
        "04-new-landmark",
        "pose's covariance forgotten in P_nn",
        """
def new_landmark(x, P, z, R):
    Jz = J_z(x, z)
    return Jz @ R @ Jz.T, P @ J_xr(x, z).T
""",
    ),
    (
        "04-new-landmark",
        "Jz.T R Jz instead of Jz R Jz.T",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T
    P_nn = P_nn + Jz.T @ R @ Jz
    return P_nn, P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "correlations within P ignored",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    variances = np.diag(np.diag(P))
    return Jr @ variances @ Jr.T + Jz @ R @ Jz.T, variances @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "correlation of range and bearing ignored",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T
    for k in range(2):
        P_nn = P_nn + R[k, k] * np.outer(Jz[:, k], Jz[:, k])
    return P_nn, P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "P_rn set to zero, 'they err independently'",
        """
def new_landmark(x, P, z, R):
    J = np.hstack([J_xr(x, z), J_z(x, z)])
    S = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    return J @ S @ J.T, np.zeros((3, 2))
""",
    ),
    (
        "04-new-landmark",
        "returned in the other order",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = P @ Jr.T
    P_nn = Jr @ P_rn + Jz @ R @ Jz.T
    return P_rn, P_nn
""",
    ),
    (
        "04-new-landmark",
        "R added as it is, in range and bearing",
        """
def new_landmark(x, P, z, R):
    Jr = J_xr(x, z)
    return Jr @ P @ Jr.T + R, P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "R taken for standard deviations and squared",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz @ (R @ R) @ Jz.T, P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "P_rn is the pose's own columns: the lever of the heading forgotten",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, P[:, :2].copy()
""",
    ),
    (
        "04-new-landmark",
        "P_rn's row for the heading left zero",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = np.zeros((3, 2))
    P_rn[:2] = P[:2] @ Jr.T
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, P_rn
""",
    ),
    (
        "04-new-landmark",
        "adds the bearing's variance to the heading's in P, in place",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = P @ Jr.T
    cross = R[0, 1] * (np.outer(Jz[:, 0], Jz[:, 1]) + np.outer(Jz[:, 1], Jz[:, 0]))
    P[2, 2] += R[1, 1]
    P_nn = Jr @ P @ Jr.T + R[0, 0] * np.outer(Jz[:, 0], Jz[:, 0]) + cross
    return P_nn, P_rn
""",
    ),
    (
        "04-new-landmark",
        "400 samples",
        """
def new_landmark(x, P, z, R):
    rng = np.random.default_rng(0)
    poses = rng.multivariate_normal(x, P, 400)
    seen = rng.multivariate_normal(z, R, 400)
    both = np.hstack([poses, np.array([g(a, b) for a, b in zip(poses, seen)])])
    S = np.cov(both.T)
    return S[3:, 3:], S[:3, 3:]
""",
    ),
    (
        "04-new-landmark",
        "Jacobians at the origin instead of at x",
        """
def new_landmark(x, P, z, R):
    home = np.zeros(3)
    Jr, Jz = J_xr(home, z), J_z(home, z)
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "symmetrised without the half",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T + Jz @ R @ Jz.T
    return P_nn + P_nn.T, P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "elementwise product for the measurement's part",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz * R * Jz.T, P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "minus: the landmark lies the other way, so P_rn negative",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T + Jz @ R @ Jz.T
    return P_nn, -P @ Jr.T
""",
    ),
    (
        "04-new-landmark",
        "counts P through the measurement as well (H P H^T added to R)",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    H = H_robot(x, g(x, z))
    S = H @ P @ H.T + R
    return Jr @ P @ Jr.T + Jz @ S @ Jz.T, P @ Jr.T
""",
    ),
]
