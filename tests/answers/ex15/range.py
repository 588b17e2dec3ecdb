"""Independent answers to 15-range: right ones, and students' mistakes."""

RIGHT = [
    (
        "15-range",
        "in i's frame, by chain rule with 2 x 3 matrices",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def place(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        R, dR = np.array([[c, -s], [s, c]]), np.array([[-s, -c], [c, -s]])
        return x[:2] + R @ a, np.column_stack([np.eye(2), dR @ a])

    p_i, G_i = place(x_i, a_i)
    p_j, G_j = place(x_j, a_j)
    d = p_j - p_i
    length = np.linalg.norm(d)
    return float(length - r), -(d @ G_i) / length, (d @ G_j) / length
""",
    ),
    (
        "15-range",
        "complex numbers, direction as an angle",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    arm_i = complex(*a_i) * np.exp(1j * x_i[2])
    arm_j = complex(*a_j) * np.exp(1j * x_j[2])
    d = complex(x_j[0], x_j[1]) + arm_j - complex(x_i[0], x_i[1]) - arm_i
    bearing = np.angle(d)
    c, s = np.cos(bearing), np.sin(bearing)

    def along(v):
        return c * v.real + s * v.imag

    A = np.array([-c, -s, -along(1j * arm_i)])
    B = np.array([c, s, along(1j * arm_j)])
    return float(abs(d) - r), A, B
""",
    ),
]

WRONG = [
    (
        "15-range",
        "turning the robots does nothing, says the third column",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    d = transform(x_j, [a_j])[0] - transform(x_i, [a_i])[0]
    u = d / np.linalg.norm(d)
    return np.linalg.norm(d) - r, np.array([*-u, 0.0]), np.array([*u, 0.0])


def transform(pose, points):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.asarray(points) @ np.array([[c, s], [-s, c]]) + pose[:2]
""",
    ),
    (
        "15-range",
        "error the other way round, r - |d| (Jacobians of |d|)",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def R(t):
        return np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])

    w_i, w_j = R(x_i[2]) @ a_i, R(x_j[2]) @ a_j
    d = x_j[:2] + w_j - x_i[:2] - w_i
    dist = np.sqrt(d @ d)
    ux, uy = d / dist
    A = np.array([-ux, -uy, ux * w_i[1] - uy * w_i[0]])
    B = np.array([ux, uy, -ux * w_j[1] + uy * w_j[0]])
    return r - dist, A, B
""",
    ),
    (
        "15-range",
        "squares of the distances compared, and their Jacobians",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        return x[:2] + arm, np.array([-arm[1], arm[0]])

    (p, dp), (q, dq) = radio(x_i, a_i), radio(x_j, a_j)
    d = q - p
    return d @ d - r**2, np.array([*(-2 * d), -2 * d @ dp]), np.array([*(2 * d), 2 * d @ dq])
""",
    ),
    (
        "15-range",
        "the radios' places are not turned with their robots",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    d = (x_j[:2] + a_j) - (x_i[:2] + a_i)
    n = np.hypot(*d)
    u = d / n
    A = np.array([-u[0], -u[1], -(u[1] * a_i[0] - u[0] * a_i[1])])
    B = np.array([u[0], u[1], u[1] * a_j[0] - u[0] * a_j[1]])
    return n - r, A, B
""",
    ),
    (
        "15-range",
        "arms turned back (R transposed)",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def Rt(t):
        return np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]])

    arm_i, arm_j = Rt(x_i[2]) @ a_i, Rt(x_j[2]) @ a_j
    d = x_j[:2] - x_i[:2] + arm_j - arm_i
    length = np.linalg.norm(d)
    u = d / length
    quarter = np.array([[0, -1], [1, 0]])
    A = np.r_[-u, -u @ quarter @ arm_i]
    B = np.r_[u, u @ quarter @ arm_j]
    return length - r, A, B
