"""Independent answers to 09-place: right ones, and students' mistakes."""

RIGHT = [
    (
        "09-place",
        "one Jacobian of pose and sight",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    d = x[1] * c - x[0] * s
    J = np.array([[c, s, d, 1.0, d], [0, 0, 1, 0, 1]])
    Q = np.zeros((5, 5))
    Q[:3, :3], Q[3:, 3:] = P, R
    line = np.array([z[0] + c * x[0] + s * x[1], np.arctan2(s, c)])
    return line, J @ Q @ J.T, J[:, :3] @ P
""",
    ),
    (
        "09-place",
        "foot of the perpendicular: rho as a scalar product, no wrap by hand",
        """
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
""",
    ),
]

WRONG = [
    (
        "09-place",
        "the slope by theta is forgotten",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    J_x = np.array([[c, s, 0], [0, 0, 1]])
    J_z = np.eye(2)
    line = np.array([z[0] + x[0] * c + x[1] * s, alpha])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    (
        "09-place",
        "J_z is the unit matrix",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    J_x = np.array([[c, s, x[1] * c - x[0] * s], [0, 0, 1]])
    return np.array([z[0] + x[0] * c + x[1] * s, alpha]), J_x @ P @ J_x.T + R, J_x @ P
""",
    ),
    (
        "09-place",
        "the lever's sign",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    lever = x[0] * s - x[1] * c
    J_x = np.array([[c, s, lever], [0, 0, 1]])
    J_z = np.array([[1, lever], [0, 1]])
    return (np.array([z[0] + x[0] * c + x[1] * s, alpha]),
            J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P)
""",
    ),
    (
        "09-place",
        "alpha' without theta in the cosine",
        """
def place(x, P, z, R):
    c, s = np.cos(z[1]), np.sin(z[1])
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, wrap(x[2] + z[1])])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    (
        "09-place",
        "negative rho is made positive and alpha turned by pi",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    d = -x[0] * s + x[1] * c
    rho = z[0] + x[0] * c + x[1] * s
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    if rho < 0:
        rho, alpha = -rho, wrap(alpha + np.pi)
        J_x[0] *= -1
        J_z[0] *= -1
    return np.array([rho, alpha]), J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    (
        "09-place",
        "rho minus instead of plus",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] - x[0] * c - x[1] * s, alpha])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    (
        "09-place",
        "X is P J_x', shape (3, 2)",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, alpha])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, P @ J_x.T
""",
    ),
    (
        "09-place",
        "returns J_x instead of J_x P",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, alpha])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x
""",
    ),
    (
        "09-place",
        "the sight's noise is not added",
        """
def place(x, P, z, R):
    a = wrap(x[2] + z[1])
    n = np.array([np.cos(a), np.sin(a)])
    J = np.array([[n[0], n[1], n[0] * x[1] - n[1] * x[0]], [0, 0, 1]])
    return np.array([z[0] + n @ x[:2], a]), J @ P @ J.T, J @ P
""",
    ),
    (
        "09-place",
        "slopes as for a point: range times the sine",
        """
def place(x, P, z, R):
    a = wrap(x[2] + z[1])
    c, s = np.cos(a), np.sin(a)
    J_x = np.array([[c, s, -z[0] * s], [0, 0, 1]])
    J_z = np.array([[1, -z[0] * s], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, a])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    (
        "09-place",
        "only the diagonal of P",
        """
def place(x, P, z, R):
    a = wrap(x[2] + z[1])
    c, s = np.cos(a), np.sin(a)
    d = -x[0] * s + x[1] * c
    var = np.diag(np.diag(P))
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, a])
    return line, J_x @ var @ J_x.T + J_z @ R @ J_z.T, J_x @ var
""",
    ),
    (
        "09-place",
        "alpha wrapped by mod pi: a line has no direction",
        """
def place(x, P, z, R):
    a = (x[2] + z[1]) % np.pi
    c, s = np.cos(a), np.sin(a)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, a])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    (
        "09-place",
        "theta minus alpha'",
        """
def place(x, P, z, R):
    a = wrap(x[2] - z[1])
    c, s = np.cos(a), np.sin(a)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, -d], [0, -1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, a])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    (
        "09-place",
        "J' P J by transposing on the wrong side of z's part",
        """
def place(x, P, z, R):
    a = wrap(x[2] + z[1])
    c, s = np.cos(a), np.sin(a)
    d = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, d], [0, 0, 1]])
    J_z = np.array([[1, d], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, a])
    return line, J_x @ P @ J_x.T + J_z.T @ R @ J_z, J_x @ P
""",
    ),
]
