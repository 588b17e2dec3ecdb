"""Right ways and slips of 09-place."""

from course.tasks import Slip, Stumble

TASK = "09-place"

WAYS = {
    "by differences": """
def place(x, P, z, R):
    def f(s):
        n = np.array([np.cos(s[2] + s[4]), np.sin(s[2] + s[4])])
        return np.array([(s[:2] + s[3] * n) @ n, s[2] + s[4]])
    s = np.concatenate([x, z])
    J = np.column_stack([(f(s + e) - f(s - e)) / 2e-6 for e in 1e-6 * np.eye(5)])
    full = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    return f(s), J @ full @ J.T, J[:, :3] @ P
""",
    "in sums, α not wrapped": """
def place(x, P, z, R):
    a = x[2] + z[1]
    J = np.array([[np.cos(a), np.sin(a), 0], [0, 0, 1.0]])
    J[0, 2] = -x[0] * np.sin(a) + x[1] * np.cos(a)
    G = np.eye(2)
    G[0, 1] = J[0, 2]
    C = [[sum(J[i, k] * P[k, l] * J[m, l] for k in range(3) for l in range(3))
          + sum(G[i, k] * R[k, l] * G[m, l] for k in range(2) for l in range(2))
          for m in range(2)] for i in range(2)]
    return [z[0] + x[0] * J[0, 0] + x[1] * J[0, 1], a], np.array(C), (P @ J.T).T
""",
    "by complex numbers": """
def place(x, P, z, R):
    way = np.exp(1j * (x[2] + z[1]))
    inside = (x[0] + 1j * x[1]) * np.conj(way)
    J = np.array([[way.real, way.imag, inside.imag, 1, inside.imag], [0, 0, 1, 0, 1]])
    full = np.zeros((5, 5))
    full[:3, :3], full[3:, 3:] = P, R
    X = J @ full
    return np.array([z[0] + inside.real, np.angle(way)]), X @ J.T, X[:, :3]
""",
    "by the moved foot": """
def place(x, P, z, R):
    alpha = np.arctan2(np.sin(x[2] + z[1]), np.cos(x[2] + z[1]))
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    tangent = np.array([-np.sin(alpha), np.cos(alpha)])
    foot = x[:2] + z[0] * normal
    J_x = np.vstack([np.append(normal, tangent @ foot), [0, 0, 1]])
    J_z = np.eye(2)
    J_z[0, 1] = foot @ tangent
    C = np.einsum("ai,ij,bj->ab", J_x, P, J_x) + np.linalg.multi_dot([J_z, R, J_z.T])
    return (normal @ foot, alpha), C, J_x.dot(P)
""",
}

ALPHA = "alpha = wrap(x[2] + z[1])"
LEVER = "lever = -x[0] * s + x[1] * c"
J_X = "J_x = np.array([[c, s, lever], [0, 0, 1]])"
J_Z = "J_z = np.array([[1, lever], [0, 1]])"
LINE = "line = np.array([z[0] + x[0] * c + x[1] * s, alpha])"
RETURN = "return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P"


def _returns(C="J_x @ P @ J_x.T + J_z @ R @ J_z.T", X="J_x @ P", line="line"):
    """An edit of what is returned."""
    return RETURN, f"return {line}, {C}, {X}"


