"""Independent answers to 09-update: right ones, and students' mistakes."""

RIGHT = [
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
]

WRONG = [
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
]
