"""Programs of task 07-corridor."""

from course.tasks import Edit, Slip, Stumble

TASK = "07-corridor"
MUTANTS = 250

WAYS = {
    "joseph": """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    P[0, 0] += q
    x[0] += d
    H = np.zeros((1, len(x)))
    H[0, 0], H[0, i] = -1, 1
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + r)
    L = np.eye(len(x)) - K @ H
    return x + (K * (z - x[i] + x[0])).ravel(), L @ P @ L.T + K * r @ K.T
""",
    "entry by entry": """
def step(x, P, d, q, i, z, r):
    n = len(x)
    x, P = list(x), [list(row) for row in P]
    x[0], P[0][0] = x[0] + d, P[0][0] + q
    c = [P[k][i] - P[k][0] for k in range(n)]
    S = c[i] - c[0] + r
    v = z - (x[i] - x[0])
    x = [x[k] + c[k] * v / S for k in range(n)]
    return x, [[P[k][l] - c[k] * c[l] / S for l in range(n)] for k in range(n)]
""",
    "with A and Q": """
def step(x, P, d, q, i, z, r):
    A, Q, u = np.eye(len(x)), np.zeros_like(P), np.zeros_like(x)
    Q[0, 0], u[0] = q, d
    x, P = A @ x + u, A @ P @ A.T + Q
    H = np.eye(len(x))[i] - np.eye(len(x))[0]
    S = float(H @ P @ H) + r
    return [x + P @ H * (z - H @ x) / S, P - np.outer(P @ H, H @ P) / S]
""",
    "short": """
def step(x, P, d, q, i, z, r):
    first = np.arange(len(x)) == 0
    x, P = x + d * first, P + q * np.outer(first, first)
    shared = P[:, i] - P[:, 0]
    K = shared / (shared[i] - shared[0] + r)
    return x + K * (z + x[0] - x[i]), P - np.outer(K, shared)
""",
    "the sight as an entry": """
def step(x, P, d, q, i, z, r):
    n = len(x)
    F = np.vstack([np.eye(n), np.eye(n)[i] - np.eye(n)[0]])
    x = x + d * np.eye(n)[0]
    joint = F @ (P + np.diag(np.r_[q, np.zeros(n - 1)])) @ F.T
    joint[n, n] += r
    K = joint[:n, n] / joint[n, n]
    return x + K * (z - F[n] @ x), joint[:n, :n] - np.outer(K, joint[n, :n])
""",
}

_DRIVE = "x[0] += d\n    P[0, 0] += q\n    "
_S, _K = "S = H @ P @ H + r", "K = P @ H / S"
_x, _P = "x + K * (z - H @ x)", "P - S * np.outer(K, K)"
_PAIR = "return x + K * (z - H @ x), P - S * np.outer(K, K)"
_NEW = "x, P = x + K * (z - H @ x), P - S * np.outer(K, K)\n    "
_SEEN = "np.isin(np.arange(len(x)), [0, i])"

