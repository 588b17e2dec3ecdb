"""Right ways and slips of 05-ranges."""

from course.tasks import Slip, Stumble

TASK = "05-ranges"

HEAD = "def locate_by_ranges(x, P, rs, beacons, a, sigma):\n"
ANTENNA = """    c, s = np.cos(x[2]), np.sin(x[2])
    q = np.array([x[0] + c * a[0] - s * a[1], x[1] + s * a[0] + c * a[1]])
"""
WAYS = {
    "one after the other, H of the first pose": HEAD
    + ANTENNA
    + """    here = x
    for r, b in zip(rs, beacons):
        far = np.hypot(*(q - b))
        ex, ey = (q - b) / far
        h_row = np.array([ex, ey, ey * (q - x[:2])[0] - ex * (q - x[:2])[1]])
        K = P @ h_row / (h_row @ P @ h_row + sigma**2)
        here = here + K * (r - far - h_row @ (here - x))
        P = P - np.outer(K, h_row @ P)
    return here, P
""",
    "information, summed": HEAD
    + ANTENNA
    + """    Y, y = np.linalg.inv(P), np.zeros(3)
    for r, b in zip(rs, beacons):
        far = np.linalg.norm(q - b)
        angle = np.arctan2(*(q - b)[::-1])
        arm = a[0] * np.sin(angle - x[2]) - a[1] * np.cos(angle - x[2])
        H = np.array([np.cos(angle), np.sin(angle), arm])
        Y, y = Y + np.outer(H, H) / sigma**2, y + H * (r - far) / sigma**2
    return x + np.linalg.solve(Y, y), np.linalg.inv(Y)
""",
    "H by differences": HEAD
    + """    def expected(x):
        c, s = np.cos(x[2]), np.sin(x[2])
        at = x[:2] + np.array([[c, -s], [s, c]]) @ a
        return np.array([np.sqrt((at - b) @ (at - b)) for b in beacons])

    H = np.array([(expected(x + e) - expected(x - e)) / 2e-6 for e in 1e-6 * np.eye(3)]).T
    H = H.reshape(len(rs), 3)
    R = np.diag(np.full(len(rs), sigma**2))
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    keep = np.eye(3) - K @ H
    return x + K @ (rs - expected(x)), keep @ P @ keep.T + K @ R @ K.T
""",
    "by the antenna's polar models": HEAD
    + """    if len(rs) == 0:
        return x.copy(), P.copy()
    q = g(x, np.array([np.hypot(*a), np.arctan2(a[1], a[0])]))
    at = np.array([q[0], q[1], x[2]])
    arm = np.eye(3)
    arm[:2, 2] = [-(q - x[:2])[1], (q - x[:2])[0]]
    H = np.vstack([H_robot(at, b)[:1] @ arm for b in beacons])
    v = rs - h(at, beacons)[:, 0]
    S = H @ P @ H.T + np.diag([sigma**2] * len(v))
    K = np.linalg.solve(S, H @ P).T
    x = x + K @ v
    x[2] = wrap(x[2])
    return [x, P - K @ S @ K.T]
""",
    "least squares by QR": HEAD
    + ANTENNA
    + """    d = q - beacons
    r = np.sqrt((d**2).sum(axis=1))
    H = np.stack([d[:, 0] / r, d[:, 1] / r, (d[:, 1] * (q - x[:2])[0] - d[:, 0] * (q - x[:2])[1]) / r], 1)
    root = np.linalg.cholesky(np.linalg.inv(P)).T
    M = np.vstack([root, H / sigma])
    Q, U = np.linalg.qr(M)
    step = np.linalg.solve(U, Q.T @ np.append(np.zeros(3), (rs - r) / sigma))
    return x + step, np.linalg.inv(U.T @ U)
""",
}

ARM, D = "arm = np.array([[c, -s], [s, c]]) @ a", "d = x[:2] + arm - beacons"
R = "r = np.linalg.norm(d, axis=1)"
SWING = "swing = np.array([-arm[1], arm[0]])"
H = "H = np.column_stack([d, d @ swing]) / r[:, None]"
S, NOISE = "S = H @ P @ H.T + sigma**2 * np.eye(len(rs))", "sigma**2 * np.eye(len(rs))"
K, X, P_AFTER = "K = P @ H.T @ np.linalg.inv(S)", "x + K @ (rs - r)", "P - K @ S @ K.T"
OUT = f"return {X}, {P_AFTER}"

