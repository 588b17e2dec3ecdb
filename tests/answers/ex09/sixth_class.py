"""A sixth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "09-place",
        "Jacobians by a complex step",
        """
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
""",
    ),
    (
        "09-end",
        "two lines that meet, differentiated implicitly",
        """
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j], x[4 + 2 * j]
    phi = x[2] + beta
    n, m = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(phi), np.cos(phi)])
    along, ahead = np.array([-n[1], n[0]]), np.array([m[1], -m[0]])
    A = np.array([n, m])
    p = np.linalg.solve(A, [rho, m @ x[:2]])
    wrong = np.zeros((2, len(x) + 1))
    wrong[0, 3 + 2 * j] = 1
    wrong[0, 4 + 2 * j] = -along @ p
    wrong[1, :2] = m
    wrong[1, 2] = wrong[1, -1] = ahead @ (p - x[:2])
    J = np.linalg.solve(A, wrong)
    F, w = J[:, :-1], J[:, -1:]
    return p, F @ P @ F.T + sigma**2 * w @ w.T, F @ P
""",
    ),
    (
        "09-life",
        "a new book from the union of old and seen",
        """
def keep_book(book, seen, N, lives):
    now, new = set(seen), {}
    for id in now | set(book):
        times, left = book.get(id, (0, lives))
        times, left = (times + 1, lives) if id in now else (times, left - 1)
        if left > 0:
            new[id] = (times, left)
    return new, [id for id in now if new[id][0] >= N]
""",
    ),
]

WRONG = [
    (
        "09-place",
        "the robot's foot point on the wall, as if it were the origin's",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    fx, fy = x[0] + z[0] * c, x[1] + z[0] * s
    rho = np.hypot(fx, fy)
    J_foot = np.array([[fx / rho, fy / rho], [-fy / rho**2, fx / rho**2]])
    Jr = J_foot @ np.array([[1, 0, -z[0] * s], [0, 1, z[0] * c]])
    Jz = J_foot @ np.array([[c, -z[0] * s], [s, z[0] * c]])
    line = np.array([rho, np.arctan2(fy, fx)])
    return line, Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-update",
        "an expected distance below zero is turned round",
        """
def update(x, P, z, j, R):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    c, s = np.cos(alpha), np.sin(alpha)
    H = np.zeros((2, len(x)))
    H[0, :2], H[0, k], H[0, k + 1] = [-c, -s], 1, x[0] * s - x[1] * c
    H[1, 2], H[1, k + 1] = -1, 1
    expected = np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])
    if expected[0] < 0:
        expected = np.array([-expected[0], expected[1] + np.pi])
        H[0] = -H[0]
    v = z - expected
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "only the pose and the wall that was seen",
        """
def update(x, P, z, j, R):
    part = np.array([0, 1, 2, 3 + 2 * j, 4 + 2 * j])
    y, Q = x[part], P[np.ix_(part, part)]
    c, s = np.cos(y[4]), np.sin(y[4])
    H = np.array([[-c, -s, 0, 1, y[0] * s - y[1] * c], [0, 0, -1, 0, 1]])
    v = np.array([z[0] - (y[3] - y[0] * c - y[1] * s), wrap(z[1] - y[4] + y[2])])
    S = H @ Q @ H.T + R
    K = Q @ H.T @ np.linalg.inv(S)
    x, P = x.copy(), P.copy()
    x[part] = y + K @ v
    P[np.ix_(part, part)] = Q - K @ S @ K.T
    return x, P
""",
    ),
    (
        "09-life",
        "a loop in the loop: each wall of the scan takes a life from every other",
        """
def keep_book(book, seen, N, lives):
    book = dict(book)
    for id in set(seen):
        times = book[id][0] if id in book else 0
        book[id] = (times + 1, lives)
        for other in list(book):
            if other not in seen:
                book[other] = (book[other][0], book[other][1] - 1)
                if book[other][1] == 0:
                    del book[other]
    return book, [id for id in set(seen) if book[id][0] >= N]
""",
    ),
    (
        "09-life",
        "it leaves the book only when it has no life to lose",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for id, (times, left) in book.items():
        if id in seen:
            new[id] = (times + 1, lives)
        elif left == 0:
            pass
        else:
            new[id] = (times, left - 1)
    for id in seen:
        if id not in book:
            new[id] = (1, lives)
    used = []
    for id in seen:
        if new[id][0] >= N and id not in used:
            used.append(id)
    return new, used
""",
    ),
    (
        "09-end",
        "the range is found once and then held",
        """
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j], x[4 + 2 * j]
    phi = x[2] + beta
    r = (rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)) / np.cos(phi - alpha)
    c, s = np.cos(phi), np.sin(phi)
    p = x[:2] + r * np.array([c, s])
    F = np.zeros((2, len(x)))
    F[:, :3] = [[1, 0, -r * s], [0, 1, r * c]]
    w = F[:, 2:3]
    return p, F @ P @ F.T + sigma**2 * w @ w.T, F @ P
""",
    ),
    (
        "09-end",
        "pose and wall as if they erred on their own",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    def point(v, b):
        phi = v[2] + b
        r = (v[3] - v[0] * np.cos(v[4]) - v[1] * np.sin(v[4])) / np.cos(phi - v[4])
        return v[:2] + r * np.array([np.cos(phi), np.sin(phi)])
    v = np.concatenate([x[:3], x[k : k + 2]])
    e = 1e-6
    J = np.column_stack(
        [(point(v + e * d, beta) - point(v - e * d, beta)) / (2 * e) for d in np.eye(5)]
    )
    w = ((point(v, beta + e) - point(v, beta - e)) / (2 * e))[:, None]
    Jr, Jl = J[:, :3], J[:, 3:]
    C = Jr @ P[:3, :3] @ Jr.T + Jl @ P[k : k + 2, k : k + 2] @ Jl.T + sigma**2 * w @ w.T
    X = np.zeros((2, len(x)))
    X[:, :3] = Jr @ P[:3, :3]
    X[:, k : k + 2] = Jl @ P[k : k + 2, k : k + 2]
    return point(v, beta), C, X
""",
    ),
    (
        "09-ghosts",
        "a wall is what was sighted eight times, by the wheels alone",
        """
def clean_map(x, P, drives, C, scans, R, far):
    x, walls = x.copy(), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            a = wrap(x[2] + z[1])
            line = np.array([z[0] + x[0] * np.cos(a) + x[1] * np.sin(a), a])
            for wall in walls:
                mean = wall[0] / wall[1]
                if abs(line[0] - mean[0]) < 0.5 and abs(wrap(line[1] - mean[1])) < 0.2:
                    wall[0], wall[1] = wall[0] + line, wall[1] + 1
                    break
            else:
                walls.append([line, 1])
    return np.array([s / n for s, n in walls if n >= 8])
""",
    ),
]