SLIPS = (
    Slip(
        "forgotten",
        "Correlations are forgotten after a step. The next sight then counts as fresh news what "
        "came from the same error, and the filter is too sure: this is what NEES shows.",
        (_PAIR, _NEW + "return x, np.diag(np.diag(P))"),
        (_PAIR, _NEW + "P[1:, 1:] = np.diag(np.diag(P[1:, 1:]))\n    return x, P"),
        (_PAIR, _NEW + "P[0, 1:] = P[1:, 0] = 0\n    return x, P"),
        ("x, P = x.copy(), P.copy()", "x, P = x.copy(), np.diag(np.diag(P))"),
        ("P[0, 0] += q\n", "P[0, 0] += q\n    P[0, 1:] = P[1:, 0] = 0\n"),
    ),
    Slip(
        "others-not-moved",
        "Only the robot and the door in sight learn from a sight. The other doors err together "
        "with the robot: K has an entry for each of them.",
        [
            (_x, f"x + {_SEEN} * K * (z - H @ x)"),
            (_P, f"P - S * np.outer(K, K) * np.outer({_SEEN}, {_SEEN})"),
        ],
        (_x, f"x + {_SEEN} * K * (z - H @ x)"),
        (_P, f"P - S * np.outer(K, K) * np.outer({_SEEN}, {_SEEN})"),
        (_K, f"K = {_SEEN} * (P @ H) / S"),
    ),
    Slip(
        "robot-alone",
        "Only the robot is corrected. A door that is hardly known learns more from being seen than "
        "the robot does.",
        (_K, "K = P @ H / S\n    K[1:] = 0"),
    ),
    Slip(
        "door-alone",
        "Only the door is corrected, as if the robot were where it believes to be.",
        (_K, "K = P @ H / S\n    K[0] = 0"),
    ),
    Slip(
        "innovation-sign",
        "x walks away from what is seen: the innovation is what is seen less what was expected, "
        "and a door ahead has a larger x than the robot.",
        (_x, "x - K * (z - H @ x)"),
        (_x, "x + K * (H @ x - z)"),
        (_x, "x + K * (z + H @ x)"),
        ("H[0], H[i] = -1, 1", "H[0], H[i] = 1, -1"),
    ),
    Slip(
        "expected-as-a-sum",
        "What is expected is the distance from the robot to the door, x_i − x_0; here both places were "
        "taken away from z, or added.",
        (_x, "x + K * (z - x[i] - x[0])"),
        (_x, "x + K * (z + x[i] + x[0])"),
    ),
    Slip(
        "nothing-expected",
        "What was expected is missing from the innovation: it is z less x_i − x_0, or less one of them "
        "only.",
        (_x, "x + K * z"),
        (_x, "x + K * (z - x[i])"),
        (_x, "x + K * (z + x[0])"),
    ),
    Slip(
        "sides-lost",
        "A door behind the robot has a negative distance, and the sign is lost on the way.",
        (_x, "x + K * (abs(z) - abs(H @ x))"),
        (_x, "x + K * (abs(z) - H @ x)"),
        ("H[0], H[i] = -1, 1", "side = np.sign(x[i] - x[0])\n    H[0], H[i] = -side, side"),
    ),
    Slip(
        "robot-not-in-H",
        "H has an entry for the door and none for the robot: what is seen errs with both.",
        [("H[0], H[i] = -1, 1", "H[i] = 1"), (_x, "x + K * (z - x[i] + x[0])")],
    ),
    Slip(
        "signs-of-H",
        "A sight is the door's place *less* the robot's: the two entries of H have different signs.",
        ("H[0], H[i] = -1, 1", "H[0], H[i] = 1, 1"),
    ),
    Slip(
        "index-of-door",
        "The wrong door: i counts entries of x, and the robot is entry 0.",
        [("H[0], H[i] = -1, 1", "H[0] = -1\n    H[(i + 1) % len(x)] += 1")],
        [("H[0], H[i] = -1, 1", "H[0] = -1\n    H[i - 1] += 1")],
    ),
    Slip(
        "not-moved",
        "A drive moves the robot by d, forwards, and leaves the doors where they are.",
        ("    x[0] += d\n", ""),
        ("x[0] += d", "x += d"),
        ("x[0] += d", "x[0] -= d"),
        ("x[0] += d", "x[1:] -= d"),
    ),
    Slip(
        "set-to-d",
        "d is the way driven in this step, not the place where the robot is: it adds up.",
        ("x[0] += d", "x[0] = d"),
        ("P[0, 0] += q", "P[0, 0] = q"),
    ),
    Slip(
        "see-then-drive",
        "The sight was taken in before the drive. The robot drives first and then sees, from where "
        "it has come to.",
        [(_DRIVE, ""), (_PAIR, _NEW + _DRIVE + "return x, P")],
        [("    x[0] += d\n", ""), (_PAIR, _NEW + "x[0] += d\n    return x, P")],
        [("    P[0, 0] += q\n", ""), (_PAIR, _NEW + "P[0, 0] += q\n    return x, P")],
    ),
    Slip(
        "drive-noise-missing",
        "A drive makes the robot less certain, once each step.",
        ("    P[0, 0] += q\n", ""),
        ("P[0, 0] += q", "P[0, 0] -= q"),
    ),
    Slip(
        "drive-noise-twice",
        "q was added twice: a drive happens once each step.",
        ("P[0, 0] += q", "P[0, 0] += 2 * q"),
    ),
    Slip(
        "doors-made-noisy",
        "q was added to more than the robot's variance. Doors do not move when the robot drives, "
        "so a drive does not make them less certain.",
        ("P[0, 0] += q", "P += q * np.eye(len(x))"),
        ("P[0, 0] += q", "P += q"),
        ("P[0, 0] += q", "P[0] += q\n    P[1:, 0] += q"),
        ("P[0, 0] += q", "P[i, i] += q"),
    ),
    Slip(
        "sight-noise-missing",
        "S holds no r: sights would have no noise.",
        (_S, "S = H @ P @ H"),
        [(_S, "S = H @ P @ H"), (_K, "K = P @ H / (S + r)")],
    ),
    Slip(
        "q-and-r",
        "q belongs to the drive and r to the sight: they are exchanged somewhere.",
        [("P[0, 0] += q", "P[0, 0] += r"), (_S, "S = H @ P @ H + q")],
        (_S, "S = H @ P @ H + q"),
        ("P[0, 0] += q", "P[0, 0] += r"),
        (_S, "S = H @ P @ H + q + r"),
    ),
    Slip(
        "standard-deviation",
        "q and r are variances already: look whether you take a square or a root of one.",
        ("P[0, 0] += q", "P[0, 0] += q**2"),
        ("P[0, 0] += q", "P[0, 0] += np.sqrt(q)"),
        (_S, "S = H @ P @ H + r**2"),
        (_S, "S = H @ P @ H + np.sqrt(r)"),
        [(_S, "S = H @ P @ H + np.sqrt(r)"), (_P, "P - np.outer(K, H @ P)")],
        [("P[0, 0] += q", "P[0, 0] += q**2"), (_S, "S = H @ P @ H + r**2")],
        [("P[0, 0] += q", "P[0, 0] += np.sqrt(q)"), (_S, "S = H @ P @ H + np.sqrt(r)")],
    ),
    Slip(
        "noise-scaled-by-the-way",
        "q is the variance of this drive, whatever its length: nothing is to be multiplied by d.",
        ("P[0, 0] += q", "P[0, 0] += q * abs(d)"),
        ("P[0, 0] += q", "P[0, 0] += q * d**2"),
    ),
    Slip(
        "shares-ignored-in-S",
        "S leaves out what robot and door share: H P Hᵀ is P_00 + P_ii − 2 P_0i.",
        (_S, "S = P[0, 0] + P[i, i] + r"),
        [(_S, "S = P[0, 0] + P[i, i] + r"), (_P, "P - np.outer(K, H @ P)")],
        (_S, "S = P[0, 0] + P[i, i] - P[0, i] + r"),
    ),
    Slip(
        "gain-halved",
        "Only half of the correction was made.",
        (_x, "x + K / 2 * (z - H @ x)"),
        (_K, "K = P @ H / S / 2"),
        (_P, "P - S * np.outer(K, K) / 2"),
    ),
    Slip(
        "sandwich",
        "What a sight takes off from P is K S Kᵀ: once S, between two gains.",
        (_P, "P - np.outer(K, K)"),
        (_P, "P - np.outer(K, K) / S"),
        (_P, "P - S * K @ K"),
        (_P, "P - S * K * K"),
    ),
    Slip(
        "added",
        "What a sight teaches was added to P: to see makes more certain.",
        (_P, "P + S * np.outer(K, K)"),
    ),
    Slip(
        "not-learned",
        "x or P does not learn from the sight: both change at each of them.",
        (_P, "P"),
        (_PAIR, "return x, P - S * np.outer(K, K)"),
    ),
    Slip(
        "joseph-without-noise",
        "Joseph's form without K r Kᵀ: the noise that the gain lets in is missing.",
        Edit("joseph", ((" + K * r @ K.T", ""),)),
    ),
    Slip(
        "too-sure",
        "P is a constant times what it should be. NEES tells: it is not what such errors claim.",
        (_P, "(P - S * np.outer(K, K)) / 4"),
    ),
    Slip(
        "three-doors",
        "The number of doors is written into the program. Take it from x: there may be one, or many.",
        ("H = np.zeros(len(x))", "H = np.zeros(4)"),
        [
            (
                _PAIR,
                "n = 4\n    P = P[:n, :n] - S * np.outer(K, K)[:n, :n] if len(x) > n else "
                + _P
                + "\n    return "
                + _x
                + ", np.pad(P, (0, len(x) - len(P)))",
            )
        ],
    ),
)

STUMBLES = (
    Stumble("raised", ("H = np.zeros(len(x))", "H = np.zeros(3)"), (_PAIR, "return x[99], P")),
    Stumble(
        "malformed",  # the first four run away
        (_K, "K = P @ H"),
        (_K, "K = P @ H * S"),
        (_S, "S = P[i, i] + r"),
        (_S, "S = P[0, 0] + r"),
        (_PAIR, "return x + K * (z - H @ x)"),
        (_PAIR, "return (x + K * (z - H @ x))[:, None], P"),
        (_PAIR, "return 'x', P"),
        (_PAIR, "pass"),
    ),
)
