"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "09-place",
        "Jacobians by complex-step differentiation of the formula, not derived by hand",
        """
def place(x, P, z, R):
    x, z = np.asarray(x, float), np.asarray(z, float)
    args = np.concatenate([x, z]).astype(complex)

    def f(a):
        al = a[2] + a[4]
        return np.array([a[3] + a[0] * np.cos(al) + a[1] * np.sin(al), al])

    J = np.zeros((2, 5))
    for k in range(5):
        b = args.copy()
        b[k] += 1e-30j
        J[:, k] = f(b).imag / 1e-30
    rho, alpha = f(args).real
    Jr, Jz = J[:, :3], J[:, 3:]
    return np.array([rho, wrap(alpha)]), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-update",
        "Joseph form of the covariance, gain by solve, innovation angle by atan2",
        """
def update(x, P, z, j, R):
    n = len(x)
    i = 3 + 2 * j
    px, py, th, rho, al = x[0], x[1], x[2], x[i], x[i + 1]
    H = np.zeros((2, n))
    H[0, 0] = -np.cos(al)
    H[0, 1] = -np.sin(al)
    H[0, i] = 1
    H[0, i + 1] = px * np.sin(al) - py * np.cos(al)
    H[1, 2] = -1
    H[1, i + 1] = 1
    d = z[1] - (al - th)
    v = np.array([z[0] - rho + px * np.cos(al) + py * np.sin(al), np.arctan2(np.sin(d), np.cos(d))])
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    A = np.eye(n) - K @ H
    return x + K @ v, A @ P @ A.T + K @ R @ K.T
""",
    ),
    (
        "09-end",
        "end in closed form with r and tan of the slant, Jacobian by central differences",
        """
def end_point(x, P, j, beta, sigma):
    x = np.array(x, dtype=float)
    n = len(x)
    a = 3 + 2 * j

    def end(s):
        phi = s[2] + s[n]
        r = (s[a] - s[0] * np.cos(s[a + 1]) - s[1] * np.sin(s[a + 1])) / np.cos(phi - s[a + 1])
        return np.array([s[0] + r * np.cos(phi), s[1] + r * np.sin(phi)])

    full = np.append(x, beta)
    J = np.zeros((2, n + 1))
    for k in range(n + 1):
        h = np.zeros(n + 1)
        h[k] = 1e-5
        J[:, k] = (8 * (end(full + h) - end(full - h)) - (end(full + 2 * h) - end(full - 2 * h))) / 12e-5
    big = np.zeros((n + 1, n + 1))
    big[:n, :n] = P
    big[n, n] = sigma**2
    return end(full), J @ big @ J.T, J[:, :n] @ P
""",
    ),
]

WRONG = [
    (
        "09-place",
        "alpha inside the cosine forgotten: derivatives of rho by theta and by alpha' are left 0",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    Jr = np.array([[c, s, 0], [0, 0, 1]])
    Jz = np.eye(2)
    return np.array([z[0] + x[0] * c + x[1] * s, alpha]), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-place",
        "lever arm only in the Jacobian of the pose; J_z is the identity",
        """
def place(x, P, z, R):
    px, py, th = x
    alpha = wrap(th + z[1])
    n = np.array([np.cos(alpha), np.sin(alpha)])
    t = np.array([-n[1], n[0]])
    Jr = np.vstack([np.append(n, t @ x[:2]), [0, 0, 1]])
    C = Jr @ P @ Jr.T + R
    return np.array([z[0] + n @ x[:2], alpha]), C, Jr @ P
""",
    ),
    (
        "09-place",
        "derivative of rho by the angle has the wrong sign (x sin - y cos), in both Jacobians",
        """