SLIPS = (
    Slip(
        "antenna-forgotten",
        "The ranges are taken for those of the pose. They were measured at the antenna, which stands beside "
        "it and swings round when the robot turns.",
        (D, "arm = 0 * a\n    d = x[:2] - beacons"),
        (D, "d = x[:2] - beacons"),
    ),
    Slip(
        "antenna-not-turned",
        "The antenna is placed as if the robot looked east: a is forward and left of the robot, however that "
        "is turned.",
        (ARM, "arm = a"),
    ),
    Slip(
        "turned-the-other-way",
        "The antenna is turned to the wrong side: look at a robot that looks north, and ask where forward is.",
        (ARM, "arm = np.array([[c, s], [-s, c]]) @ a"),
        (ARM, "arm = a @ np.array([[c, -s], [s, c]])"),
        (ARM, "arm = np.array([[c, -s], [s, c]]) @ a[::-1]"),
        (D, "d = x[:2] - arm - beacons"),
    ),
    Slip(
        "heading-teaches-nothing",
        "H's third column is zero: an antenna beside the axle moves when the robot turns, and the range "
        "changes with it.",
        (H, "H = np.column_stack([d, 0 * r]) / r[:, None]"),
    ),
    Slip(
        "swing-wrong",
        "H's third column is not how the range changes with θ. Where does the antenna go when the robot turns "
        "by a small angle to the left?",
        (SWING, "swing = np.array([arm[1], -arm[0]])"),
        (SWING, "swing = arm"),
        (SWING, "swing = np.array([-a[1], a[0]])"),
        (H, "H = np.column_stack([d / r[:, None], d @ swing])"),
        (H, "H = np.column_stack([d / r[:, None], -np.ones(len(r))])"),
    ),
    Slip(
        "H-turned",
        "H has the wrong sign: when the robot moves away from a beacon, the range grows.",
        (H, "H = np.column_stack([-d, d @ swing]) / r[:, None]"),
    ),
    Slip(
        "not-a-unit-vector",
        "H's first columns are not a direction: a metre straight away from a beacon makes the range a metre "
        "longer, however far it is.",
        (H, "H = np.column_stack([d, d @ swing])"),
        (H, "H = np.column_stack([d, d @ swing]) / r[:, None] ** 2"),
    ),
    Slip(
        "H-by-what-was-measured",
        "H was divided by the measured ranges. It belongs to the pose you are given, and so to the range "
        "expected there.",
        (H, "H = np.column_stack([d, d @ swing]) / rs[:, None]"),
    ),
    Slip(
        "sigma-for-variance",
        "sigma is a standard deviation; S holds variances.",
        (NOISE, "sigma * np.eye(len(rs))"),
        (NOISE, "sigma**4 * np.eye(len(rs))"),
    ),
    Slip(
        "noise-in-all-of-S",
        "σ² stands in every place of S, as if all ranges erred alike. They err independently of each other.",
        (NOISE, "sigma**2"),  # S is singular: its inverse is what rounding left
        shaky=True,
    ),
    Slip(
        "noise-forgotten",
        "S lacks the ranges' own noise, or holds it once for each beacon: each range errs by σ, once.",
        (S, "S = H @ P @ H.T"),
        (NOISE, "len(rs) * sigma**2 * np.eye(len(rs))"),
    ),
    Slip(
        "linearised-anew",
        "Each range was used at the pose that the one before had corrected. They are heard all at once: take "
        "H and the expected ranges at the pose you are given.",
        HEAD
        + """    for r, b in zip(rs, beacons):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        d = x[:2] + arm - b
        far = np.hypot(*d)
        H = np.array([[d[0], d[1], d[1] * arm[0] - d[0] * arm[1]]]) / far
        S = H @ P @ H.T + sigma**2
        K = P @ H.T / S
        x, P = x + K[:, 0] * (r - far), P - K @ S @ K.T
    return x, P
""",
    ),
    Slip(
        "one-beacon-only",
        "Only some of the beacons are used: m may be any number.",
        (R, "d, rs = d[:1], rs[:1]\n    " + R),
        (R, "d, rs = d[-1:], rs[-1:]\n    " + R),
        (R, "d, rs = d[:3], rs[:3]\n    " + R),
    ),
    Slip(
        "averaged",
        "The beacons are lumped together: each range is an observation of its own, with its own row of H.",
        (H, H + "\n    H[:] = H.mean(axis=0)"),
    ),
    Slip(
        "sign",
        "The pose moves the wrong way: v is measured minus expected, and is added.",
        (X, "x - K @ (rs - r)"),
        (X, "x + K @ (r - rs)"),
    ),
    Slip(
        "correction-only",
        "x is the correction alone: it is to be added to what was believed.",
        (X, "K @ (rs - r)"),
    ),
    Slip(
        "wrapped",
        "Ranges were wrapped: they are lengths, and only angles count modulo 2π.",
        (X, "x + K @ wrap(rs - r)"),
    ),
    Slip(
        "squares",
        "Squares of ranges were compared, or the ranges themselves without what was expected.",
        (X, "x + K @ (rs**2 - r**2)"),
        (X, "x + K @ rs"),
    ),
    Slip(
        "no-S",
        "The gain lacks S⁻¹: the larger the innovation's doubt, the less it must move the pose.",
        (K, "K = P @ H.T"),
        (K, "K = P @ H.T @ S"),
    ),
    Slip(
        "half-gain",
        "The pose moves half as far as it should, or twice as far.",
        (X, "x + 0.5 * K @ (rs - r)"),
        (X, "x + 2 * K @ (rs - r)"),
    ),
    Slip(
        "place-only",
        "The heading, or the place, learned nothing. Even a range that does not depend on θ corrects it, by "
        "what P says that they share.",
        (K, K + "\n    K[2] = 0"),
        (X, "x + K @ (rs - r) * [1, 1, 0]"),
        (X, "x + K @ (rs - r) * [0, 0, 1]"),
    ),
    Slip(
        "P-by-its-diagonal",
        "Only the variances of P were used.",
        (S, "P = np.diag(np.diag(P))\n    " + S),
    ),
    Slip(
        "P-stays",
        "P comes back as it went in: who has heard something is less unsure.",
        (P_AFTER, "P.copy()"),
    ),
    Slip(
        "P-grows", "P grew: hearing something makes nobody less sure.", (P_AFTER, "P + K @ S @ K.T")
    ),
    Slip(
        "P-missing",
        "Something of P is missing: I − K H has still to be multiplied by P.",
        (P_AFTER, "np.eye(3) - K @ H"),
        (P_AFTER, "P - K @ H"),
    ),
    Slip(
        "S-inverted",
        "Not S⁻¹ stands between K and Kᵀ, but S.",
        (P_AFTER, "P - K @ np.linalg.inv(S) @ K.T"),
        (P_AFTER, "P - K @ K.T"),
    ),
    Slip(
        "half-of-joseph",
        "(I − K H) P (I − K H)ᵀ alone leaves out the ranges' own noise.",
        (P_AFTER, "(np.eye(3) - K @ H) @ P @ (np.eye(3) - K @ H).T"),
    ),
    Slip(
        "refused",
        "Beacons that are near, or ranges that contradict the belief, were not used. Each is to be believed, as "
        "far as sigma says.",
        (R, "d, rs = d[(d**2).sum(axis=1) > 0.01], rs[(d**2).sum(axis=1) > 0.01]\n    " + R),
        (H, "d, rs, r = d[abs(rs - r) < 3], rs[abs(rs - r) < 3], r[abs(rs - r) < 3]\n    " + H),
    ),
    Slip(
        "twice-heard",
        "A beacon that was heard twice is used once: two measurements of it teach more than one.",
        (
            D,
            "beacons, once = np.unique(beacons, axis=0, return_index=True)\n    rs = rs[once]\n    "
            + D,
        ),
    ),
)

STUMBLES = (
    Stumble("malformed", (OUT, "return x"), (OUT, "return None")),
    Stumble("raised", (H, "H = np.column_stack([d, d @ swing]) / r"), (R, "r = np.linalg.norm(d)")),
)

PASTED = {
    "the lesson's update with the range alone": HEAD
    + """    for r, p in zip(rs, beacons):
        v = np.array([r - h(x, p)[0]])
        H = H_robot(x, p)[:1]
        S = H @ P @ H.T + sigma**2
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
    return x, P
""",
    "locate, its bearing worth nothing": HEAD
    + """    for r, p in zip(rs, beacons):
        x, P = locate(x, P, np.array([r, h(x, p)[1]]), p, np.diag([sigma**2, 1e6]))
    return x, P
""",
}

EQUIVALENT = {}
