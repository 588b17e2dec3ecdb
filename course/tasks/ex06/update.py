"""Right ways and slips of 06-update."""

from course.tasks import Edit, Slip, Stumble

TASK = "06-update"

WAYS = {
    "Joseph's form": """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = wrap(v[1])
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    keep = np.eye(len(x)) - K @ H
    return x + K @ v, keep @ P @ keep.T + K @ R @ K.T
""",
    "information": """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
    H, Y, W = H_full(x, j), np.linalg.inv(P), np.linalg.inv(R)
    P = np.linalg.inv(Y + H.T @ W @ H)
    return x + P @ H.T @ W @ v, P
""",
    "Cholesky": """
def update(x, P, z, j, R):
    x, P = x.copy(), P.copy()
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    H = H_full(x, j)
    root = np.linalg.cholesky(H @ P @ H.T + R)
    B = np.linalg.solve(root, H @ P).T
    x += B @ np.linalg.solve(root, v)
    P -= B @ B.T
    x[2] = np.arctan2(np.sin(x[2]), np.cos(x[2]))
    return [x, P]
""",
    "(I − K H) P": """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = wrap(v[1])
    H = H_full(x, j)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, (np.eye(len(x)) - K @ H) @ P
""",
    "H by differences": """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    seen = lambda s: h(s[:3], s[at : at + 2])
    columns = []
    for e in 1e-6 * np.eye(len(x)):
        d = seen(x + e) - seen(x - e)
        columns.append([d[0] / 2e-6, wrap(d[1]) / 2e-6])
    H = np.array(columns).T
    v = z - seen(x)
    v = np.array([v[0], wrap(v[1])])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.pinv(S)
    return x + K @ v, P - K @ H @ P
""",
}

APART = (
    "P * (np.r_[0, 0, 0, np.arange(2, len(x) - 1) // 2][:, None] == "
    "np.r_[0, 0, 0, np.arange(2, len(x) - 1) // 2])"
)
K = "K = P @ H.T @ np.linalg.inv(S)"
S = "S = H @ P @ H.T + R"
X = "x = x + K @ v"
RETURN = "return x, P - K @ S @ K.T"

