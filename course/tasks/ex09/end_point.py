"""Right ways and slips of 09-end."""

from course.tasks import Slip, Stumble

TASK = "09-end"

WAYS = {
    "differentiated by hand": """
def end_point(x, P, j, beta, sigma):
    px, py, theta = x[:3]
    rho, alpha = x[3 + 2 * j], x[4 + 2 * j]
    c, s, cp, sp = np.cos(alpha), np.sin(alpha), np.cos(theta + beta), np.sin(theta + beta)
    D = c * cp + s * sp
    r = (rho - px * c - py * s) / D
    r_phi = r * np.sin(theta + beta - alpha) / D
    r_alpha = (px * s - py * c) / D - r_phi
    u, w = np.array([cp, sp]), np.array([-sp, cp])
    J = np.zeros((2, len(x)))
    J[:, 0] = np.array([1, 0]) - u * c / D
    J[:, 1] = np.array([0, 1]) - u * s / D
    J[:, 2] = r_phi * u + r * w
    J[:, 3 + 2 * j] = u / D
    J[:, 4 + 2 * j] = r_alpha * u
    C = J @ P @ J.T + sigma**2 * np.outer(J[:, 2], J[:, 2])
    return np.array([px, py]) + r * u, C, J @ P
""",
    "by differences": """
def end_point(x, P, j, beta, sigma):
    def f(s):
        rho, alpha, phi = s[3 + 2 * j], s[4 + 2 * j], s[2] + s[-1]
        r = (rho - s[0] * np.cos(alpha) - s[1] * np.sin(alpha)) / np.cos(phi - alpha)
        return s[:2] + r * np.array([np.cos(phi), np.sin(phi)])
    full = np.zeros((len(x) + 1, len(x) + 1))
    full[:-1, :-1], full[-1, -1] = P, sigma**2
    s = np.append(x, beta)
    J = np.array([(f(s + e) - f(s - e)) / 2e-6 for e in 1e-6 * np.eye(len(s))]).T
    return f(s), J @ full @ J.T, (J @ full)[:, :-1]
""",
    "by a complex step": """
def end_point(x, P, j, beta, sigma):
    def f(s, beta):
        a, b = s[3 + 2 * j], s[4 + 2 * j]
        t = np.array([-np.sin(b), np.cos(b)])
        n = np.array([np.cos(b), np.sin(b)])
        ahead = a - n @ s[:2]
        return a * n + (t @ s[:2] + ahead * np.tan(s[2] + beta - b)) * t
    step = 1e-30j * np.eye(len(x) + 1)
    J = np.array([f(x + e[:-1], beta + e[-1]).imag / 1e-30 for e in step]).T
    X = J[:, :-1] @ P
    return f(x, beta), X @ J[:, :-1].T + sigma**2 * np.outer(J[:, -1], J[:, -1]), X
""",
    "five numbers, the cross of two lines": """
def end_point(x, P, j, beta, sigma):
    at = [0, 1, 2, 3 + 2 * j, 4 + 2 * j]
    px, py, theta, rho, alpha = x[at]
    phi = theta + beta
    A = np.array([[np.cos(alpha), np.sin(alpha)], [-np.sin(phi), np.cos(phi)]])
    p = np.linalg.inv(A) @ [rho, px * A[1, 0] + py * A[1, 1]]
    along = np.array([-np.sin(alpha), np.cos(alpha)]) @ p
    r = np.hypot(p[0] - px, p[1] - py)
    J = np.linalg.inv(A) @ [[0, 0, 0, 1, -along], [A[1, 0], A[1, 1], r, 0, 0]]
    C = P[np.ix_(at, at)].copy()
    C[2, 2] += sigma**2
    return list(p), J @ C @ J.T, J @ P[at]
""",
}

PHI = "phi = x[2] + beta"
R = "r = (rho - normal @ x[:2]) / (normal @ beam)"
P_ = "p = x[:2] + r * beam"
N_B = "N, b = np.array([normal, across]), np.array([0, r])"
WALL = "B[0, at : at + 2] = 1, -turned @ p"
ROBOT = "B[1, :2], B[1, 2] = across, r"
RETURN = "return p, J @ P @ J.T + sigma**2 * np.outer(J_beta, J_beta), J @ P"
BEAM = "sigma**2 * np.outer(J_beta, J_beta)"
NO_CROSS = "Q = P.copy()\n    Q[:3, 3:] = Q[3:, :3] = 0\n    "