def place(x, P, z, R):
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    dr = x[0] * s - x[1] * c
    Jr = np.array([[c, s, dr], [0, 0, 1]])
    Jz = np.array([[1, dr], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, alpha])
    return line, Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-place",
        "makes rho positive: flips the normal by pi where rho comes out negative",
        """
def place(x, P, z, R):
    alpha = x[2] + z[1]
    c, s = np.cos(alpha), np.sin(alpha)
    rho = z[0] + x[0] * c + x[1] * s
    k = -x[0] * s + x[1] * c
    Jr = np.array([[c, s, k], [0, 0, 1.0]])
    Jz = np.array([[1, k], [0, 1.0]])
    if rho < 0:
        rho, alpha = -rho, alpha + np.pi
        Jr[0], Jz[0] = -Jr[0], -Jz[0]
    return np.array([rho, wrap(alpha)]), Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "09-place",
        "uses the heading theta instead of alpha in rho and in its derivatives",
        """
def place(x, P, z, R):
    def line_of(v):
        px, py, th, r, a = v
        return np.array([r + px * np.cos(th) + py * np.sin(th), th + a])

    v = np.concatenate([x, z])
    J = np.zeros((2, 5))
    for k in range(5):
        d = np.zeros(5)
        d[k] = 1e-6
        J[:, k] = (line_of(v + d) - line_of(v - d)) / 2e-6
    big = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    line = line_of(v)
    line[1] = wrap(line[1])
    return line, J @ big @ J.T, J[:, :3] @ P
""",
    ),
    (
        "09-place",
        "covariance from 3000 random samples instead of the Jacobians: only roughly right",
        """
def place(x, P, z, R):
    rng = np.random.default_rng(0)
    xs = rng.multivariate_normal(x, P, 3000)
    zs = rng.multivariate_normal(z, R, 3000)
    al = xs[:, 2] + zs[:, 1]
    rho = zs[:, 0] + xs[:, 0] * np.cos(al) + xs[:, 1] * np.sin(al)
    full = np.cov(np.column_stack([rho, al, xs]).T)
    a = wrap(x[2] + z[1])
    line = np.array([z[0] + x[0] * np.cos(a) + x[1] * np.sin(a), a])
    return line, full[:2, :2], full[:2, 2:]
""",
    ),
    (
        "09-update",
        "the innovation's angle is not wrapped",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at], x[at + 1]
    c, s = np.cos(alpha), np.sin(alpha)
    h = np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (z - h), P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "the expected angle is wrapped, but not the difference z - h",
        """
