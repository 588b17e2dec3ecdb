"""Right ways and slips of 09-update."""

from course.tasks import Edit, Slip, Stumble

TASK = "09-update"

WAYS = {
    "Joseph's form": """
def update(x, P, z, j, R):
    i = 2 * j + 3
    a = x[i + 1]
    H = np.zeros((2, x.size))
    H[0, 0], H[0, 1], H[1, 2] = -np.cos(a), -np.sin(a), -1
    H[0, i], H[0, i + 1], H[1, i + 1] = 1, x[0] * np.sin(a) - x[1] * np.cos(a), 1
    v = np.array([z[0] - x[i] + x[0] * np.cos(a) + x[1] * np.sin(a), wrap(z[1] - wrap(a - x[2]))])
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    keep = np.eye(len(x)) - K @ H
    return x + K @ v, keep @ P @ keep.T + K @ R @ K.T
""",
    "information, on copies": """
def update(x, P, z, j, R):
    x, P = x.copy(), P.copy()
    a = x[4 + 2 * j]
    n, t = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
    H = np.zeros((2, len(x)))
    H[0, :2], H[1, 2], H[0, 3 + 2 * j], H[1, 4 + 2 * j] = -n, -1, 1, 1
    H[0, 4 + 2 * j] = -t @ x[:2]
    v = z - [x[3 + 2 * j] - n @ x[:2], a - x[2]]
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    W = np.linalg.inv(R)
    P[:] = np.linalg.inv(np.linalg.inv(P) + H.T @ W @ H)
    x += P @ H.T @ W @ v
    x[2::2] = wrap(x[2::2])
    return x, P
""",
    "H by differences": """
def update(x, P, z, j, R):
    def seen(s):
        rho, alpha = s[3 + 2 * j], s[4 + 2 * j]
        return np.array([rho - s[0] * np.cos(alpha) - s[1] * np.sin(alpha), alpha - s[2]])
    H = np.array([(seen(x + e) - seen(x - e)) / 2e-6 for e in 1e-6 * np.eye(len(x))]).T
    v = z - seen(x)
    v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
    K = P @ H.T @ np.linalg.pinv(H @ P @ H.T + R)
    return [x + K @ v, P - K @ H @ P]
""",
    "five numbers at a time": """
def update(x, P, z, j, R):
    at = [0, 1, 2, 3 + 2 * j, 4 + 2 * j]
    px, py, theta, rho, alpha = x[at]
    c, s = np.cos(alpha), np.sin(alpha)
    H = np.array([[-c, -s, 0, 1, px * s - py * c], [0, 0, -1, 0, 1]])
    B = P[:, at] @ H.T
    S = H @ B[at] + R
    v = np.array([z[0] - rho + px * c + py * s, wrap(z[1] - alpha + theta)])
    return x + B @ np.linalg.solve(S, v), P - B @ np.linalg.solve(S, B.T)
""",
}

APART = (
    "P * (np.r_[0, 0, 0, np.arange(2, len(x) - 1) // 2][:, None] == "
    "np.r_[0, 0, 0, np.arange(2, len(x) - 1) // 2])"
)
V = "v = z - np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])"
WRAP = "v[1] = wrap(v[1])"
H_R = "H[:, :3] = [[-c, -s, 0], [0, 0, -1]]"
H_W = "H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]"
S = "S = H @ P @ H.T + R"
K = "K = P @ H.T @ np.linalg.inv(S)"
RETURN = "return x + K @ v, P - K @ S @ K.T"
TURNED = """
    if rho < x[0] * c + x[1] * s:
        v = z - [x[0] * c + x[1] * s - rho, alpha - x[2] + np.pi]"""


def _x(x):
    return RETURN, f"return {x}, P - K @ S @ K.T"


def _P(P, before=""):
    return RETURN, f"{before}return x + K @ v, {P}"