def _C(C, before="", X="J @ P"):
    return RETURN, f"{before}return p, {C}, {X}"


SLIPS = (
    Slip(
        "beam-from-the-robot",
        "β is counted from the robot's heading. In the world the beam points to θ + β.",
        (PHI, "phi = beta"),
        (PHI, "phi = x[2] - beta"),
    ),
    Slip(
        "foot",
        "That is the foot of the perpendicular, or a point as far off as it. At a slant a beam goes "
        "farther until it meets the wall.",
        (R, "r = rho - normal @ x[:2]"),
        (P_, "p = x[:2] + (rho - normal @ x[:2]) * normal"),
        (R, "r = (rho - normal @ x[:2]) * (normal @ beam)"),
    ),
    Slip(
        "from-the-origin",
        "The range was counted from the world's origin, or the point was: robot and wall are both in the "
        "world, and the robot stands elsewhere.",
        (R, "r = rho / (normal @ beam)"),
        (P_, "p = r * beam"),
        (R, "r = (rho + normal @ x[:2]) / (normal @ beam)"),
    ),
    Slip(
        "beam-missing",
        "C lacks the error of the beam's direction: sigma is not used.",
        _C("J @ P @ J.T"),
    ),
    Slip(
        "sigma-not-squared",
        "sigma is a standard deviation, and C holds variances.",
        _C("J @ P @ J.T + sigma * np.outer(J_beta, J_beta)"),
        _C("J @ P @ J.T + sigma**4 * np.outer(J_beta, J_beta)"),
    ),
    Slip(
        "beam-not-carried",
        "σ is an angle. How far does the end go along the wall when the beam turns by so much, at this "
        "range and slant?",
        _C("J @ P @ J.T + sigma**2 * np.eye(2)"),
        _C("J @ P @ J.T + (sigma * r) ** 2 * np.eye(2)"),
        _C("J @ P @ J.T + (sigma * r) ** 2 * np.outer(across, across)"),
        _C("J @ P @ J.T + (sigma * r) ** 2 * np.outer(turned, turned)"),
    ),
    Slip(
        "degrees",
        "A degree stands where a radian should, or the other way round.",
        _C("J @ P @ J.T + np.radians(sigma)**2 * np.outer(J_beta, J_beta)"),
        _C("J @ P @ J.T + np.degrees(sigma)**2 * np.outer(J_beta, J_beta)"),
    ),
    Slip(
        "robot-known",
        "The robot was taken for known, in place or in heading. It errs, and its beam with it.",
        (ROBOT, "pass"),
        (ROBOT, "B[1, :2] = across"),
        (ROBOT, "B[1, 2] = r"),
    ),
    Slip(
        "wall-known",
        "The wall was taken for known, in ρ or in α. It errs as well.",
        (WALL, "pass"),
        (WALL, "B[0, at] = 1"),
        (WALL, "B[0, at + 1] = -turned @ p"),
    ),
    Slip(
        "moved-along-with-the-robot",
        "The end moves with the robot in your J as if the range were fixed. But the wall stands: who "
        "steps towards it has a shorter beam.",
        ("J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)",
         "J, J_beta = np.zeros((2, len(x))), r * across\n    J[:, :2], J[:, 2] = np.eye(2), r * across"),
        ("J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)",
         "J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)\n    J[:, :2] = np.eye(2)"),
        ("J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)",
         "J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)\n    J[:, 2] = r * across"),
    ),
    Slip(
        "beam-does-not-swing",
        "When the robot turns, or the beam does, your end moves along the beam alone, as its range "
        "changes. The beam swings as well: where does that carry a point r metres ahead?",
        ("J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)",
         "J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)\n    J[:, 2] -= r * across"),
        ("J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)",
         "J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)\n    J_beta = J_beta - r * across"),
        ("J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)",
         "J, J_beta = np.linalg.solve(N, B), np.linalg.solve(N, b)\n    J[:, 2] -= r * across\n    J_beta = J[:, 2]"),
    ),
    Slip(
        "lever-sign",
        "A lever arm has the wrong sign: look which way the end goes when the wall, or the robot, turns "
        "left.",
        (WALL, "B[0, at : at + 2] = 1, turned @ p"),
        (ROBOT, "B[1, :2], B[1, 2] = across, -r"),
        (N_B, "N, b = np.array([normal, across]), np.array([0, -r])\n    across = -across"),
    ),
    Slip(
        "lever-of-the-robot",
        "When α errs, the wall turns about the world's origin, and so far from there, along the wall, "
        "lies the end: not as far as from the robot.",
        (WALL, "B[0, at : at + 2] = 1, -turned @ (p - x[:2])"),
        (WALL, "B[0, at : at + 2] = 1, -turned @ x[:2]"),
    ),
    Slip(
        "unrelated",
        "Robot and wall were taken as unrelated. The wall was placed by this robot: most of their errors "
        "are shared, and partly cancel.",
        _C(f"J @ Q @ J.T + {BEAM}", NO_CROSS),
        _C(f"J @ np.diag(np.diag(P)) @ J.T + {BEAM}"),
    ),
    Slip(
        "added-as-they-are",
        "Variances of robot or wall were added as they are. Each is to be carried to the end by how "
        "the end follows.",
        _C(f"P[:2, :2] + {BEAM}"),
        _C(f"J @ P @ J.T + P[:2, :2] + {BEAM}"),
    ),
    Slip(
        "wrong-wall",
        "Another wall's numbers are used: the robot takes three numbers of x, and walls are counted from "
        "0.",
        ("at = 3 + 2 * j", "at = 1 + 2 * j"),
        ("at = 3 + 2 * j", "at = 3"),
        (WALL, "B[0, 3:5] = 1, -turned @ p"),
        (WALL, "B[0, -2:] = 1, -turned @ p"),
    ),
    Slip(
        "X-of-its-own-wall",
        "X lacks what the end shares with the other walls, or with some part of the state. It is "
        "correlated with all that robot and wall are.",
        _C(f"J @ P @ J.T + {BEAM}", X="J @ (P * (np.abs(B).max(axis=0) > 0))"),
        _C(f"J @ P @ J.T + {BEAM}", X="J[:, :3] @ P[:3]"),
        _C(f"J @ P @ J.T + {BEAM}", X="J @ np.diag(np.diag(P))"),
    ),
    Slip(
        "X-is-no-covariance",
        "X is a covariance, of the end's error with the state's: how the end follows the state, times "
        "how the state errs.",
        _C(f"J @ P @ J.T + {BEAM}", X="J"),
        _C(f"J @ P @ J.T + {BEAM}", X="np.zeros(J.shape)"),
    ),
)  # fmt: skip

