"""Independent answers to exercise 09: right ones, and students' mistakes."""

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
    (
        "09-update",
        "a loop over the two numbers of H, Joseph's form",
        """
def update(x, P, z, j, R):
    n = len(x)
    i = 3 + 2 * j
    a = x[i + 1]
    expected = [x[i] - x[0] * np.cos(a) - x[1] * np.sin(a), a - x[2]]
    H = np.zeros((2, n))
    H[0, 0], H[0, 1] = -np.cos(a), -np.sin(a)
    H[0, i], H[0, i + 1] = 1, x[0] * np.sin(a) - x[1] * np.cos(a)
    H[1, 2], H[1, i + 1] = -1, 1
    v = np.array([z[0] - expected[0], (z[1] - expected[1] + np.pi) % (2 * np.pi) - np.pi])
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    A = np.eye(n) - K @ H
    return x + K @ v, A @ P @ A.T + K @ R @ K.T
""",
    ),
    (
        "09-update",
        "rho first, then alpha, by whitening R; expectation stays that of the given state",
        """
def update(x, P, z, j, R):
    k = 3 + 2 * j
    n = np.array([np.cos(x[k + 1]), np.sin(x[k + 1])])
    t = np.array([-n[1], n[0]])
    H = np.zeros((2, x.size))
    H[0, :2] = -n
    H[0, k] = 1
    H[0, k + 1] = -t @ x[:2]
    H[1, 2] = -1
    H[1, k + 1] = 1
    v = np.array([z[0] - (x[k] - n @ x[:2]), wrap(z[1] - x[k + 1] + x[2])])
    L = np.linalg.inv(np.linalg.cholesky(R))
    G, w = L @ H, L @ v
    dx, Q = np.zeros(x.size), P.copy()
    for g_row, w_row in zip(G, w):
        gain = Q @ g_row / (g_row @ Q @ g_row + 1)
        dx = dx + gain * (w_row - g_row @ dx)
        Q = Q - np.outer(gain, g_row @ Q)
    return x + dx, (Q + Q.T) / 2
""",
    ),
    (
        "09-life",
        "a copy of the book, changed in three passes",
        """
def keep_book(book, seen, N, lives):
    new = dict(book)
    here = set(seen)
    for i in list(new):
        if i not in here:
            count, left = new[i]
            if left == 1:
                del new[i]
            else:
                new[i] = (count, left - 1)
    used = []
    for i in here:
        count = new.get(i, (0, 0))[0] + 1
        new[i] = (count, lives)
        if count >= N:
            used.append(i)
    return new, used
""",
    ),
    (
        "09-life",
        "comprehensions",
        """
def keep_book(book, seen, N, lives):
    seen = list(dict.fromkeys(seen))
    missed = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left - 1 > 0}
    found = {i: (book.get(i, (0, lives))[0] + 1, lives) for i in seen}
    return missed | found, [i for i, (n, _) in found.items() if n >= N]
""",
    ),
    (
        "09-end",
        "the slopes of r by hand",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = b * dr[2] + r * db
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "complex-step differentiation",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j

    def meet(y):
        x_, b = y[:-1], y[-1]
        c, s = np.cos(x_[at + 1]), np.sin(x_[at + 1])
        u = np.array([np.cos(x_[2] + b), np.sin(x_[2] + b)])
        r = (x_[at] - c * x_[0] - s * x_[1]) / (c * u[0] + s * u[1])
        return x_[:2] + r * u

    y = np.append(x, beta)
    J = np.zeros((2, len(y)))
    for i in range(len(y)):
        step = y.astype(complex)
        step[i] += 1e-30j
        J[:, i] = meet(step).imag / 1e-30
    A, b = J[:, :-1], J[:, -1:]
    return meet(y), A @ P @ A.T + sigma ** 2 * b @ b.T, A @ P
""",
    ),
    (
        "09-ghosts",
        "the whole drive first, then found / in view along the way",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    keep = []
    for k, (rho, alpha) in enumerate(walls):
        gap = rho - way @ [np.cos(alpha), np.sin(alpha)]
        due = np.sum((gap > 0.1) & (gap < far - 0.3))
        if found[k] >= 5 and found[k] >= 0.6 * due:
            keep.append(k)
    return walls[keep]
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
    (
        "09-update",
        "the angle of v is not wrapped",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at], x[at + 1]
    c, s = np.cos(alpha), np.sin(alpha)
    v = z - np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at:at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "only the predicted angle is wrapped",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at], x[at + 1]
    c, s = np.cos(alpha), np.sin(alpha)
    v = z - np.array([rho - x[0] * c - x[1] * s, wrap(alpha - x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at:at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "the slope of rho' by alpha is missing",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = np.eye(2)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "the slope of rho' by alpha has the wrong sign",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, -x[0] * s + x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "wall j begins at 3 + j",
        """
def update(x, P, z, j, R):
    at = 3 + j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "j counted from 1",
        """
def update(x, P, z, j, R):
    at = 1 + 2 * j if j > 0 else 3
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "only the pose and this wall are corrected",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    sel = [0, 1, 2, at, at + 1]
    y, Q = x[sel], P[np.ix_(sel, sel)]
    c, s = np.cos(y[4]), np.sin(y[4])
    v = np.array([z[0] - y[3] + y[0] * c + y[1] * s, wrap(z[1] - y[4] + y[2])])
    H = np.array([[-c, -s, 0, 1, y[0] * s - y[1] * c], [0, 0, -1, 0, 1]])
    S = H @ Q @ H.T + R
    K = Q @ H.T @ np.linalg.inv(S)
    x, P = x.copy(), P.copy()
    x[sel] = y + K @ v
    P[np.ix_(sel, sel)] = Q - K @ S @ K.T
    return x, P
""",
    ),
    (
        "09-update",
        "v with the wrong sign",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([rho - x[0] * c - x[1] * s - z[0], wrap(alpha - x[2] - z[1])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "the slope by theta is +1",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[0, :2] = -c, -s
    H[1, 2] = 1
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "the map of one wall: H has five columns",
        """
def update(x, P, z, j, R):
    rho, alpha = x[3], x[4]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.array([[-c, -s, 0, 1, x[0] * s - x[1] * c], [0, 0, -1, 0, 1]])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "a wall behind the robot is not believed: |rho'|",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - abs(rho - x[0] * c - x[1] * s), wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "the angle of v between 0 and 2 pi",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    turn = z[1] - alpha + x[2]
    turn = turn % (2 * np.pi)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, turn])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "P - K H",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ H
""",
    ),
    (
        "09-update",
        "x changed in place",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x += K @ v
    return x, P - K @ S @ K.T
""",
    ),
    (
        "09-update",
        "stale: P by H at the new state",
        """
def update(x, P, z, j, R):
    at = 3 + 2 * j

    def slopes(x):
        c, s = np.cos(x[at + 1]), np.sin(x[at + 1])
        H = np.zeros((2, len(x)))
        H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
        H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
        return H

    H = slopes(x)
    c, s = np.cos(x[at + 1]), np.sin(x[at + 1])
    v = np.array([z[0] - x[at] + x[0] * c + x[1] * s, wrap(z[1] - x[at + 1] + x[2])])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    x = x + K @ v
    return x, (np.eye(len(x)) - K @ slopes(x)) @ P
""",
    ),
    (
        "09-life",
        "twice in one scan counts twice",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i in seen or left > 1}
    for i in seen:
        n = new[i][0] if i in new else 0
        new[i] = (n + 1, lives)
    return new, sorted({i for i in seen if new[i][0] >= N})
""",
    ),
    (
        "09-life",
        "N exclusive",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] > N]
""",
    ),
    (
        "09-life",
        "used by the book before this scan",
        """
def keep_book(book, seen, N, lives):
    used = [i for i in set(seen) if i in book and book[i][0] >= N]
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, used
""",
    ),
    (
        "09-life",
        "used are all of the book with N sightings",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i, (n, _) in new.items() if n >= N]
""",
    ),
    (
        "09-life",
        "leaves the book at -1: one life too many",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            continue
        if left - 1 >= 0:
            new[i] = (n, left - 1)
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "leaves the book at 1: one life too few",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i not in seen and left > 2:
            new[i] = (n, left - 1)
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "lives are not given back",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, left)
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        if i not in book:
            new[i] = (1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "gets one life back, not all",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, min(left + 1, lives))
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        if i not in book:
            new[i] = (1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "changes the book it is given",
        """
def keep_book(book, seen, N, lives):
    for i in list(book):
        if i not in seen:
            n, left = book[i]
            book[i] = (n, left - 1)
            if left <= 1:
                del book[i]
    for i in set(seen):
        book[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return book, [i for i in set(seen) if book[i][0] >= N]
""",
    ),
    (
        "09-life",
        "deletes while it goes through the dict",
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
        book[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return book, [i for i in set(seen) if book[i][0] >= N]
""",
    ),
    (
        "09-life",
        "all lose a life first: a wall with one life is dropped though it is seen",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if left > 1}
    for i in set(seen):
        new[i] = (new[i][0] + 1 if i in new else 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "a new wall comes in with no sighting",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, lives)
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        new.setdefault(i, (0, lives))
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "a new wall is never used, even with N = 1",
        """
def keep_book(book, seen, N, lives):
    new, used = {}, []
    for i, (n, left) in book.items():
        if i in seen:
            new[i] = (n + 1, lives)
            if n + 1 >= N:
                used.append(i)
        elif left > 1:
            new[i] = (n, left - 1)
    for i in seen:
        if i not in book:
            new[i] = (1, lives)
    return new, used
""",
    ),
    (
        "09-life",
        "an empty scan costs no lives",
        """
def keep_book(book, seen, N, lives):
    if len(seen) == 0:
        return dict(book), []
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "used lists a wall as often as it stands in the scan",
        """
def keep_book(book, seen, N, lives):
    new = {i: (n, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in seen if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "sightings reset when a scan is missed",
        """
def keep_book(book, seen, N, lives):
    new = {i: (0, left - 1) for i, (n, left) in book.items() if i not in seen and left > 1}
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-life",
        "what has been used once never leaves the book",
        """
def keep_book(book, seen, N, lives):
    new = {}
    for i, (n, left) in book.items():
        if i not in seen and (left > 1 or n >= N):
            new[i] = (n, max(left - 1, 1))
    for i in set(seen):
        new[i] = (book.get(i, (0, 0))[0] + 1, lives)
    return new, [i for i in set(seen) if new[i][0] >= N]
""",
    ),
    (
        "09-end",
        "beta counted from the world's x",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "r does not depend on the heading",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = 0
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the wall's direction: slope by the robot's place instead of the end's",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ x[:2]) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the wall's direction is taken as known",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = 0
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the beam's error across the beam only, not along the wall",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = r * db
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "sigma not squared",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the beam's error is forgotten",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T, J @ P
""",
    ),
    (
        "09-end",
        "X is (n, 2)",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), P @ J.T
""",
    ),
    (
        "09-end",
        "X holds only the pose",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J[:, :3] @ P[:3, :3]
""",
    ),
    (
        "09-end",
        "divides by the cosine of beta instead of that between beam and normal",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / np.cos(beta)
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "wall j begins at 3 + j",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "slope of rho is 1",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "r is a reading and held fixed: as for a point landmark",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    c, s = np.cos(x[k + 1]), np.sin(x[k + 1])
    f = x[2] + beta
    u = np.array([np.cos(f), np.sin(f)])
    r = (x[k] - c * x[0] - s * x[1]) / (c * u[0] + s * u[1])
    J = np.zeros((2, len(x)))
    J[:, :2] = np.eye(2)
    J[:, 2] = r * np.array([-u[1], u[0]])
    return x[:2] + r * u, J @ P @ J.T + sigma ** 2 * np.outer(J[:, 2], J[:, 2]), J @ P
""",
    ),
    (
        "09-end",
        "the wall is exact: its columns of J are zero",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    n = np.array([np.cos(x[k + 1]), np.sin(x[k + 1])])
    t = np.array([-n[1], n[0]])
    f = x[2] + beta
    u = np.array([np.cos(f), np.sin(f)])
    v = np.array([-u[1], u[0]])
    r = (x[k] - n @ x[:2]) / (n @ u)
    J = np.zeros((2, len(x)))
    J[:, :2] = np.outer(t, v) / (t @ v)
    J[:, 2] = t * r / (t @ v)
    return x[:2] + r * u, J @ P @ J.T + sigma ** 2 * np.outer(J[:, 2], J[:, 2]), J @ P
""",
    ),
    (
        "09-end",
        "pose and wall as if independent of each other",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j
    Q = np.zeros_like(P)
    Q[:3, :3] = P[:3, :3]
    Q[at:at + 2, at:at + 2] = P[at:at + 2, at:at + 2]
    n = np.array([np.cos(x[at + 1]), np.sin(x[at + 1])])
    u = np.array([np.cos(x[2] + beta), np.sin(x[2] + beta)])
    t, v = np.array([-n[1], n[0]]), np.array([-u[1], u[0]])
    r = (x[at] - n @ x[:2]) / (n @ u)
    p = x[:2] + r * u
    A = np.array([n, v])
    B = np.zeros((2, len(x)))
    B[0, at], B[0, at + 1] = 1, -t @ p
    B[1, :2], B[1, 2] = v, r
    J = np.linalg.inv(A) @ B
    g = np.linalg.inv(A) @ [0, r]
    return p, J @ Q @ J.T + sigma ** 2 * np.outer(g, g), J @ P
""",
    ),
    (
        "09-end",
        "half-finished: a round ellipse of r sigma, X zero",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    c, s = np.cos(x[k + 1]), np.sin(x[k + 1])
    u = np.array([np.cos(x[2] + beta), np.sin(x[2] + beta)])
    r = (x[k] - c * x[0] - s * x[1]) / (c * u[0] + s * u[1])
    return x[:2] + r * u, P[:2, :2] + (r * sigma) ** 2 * np.eye(2), np.zeros((2, len(x)))
""",
    ),
    (
        "09-end",
        "differences with a far too large step",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j

    def meet(x, beta):
        c, s = np.cos(x[at + 1]), np.sin(x[at + 1])
        u = np.array([np.cos(x[2] + beta), np.sin(x[2] + beta)])
        return x[:2] + (x[at] - c * x[0] - s * x[1]) / (c * u[0] + s * u[1]) * u

    p, e = meet(x, beta), 0.01
    J = np.column_stack([(meet(x + e * row, beta) - p) / e for row in np.eye(len(x))])
    b = (meet(x, beta + e) - p) / e
    return p, J @ P @ J.T + sigma ** 2 * np.outer(b, b), J @ P
""",
    ),
    (
        "09-end",
        "sigma taken for degrees",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + np.radians(sigma) ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-ghosts",
        "everything that was found",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls
""",
    ),
    (
        "09-ghosts",
        "three sightings",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 3]
""",
    ),
    (
        "09-ghosts",
        "ten sightings",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 10]
""",
    ),
    (
        "09-ghosts",
        "twenty sightings",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 20]
""",
    ),
    (
        "09-ghosts",
        "the eight that were found most often",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    best = np.argsort(-found)[:8]
    return walls[best]
""",
    ),
    (
        "09-ghosts",
        "share of all scans, whether in view or not",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 0.4 * len(scans)]
""",
    ),
    (
        "09-ghosts",
        "a gate so narrow that walls are doubled",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.1, wrap(z[1] - a + x[2]) / 0.03)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0) & (gap < far), axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "a gate so wide that walls become one",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 3, wrap(z[1] - a + x[2]) / 1.0)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 0:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0) & (gap < far), axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "nothing at all",
        """
def clean_map(x, P, drives, C, scans, R, far):
    return np.zeros((0, 2))
""",
    ),
    (
        "09-ghosts",
        "a guess: eight walls round the start",
        """
def clean_map(x, P, drives, C, scans, R, far):
    return np.column_stack([np.full(8, 4.0), wrap(np.arange(8) * np.pi / 4)])
""",
    ),
    (
        "09-ghosts",
        "by wheels alone, no update",
        """
def clean_map(x, P, drives, C, scans, R, far):
    walls, found, way = np.zeros((0, 2)), np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            line = place(x, P, z, R)[0]
            off = np.hypot((walls[:, 0] - line[0]) / 0.5, wrap(walls[:, 1] - line[1]) / 0.2)
            if len(off) and off.min() < 1:
                found[off.argmin()] += 1
            else:
                walls = np.vstack([walls, line])
                found = np.append(found, 1)
        way.append(x[:2])
    gap = walls[:, 0] - np.array(way) @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0) & (gap < far), axis=0)
    return walls[(found >= 5) & (found > 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "a book of lives: walls left behind are forgotten",
        """
def clean_map(x, P, drives, C, scans, R, far):
    count, left = [], []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        seen = set()
        for z in scan:
            a = x[4::2]
            r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
            off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
            if len(off) and off.min() < 1:
                j = int(off.argmin())
                x, P = update(x, P, z, j, R)
                count[j] += 1
            else:
                x, P = add(x, P, z, R)
                j = len(count)
                count.append(1)
                left.append(5)
            seen.add(j)
        left = [5 if i in seen else n - 1 for i, n in enumerate(left)]
        stay = [i for i, n in enumerate(left) if n > 0]
        at = [0, 1, 2] + [k for i in stay for k in (3 + 2 * i, 4 + 2 * i)]
        x, P = x[at], P[np.ix_(at, at)]
        count, left = [count[i] for i in stay], [left[i] for i in stay]
    return x[3:].reshape(-1, 2)[np.array(count, dtype=int) >= 3]
""",
    ),
    (
        "09-ghosts",
        "the lines in the robot's frame, of all scans",
        """
def clean_map(x, P, drives, C, scans, R, far):
    return np.vstack([s for s in scans if len(s)])
""",
    ),
    (
        "09-ghosts",
        "drives one late: predicts after the scan with the same index, first scan driven",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for u, scan in zip(drives, scans):
        x, P = predict(x, P, u, C)
        for z in scan:
            a = x[4::2]
            r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
            off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
            if len(off) == 0 or off.min() > 1:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[off.argmin()] += 1
                x, P = update(x, P, z, int(off.argmin()), R)
    return x[3:].reshape(-1, 2)[found >= 8]
""",
    ),
    (
        "09-ghosts",
        "found / in view, but in view counts walls behind the robot too",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = abs(walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])]))
    due = np.sum(gap < 3 * far, axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "the wrong columns: alpha first",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0.1) & (gap < far - 0.3), axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)][:, ::-1]
""",
    ),
]