""",
    ),
    (
        "15-range",
        "third entry of A lost its minus",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        return x[:2] + arm, np.array([-arm[1], arm[0]])

    (from_i, turned_i), (from_j, turned_j) = radio(x_i, a_i), radio(x_j, a_j)
    d = from_j - from_i
    distance = np.hypot(d[0], d[1])
    u = d / distance
    return distance - r, np.array([-u[0], -u[1], u @ turned_i]), np.array([u[0], u[1], u @ turned_j])
""",
    ),
    (
        "15-range",
        "direction not of length one",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    ci, si, cj, sj = np.cos(x_i[2]), np.sin(x_i[2]), np.cos(x_j[2]), np.sin(x_j[2])
    wi = np.array([ci * a_i[0] - si * a_i[1], si * a_i[0] + ci * a_i[1]])
    wj = np.array([cj * a_j[0] - sj * a_j[1], sj * a_j[0] + cj * a_j[1]])
    d = x_j[:2] + wj - x_i[:2] - wi
    A = np.array([-d[0], -d[1], d[0] * wi[1] - d[1] * wi[0]])
    B = np.array([d[0], d[1], d[1] * wj[0] - d[0] * wj[1]])
    return np.linalg.norm(d) - r, A, B
""",
    ),
    (
        "15-range",
        "direction divided by the measured distance",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def R(t):
        return np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])

    def dR(t):
        return np.array([[-np.sin(t), -np.cos(t)], [np.cos(t), -np.sin(t)]])

    d = x_j[:2] + R(x_j[2]) @ a_j - x_i[:2] - R(x_i[2]) @ a_i
    u = d / r
    A = np.append(-u, -u @ dR(x_i[2]) @ a_i)
    B = np.append(u, u @ dR(x_j[2]) @ a_j)
    return np.linalg.norm(d) - r, A, B
""",
    ),
    (
        "15-range",
        "a turn of pose i swings the whole d (as in task 2)",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def arm(x, a):
        return np.array(
            [a[0] * np.cos(x[2]) - a[1] * np.sin(x[2]), a[0] * np.sin(x[2]) + a[1] * np.cos(x[2])]
        )

    d = x_j[:2] + arm(x_j, a_j) - x_i[:2] - arm(x_i, a_i)
    u = d / np.linalg.norm(d)
    swing = np.array([-d[1], d[0]])
    A = np.array([-u[0], -u[1], -u @ swing])
    w = arm(x_j, a_j)
    B = np.array([u[0], u[1], u @ np.array([-w[1], w[0]])])
    return np.linalg.norm(d) - r, A, B
""",
    ),
    (
        "15-range",
        "quarter turn taken of the arm in its own frame",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def rot(t, v):
        return np.array([np.cos(t) * v[0] - np.sin(t) * v[1], np.sin(t) * v[0] + np.cos(t) * v[1]])

    d = (x_j[:2] + rot(x_j[2], a_j)) - (x_i[:2] + rot(x_i[2], a_i))
    length = np.linalg.norm(d)
    u = d / length
    A = np.array([-u[0], -u[1], -(u @ np.array([-a_i[1], a_i[0]]))])
    B = np.array([u[0], u[1], u @ np.array([-a_j[1], a_j[0]])])
    return length - r, A, B
""",
    ),
    (
        "15-range",
        "A and B are matrices of one row",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def place(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        return (
            x[:2] + np.array([[c, -s], [s, c]]) @ a,
            np.column_stack([np.eye(2), np.array([[-s, -c], [c, -s]]) @ a]),
        )

    (p, G), (q, F) = place(x_i, a_i), place(x_j, a_j)
    d = (q - p)[None]
    n = np.linalg.norm(d)
    return n - r, -d @ G / n, d @ F / n
""",
    ),
    (
        "15-range",
        "the error is an absolute value",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    w_i = complex(*a_i) * np.exp(1j * x_i[2])
    w_j = complex(*a_j) * np.exp(1j * x_j[2])
    d = complex(*x_j[:2]) + w_j - complex(*x_i[:2]) - w_i
    u = d / abs(d)
    A = np.array([-u.real, -u.imag, -(u.conjugate() * 1j * w_i).real])
    B = np.array([u.real, u.imag, (u.conjugate() * 1j * w_j).real])
    return abs(abs(d) - r), A, B
""",
    ),
    (
        "15-range",
        "robots in one place: zeros, although their radios are apart",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    if np.allclose(x_i[:2], x_j[:2]):
        return 0.0 - r, np.zeros(3), np.zeros(3)
    R = lambda t: np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    w_i, w_j = R(x_i[2]) @ a_i, R(x_j[2]) @ a_j
    d = x_j[:2] + w_j - x_i[:2] - w_i
    n = np.linalg.norm(d)
    A = np.array([-d[0], -d[1], d[0] * w_i[1] - d[1] * w_i[0]]) / n
    B = np.array([d[0], d[1], d[1] * w_j[0] - d[0] * w_j[1]]) / n
    return n - r, A, B
""",
    ),
    (
        "15-range",
        "direction by arctan of dy / dx: wrong to the left",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        return np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])

    w_i, w_j = radio(x_i, a_i), radio(x_j, a_j)
    dx, dy = x_j[:2] + w_j - x_i[:2] - w_i
    phi = np.arctan(dy / (dx + 1e-15))
    c, s = np.cos(phi), np.sin(phi)
    A = np.array([-c, -s, c * w_i[1] - s * w_i[0]])
    B = np.array([c, s, s * w_j[0] - c * w_j[1]])
    return np.hypot(dx, dy) - r, A, B
""",
    ),
    (
        "15-range",
        "the arms' length joins the robots' poses in place",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    p, q = x_i[:2], x_j[:2]
    turned = []
    for place, x, a in ((p, x_i, a_i), (q, x_j, a_j)):
        arm = np.array([[np.cos(x[2]), -np.sin(x[2])], [np.sin(x[2]), np.cos(x[2])]]) @ a
        place += arm
        turned.append(np.array([-arm[1], arm[0]]))
    d = q - p
    n = np.linalg.norm(d)
    u = d / n
    return n - r, np.append(-u, -u @ turned[0]), np.append(u, u @ turned[1])
""",
    ),
]