STUMBLES = (
    Stumble("malformed", (RETURN, "return p, J @ P @ J.T"), _C("P[:2, :2]", X="(J @ P).T")),
    Stumble("raised", (N_B, "N, b = np.array([normal]), np.array([0, r])")),
    Stumble("not attempted", "def end_point(x, P, j, beta, sigma):\n    raise NotImplementedError"),
)

PASTED = {
    "place, of the wall as it is expected": """
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j : 5 + 2 * j]
    z = np.array([rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha), beta])
    line, C, X = place(x[:3], P[:3, :3], z, np.diag([0, sigma**2]))
    return line, C, np.hstack([X, np.zeros((2, len(x) - 3))])
""",
    "a point landmark, of lesson 06": """
def end_point(x, P, j, beta, sigma):
    rho, alpha = x[3 + 2 * j : 5 + 2 * j]
    a = x[2] + beta
    r = (rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha)) / np.cos(a - alpha)
    J = np.array([[1, 0, -r * np.sin(a)], [0, 1, r * np.cos(a)]])
    J_z = np.array([[np.cos(a), -r * np.sin(a)], [np.sin(a), r * np.cos(a)]])
    C = J @ P[:3, :3] @ J.T + J_z @ np.diag([0, sigma**2]) @ J_z.T
    return x[:2] + r * np.array([np.cos(a), np.sin(a)]), C, J @ P[:3]
""",
}

EQUIVALENT = {}