def update(x, P, z, j, R):
    i = 3 + 2 * j
    normal = np.array([np.cos(x[i + 1]), np.sin(x[i + 1])])
    expected = np.array([x[i] - normal @ x[:2], wrap(x[i + 1] - x[2])])
    H = np.zeros((2, x.size))
    H[0, :2] = -normal
    H[1, 2] = -1
    H[0, i], H[1, i + 1] = 1, 1
    H[0, i + 1] = x[0] * normal[1] - x[1] * normal[0]
    S = H @ P @ H.T + R
    K = np.linalg.solve(S.T, H @ P.T).T
    return x + K @ (z - expected), P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "derivative of the expected rho' by the wall's alpha forgotten (0 in H)",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - (rho - x[0] * c - x[1] * s), wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[0, 0], H[0, 1], H[0, at] = -c, -s, 1
    H[1, 2], H[1, at + 1] = -1, 1
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "only the pose and wall j are updated; the other walls and their covariances stay as they were",
        """
def update(x, P, z, j, R):
    pick = [0, 1, 2, 3 + 2 * j, 4 + 2 * j]
    small, Ps = x[pick], P[np.ix_(pick, pick)]
    px, py, th, rho, al = small
    c, s = np.cos(al), np.sin(al)
    H = np.array([[-c, -s, 0, 1, px * s - py * c], [0, 0, -1, 0, 1]])
    v = np.array([z[0] - (rho - px * c - py * s), wrap(z[1] - (al - th))])
    S = H @ Ps @ H.T + R
    K = Ps @ H.T @ np.linalg.inv(S)
    x, P = x.copy(), P.copy()
    x[pick] = small + K @ v
    P[np.ix_(pick, pick)] = Ps - K @ S @ K.T
    return x, P
""",
    ),
    (
        "09-update",
        "rho' and alpha' are taken in one after the other with the diagonal of R: their correlation is ignored",
        """
def update(x, P, z, j, R):
    i = 3 + 2 * j
    al = x[i + 1]
    H = np.zeros((2, len(x)))
    H[0, [0, 1, i, i + 1]] = -np.cos(al), -np.sin(al), 1, x[0] * np.sin(al) - x[1] * np.cos(al)
    H[1, [2, i + 1]] = -1, 1
    v = np.array([z[0] - x[i] + x[0] * np.cos(al) + x[1] * np.sin(al), wrap(z[1] - al + x[2])])
    dx = np.zeros(len(x))
    for k in range(2):
        S = H[k] @ P @ H[k] + R[k, k]
        K = P @ H[k] / S
        dx = dx + K * (v[k] - H[k] @ dx)
        P = P - S * np.outer(K, K)
    return x + dx, P
""",
    ),
    (
        "09-update",
        "a negative expected rho' is made positive and its normal turned by pi",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    r, a = rho - x[0] * c - x[1] * s, alpha - x[2]
    if r < 0:
        r, a = -r, a + np.pi
        H[0] = -H[0]
    v = np.array([z[0] - r, wrap(z[1] - a)])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "wraps everything from theta on in the new state, so a rho above pi is wrapped too",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = z - np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])
    v[1] = wrap(v[1])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    new = x + K @ v
    new[2:] = wrap(new[2:])
    return new, P - K @ S @ K.T
""",
    ),
    (
        "09-life",
        "a wall that stands twice in a scan gets two sightings",
        """
def keep_book(book, seen, N, lives):
    new = {k: (c, l - 1) for k, (c, l) in book.items() if k not in seen and l - 1 > 0}
    for k in seen:
        if k in new:
            new[k] = (new[k][0] + 1, lives)
        elif k in book:
            new[k] = (book[k][0] + 1, lives)
        else:
            new[k] = (1, lives)
    return new, list({k for k in seen if new[k][0] >= N})
""",
    ),
    (
        "09-life",
        "used are all walls of the book with N sightings, also those not in this scan",
        """
def keep_book(book, seen, N, lives):
    seen = set(seen)
    result = {}
    for wall in seen | set(book):
        n, left = book.get(wall, (0, lives))
        if wall in seen:
            result[wall] = (n + 1, lives)
        elif left > 1:
            result[wall] = (n, left - 1)
    return result, [wall for wall, (n, _) in result.items() if n >= N]
""",
    ),
    (
        "09-life",
        "a wall stays with 0 lives and leaves only one scan later (below 0)",
        """
def keep_book(book, seen, N, lives):
    after = dict(book)
    for i in list(after):
        if i not in seen:
            count, left = after[i]
            left -= 1
            if left < 0:
                del after[i]
            else:
                after[i] = (count, left)
    for i in set(seen):
        after[i] = (after[i][0] + 1 if i in after else 1, lives)
    return after, [i for i in set(seen) if after[i][0] >= N]
""",
    ),
    (
        "09-life",
        "a seen wall gets one life back (not all), up to the maximum",
        """
def keep_book(book, seen, N, lives):
    out, used = {}, []
    for i in sorted(set(book) | set(seen)):
        if i in seen:
            if i in book:
                c, l = book[i]
                out[i] = (c + 1, min(l + 1, lives))
            else:
                out[i] = (1, lives)
            if out[i][0] >= N:
                used.append(i)
        else:
            c, l = book[i]
            if l > 1:
                out[i] = (c, l - 1)
    return out, used
""",
    ),
    (
        "09-life",
        "used by the sightings before this scan: the present one is not counted",
        """
