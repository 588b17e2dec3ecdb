"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "09-place",
        "rows by hand, lists returned",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    side = -x[0] * np.sin(a) + x[1] * np.cos(a)
    Jr = [[np.cos(a), np.sin(a), side], [0, 0, 1]]
    Jz = [[1, side], [0, 1]]
    Jr, Jz = np.matrix(Jr), np.matrix(Jz)
    line = [z[0] + x[0] * np.cos(a) + x[1] * np.sin(a), a]
    return line, np.asarray(Jr * P * Jr.T + Jz * R * Jz.T), np.asarray(Jr * P)
""",
    ),
    (
        "09-life",
        "sets and a new dict by comprehension",
        """
def keep_book(book, seen, N, lives):
    here = set(seen)
    new = {i: (n + 1, lives) if i in here else (n, left - 1) for i, (n, left) in book.items()}
    new = {i: v for i, v in new.items() if v[1] > 0} | {i: (1, lives) for i in here - set(book)}
    return new, [i for i in here if new[i][0] >= N]
""",
    ),
]

WRONG = [
    (
        "09-place",
        "α taken for constant",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    Jr = np.array([[c, s, 0], [0, 0, 1]])
    return np.array([z[0] + x[0] * c + x[1] * s, a]), Jr @ P @ Jr.T + R, Jr @ P
""",
    ),
    (
        "09-place",
        "side with the wrong sign",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    k = x[0] * s - x[1] * c
    Jr, Jz = np.array([[c, s, k], [0, 0, 1]]), np.array([[1, k], [0, 1]])
    return np.array([z[0] + x[0] * c + x[1] * s, a]), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-place",
        "made positive",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    k = -x[0] * s + x[1] * c
    Jr, Jz = np.array([[c, s, k], [0, 0, 1]]), np.array([[1, k], [0, 1]])
    rho = z[0] + x[0] * c + x[1] * s
    if rho < 0:
        rho, a = -rho, a + np.pi
    return np.array([rho, a]), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-update",
        "the pose's α column forgotten",
        """
def update(x, P, z, j, R):
    k = 3 + 2 * j
    rho, a = x[k], x[k + 1]
    c, s = np.cos(a), np.sin(a)
    H = np.zeros((2, len(x)))
    H[0, :2], H[0, k] = [-c, -s], 1
    H[1, 2], H[1, k + 1] = -1, 1
    v = z - [rho - x[0] * c - x[1] * s, a - x[2]]
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "expected range by its absolute value",
        """
def update(x, P, z, j, R):
    k = 3 + 2 * j
    rho, a = x[k], x[k + 1]
    c, s = np.cos(a), np.sin(a)
    H = np.zeros((2, len(x)))
    H[0, :2], H[0, k], H[0, k + 1] = [-c, -s], 1, x[0] * s - x[1] * c
    H[1, 2], H[1, k + 1] = -1, 1
    v = z - [abs(rho - x[0] * c - x[1] * s), a - x[2]]
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "the last wall, whichever was seen",
        """
def update(x, P, z, j, R):
    k = len(x) - 2
    rho, a = x[k], x[k + 1]
    c, s = np.cos(a), np.sin(a)
    H = np.zeros((2, len(x)))
    H[0, :2], H[0, k], H[0, k + 1] = [-c, -s], 1, x[0] * s - x[1] * c
    H[1, 2], H[1, k + 1] = -1, 1
    v = z - [rho - x[0] * c - x[1] * s, a - x[2]]
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-life",
        "deletes while it loops",
        """
def keep_book(book, seen, N, lives):
    book = dict(book)
    for i in book:
        if i not in seen:
            n, left = book[i]
            if left == 1:
                del book[i]
            else:
                book[i] = (n, left - 1)
    for i in set(seen):
        n = book.get(i, (0, 0))[0]
        book[i] = (n + 1, lives)
    return book, [i for i in set(seen) if book[i][0] >= N]
""",
    ),
    (
        "09-life",
        "counts a double sighting twice",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n, left)
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        new[i] = (new.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in new if i in seen and new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "used are all in the book",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in new if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "leaves the book below 0, not at 0",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i not in seen and left > 0:
            new[i] = (n, left - 1)
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-end",
        "β from the world's x",
        """
def end_point(x, P, j, beta, sigma):
    def f(s, b):
        rho, a = s[3 + 2 * j], s[4 + 2 * j]
        n, u = np.array([np.cos(a), np.sin(a)]), np.array([np.cos(b), np.sin(b)])
        return s[:2] + (rho - n @ s[:2]) / (n @ u) * u
    J = np.column_stack([(f(x + e, beta) - f(x - e, beta)) / 2e-6 for e in 1e-6 * np.eye(len(x))])
    b = (f(x, beta + 1e-6) - f(x, beta - 1e-6)) / 2e-6
    return f(x, beta), J @ P @ J.T + sigma ** 2 * np.outer(b, b), J @ P
""",
    ),
    (
        "09-end",
        "the beam's error across itself, not along the wall",
        """
def end_point(x, P, j, beta, sigma):
    def f(s, b):
        rho, a = s[3 + 2 * j], s[4 + 2 * j]
        t = s[2] + b
        n, u = np.array([np.cos(a), np.sin(a)]), np.array([np.cos(t), np.sin(t)])
        return s[:2] + (rho - n @ s[:2]) / (n @ u) * u
    J = np.column_stack([(f(x + e, beta) - f(x - e, beta)) / 2e-6 for e in 1e-6 * np.eye(len(x))])
    p = f(x, beta)
    d = p - x[:2]
    b = np.array([-d[1], d[0]])
    return p, J @ P @ J.T + sigma ** 2 * np.outer(b, b), J @ P
""",
    ),
    (
        "09-ghosts",
        "every sighting is a wall of the map",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, pose = [], x[:3].copy()
    for k, scan in enumerate(scans):
        if k:
            d, t = drives[k - 1]
            pose = pose + [d * np.cos(pose[2]), d * np.sin(pose[2]), t]
        for z in scan:
            a = pose[2] + z[1]
            found.append([z[0] + pose[0] * np.cos(a) + pose[1] * np.sin(a), a])
    return np.array(found)
""",
    ),
]
