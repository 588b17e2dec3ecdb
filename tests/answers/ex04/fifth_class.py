"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "04-camera",
        "by the chain rule, rotation and its derivative as matrices",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    Rt, dRt = np.array([[c, s], [-s, c]]), np.array([[-s, c], [-c, -s]])
    d = np.asarray(p) - x[:2]
    X, Y = Rt @ d - mount
    D = np.column_stack([-Rt, dRt @ d, Rt])
    q = np.array([F * Y / X ** 2, -F / X])
    return float(-F * Y / X), (q @ D).ravel()
""",
    ),
]

WRONG = [
    (
        "04-new-landmark",
        "P's diagonal only",
        """
def new_landmark(x, P, z, R):
    A, B = J_xr(x, z), J_z(x, z)
    D = np.diag(np.diag(P))
    return A @ D @ A.T + B @ R @ B.T, D @ A.T
""",
    ),
    (
        "04-camera",
        "returns pixels from the left, and H of p first",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p[0] - x[0], p[1] - x[1]
    X, Y = c * dx + s * dy - mount[0], -s * dx + c * dy - mount[1]
    dX = np.array([c, s, -c, -s, -s * dx + c * dy])
    dY = np.array([-s, c, s, -c, -c * dx - s * dy])
    return -F * Y / X, -F * (dY * X - Y * dX) / X ** 2
""",
    ),
]