def keep_book(book, seen, N, lives):
    seen = set(seen)
    used = [i for i in seen if i in book and book[i][0] >= N]
    after = {}
    for i, (n, left) in book.items():
        if i in seen:
            after[i] = (n + 1, lives)
        elif left - 1 > 0:
            after[i] = (n, left - 1)
    for i in seen - set(book):
        after[i] = (1, lives)
    return after, used
""",
    ),
    (
        "09-life",
        "an empty scan changes nothing: returns the book at once, no life is lost",
        """
def keep_book(book, seen, N, lives):
    if not seen:
        return dict(book), []
    book = dict(book)
    for i in set(seen):
        n = book[i][0] if i in book else 0
        book[i] = (n + 1, lives + 1)
    book = {i: (n, left - 1) for i, (n, left) in book.items() if left > 1}
    return book, [i for i in set(seen) if book[i][0] >= N]
""",
    ),
    (
        "09-life",
        "changes the book that it was given in place",
        """
def keep_book(book, seen, N, lives):
    for i in list(book):
        if i not in seen:
            n, left = book[i]
            if left == 1:
                book.pop(i)
            else:
                book[i] = (n, left - 1)
    for i in set(seen):
        n, _ = book.get(i, (0, lives))
        book[i] = (n + 1, lives)
    return book, [i for i in set(seen) if book[i][0] >= N]
""",
    ),
    (
        "09-life",
        "a new wall loses a life in the scan that brought it: it begins with lives - 1",
        """
def keep_book(book, seen, N, lives):
    after = {}
    for i in set(list(book) + list(seen)):
        if i not in book:
            count, left = 1, lives - 1
        elif i in seen:
            count, left = book[i][0] + 1, lives
        else:
            count, left = book[i][0], book[i][1] - 1
        if left > 0:
            after[i] = (count, left)
    return after, [i for i in set(seen) if i in after and after[i][0] >= N]
""",
    ),
    (
        "09-end",
        "the range r is held fixed: only the pose moves the end, the wall's errors never enter",
        """
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j], x[4 + 2 * j]
    phi = x[2] + beta
    b = np.array([np.cos(phi), np.sin(phi)])
    n = np.array([np.cos(alpha), np.sin(alpha)])
    r = (rho - n @ x[:2]) / (n @ b)
    p = x[:2] + r * b
    perp = r * np.array([-b[1], b[0]])
    J = np.zeros((2, len(x)))
    J[:, :2] = np.eye(2)
    J[:, 2] = perp
    return p, J @ P @ J.T + sigma**2 * np.outer(perp, perp), J @ P
