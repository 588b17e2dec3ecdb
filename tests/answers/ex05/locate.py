"""Independent answers to 05-locate: right ones, and students' mistakes."""

RIGHT = [
    (
        "05-locate",
        "information form",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    W = np.linalg.inv(R)
    P_new = np.linalg.inv(np.linalg.inv(P) + H.T @ W @ H)
    dr, db = z - h(x, p)
    v = np.array([dr, wrap(db)])
    return x + P_new @ H.T @ W @ v, P_new
""",
    ),
    (
        "05-locate",
        "Joseph's form, solve, Jacobian by hand",
        """
def locate(x, P, z, p, R):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx ** 2 + dy ** 2
    r = q ** 0.5
    H = np.array([[-dx / r, -dy / r, 0.0], [dy / q, -dx / q, -1.0]])
    beta = np.arctan2(dy, dx) - x[2]
    db = (z[1] - beta + np.pi) % (2 * np.pi) - np.pi
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    I_KH = np.eye(3) - K @ H
    return x + K @ np.array([z[0] - r, db]), I_KH @ P @ I_KH.T + K @ R @ K.T
""",
    ),
    (
        "05-locate",
        "(I - KH) P, heading wrapped at the end",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    v = z - h(x, p)
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    new = x + K @ v
    new[2] = wrap(new[2])
    return new, (np.eye(3) - K @ H) @ P
""",
    ),
]

WRONG = [
    (
        "05-locate",
        "bearing not wrapped",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "both of v wrapped, also the range",
        """
def locate(x, P, z, p, R):
    v = wrap(z - h(x, p))
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "v is expected minus measured",
        """
def locate(x, P, z, p, R):
    v = h(x, p) - z
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, (np.eye(3) - K @ H) @ P
""",
    ),
    (
        "05-locate",
        "R is forgotten",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    dr, db = z - h(x, p)
    S = H @ P @ H.T
    K = P @ H.T @ np.linalg.pinv(S)
    return x + K @ [dr, wrap(db)], P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "only R's diagonal",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    v = z - h(x, p)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + np.diag(np.diag(R))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "P is not updated",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    x = x + K @ v
    return x, P
""",
    ),
    (
        "05-locate",
        "divides by S[0, 0] instead of the inverse",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T / S[0, 0]
    v = z - h(x, p)
    v[1] = wrap(v[1])
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "elementwise 1 / S",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ (1 / S)
    v = z - h(x, p)
    v[1] = wrap(v[1])
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "the Jacobian at the new pose for P",
        """
def locate(x, P, z, p, R):
    def gain(at):
        H = H_robot(at, p)
        S = H @ P @ H.T + R
        return P @ H.T @ np.linalg.inv(S), S

    v = z - h(x, p)
    v[1] = wrap(v[1])
    K, S = gain(x)
    x = x + K @ v
    K, S = gain(x)
    return x, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "a gate: a sight that contradicts the belief is thrown away",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    if v @ np.linalg.solve(S, v) > 9.21:
        return x, P
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "x changed in place with +=",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x += K @ v
    P -= K @ S @ K.T
    return x, P
""",
    ),
    (
        "05-locate",
        "the landmark's Jacobian with a zero column for the heading",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = np.column_stack([H_landmark(x, p), [0, -1]])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "the heading column of H is zero",
        """
def locate(x, P, z, p, R):
    d = p - x[:2]
    r = np.hypot(*d)
    H = np.zeros((2, 3))
    H[0, :2] = -d / r
    H[1, :2] = d[1] / r ** 2, -d[0] / r ** 2
    v = z - h(x, p)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "wraps once by hand: with pi instead of 2 pi",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    if v[1] > np.pi:
        v[1] -= np.pi
    elif v[1] < -np.pi:
        v[1] += np.pi
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "v[1] wrapped to 0..2pi",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] %= 2 * np.pi
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
]
