"""Independent answers to 08-corner: right ones, and students' mistakes."""

RIGHT = [
    (
        "08-corner",
        "Cramer's rule and one 2 x 4 Jacobian",
        """
def corner(z1, R1, z2, R2):
    (r1, a1), (r2, a2) = z1, z2
    c1, s1, c2, s2 = np.cos(a1), np.sin(a1), np.cos(a2), np.sin(a2)
    D = c1 * s2 - s1 * c2
    x = (r1 * s2 - r2 * s1) / D
    y = (c1 * r2 - c2 * r1) / D
    t1 = -s1 * x + c1 * y
    t2 = -s2 * x + c2 * y
    J = np.array([[s2, -t1 * s2, -s1, t2 * s1], [-c2, t1 * c2, c1, -t2 * c1]]) / D
    R = np.zeros((4, 4))
    R[:2, :2] = R1
    R[2:, 2:] = R2
    return np.array([x, y]), J @ R @ J.T
""",
    ),
    (
        "08-corner",
        "complex-step derivative of the corner",
        """
def corner(z1, R1, z2, R2):
    def meet(r1, a1, r2, a2):
        D = np.sin(a2 - a1)
        return np.array([r1 * np.sin(a2) - r2 * np.sin(a1), r2 * np.cos(a1) - r1 * np.cos(a2)]) / D

    z = np.concatenate([z1, z2]).astype(complex)
    J = np.column_stack([meet(*(z + 1e-30j * e)).imag / 1e-30 for e in np.eye(4)])
    return meet(*z).real, J[:, :2] @ R1 @ J[:, :2].T + J[:, 2:] @ R2 @ J[:, 2:].T
""",
    ),
    (
        "08-corner",
        "variances of n.p of both lines, carried through the inverse of N",
        """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    N, N_dash = np.stack([np.cos(a), np.sin(a)], 1), np.stack([-np.sin(a), np.cos(a)], 1)
    inverse = np.linalg.inv(N)
    p = inverse @ np.array([z1[0], z2[0]])
    g = np.stack([np.ones(2), -(N_dash @ p)], 1)
    var = np.einsum("ki,kij,kj->k", g, np.stack([R1, R2]), g)
    return p, inverse @ np.diag(var) @ inverse.T
""",
    ),
]