SLIPS = (
    Slip(
        "one-for-identity",
        "The 1 in (1 − K H) P is the identity matrix, np.eye: the number 1 is taken from every entry.",
        (RETURN, "return x, (1 - K @ H) @ P"),
    ),
    Slip(
        "printed-15",
        "x is K · innovation alone: the old x is lost. The innovation corrects what was believed.",
        (X, "x = K @ v"),
    ),
    Slip(
        "sign",
        "x moves away from what was seen: the innovation is measured minus predicted, and is added.",
        (X, "x = x - K @ v"),
    ),
    Slip(
        "S-missing",
        "The gain lacks S⁻¹: P Hᵀ v would move the state by more the larger the innovation's own "
        "uncertainty.",
        (X, "x = x + P @ H.T @ v"),
        (K, "K = P @ H.T"),
    ),
    Slip(
        "S-not-inverted",
        "The gain is multiplied by S where it should be divided by it: a doubtful innovation must move "
        "the state by less.",
        (K, "K = P @ H.T @ S"),
    ),
    Slip(
        "R-missing",
        "S lacks R: the sight was taken for exact.",
        (S, "S = H @ P @ H.T"),
    ),
    Slip(
        "R-only",
        "S is R alone: the pose and the landmark err as well, and their error is in the innovation.",
        (S, "S = R"),
    ),
    Slip(
        "R-twice",
        "S holds R twice: the sight is made once, and errs once.",
        (S, "S = H @ P @ H.T + 2 * R"),
    ),
    Slip(
        "R-by-its-diagonal",
        "Only the variances of R were used. What range and bearing share in their errors stands beside "
        "the diagonal.",
        (S, "S = H @ P @ H.T + np.diag(np.diag(R))"),
    ),
    Slip(
        "R-squared",
        "R holds variances already: look whether you take a root or a square of it.",
        (S, "S = H @ P @ H.T + R @ R"),
        (S, "S = H @ P @ H.T + R**2"),
        (S, "S = H @ P @ H.T + np.sqrt(np.abs(R))"),
    ),
    Slip(
        "kept-apart",
        "S (or K too) was made without the blocks between robot and landmarks. Both errors are in the "
        "innovation, and what they share decides how much is to be learned from it: use the whole of P.",
        (S, f"S = H @ ({APART}) @ H.T + R"),
        [(S, f"S = H @ ({APART}) @ H.T + R"), (K, f"K = ({APART}) @ H.T @ np.linalg.inv(S)")],
    ),
    Slip(
        "robot-only-in-H",
        "H has only the robot's columns, or only the landmark's: in SLAM the errors of both are in the "
        "innovation.",
        ("H = H_full(x, j)", "H = H_full(x, j)\n    H[:, 3:] = 0"),
        ("H = H_full(x, j)", "H = H_full(x, j)\n    H[:, :3] = 0"),
    ),
    Slip(
        "wrong-landmark",
        "Another landmark's place is used: the robot takes three numbers of x, and landmarks are counted "
        "from 0.",
        ("at = 3 + 2 * j", "at = 2 * j"),
        ("at = 3 + 2 * j", "at = 1 + 2 * j"),
        ("at = 3 + 2 * j", "at = 3 + j"),
        ("at = 3 + 2 * j", "at = 3 + 2 * ((j + 1) % (len(x) // 2 - 1))"),
        ("H_full(x, j)", "H_full(x, (j + 1) % (len(x) // 2 - 1))"),
        ("at = 3 + 2 * j", "at = 3"),
        [("at = 3 + 2 * j", "at = 1 + 2 * j"), ("H_full(x, j)", "H_full(x, j - 1)")],
        [("at = 3 + 2 * j", "at = len(x) - 2"), ("H_full(x, j)", "H_full(x, len(x) // 2 - 2)")],
    ),
    Slip(
        "x-stays",
        "x comes back as it went in: the innovation, weighed by K, has to be added.",
        (X, "x = x.copy()"),
    ),
    Slip(
        "some-rows-only",
        "Some parts of the state learned nothing. No block of K is zero: robot, the landmark seen and "
        "all the others are corrected, by all rows of K.",
        (K, K + "\n    K = K * (np.abs(H).max(axis=0) > 0)[:, None]"),
        (K, K + "\n    K[3:] = 0"),
        (K, K + "\n    K[:3] = 0"),
        (X, "x = x + np.r_[K[:3] @ v, np.zeros(len(x) - 3)]"),
        (X, "x = np.r_[x[:3], x[3:] + K[3:] @ v]"),
        (X, "x = x + (K * (np.abs(H).max(axis=0) > 0)[:, None]) @ v"),
    ),
    Slip(
        "half-gain",
        "The state moves half as far as it should, or twice as far: no factor belongs before K or v.",
        (X, "x = x + 0.5 * K @ v"),
        (X, "x = x + 2 * K @ v"),
        (K, "K = 0.5 * P @ H.T @ np.linalg.inv(S)"),
    ),
    Slip(
        "range-or-bearing-only",
        "Only one of range and bearing is used; z holds two numbers, and both teach something.",
        (X, "v[1] = 0\n    x = x + K @ v"),
        (X, "v[0] = 0\n    x = x + K @ v"),
    ),
    Slip(
        "unwrapped",
        "The innovation's bearing is not wrapped: a landmark predicted at 179° and seen at −179° is 2° "
        "off, not 358°.",
        ("v[1] = wrap(v[1])", "pass"),
        Edit("Joseph's form", (("v[1] = wrap(v[1])", "pass"),)),
    ),
    Slip(
        "bearing-from-0-to-2π",
        "The innovation's bearing is counted from 0 to 2π: what is seen 2° farther to the right than "
        "expected is then 358° to the left. Wrap it into (−π, π].",
        ("v[1] = wrap(v[1])", "v[1] = v[1] % (2 * np.pi)"),
    ),
    Slip(
        "range-wrapped",
        "The range was wrapped as well: it is a length. Only the bearing counts modulo 2π.",
        ("v[1] = wrap(v[1])", "v = wrap(v)"),
    ),
    Slip(
        "h-in-another-frame",
        "The prediction is not what h says: it takes the robot's pose and the landmark's place in the "
        "world, and gives range and bearing as seen from the robot.",
        ("h(x[:3], x[at : at + 2])", "h(np.zeros(3), x[at : at + 2])"),
        ("h(x[:3], x[at : at + 2])", "h(x[:3] * [1, 1, 0], x[at : at + 2])"),
    ),
    Slip(
        "P-stays",
        "P comes back as it went in: the robot has learned something and does not know it. By how much "
        "does what was unsure shrink?",
        (RETURN, "return x, P.copy()"),
    ),
    Slip(
        "P-sign",
        "P grew: seeing something makes nobody less sure. Look at the sign of K S Kᵀ.",
        (RETURN, "return x, P + K @ S @ K.T"),
    ),
    Slip(
        "S-inverse",
        "Not S⁻¹ stands between K and Kᵀ, but S: look at the units of K S Kᵀ.",
        (RETURN, "return x, P - K @ np.linalg.inv(S) @ K.T"),
        (RETURN, "return x, P - K @ K.T"),
    ),
    Slip(
        "R-between-the-gains",
        "P shrinks by K R Kᵀ instead of K S Kᵀ: it is the whole innovation's covariance that counts.",
        (RETURN, "return x, P - K @ R @ K.T"),
    ),
    Slip(
        "half-of-joseph",
        "(I − K H) P (I − K H)ᵀ alone leaves out the sight's own noise: Joseph's form adds a term of R.",
        (RETURN, "return x, (np.eye(len(x)) - K @ H) @ P @ (np.eye(len(x)) - K @ H).T"),
        Edit("Joseph's form", ((" + K @ R @ K.T", " + R[0, 0] * K @ K.T"),)),
    ),
    Slip(
        "cross-zero",
        "Blocks of P beside the diagonal are zero. One sight corrects robot and landmarks together, so "
        "they share what is left of the error: keep all of P − K S Kᵀ.",
        (RETURN, f"P = P - K @ S @ K.T\n    return x, {APART}"),
        (RETURN, "P = P - K @ S @ K.T\n    P[:3, 3:] = P[3:, :3] = 0\n    return x, P"),
    ),
    Slip(
        "P-in-part",
        "Some blocks of P are as they were. K S Kᵀ has no zero block: the covariance of the unseen "
        "landmarks, and what they share, shrinks as well.",
        (RETURN, "new = P.copy()\n    new[:3, :3] -= (K @ S @ K.T)[:3, :3]\n    return x, new"),
        (RETURN, "return x, P - np.triu(K @ S @ K.T)"),
        (RETURN, "return x, P - np.diag(np.diag(K @ S @ K.T))"),
    ),
    Slip(
        "H-after-the-update",
        "P was made with H at the new state: the gain that moved x belongs to H at the old one, and so "
        "does the covariance.",
        (RETURN, "H = H_full(x, j)\n    return x, (np.eye(len(x)) - K @ H) @ P"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        "def update(x, P, z, j, R):\n    return x",
        (X, "x = x + K @ v + 0j"),
        (RETURN, "return P - K @ S @ K.T, x"),
        (RETURN, "return x[:3], (P - K @ S @ K.T)[:3, :3]"),
    ),
    Stumble("raised", (X, "x = x + K @ v[:1]"), (K, "K = np.linalg.inv(S) @ H @ P")),
    Stumble("not attempted", "def update(x, P, z, j, R):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
