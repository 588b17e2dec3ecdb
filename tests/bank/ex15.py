"""Solutions of exercise 15 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

ERROR = """
def error(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    ti, tj, tz = x_i[:2], x_j[:2], z[:2]
    way = {way}
    turn = {turn}
    return {result}
"""


def error(**changes):
    parts = {
        "way": "R(z[2]).T @ (R(x_i[2]).T @ (tj - ti) - tz)",
        "turn": "wrap(float(x_j[2] - x_i[2] - z[2]))",
        "result": "np.array([way[0], way[1], turn])",
    }
    return ERROR.format(**(parts | changes))


JACOBIANS = """
def jacobians(x_i, x_j, z):
    a = {angle}
    c, s = np.cos(a), np.sin(a)
    dx, dy = x_j[:2] - x_i[:2]
    A = np.array({A}, dtype=float)
    B = np.array({B}, dtype=float)
    return {result}
"""


def jacobians(**changes):
    parts = {
        "angle": "x_i[2] + z[2]",
        "A": "[[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]]",
        "B": "[[c, s, 0], [-s, c, 0], [0, 0, 1]]",
        "result": "A, B",
    }
    return JACOBIANS.format(**(parts | changes))


def heading(x, y):
    """A with another heading column."""
    return jacobians(A=f"[[-c, -s, {x}], [s, -c, {y}], [0, 0, -1]]")


STEP = """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        {L}
        I, J = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
        H[I, I] {add} {ii}
        {cross}
        H[J, J] {add} {jj}
        b[I] {add} {bi}
        b[J] {add} {bj}
    {solve}
    poses = {poses}
    {wrapped}
    return {result}
"""


def step(**changes):
    parts = {
        "L": "pass",
        "add": "+=",
        "ii": "A.T @ L @ A",
        "cross": "H[I, J] += A.T @ L @ B; H[J, I] += B.T @ L @ A",
        "jj": "B.T @ L @ B",
        "bi": "A.T @ L @ e",
        "bj": "B.T @ L @ e",
        "solve": "delta = np.zeros(3 * n); delta[3:] = -np.linalg.solve(H[3:, 3:], b[3:])",
        "poses": "poses + delta.reshape(n, 3)",
        "wrapped": "poses[:, 2] = wrap(poses[:, 2])",
        "result": "poses",
    }
    return STEP.format(**(parts | changes))


def weight(returns):
    return (
        f"def weight(chi2, phi):\n    s = min(1.0, 2 * phi / (phi + chi2))\n    return {returns}\n"
    )


def update(returns):
    return (
        "def update(l, p, most):\n"
        "    add, bound = np.log(p / (1 - p)), np.log(most / (1 - most))\n"
        f"    return {returns}\n"
    )


LEADS, BOTH = {"15-error:leads"}, {"15-jacobians:A", "15-jacobians:B"}
IN_A, IN_B = {"15-jacobians:A"}, {"15-jacobians:B"}
LEAST, FREE = {"15-step:least"}, {"15-step:least", "15-step:anchored"}
DOUBTED, CELL = {"15-weight:doubted"}, {"15-cell:bayes", "15-cell:clamped"}

WRONG = [
    Wrong(
        "turn not wrapped",
        error(turn="x_j[2] - x_i[2] - z[2]"),
        {"15-error:wrapped"},
        "not-wrapped",
    ),
    Wrong("nothing turned", error(way="tj - ti - tz"), LEADS, "world-frame"),
    Wrong("not into z's frame", error(way="R(x_i[2]).T @ (tj - ti) - tz"), LEADS, "not-into-z"),
    Wrong(
        "forth by pose i's heading",
        error(way="R(z[2]).T @ (R(x_i[2]) @ (tj - ti) - tz)"),
        LEADS,
        "turned-forth",
    ),
    Wrong(
        "forth by z's turn",
        error(way="R(z[2]) @ (R(x_i[2]).T @ (tj - ti) - tz)"),
        LEADS,
        "turned-forth",
    ),
    Wrong(
        "z's shift taken off last",
        error(way="R(z[2]).T @ R(x_i[2]).T @ (tj - ti) - tz"),
        LEADS,
        "z-after-turn",
    ),
    Wrong("the whole negative", error(result="-np.array([*way, turn])"), LEADS, "sign"),
    Wrong(
        "poses exchanged",
        error(
            way="R(z[2]).T @ (R(x_j[2]).T @ (ti - tj) - tz)",
            turn="wrap(float(x_i[2] - x_j[2] - z[2]))",
        ),
        LEADS,
        "i-j-swapped",
    ),
    Wrong(
        "seen from the other end",
        error(
            way="R(x_j[2] - x_i[2]).T @ (tz - R(x_i[2]).T @ (tj - ti))",
            turn="wrap(float(z[2] - x_j[2] + x_i[2]))",
        ),
        LEADS,
        "backwards",
    ),
    Wrong(
        "z laid on top",
        error(
            way="R(z[2]) @ R(x_i[2]).T @ (tj - ti) + tz",
            turn="wrap(float(x_j[2] - x_i[2] + z[2]))",
        ),
        LEADS,
        "z-inverted",
    ),
    Wrong("two numbers", error(result="way"), {"15-error"}, None, "malformed"),
    Wrong("no return", error(result="None"), {"15-error"}, None, "malformed"),
    Wrong("A and B exchanged", jacobians(result="(B, A)"), BOTH, "swapped"),
    Wrong("B transposed", jacobians(result="(A, B.T)"), IN_B, "b-transposed"),
    Wrong("A transposed", jacobians(result="(A.T, B)"), IN_A, "a-transposed"),
    Wrong("θ_z missing", jacobians(angle="x_i[2]"), BOTH, "b-angle"),
    Wrong("θ_i missing", jacobians(angle="z[2]"), BOTH, "b-angle"),
    Wrong("θ_i − θ_z", jacobians(angle="x_i[2] - z[2]"), BOTH, "b-angle"),
    Wrong(
        "A with B's sign",
        jacobians(A="[[c, s, c * dy - s * dx], [-s, c, -c * dx - s * dy], [0, 0, -1]]"),
        IN_A,
        "a-sign",
    ),
    Wrong(
        "A's block turned forth",
        jacobians(A="[[-c, s, c * dy - s * dx], [-s, -c, -c * dx - s * dy], [0, 0, -1]]"),
        IN_A,
        "a-turned-forth",
    ),
    Wrong(
        "θ_z missing in A only",
        jacobians(
            result="np.column_stack([-B @ np.array([[np.cos(z[2]), -np.sin(z[2]), 0], "
            "[np.sin(z[2]), np.cos(z[2]), 0], [0, 0, 1]])[:, :2], A[:, 2]]), B"
        ),
        IN_A,
        "a-angle",
    ),
    Wrong("radians taken twice", jacobians(angle="np.radians(x_i[2] + z[2])"), BOTH, "degrees"),
    Wrong("A is −B", jacobians(result="(-B, B)"), IN_A, "a-heading-missing"),
    Wrong("heading's sign", heading("s * dx - c * dy", "c * dx + s * dy"), IN_A, "a-heading-sign"),
    Wrong(
        "one of the heading's signs",
        heading("c * dy - s * dx", "s * dy - c * dx"),
        IN_A,
    ),
    Wrong(
        "heading's entries exchanged",
        heading("-c * dx - s * dy", "c * dy - s * dx"),
        IN_A,
        "a-heading-swapped",
    ),
    Wrong(
        "heading column not turned by θ_z",
        heading(
            "np.cos(x_i[2]) * dy - np.sin(x_i[2]) * dx",
            "-np.cos(x_i[2]) * dx - np.sin(x_i[2]) * dy",
        ),
        IN_A,
        "a-heading-angle",
    ),
    Wrong(
        "z's shift swings, too",
        heading("error(x_i, x_j, z)[1]", "-error(x_i, x_j, z)[0]"),
        IN_A,
        "a-heading-of-e",
    ),
    Wrong(
        "A's turn with a plus",
        jacobians(A="[[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, 1]]"),
        IN_A,
        "a-turn",
    ),
    Wrong("B's turn missing", jacobians(B="[[c, s, 0], [-s, c, 0], [0, 0, 0]]"), IN_B, "b-turn"),
    Wrong("one matrix", jacobians(result="A"), {"15-jacobians"}, None, "malformed"),
    Wrong("b's sign", step(poses="poses - delta.reshape(n, 3)"), LEAST, "sign-of-b"),
    Wrong("δ alone", step(poses="delta.reshape(n, 3)"), FREE, "step-alone"),
    Wrong("δ put on with ⊕", step(poses="compose(poses, delta.reshape(n, 3))"), LEAST, "composed"),
    Wrong("not wrapped", step(wrapped="pass"), {"15-step:wrapped"}, "not-wrapped"),
    Wrong(
        "gauge free, least norm",
        step(solve="delta = -np.linalg.lstsq(H, b, rcond=1e-10)[0]"),
        FREE,
        "gauge-free",
    ),
    Wrong(
        "gauge free, pseudo-inverse",
        step(solve="delta = -np.linalg.pinv(H, rcond=1e-10) @ b"),
        FREE,
        "gauge-free",
    ),
    Wrong(
        "gauge free, damped",
        step(solve="delta = -np.linalg.solve(H + 0.1 * np.eye(3 * n), b)"),
        FREE,
        "pose-0-moved",
    ),
    Wrong(
        "last pose held",
        step(solve="delta = np.zeros(3 * n); delta[:-3] = -np.linalg.solve(H[:-3, :-3], b[:-3])"),
        FREE,
        "another-pose-held",
    ),
    Wrong("Λ left out", step(L="L = np.eye(3)"), LEAST, "information-ignored"),
    Wrong("Λ inverted", step(L="L = np.linalg.inv(L)"), LEAST, "covariance-for-information"),
    *(
        Wrong(
            f"Λ turned by z's heading, {way}",
            step(
                L="c, s = np.cos(z[2]), np.sin(z[2]); "
                "T = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]); "
                f"L = {turned}"
            ),
            LEAST,
            "information-turned",
        )
        for way, turned in {"back": "T.T @ L @ T", "forth": "T @ L @ T.T"}.items()
    ),
    Wrong("Λ missing in b", step(bi="A.T @ e", bj="B.T @ e"), LEAST, "information-in-one"),
    Wrong("b not transposed", step(bi="A @ L @ e", bj="B @ L @ e"), LEAST, "transpose"),
    Wrong(
        "the other J transposed in H",
        step(
            ii="A @ L @ A.T",
            jj="B @ L @ B.T",
            cross="H[I, J] += A @ L @ B.T; H[J, I] += B @ L @ A.T",
        ),
        LEAST,
        "transpose",
    ),
    Wrong(
        "no transpose in H",
        step(ii="A @ L @ A", jj="B @ L @ B", cross="H[I, J] += A @ L @ B; H[J, I] += B @ L @ A"),
        LEAST,
        "transpose",
    ),
    Wrong(
        "edges overwrite each other",
        step(add="=", cross="H[I, J] = A.T @ L @ B; H[J, I] = B.T @ L @ A"),
        LEAST,
        "overwritten",
    ),
    Wrong("diagonal blocks only", step(cross="pass"), LEAST, "no-cross-blocks"),
    Wrong("upper blocks only", step(cross="H[I, J] += A.T @ L @ B"), LEAST, "half-of-cross"),
    Wrong(
        "b's parts exchanged",
        step(bi="B.T @ L @ e", bj="A.T @ L @ e"),
        LEAST,
        "cross-exchanged",
    ),
    Wrong("δ as it is solved", step(result="delta"), {"15-step"}, None, "malformed"),
    Wrong("s for s²", weight("s"), DOUBTED, "not-squared"),
    Wrong(
        "not limited",
        weight("(2 * phi / (phi + chi2)) ** 2"),
        {"15-weight:trusted"},
        "unlimited",
    ),
    Wrong("cut off", weight("float(chi2 <= phi)"), DOUBTED, "cut-off"),
    Wrong(
        "root of χ²", weight("min(1, 2 * phi / (phi + chi2**0.5)) ** 2"), DOUBTED, "root-of-chi2"
    ),
    Wrong("2 missing", weight("(s / 2) ** 2"), {"15-weight"}, "two-missing"),
    Wrong("Huber's", weight("min(1, phi / chi2) ** 0.5"), DOUBTED, "other-kernel"),
    Wrong("scaled χ²", weight("s**2 * chi2"), {"15-weight"}, "cost-for-weight"),
    Wrong("always one", weight("1.0"), {"15-weight"}, "always-trusted"),
    Wrong("no bound", update("l + add"), {"15-cell:clamped"}, "not-clamped"),
    Wrong("bound above only", update("min(l + add, bound)"), {"15-cell:clamped"}, "one-side"),
    Wrong("bound below only", update("max(l + add, -bound)"), {"15-cell:clamped"}, "one-side"),
    Wrong(
        "bounded by the probability",
        update("np.clip(l + add, -most, most)"),
        CELL,
        "bound-not-log-odds",
    ),
    Wrong("p added", update("np.clip(l + p, -bound, bound)"), CELL, "probability-added"),
    Wrong(
        "log p added", update("np.clip(l + np.log(p), -bound, bound)"), CELL, "probability-added"
    ),
    Wrong("sign", update("np.clip(l - add, -bound, bound)"), CELL, "sign"),
    Wrong(
        "logarithm to ten",
        update("np.clip(l + np.log10(p / (1 - p)), -bound, bound)"),
        CELL,
        "other-base",
        may_lose={"15-cell:clamped"},
    ),
    Wrong("forgets", update("np.clip(add, -bound, bound)"), CELL, "forgets"),
    Wrong("averages", update("np.clip((l + add) / 2, -bound, bound)"), CELL, "averaged"),
    Wrong("as it was", update("l"), CELL, "unchanged"),
    Wrong(
        "a probability",
        update("1 / (1 + np.exp(-np.clip(l + add, -bound, bound)))"),
        CELL,
        "probability",
    ),
]

RIGHT = [
    Right(
        "by the package's ⊕",
        "def error(x_i, x_j, z):\n"
        "    from slamlab.geometry import between\n"
        "    return between(z, between(x_i, x_j))\n",
    ),
    Right(
        "as a list, atan2 for wrap",
        error(
            turn="np.arctan2(np.sin(x_j[2] - x_i[2] - z[2]), np.cos(x_j[2] - x_i[2] - z[2]))",
            result="[*way, turn]",
        ),
    ),
    Right(
        "homogeneous matrices",
        """
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.inv(T(z)) @ np.linalg.inv(T(x_i)) @ T(x_j)
    return np.array([E[0, 2], E[1, 2], np.arctan2(E[1, 0], E[0, 0])])
""",
    ),
    Right(
        "Jacobians by differences",
        """
def jacobians(x_i, x_j, z):
    def slope(f, x):
        columns = []
        for h in 1e-6 * np.eye(3):
            d = f(x + h) - f(x - h)
            d[2] = wrap(float(d[2]))
            columns.append(d / 2e-6)
        return np.column_stack(columns)

    return slope(lambda v: error(v, x_j, z), x_i), slope(lambda v: error(x_i, v, z), x_j)
""",
    ),
    Right("blocks one by one", step()),
    Right(
        "pose 0 held by a strong prior",
        step(solve="H[:3, :3] += 1e9 * np.eye(3); delta = -np.linalg.solve(H, b)"),
    ),
    Right(
        "rows of pose 0 replaced by the identity",
        step(
            solve="H[:3] = 0; H[:, :3] = 0; H[:3, :3] = np.eye(3); b[:3] = 0; "
            "delta = -np.linalg.solve(H, b)"
        ),
    ),
    Right(
        "poses changed in place, headings by atan2",
        step(wrapped="poses[:, 2] = np.arctan2(np.sin(poses[:, 2]), np.cos(poses[:, 2]))"),
    ),
    Right(
        "whitened least squares, no H",
        """
def step(poses, edges):
    rows, right = [], []
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        U = np.linalg.cholesky(L).T
        J = np.zeros((3, poses.size))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = U @ A, U @ B
        rows.append(J)
        right.append(-U @ error(poses[i], poses[j], z))
    delta = np.linalg.lstsq(np.vstack(rows)[:, 3:], np.concatenate(right), rcond=None)[0]
    better = np.array(poses)
    better[1:] += delta.reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
    ),
    Right(
        "sparse, with scipy",
        step(
            solve="from scipy.sparse import csc_array; from scipy.sparse.linalg import spsolve; "
            "delta = np.concatenate([np.zeros(3), spsolve(csc_array(H[3:, 3:]), -b[3:])])"
        ),
    ),
    Right("by cases", weight("1 if chi2 <= phi else 4 * phi**2 / (phi + chi2) ** 2")),
    Right("an array", weight("np.minimum(1, 2 * phi / (phi + np.asarray(chi2))) ** 2")),
    Right(
        "by Bayes' rule",
        """
def update(l, p, most):
    before = 1 / (1 + np.exp(-l))
    after = before * p / (before * p + (1 - before) * (1 - p))
    after = min(max(after, 1 - most), most)
    return np.log(after) - np.log(1 - after)
""",
    ),
    Right("min and max", update("min(max(l + add, -bound), bound)")),
]