SLIPS = (
    Slip(
        "foot",
        "That is the foot of the perpendicular. The landmark is the line itself, (ρ, α).",
        (LINE, "line = (z[0] + x[0] * c + x[1] * s) * np.array([c, s])"),
        (LINE, "line = x[:2] + z[0] * np.array([c, s])"),
    ),
    Slip(
        "foot-of-the-robot",
        "The point of the wall that is nearest to the robot was taken for the one nearest to the origin: "
        "its distance and direction from there are not ρ and α. The wall's normal is the same from both.",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    foot = x[:2] + z[0] * np.array([c, s])
    rho = np.hypot(*foot)
    J = np.array([foot / rho, [-foot[1] / rho**2, foot[0] / rho**2]])
    J_x = J @ np.array([[1, 0, -z[0] * s], [0, 1, z[0] * c]])
    J_z = J @ np.array([[c, -z[0] * s], [s, z[0] * c]])
    line = np.array([rho, np.arctan2(foot[1], foot[0])])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
""",
    ),
    Slip(
        "coarse-differences",
        "The Jacobians are differences over a step that is too large, or taken to one side only. Derive them, "
        "or take a step of 1e-6 to both sides.",
        *(
            f"""
def place(x, P, z, R):
    def line(s):
        a = s[2] + s[4]
        return np.array([s[3] + s[0] * np.cos(a) + s[1] * np.sin(a), a])
    s, steps = np.concatenate([x, z]), {step} * np.eye(5)
    J = np.column_stack([(line(s + e) - line(s)) / {step} for e in steps])
    J_x, J_z = J[:, :3], J[:, 3:]
    return line(s), J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
"""
            for step in ("0.1", "0.01", "1e-3", "1e-4")
        ),
    ),
    Slip(
        "turned",
        "Where ρ is negative you turned the normal or dropped the sign. It keeps pointing away from the "
        "robot that saw it: turned, the wall would look quite different from what is seen.",
        (LINE, LINE + "\n    if line[0] < 0:\n        line = np.array([-line[0], wrap(alpha + np.pi)])"),
        (LINE, "line = np.array([abs(z[0] + x[0] * c + x[1] * s), alpha])"),
        (LINE, "line = np.array([max(0, z[0] + x[0] * c + x[1] * s), alpha])"),
    ),
    Slip(
        "heading",
        "α' is counted from the robot's heading. In the world the normal points to θ + α'.",
        (ALPHA, "alpha = z[1]"),
        (ALPHA, "alpha = wrap(x[2] - z[1])"),
        (ALPHA, "alpha = wrap(z[1] - x[2])"),
        (LINE, "line = np.array([z[0] + x[0] * c + x[1] * s, z[1]])"),
    ),
    Slip(
        "not-moved",
        "ρ is the distance from the robot still. How far is the world's origin from the wall?",
        (LINE, "line = np.array([z[0], alpha])"),
        (LINE, "line = np.array([z[0] + np.hypot(x[0], x[1]), alpha])"),
    ),
    Slip(
        "sign",
        "The robot's place along the normal comes with the wrong sign: who walks away from the wall has "
        "it farther off, and the wall stands where it stood.",
        (LINE, "line = np.array([z[0] - x[0] * c - x[1] * s, alpha])"),
        (LINE, "line = np.array([x[0] * c + x[1] * s - z[0], alpha])"),
        (LINE, "line = np.array([z[0] + x[0] * c - x[1] * s, alpha])"),
    ),
    Slip(
        "two-frames",
        "ρ mixes two frames: x and y are in the world, so the normal they are projected on is to be in "
        "the world, too (α, not α').",
        (LINE, "line = np.array([z[0] + x[0] * np.cos(z[1]) + x[1] * np.sin(z[1]), alpha])"),
        (LINE, "line = np.array([z[0] + x[0] * np.cos(x[2]) + x[1] * np.sin(x[2]), alpha])"),
    ),
    Slip(
        "cross-missing",
        "X says that the wall shares nothing with the pose, or with some of its numbers. It was placed "
        "from there.",
        _returns(X="np.zeros((2, 3))"),
        _returns(X="J_x @ np.diag(np.diag(P))"),
    ),
    Slip(
        "X-is-no-covariance",
        "X is a covariance, of the line's error with the pose's: how the line follows the pose, times "
        "how the pose errs.",
        _returns(X="J_x"),
        _returns(X="J_x @ np.linalg.pinv(P)"),
        _returns(X="J_x @ P @ P"),
    ),
    Slip(
        "lever-missing",
        "An error of θ or of α' turns your wall only, and does not shift it. But it is turned about the "
        "robot, so its distance from the origin changes: differentiate ρ by θ, cos α included.",
        (J_X, "J_x = np.array([[c, s, 0], [0, 0, 1]])"),
        (LEVER, "lever = 0"),
    ),
    Slip(
        "degrees",
        "A lever arm (metres per angle) is 180/π too long or too short: angles are in radians here, and "
        "no factor belongs there.",
        (LEVER, "lever = np.degrees(-x[0] * s + x[1] * c)"),
        (LEVER, "lever = np.radians(-x[0] * s + x[1] * c)"),
        (J_X, "J_x = np.array([[c, s, np.degrees(lever)], [0, 0, 1]])"),
        (J_X, "J_x = np.array([[c, s, np.radians(lever)], [0, 0, 1]])"),
        (J_Z, "J_z = np.array([[1, np.degrees(lever)], [0, 1]])"),
        (J_Z, "J_z = np.array([[1, np.radians(lever)], [0, 1]])"),
    ),
    Slip(
        "lever-sign",
        "A lever arm has the wrong sign: look how ρ changes when the robot turns left.",
        (LEVER, "lever = x[0] * s - x[1] * c"),
        (LEVER, "lever = x[0] * s + x[1] * c"),
        (J_X, "J_x = np.array([[c, s, -lever], [0, 0, 1]])"),
        (J_Z, "J_z = np.array([[1, -lever], [0, 1]])"),
    ),
    Slip(
        "lever-of-ρ",
        "A derivative by an angle holds ρ' or ρ itself, or the place along the normal. What turns with "
        "the angle is cos α and sin α; ρ' does not depend on it.",
        (LEVER, "lever = x[0] * c + x[1] * s"),
        (LEVER, "lever = z[0] - x[0] * s + x[1] * c"),
    ),
    Slip(
        "jacobian-in-robot-frame",
        "J_x is made with α' or with θ where α stands: what counts is the normal in the world.",
        (J_X, "c, s = np.cos(z[1]), np.sin(z[1])\n    "
         "J_x = np.array([[c, s, -x[0] * s + x[1] * c], [0, 0, 1]])\n    "
         "c, s = np.cos(alpha), np.sin(alpha)"),
        (J_X, "J_x = np.array([[np.cos(x[2]), np.sin(x[2]), lever], [0, 0, 1]])"),
    ),
    Slip(
        "rows-or-columns-lost",
        "The second row of J_x or J_z is not that of α: α = θ + α' follows both angles one to one, and "
        "neither x nor ρ'.",
        (J_X, "J_x = np.array([[c, s, lever], [0, 0, 0]])"),
        (J_Z, "J_z = np.array([[1, lever], [0, 0]])"),
    ),
    Slip("noise-missing", "C lacks R: the sight itself errs.", _returns("J_x @ P @ J_x.T")),
    Slip(
        "pose-missing",
        "C holds the sight's error only. The robot that saw it is unsure as well.",
        _returns("J_z @ R @ J_z.T"),
        _returns("R"),
    ),
    Slip(
        "noise-not-carried",
        "R was added as it is: an error of α' swings the wall about the robot, which J_z tells.",
        _returns("J_x @ P @ J_x.T + R"),
        _returns("J_x @ P @ J_x.T + np.diag(np.diag(R))"),
    ),
    Slip(
        "sandwich-reversed",
        "The sandwich is the wrong way round: a covariance is carried by J · J transposed.",
        _returns("J_x @ P @ J_x.T + J_z.T @ R @ J_z"),
    ),
    Slip(
        "diagonal-only",
        "Only variances were carried on. What the errors share stands beside the diagonals of P and R.",
        _returns("J_x @ np.diag(np.diag(P)) @ J_x.T + J_z @ R @ J_z.T"),
        _returns("J_x @ P @ J_x.T + J_z @ np.diag(np.diag(R)) @ J_z.T"),
        _returns("np.diag(np.diag(J_x @ P @ J_x.T + J_z @ R @ J_z.T))"),
    ),
    Slip(
        "standard-deviation",
        "P and R hold variances already: look where you take a square or a root of them.",
        _returns("J_x @ P @ J_x.T + J_z @ R @ R @ J_z.T"),
        _returns("J_x @ P @ J_x.T + J_z @ R**2 @ J_z.T"),
        _returns("J_x @ P @ P @ J_x.T + J_z @ R @ J_z.T"),
        _returns("np.sqrt(np.abs(J_x @ P @ J_x.T + J_z @ R @ J_z.T))"),
    ),
    Slip(
        "cross-counted-in",
        "C holds terms of pose and sight together. The two errors have nothing to do with each other.",
        _returns("J_x @ P @ J_x.T + J_z @ R @ J_z.T + J_x @ P[:, :2] + (J_x @ P[:, :2]).T"),
        _returns("(J_x[:, :2] + J_z) @ (P[:2, :2] + R) @ (J_x[:, :2] + J_z).T"),
    ),
    Slip(
        "subtracted",
        "One error was taken from the other: two independent errors add up.",
        _returns("J_x @ P @ J_x.T - J_z @ R @ J_z.T"),
    ),
)  # fmt: skip

STUMBLES = (
    Stumble("malformed", _returns(X="P @ J_x.T"), (RETURN, "return line")),
    Stumble("malformed", "def place(x, P, z, R):\n    pass\n", _returns(C="np.nan * R")),
    Stumble("raised", (J_X, "J_x = np.array([[c, s, lever], [0, 1]])")),
    Stumble("not attempted", "def place(x, P, z, R):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
