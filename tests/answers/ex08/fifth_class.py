"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "08-corner",
        "finite differences of the corner",
        """
def corner(z1, R1, z2, R2):
    def at(q):
        N = np.array([[np.cos(q[1]), np.sin(q[1])], [np.cos(q[3]), np.sin(q[3])]])
        return np.linalg.solve(N, [q[0], q[2]])
    q = np.array([*z1, *z2], float)
    J = np.array([(at(q + d) - at(q - d)) / 2e-6 for d in 1e-6 * np.eye(4)]).T
    C = np.zeros((4, 4))
    C[:2, :2], C[2:, 2:] = R1, R2
    return at(q), J @ C @ J.T
""",
    ),
]

WRONG = [
    (
        "08-associate",
        "the nearest for each, walls twice",
        """
def associate(z, expected, S, gate):
    out = []
    for s in z:
        d = []
        for e, C in zip(expected, S):
            v = s - e
            v[1] = wrap(v[1])
            d.append(v @ np.linalg.inv(C) @ v)
        out.append(int(np.argmin(d)) if len(d) and min(d) <= gate else None)
    return out
""",
    ),
    (
        "08-fit-line",
        "the direction of the wall for its normal",
        """
def fit_line(points):
    m = points.mean(axis=0)
    n = np.linalg.svd(points - m)[2][0]
    rho = n @ m
    return (rho, np.arctan2(n[1], n[0])) if rho > 0 else (-rho, np.arctan2(-n[1], -n[0]))
""",
    ),
    (
        "08-fit-line",
        "np.cov svd normal, abs rho",
        """
def fit_line(points):
    c = points.mean(axis=0)
    U, s, Vt = np.linalg.svd(np.cov(points.T))
    n = U[:, 1]
    rho = c @ n
    alpha = np.arctan2(n[1], n[0])
    if rho < 0:
        rho = abs(rho)
    return rho, alpha
""",
    ),
]
