"""Independent answers to 03-update: right ones, and students' mistakes."""

RIGHT = [
    (
        "03-update",
        "Joseph's form, symmetrised",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    rest = np.eye(x.size) - K @ H
    new = rest @ P @ rest.T + K @ R @ K.T
    return x + K @ v, (new + new.T) / 2
""",
    ),
    (
        "03-update",
        "information adds up",
        """
def update(x, P, z, H, R):
    before = np.linalg.inv(P)
    weight = np.linalg.inv(R)
    after = np.linalg.inv(before + H.T @ weight @ H)
    return after @ (before @ x + H.T @ weight @ z), after
""",
    ),
    (
        "03-update",
        "one number at a time, after whitening with Cholesky",
        """
def update(x, P, z, H, R):
    L = np.linalg.cholesky(R)
    rows, numbers = np.linalg.solve(L, H), np.linalg.solve(L, z)
    x, P = x.astype(float), P.astype(float)
    for h, number in zip(rows, numbers):
        Ph = P @ h
        s = h @ Ph + 1.0
        x = x + Ph * (number - h @ x) / s
        P = P - np.outer(Ph, Ph) / s
    return x, P
""",
    ),
]

WRONG = [
    (
        "03-update",
        "order of the product: P − P K H",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    v = z - H @ x
    return x + K @ v, P - P @ K @ H
""",
    ),
    (
        "03-update",
        "refuses what is more than three sigma off",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    if v @ np.linalg.solve(S, v) > 9:
        return x, P
    K = gain(P, H, R)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "03-update",
        "innovation with the wrong sign",
        """
def update(x, P, z, H, R):
    expected = H @ x
    K = gain(P, H, R)
    return x + K @ (expected - z), (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
        "03-update",
        "P is updated first, and the gain is taken from the new P",
        """
def update(x, P, z, H, R):
    P = P - gain(P, H, R) @ H @ P
    x = x + gain(P, H, R) @ (z - H @ x)
    return x, P
""",
    ),
    (
        "03-update",
        "Joseph's form without its second half",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    A = np.identity(len(P)) - K @ H
    return x + K @ v, A @ P @ A.T
""",
    ),
    (
        "03-update",
        "changes x and P of the caller",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    x += K @ v
    P -= K @ S @ K.T
    return x, P
""",
    ),
    (
        "03-update",
        "returns P first",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    P_new = P - K @ H @ P
    x_new = x + K @ v
    return P_new, x_new
""",
    ),
    (
        "03-update",
        "x becomes a column",
        """
def update(x, P, z, H, R):
    x = x.reshape(-1, 1)
    z = np.asarray(z).reshape(-1, 1)
    K = gain(P, H, R)
    x = x + K @ (z - H @ x)
    return x, P - K @ H @ P
""",
    ),
    (
        "03-update",
        "one number at a time, what R says between them ignored",
        """
def update(x, P, z, H, R):
    for i in range(len(z)):
        h = H[i:i + 1]
        K = gain(P, h, R[i:i + 1, i:i + 1])
        x = x + K @ (z[i:i + 1] - h @ x)
        P = P - K @ h @ P
    return x, P
""",
    ),
    (
        "03-update",
        "symmetrised without dividing by two",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    P = P - K @ S @ K.T
    return x + K @ v, P + P.T
""",
    ),
    (
        "03-update",
        "unit matrix of hard-coded size",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    I = np.eye(2)
    return x + K @ (z - H @ x), (I - K @ H) @ P
""",
    ),
    (
        "03-update",
        "innovation cut off at three sigma",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    limit = 3 * np.sqrt(np.diag(S))
    v = np.clip(v, -limit, limit)
    K = gain(P, H, R)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "03-update",
        "whitened with the transposed root of R",
        """
def update(x, P, z, H, R):
    W = np.linalg.inv(np.linalg.cholesky(R).T)
    h, y = W @ H, W @ z
    information = np.linalg.inv(P) + h.T @ h
    x_new = np.linalg.solve(information, np.linalg.inv(P) @ x + h.T @ y)
    return x_new, np.linalg.inv(information)
""",
    ),
    (
        "03-update",
        "Joseph's form with v vᵀ in place of R: P depends on what was measured",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    rest = np.eye(len(x)) - K @ H
    return x + K @ v, rest @ P @ rest.T + K @ np.outer(v, v) @ K.T
""",
    ),
    (
        "03-update",
        "half done: P stays as it was",
        """
def update(x, P, z, H, R):
    v, _ = innovation(x, P, z, H, R)
    return x + gain(P, H, R) @ v, P.copy()
""",
    ),
]