""",
    ),
    (
        "09-end",
        "adds sigma instead of sigma squared for the beam's direction",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    phi = x[2] + beta
    cb, sb, ca, sa = np.cos(phi), np.sin(phi), np.cos(alpha), np.sin(alpha)
    p = np.linalg.solve([[ca, sa], [-sb, cb]], [rho, -sb * x[0] + cb * x[1]])
    r = np.hypot(*(p - x[:2]))
    B = np.zeros((2, len(x)))
    B[0, at], B[0, at + 1] = 1, sa * p[0] - ca * p[1]
    B[1, :3] = -sb, cb, r
    Ninv = np.linalg.inv([[ca, sa], [-sb, cb]])
    J, g = Ninv @ B, Ninv @ [0, r]
    return p, J @ P @ J.T + sigma * np.outer(g, g), J @ P
""",
    ),
    (
        "09-end",
        "the beam's error moves the end by r sigma across the beam, not along the wall: the slant is forgotten",
        """
def end_point(x, P, j, beta, sigma):
    i = 3 + 2 * j

    def hit(s, b):
        phi = s[2] + b
        r = (s[i] - s[0] * np.cos(s[i + 1]) - s[1] * np.sin(s[i + 1])) / np.cos(s[i + 1] - phi)
        return s[:2] + r * np.array([np.cos(phi), np.sin(phi)])

    p = hit(x, beta)
    J = np.zeros((2, len(x)))
    for k in range(len(x)):
        e = np.zeros(len(x))
        e[k] = 1e-6
        J[:, k] = (hit(x + e, beta) - hit(x - e, beta)) / 2e-6
    arm = p - x[:2]
    g = np.array([-arm[1], arm[0]])
    return p, J @ P @ J.T + sigma**2 * np.outer(g, g), J @ P
""",
    ),
    (
        "09-end",
        "pose and wall are treated as independent: their covariance in P is left out of C",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    phi = x[2] + beta
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    beam = np.array([np.cos(phi), np.sin(phi)])
    turned, across = np.array([-normal[1], normal[0]]), np.array([-beam[1], beam[0]])
    r = (rho - normal @ x[:2]) / (normal @ beam)
    p = x[:2] + r * beam
    N = np.array([normal, across])
    B = np.zeros((2, len(x)))
    B[0, at : at + 2] = 1, -turned @ p
    B[1, :2], B[1, 2] = across, r
    J, g = np.linalg.solve(N, B), np.linalg.solve(N, [0, r])
    Jr, Jw = J[:, :3], J[:, at : at + 2]
    C = Jr @ P[:3, :3] @ Jr.T + Jw @ P[at : at + 2, at : at + 2] @ Jw.T
    return p, C + sigma**2 * np.outer(g, g), J @ P
""",
    ),
    (
        "09-end",
        "divides by cos(alpha - beta): the angle between normal and beam without the heading",
        """
def end_point(x, P, j, beta, sigma):
    i = 3 + 2 * j

    def hit(v):
        r = (v[i] - v[0] * np.cos(v[i + 1]) - v[1] * np.sin(v[i + 1])) / np.cos(v[i + 1] - v[-1])
        return np.array([v[0] + r * np.cos(v[2] + v[-1]), v[1] + r * np.sin(v[2] + v[-1])])

    v = np.append(x, beta)
    J = np.empty((2, v.size))
    for k in range(v.size):
        step = np.zeros(v.size)
        step[k] = 1e-6
        J[:, k] = (hit(v + step) - hit(v - step)) / 2e-6
    C = J[:, :-1] @ P @ J[:, :-1].T + sigma**2 * np.outer(J[:, -1], J[:, -1])
    return hit(v), C, J[:, :-1] @ P
""",
    ),
    (
        "09-end",
        "X only for the pose: zeros in the columns of the walls' errors that P knows",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    phi = x[2] + beta
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    beam = np.array([np.cos(phi), np.sin(phi)])
    turned, across = np.array([-normal[1], normal[0]]), np.array([-beam[1], beam[0]])
    r = (rho - normal @ x[:2]) / (normal @ beam)
    p = x[:2] + r * beam
    N = np.array([normal, across])
    B = np.zeros((2, len(x)))
    B[0, at : at + 2] = 1, -turned @ p
    B[1, :2], B[1, 2] = across, r
    J, g = np.linalg.solve(N, B), np.linalg.solve(N, [0, r])
    X = np.zeros((2, len(x)))
    X[:, :3] = J[:, :3] @ P[:3, :3]
    return p, J @ P @ J.T + sigma**2 * np.outer(g, g), X
""",
    ),
    (
        "09-ghosts",
        "no association at all: every sighting, placed by the wheels, is returned as a wall",
        """
def clean_map(x, P, drives, C, scans, R, far):
    walls = []
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            line, _, _ = place(x, P, z, R)
            walls.append(line)
    return np.array(walls).reshape(-1, 2)
""",
    ),
    (
        "09-ghosts",
        "book of lives over the whole drive: walls left behind die, only those alive at the end come back",
        """
def clean_map(x, P, drives, C, scans, R, far):
    book, names, nxt = {}, [], 0
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        seen = []
        for z in scan:
            best, who = 1.0, None
            for k in range(len(names)):
                rho, al = x[3 + 2 * k], x[4 + 2 * k]
                e = np.hypot(
                    (z[0] - rho + x[0] * np.cos(al) + x[1] * np.sin(al)) / 0.4,
                    wrap(z[1] - al + x[2]) / 0.15,
                )
                if e < best:
                    best, who = e, k
            if who is None:
                x, P = add(x, P, z, R)
                names.append(nxt)
                seen.append(nxt)
                nxt += 1
            else:
                x, P = update(x, P, z, who, R)
                seen.append(names[who])
        book, _ = keep_book(book, seen, 3, 5)
        alive = [k for k, name in enumerate(names) if name in book]
        idx = [0, 1, 2] + [i for k in alive for i in (3 + 2 * k, 4 + 2 * k)]
        x, P, names = x[idx], P[np.ix_(idx, idx)], [names[k] for k in alive]
    keep = [k for k, name in enumerate(names) if book[name][0] >= 3]
    return x[3:].reshape(-1, 2)[keep]
""",
    ),
    (
        "09-ghosts",
        "keeps whatever was found five times: nothing asks in how many scans it was in view and not found, so the things stay",
        """
def clean_map(x, P, drives, C, scans, R, far):
    hits = []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            al = x[4::2]
            d = np.abs(z[0] - (x[3::2] - x[0] * np.cos(al) - x[1] * np.sin(al)))
            a = np.abs(wrap(z[1] - al + x[2]))
            near = np.flatnonzero((d < 0.5) & (a < 0.15))
            if near.size == 0:
                x, P = add(x, P, z, R)
                hits.append(1)
            else:
                k = near[np.argmin(d[near] + 3 * a[near])]
                hits[k] += 1
                if hits[k] > 2:
                    x, P = update(x, P, z, k, R)
    return x[3:].reshape(-1, 2)[np.array(hits) >= 5]
""",
    ),
    (
        "09-ghosts",
        "dead reckoning and clusters in the world, no filter: the drift of the wheels spoils the walls and doubles them",
        """
def clean_map(x, P, drives, C, scans, R, far):
    groups = []
    pose = np.array(x, dtype=float)
    for t, scan in enumerate(scans):
        if t > 0:
            d, turn = drives[t - 1]
            pose = pose + [d * np.cos(pose[2]), d * np.sin(pose[2]), turn]
        for r, a in scan:
            al = wrap(pose[2] + a)
            rho = r + pose[0] * np.cos(al) + pose[1] * np.sin(al)
            for g in groups:
                if abs(g[0][0] - rho) < 0.3 and abs(wrap(g[0][1] - al)) < 0.1:
                    g.append((rho, al))
                    break
            else:
                groups.append([(rho, al)])
    return np.array([g[0] for g in groups if len(g) >= 12]).reshape(-1, 2)
""",
    ),
    (
        "09-ghosts",
        "drives before the first scan: each drive is one scan too early, the last scan is left out",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, due = [], []
    for u, scan in zip(drives, scans):
        x, P = predict(x, P, u, C)
        for k in range(len(found)):
            gap = x[3 + 2 * k] - x[0] * np.cos(x[4 + 2 * k]) - x[1] * np.sin(x[4 + 2 * k])
            due[k] += 0 < gap < far - 0.3
        for z in scan:
            best, j = 1, None
            for k in range(len(found)):
                rho, al = x[3 + 2 * k : 5 + 2 * k]
                e = np.hypot((z[0] - rho + x[0] * np.cos(al) + x[1] * np.sin(al)) / 0.45,
                             wrap(z[1] - al + x[2]) / 0.14)
                if e < best:
                    best, j = e, k
            if j is None:
                x, P = add(x, P, z, R)
                found.append(1)
                due.append(1)
            else:
                found[j] += 1
                x, P = update(x, P, z, j, R)
    found, due = np.array(found), np.array(due)
    return x[3:].reshape(-1, 2)[(found >= 5) & (found >= 0.6 * due)]
""",
    ),
]
