# %% way: matrices
def range_edge(x_i, x_j, r, a_i, a_j):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    arm_i, arm_j = R(x_i[2]) @ a_i, R(x_j[2]) @ a_j
    d = (x_j[:2] + arm_j) - (x_i[:2] + arm_i)
    distance = np.linalg.norm(d)
    u = d / distance
    turn_i, turn_j = u @ quarter @ arm_i, u @ quarter @ arm_j
    A = np.append(-u, -turn_i)
    B = np.append(u, turn_j)
    return distance - r, A, B

# %% way: the chain rule
def range_edge(x_i, x_j, r, a_i, a_j):
    rows = []
    ends = []
    for x, a in ((x_i, a_i), (x_j, a_j)):
        c, s = np.cos(x[2]), np.sin(x[2])
        ends.append(x[:2] + np.array([[c, -s], [s, c]]) @ a)
        rows.append(np.column_stack([np.eye(2), np.array([[-s, -c], [c, -s]]) @ a]))
    d = ends[1] - ends[0]
    by_d = d / np.sqrt(d @ d)
    return np.sqrt(d @ d) - r, -by_d @ rows[0], by_d @ rows[1]

# %% way: by the angle of sight
def range_edge(x_i, x_j, r, a_i, a_j):
    radio_i, radio_j = (compose(x, [*a, 0.0]) for x, a in ((x_i, a_i), (x_j, a_j)))
    dx, dy = (radio_j - radio_i)[:2]
    sight = np.arctan2(dy, dx)
    long_i, long_j = np.hypot(*a_i), np.hypot(*a_j)
    at_i = x_i[2] + np.arctan2(a_i[1], a_i[0])
    at_j = x_j[2] + np.arctan2(a_j[1], a_j[0])
    A = np.array([-np.cos(sight), -np.sin(sight), -long_i * np.sin(sight - at_i)])
    B = np.array([np.cos(sight), np.sin(sight), long_j * np.sin(sight - at_j)])
    return np.hypot(dx, dy) - r, A, B

# %% way: in the frame of pose i
def range_edge(x_i, x_j, r, a_i, a_j):
    seen = between(x_i, compose(x_j, [*a_j, 0.0]))[:2]
    x, y = seen - a_i
    distance = np.hypot(x, y)
    along = np.array([x, y]) / distance
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    u = np.array([c * along[0] - s * along[1], s * along[0] + c * along[1]])
    A = np.array([-u[0], -u[1], (x * seen[1] - y * seen[0]) / distance])
    there = compose(x_j, [*a_j, 0.0])[:2] - x_j[:2]
    return distance - r, A, np.array([u[0], u[1], u[1] * there[0] - u[0] * there[1]])

# %% pasted: error and Jacobians of task 1 and 2, their first rows
def range_edge(x_i, x_j, r, a_i, a_j):
    z = np.array([r, 0.0, 0.0])
    A, B = jacobians(x_i, x_j, z)
    return error(x_i, x_j, z)[0], A[0], B[0]

# %% pasted: the length of task 1's error, its derivatives by task 2
def range_edge(x_i, x_j, r, a_i, a_j):
    z = np.zeros(3)
    e, (A, B) = error(x_i, x_j, z)[:2], jacobians(x_i, x_j, z)
    u = e / np.hypot(*e)
    return np.hypot(*e) - r, u @ A[:2], u @ B[:2]

# %% pasted: distance of lesson 04's landmark
def range_edge(x_i, x_j, r, a_i, a_j):
    dx, dy = x_j[:2] - x_i[:2]
    q = np.hypot(dx, dy)
    return q - r, np.array([-dx / q, -dy / q, 0.0]), np.array([dx / q, dy / q, 0.0])

# %% pasted: the same, the arm turned by R
def range_edge(x_i, x_j, r, a_i, a_j):
    d = x_j[:2] + a_j - x_i[:2] - a_i
    q = np.hypot(*d)
    return q - r, np.append(-d / q, 0.0), np.append(d / q, 0.0)

# %% right: complex numbers, direction as an angle
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

# %% wrong: central differences, positions subtracted first, with exact steps of a power of two
def range_edge(x_i, x_j, r, a_i, a_j):
    def e(x_i, x_j):
        (ci, cj), (si, sj) = np.cos([x_i[2], x_j[2]]), np.sin([x_i[2], x_j[2]])
        d = x_j[:2] - x_i[:2]
        d = d + [cj * a_j[0] - sj * a_j[1], sj * a_j[0] + cj * a_j[1]]
        return np.hypot(*(d - [ci * a_i[0] - si * a_i[1], si * a_i[0] + ci * a_i[1]])) - r

    H = 2.0**-17 * np.eye(3)
    A = [(e(x_i + h, x_j) - e(x_i - h, x_j)) * 2.0**16 for h in H]
    B = [(e(x_i, x_j + h) - e(x_i, x_j - h)) * 2.0**16 for h in H]
    return e(x_i, x_j), np.array(A), np.array(B)

# %% wrong: e and Jacobians in another order
def range_edge(x_i, x_j, r, a_i, a_j):
    rot = lambda t: np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    p, q = rot(x_i[2]) @ a_i, rot(x_j[2]) @ a_j
    d = x_j[:2] + q - x_i[:2] - p
    n = np.hypot(*d)
    A = np.array([-d[0], -d[1], d[0] * p[1] - d[1] * p[0]]) / n
    B = np.array([d[0], d[1], -d[0] * q[1] + d[1] * q[0]]) / n
    return A, B, n - r

# %% wrong: A and B are matrices of one row
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

# %% wrong: robots in one place: zeros, although their radios are apart
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

# %% wrong: direction by arctan of dy / dx: wrong to the left
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

# %% wrong: the arms' length joins the robots' poses in place
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