WRONG = [
    (
        "08-corner",
        "sign of the alpha term",
        """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    N = np.column_stack([np.cos(a), np.sin(a)])
    Ninv = np.linalg.inv(N)
    p = Ninv @ [z1[0], z2[0]]
    t = np.column_stack([-np.sin(a), np.cos(a)]) @ p
    J1 = Ninv[:, :1] @ np.array([[1, t[0]]])
    J2 = Ninv[:, 1:] @ np.array([[1, t[1]]])
    return p, J1 @ R1 @ J1.T + J2 @ R2 @ J2.T
""",
    ),
    (
        "08-corner",
        "correlation of rho and alpha ignored",
        """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    Ninv = np.linalg.inv(np.column_stack([np.cos(a), np.sin(a)]))
    p = Ninv @ np.array([z1[0], z2[0]])
    P = np.zeros((2, 2))
    for k, R in enumerate([R1, R2]):
        t = -np.sin(a[k]) * p[0] + np.cos(a[k]) * p[1]
        var = R[0, 0] + t**2 * R[1, 1]
        P += var * np.outer(Ninv[:, k], Ninv[:, k])
    return p, P
""",
    ),
    (
        "08-corner",
        "only rho is unsure: alpha term forgotten",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    Ni = np.linalg.inv(N)
    return p, Ni @ np.diag([R1[0, 0], R2[0, 0]]) @ Ni.T
""",
    ),
    (
        "08-corner",
        "N transposed: normals as columns",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.cos(z2[1])], [np.sin(z1[1]), np.sin(z2[1])]])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    P = np.zeros((2, 2))
    for k, (z, R) in enumerate([(z1, R1), (z2, R2)]):
        n_dash = np.array([-np.sin(z[1]), np.cos(z[1])])
        J = np.outer(Ni[:, k], [1, -n_dash @ p])
        P += J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "J' R J in place of J R J'",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    n1d, n2d = (np.array([-np.sin(z[1]), np.cos(z[1])]) for z in (z1, z2))
    J1 = np.outer(Ni[:, 0], [1, -n1d @ p])
    J2 = np.outer(Ni[:, 1], [1, -n2d @ p])
    return p, J1.T @ R1 @ J1 + J2.T @ R2 @ J2
""",
    ),
    (
        "08-corner",
        "row of the inverse taken for its column",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    inv = np.linalg.inv(N)
    p = inv @ [z1[0], z2[0]]
    P = 0
    for row, n, R in zip(inv, N, (R1, R2)):
        J = np.outer(row, [1, n[1] * p[0] - n[0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "information form: fails for a line that is known exactly",
        """
def corner(z1, R1, z2, R2):
    p = np.linalg.solve(
        [[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]], [z1[0], z2[0]]
    )
    info = np.zeros((2, 2))
    for (rho, alpha), R in ((z1, R1), (z2, R2)):
        n, n_dash = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
        g = np.array([1, -n_dash @ p])
        info += np.outer(n, n) / (g @ R @ g)
    return p, np.linalg.inv(info)
""",
    ),
    (
        "08-corner",
        "walls taken for perpendicular",
        """
def corner(z1, R1, z2, R2):
    n1 = np.array([np.cos(z1[1]), np.sin(z1[1])])
    n2 = np.array([np.cos(z2[1]), np.sin(z2[1])])
    p = z1[0] * n1 + z2[0] * n2
    P = np.zeros((2, 2))
    for n, R in ((n1, R1), (n2, R2)):
        g = np.array([1, -(np.array([-n[1], n[0]]) @ p)])
        P += (g @ R @ g) * np.outer(n, n)
    return p, P
""",
    ),
    (
        "08-corner",
        "slope and intercept: a wall with sin alpha = 0 has none",
        """
def corner(z1, R1, z2, R2):
    m1, b1 = -1 / np.tan(z1[1]), z1[0] / np.sin(z1[1])
    m2, b2 = -1 / np.tan(z2[1]), z2[0] / np.sin(z2[1])
    x = (b2 - b1) / (m1 - m2)
    p = np.array([x, m1 * x + b1])
    P = np.zeros((2, 2))
    Ni = np.linalg.inv([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    for k, (z, R) in enumerate([(z1, R1), (z2, R2)]):
        J = np.outer(Ni[:, k], [1, np.sin(z[1]) * p[0] - np.cos(z[1]) * p[1]])
        P += J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "negative rho made positive",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, np.abs([z1[0], z2[0]]))
    P = np.zeros((2, 2))
    Ni = np.linalg.inv(N)
    for k, R in enumerate((R1, R2)):
        J = np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "lines turned to rho >= 0 in place: arguments changed",
        """
def corner(z1, R1, z2, R2):
    for z in (z1, z2):
        z[1] = wrap(z[1])
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    Ni, P = np.linalg.inv(N), np.zeros((2, 2))
    for k, R in enumerate((R1, R2)):
        J = np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "R1 used for both lines",
        """
def corner(z1, R1, z2, R2):
    def jac(k):
        return np.outer(Ni[:, k], [1, -(np.array([-N[k, 1], N[k, 0]]) @ p)])

    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    Ni = np.linalg.inv(N)
    p = Ni @ np.array([z1[0], z2[0]])
    return p, jac(0) @ R1 @ jac(0).T + jac(1) @ R1 @ jac(1).T
""",
    ),
    (
        "08-corner",
        "Jacobian by differences with a coarse step",
        """
def corner(z1, R1, z2, R2):
    def where(z):
        N = [[np.cos(z[1]), np.sin(z[1])], [np.cos(z[3]), np.sin(z[3])]]
        return np.linalg.solve(N, [z[0], z[2]])

    z = np.concatenate([z1, z2])
    p, h = where(z), 0.01
    J = np.array([(where(z + h * e) - p) / h for e in np.eye(4)]).T
    R = np.block([[R1, np.zeros((2, 2))], [np.zeros((2, 2)), R2]])
    return p, J @ R @ J.T
""",
    ),
    (
        "08-corner",
        "P from 2000 samples",
        """
def corner(z1, R1, z2, R2):
    def where(a, b):
        N = [[np.cos(a[1]), np.sin(a[1])], [np.cos(b[1]), np.sin(b[1])]]
        return np.linalg.solve(N, [a[0], b[0]])

    rng = np.random.default_rng(0)
    A = rng.multivariate_normal(z1, R1, 2000)
    B = rng.multivariate_normal(z2, R2, 2000)
    return where(z1, z2), np.cov(np.array([where(a, b) for a, b in zip(A, B)]).T)
""",
    ),
    (
        "08-corner",
        "n' taken at the foot of each line, not at the corner",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    P = np.zeros((2, 2))
    for k, (z, R) in enumerate(((z1, R1), (z2, R2))):
        foot = z[0] * N[1 - k]
        across = np.array([-N[k, 1], N[k, 0]])
        J = np.outer(np.linalg.inv(N)[:, k], [1, -(across @ foot)])
        P = P + J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "standard deviations in place of P",
        """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    Ni = np.linalg.inv(np.column_stack([np.cos(a), np.sin(a)]))
    p = Ni @ np.array([z1[0], z2[0]])
    P = np.zeros((2, 2))
    for k, R in enumerate([R1, R2]):
        J = np.outer(Ni[:, k], [1, np.sin(a[k]) * p[0] - np.cos(a[k]) * p[1]])
        P += J @ R @ J.T
    return p, np.sqrt(np.diag(np.diag(P)))
""",
    ),
    (
        "08-corner",
        "walls less than 20 degrees from parallel refused",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    if abs(np.linalg.det(N)) < np.sin(np.radians(20)):
        return None
    Ni = np.linalg.inv(N)
    p, P = Ni @ [z1[0], z2[0]], np.zeros((2, 2))
    for k, R in enumerate((R1, R2)):
        J = np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "sum begun in R1: argument changed",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    Js = [np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]]) for k in (0, 1)]
    P = R1
    P[:] = Js[0] @ R1 @ Js[0].T
    P += Js[1] @ R2 @ Js[1].T
    return p, P
""",
    ),
    (
        "08-corner",
        "both errors treated as one: (J1 + J2)(R1 + R2)(J1 + J2)'",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    J = sum(np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]]) for k in (0, 1))
    return p, J @ (R1 + R2) @ J.T
""",
    ),
]