SLIPS = (
    Slip(
        "made-positive",
        "The expected distance was made positive. Where the estimate has the robot beyond the wall it is "
        "negative, and stays so.",
        (V, V.replace("rho - x[0] * c - x[1] * s", "abs(rho - x[0] * c - x[1] * s)")),
    ),
    Slip(
        "printed-15",
        "x is K · innovation alone, as printed in Smolec's (15): the old x is lost.",
        _x("K @ v"),
    ),
    Slip("sign", "x moves away from what was seen: the innovation is measured minus expected.",
         _x("x - K @ v"), (V, V.replace("v = z - ", "v = -z + "))),
    Slip(
        "pose-forgotten",
        "What was seen from the robot is compared with the wall in the world, in part or in whole. What "
        "should this robot see, at its place and with its heading?",
        (V, "v = z - np.array([rho, alpha])"),
        (V, "v = z - np.array([rho - x[0] * c - x[1] * s, alpha])"),
        (V, "v = z - np.array([rho, alpha - x[2]])"),
    ),
    Slip(
        "expected-wrongly",
        "What is expected is not what the formulas say: a sign is turned, or the normal of another frame "
        "was taken.",
        (V, "v = z - np.array([rho + x[0] * c + x[1] * s, alpha - x[2]])"),
        (V, "v = z - np.array([rho - x[0] * c - x[1] * s, alpha + x[2]])"),
        (V, "v = z - np.array([rho - x[0] * c - x[1] * s, x[2] - alpha])"),
        (V, "v = z - np.array([abs(rho) - x[0] * c - x[1] * s, alpha - x[2]])"),
    ),
    Slip(
        "compared-in-the-world",
        "What was seen was placed in the world first, and compared there with the wall. The place that it "
        "gets errs with the robot, whose error is in P already: a sight's own error is that of range and "
        "angle alone. Compare what is seen with what is expected.",
        *(
            f"""
def update(x, P, z, j, R):
    at = 3 + 2 * j
    line, C, _ = place(x[:3], P[:3, :3], z, R)
    v = line - x[at : at + 2]
    v[1] = wrap(v[1])
    H = np.eye(len(x))[at : at + 2]
    S = H @ P @ H.T + {noise}
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
"""
            for noise in ("C", "R")
        ),
    ),
    Slip(
        "turned-round",
        "A wall with a negative expected ρ' was turned round. It is the same wall, which the estimate has "
        "passed: its ρ' stays negative.",
        (V, V + TURNED),
        [(V, V + TURNED), (H_W, f"{H_W}\n    H[0] *= np.sign(rho - x[0] * c - x[1] * s)")],
    ),
    Slip(
        "unwrapped",
        "The innovation's angle is not wrapped: a normal expected at 179° and seen at −179° is 2° off, "
        "not 358°.",
        (WRAP, "pass"),
        (V + "\n    " + WRAP, "v = z - np.array([rho - x[0] * c - x[1] * s, wrap(alpha - x[2])])"),
        (WRAP, "v[1] = abs(wrap(v[1]))"),
    ),
    Slip(
        "distance-wrapped",
        "The distance was wrapped as well: it is a length. Only the angle counts modulo 2π.",
        (WRAP, "v = wrap(v)"),
    ),
    Slip(
        "lever-missing",
        "H lacks ∂ρ'/∂α: turn a wall about the world's origin, and its distance from the robot changes, "
        "since the robot stands elsewhere.",
        (H_W, "H[:, at : at + 2] = np.eye(2)"),
    ),
    Slip(
        "degrees",
        "The entry ∂ρ'/∂α is 180/π too long or too short. Angles are in radians here.",
        (H_W, "H[:, at : at + 2] = [[1, np.degrees(x[0] * s - x[1] * c)], [0, 1]]"),
        (H_W, "H[:, at : at + 2] = [[1, np.radians(x[0] * s - x[1] * c)], [0, 1]]"),
    ),
    Slip(
        "lever-sign",
        "∂ρ'/∂α has a wrong sign, or sine and cosine are exchanged: differentiate −x cos α − y sin α.",
        (H_W, "H[:, at : at + 2] = [[1, x[1] * c - x[0] * s], [0, 1]]"),
        (H_W, "H[:, at : at + 2] = [[1, x[0] * s + x[1] * c], [0, 1]]"),
        (H_W, "H[:, at : at + 2] = [[1, x[0] * c - x[1] * s], [0, 1]]"),
    ),
    Slip(
        "lever-by-θ",
        "∂ρ'/∂θ is not 0 in your H: who turns on the spot stays as far from the wall as before.",
        (H_R, "H[:, :3] = [[-c, -s, x[0] * s - x[1] * c], [0, 0, -1]]"),
        (H_R, "H[:, :3] = [[-c, -s, x[1] * c - x[0] * s], [0, 0, -1]]"),
    ),
    Slip(
        "robot-sign",
        "The robot's columns of H have a wrong sign: who steps towards a wall has it nearer, who turns "
        "left sees it turn right.",
        (H_R, "H[:, :3] = [[c, s, 0], [0, 0, 1]]"),
        (H_R, "H[:, :3] = [[c, s, 0], [0, 0, -1]]"),
        (H_R, "H[:, :3] = [[-c, -s, 0], [0, 0, 1]]"),
    ),
    Slip(
        "robot-missing",
        "H lacks the pose, or one of its angles: you took it for known. The robot errs as well.",
        (H_R, "pass"),
        (H_R, "H[0, :2] = -c, -s"),
        (H_R, "H[1, 2] = -1"),
    ),
    Slip(
        "wall-missing",
        "H has no entries for the wall: you took it for known. It is as unsure as who placed it.",
        (H_W, "pass"),
    ),
    Slip(
        "wrong-wall",
        "Another wall's numbers are used: the robot takes three numbers of x, and walls are counted from "
        "0.",
        ("at = 3 + 2 * j", "at = 1 + 2 * j"),
        ("at = 3 + 2 * j", "at = 3 + j"),
        ("at = 3 + 2 * j", "at = 3"),
        ("at = 3 + 2 * j", "at = len(x) - 2"),
        ("at = 3 + 2 * j", "at = 3 + 2 * ((j + 1) % (len(x) // 2 - 1))"),
        ("rho, alpha = x[at : at + 2]", "rho, alpha = x[3:5]"),
        (H_W, H_W.replace("at : at + 2", "-2:")),
    ),
    Slip("S-missing", "The gain lacks S⁻¹, so that x jumps the more, the less is known.",
         (K, "K = P @ H.T"), _x("x + P @ H.T @ v")),
    Slip("S-not-inverted", "The gain is multiplied by S where it should be divided by it.",
         (K, "K = P @ H.T @ S")),
    Slip("R-missing", "S lacks R: the sight was taken for exact.", (S, "S = H @ P @ H.T")),
    Slip("R-only", "S is R alone: pose and wall err as well, and that is in the innovation.",
         (S, "S = R")),
    Slip(
        "R-by-its-diagonal",
        "Only the variances of R were used. What ρ' and α' share in their errors stands beside them.",
        (S, "S = H @ P @ H.T + np.diag(np.diag(R))"),
    ),
    Slip("R-squared", "R holds variances already: look whether you take a root or a square of it.",
         (S, "S = H @ P @ H.T + R @ R"), (S, "S = H @ P @ H.T + R**2"),
         (S, "S = H @ P @ H.T + np.sqrt(np.abs(R))")),
    Slip(
        "kept-apart",
        "Robot and walls are taken as unrelated in S and K. Use the whole of P.",
        (S, f"S = H @ ({APART}) @ H.T + R"),
        [(S, f"S = H @ ({APART}) @ H.T + R"), (K, f"K = ({APART}) @ H.T @ np.linalg.inv(S)")],
        (S, "P = np.diag(np.diag(P))\n    " + S),
    ),
    Slip("x-stays", "x comes back as it went in: the innovation, weighed by K, has to be added.",
         _x("x.copy()")),
    Slip(
        "half-gain",
        "The state moves half as far as it should, or twice as far: no factor belongs before K or v.",
        _x("x + 0.5 * K @ v"), _x("x + 2 * K @ v"), (K, "K = 0.5 * P @ H.T @ np.linalg.inv(S)"),
    ),
    Slip(
        "some-rows-only",
        "Some parts of the state learned nothing. The walls that were not seen were placed by the same "
        "robot: all rows of K count.",
        (K, K + "\n    K = K * (np.abs(H).max(axis=0) > 0)[:, None]"),
        (K, K + "\n    K[3:] = 0"), (K, K + "\n    K[:3] = 0"),
        _x("x + (K * (np.abs(H).max(axis=0) > 0)[:, None]) @ v"),
        _x("np.r_[x[:3] + K[:3] @ v, x[3:]]"), _x("np.r_[x[:3], x[3:] + K[3:] @ v]"),
    ),
    Slip(
        "one-number-only",
        "Only one of ρ' and α' is used; z holds two numbers, and both teach something.",
        _x("x + K @ (v * [1, 0])"), _x("x + K @ (v * [0, 1])"),
    ),
    Slip("P-stays", "P comes back as it went in: the robot has learned something and does not know it.",
         _P("P.copy()")),
    Slip("P-sign", "P grew: seeing something makes nobody less sure. Look at the sign of K S Kᵀ.",
         _P("P + K @ S @ K.T")),
    Slip("S-inverse", "Not S⁻¹ stands between K and Kᵀ, nor nothing: look at the units of K S Kᵀ.",
         _P("P - K @ np.linalg.inv(S) @ K.T"), _P("P - K @ K.T")),
    Slip("R-between-the-gains", "P shrinks by K R Kᵀ: it is the whole innovation's covariance that counts.",
         _P("P - K @ R @ K.T")),
    Slip(
        "half-of-joseph",
        "(I − K H) P (I − K H)ᵀ alone leaves out the sight's own noise: Joseph's form adds a term of R.",
        _P("(np.eye(len(x)) - K @ H) @ P @ (np.eye(len(x)) - K @ H).T"),
        Edit("Joseph's form", ((" + K @ R @ K.T", " + R[0, 0] * K @ K.T"),)),
    ),
    Slip(
        "P-in-part",
        "Some blocks of P are as they were, or zero. K S Kᵀ has no zero block: what robot and walls "
        "share shrinks as well.",
        _P("new", "new = P.copy()\n    new[:3, :3] -= (K @ S @ K.T)[:3, :3]\n    "),
        _P("new", "new = P - K @ S @ K.T\n    new[:3, 3:] = new[3:, :3] = 0\n    "),
        _P("P - np.triu(K @ S @ K.T)"), _P("P - np.diag(np.diag(K @ S @ K.T))"),
    ),
)  # fmt: skip

STUMBLES = (
    Stumble(
        "malformed",
        "def update(x, P, z, j, R):\n    return x",
        _x("x + K @ v + 0j"),
        (RETURN, "return P - K @ S @ K.T, x + K @ v"),
        (RETURN, "return x[:3], P[:3, :3]"),
    ),
    Stumble("raised", _x("x + K @ v[:1]"), (K, "K = np.linalg.inv(S) @ H @ P")),
    Stumble("not attempted", "def update(x, P, z, j, R):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
