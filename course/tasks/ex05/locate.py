"""Right ways and slips of 05-locate."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex05.locate_ways import WAYS

__all__ = ["WAYS"]

TASK = "05-locate"

V, WRAP = "v = z - h(x, p)", "v[1] = wrap(v[1])"
H, S = "H = H_robot(x, p)", "S = H @ P @ H.T + R"
K = "K = P @ H.T @ np.linalg.inv(S)"
X, P_AFTER = "x + K @ v", "P - K @ S @ K.T"
OUT = f"return {X}, {P_AFTER}"

ITERATED = """
def locate(x, P, z, p, R):
    y = x
    for _ in range({rounds}):
        v = z - h(y, p)
        v[1] = wrap(v[1])
        H = H_robot(y, p)
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        y = {better}
    return y, P - K @ S @ K.T
"""

SLIPS = (
    Slip(
        "iterated",
        "H and K were found anew at the corrected pose, and the same sight corrects from there. That is "
        "another filter, the iterated one. Here all is taken at the pose that you were given, and once.",
        *(
            ITERATED.format(rounds=rounds, better=better)
            for rounds in (2, 3, 4, 5, 10, 20)
            for better in ("x + K @ (v - H @ (x - y))", "y + K @ v")
        ),
        shaky=True,  # where it is far off, it wanders
    ),
    Slip(
        "one-number-after-the-other",
        "Range and bearing were taken one after the other, each with an H of its own. The second would need "
        "the H of the pose that you were given, and what the two share in their errors stands beside the "
        "diagonal of R. Take both at once.",
        *(
            f"""
def locate(x, P, z, p, R):
    for k in {order}:
        H = H_robot(x, p)[k]
        v = z[k] - h(x, p)[k]
        v = wrap(v) if k == 1 else v
        K = P @ H / (H @ P @ H + R[k, k])
        x, P = x + K * v, P - np.outer(K, H @ P)
    return x, P
"""
            for order in ("(0, 1)", "(1, 0)")
        ),
    ),
    Slip(
        "gated",
        "A sight that is far off was thrown away. The text asks you to take in every sight, one that "
        "contradicts the belief as well.",
        *(
            (K, f"{K}\n    if v @ np.linalg.solve(S, v) > {gate}:\n        return x, P")
            for gate in (5.99, 9.21, 13.8)
        ),
    ),
    Slip(
        "sign",
        "The pose moves away from what was seen: v is measured minus predicted, and K v is added.",
        (X, "x - K @ v"),
        (V, "v = h(x, p) - z"),
    ),
    Slip(
        "correction-only",
        "x is K v alone: the innovation corrects what was believed, and does not replace it.",
        (X, "K @ v"),
    ),
    Slip(
        "x-stays", "The pose comes back as it went in: K v has to be added to it.", (X, "x.copy()")
    ),
    Slip(
        "half-gain",
        "The pose moves half as far as it should, or twice as far: no factor belongs before K or v.",
        (X, "x + 0.5 * K @ v"),
        (X, "x + 2 * K @ v"),
        (K, "K = 0.5 * P @ H.T @ np.linalg.inv(S)"),
    ),
    Slip(
        "place-only",
        "Some numbers of the pose learned nothing. A sight of one landmark corrects x, y and θ, each by "
        "its own row of K.",
        (X, "x + K @ v * [1, 1, 0]"),
        (X, "x + K @ v * [0, 0, 1]"),
        (K, K + "\n    K[2] = 0"),
    ),
    Slip(
        "range-or-bearing-only",
        "Only one of range and bearing is used: z holds two numbers, and both teach something.",
        (OUT, "v[1] = 0\n    " + OUT),
        (OUT, "v[0] = 0\n    " + OUT),
        (H, H + "\n    H[1] = 0"),
        (H, H + "\n    H[0] = 0"),
    ),
    Slip(
        "unwrapped",
        "The innovation's bearing is not wrapped: a landmark expected at 179° and seen at −179° is 2° "
        "off, not 358°.",
        (WRAP, "pass"),
        (WRAP, "v[1] = (v[1] + 180) % 360 - 180"),
        (V + "\n    " + WRAP, "v = np.array([z[0], wrap(z[1])]) - h(x, p)"),
        (WRAP, "v[1] = abs(v[1]) if abs(v[1]) > np.pi else v[1]"),
    ),
    Slip(
        "sine-for-angle",
        "The sine of the bearing's innovation stands for the innovation. It is like it while it is small; at "
        "100° it is already smaller than at 90°. Wrap the angle instead.",
        (WRAP, "v[1] = np.sin(v[1])"),
        (WRAP, "v[1] = 2 * np.sin(v[1] / 2)"),
    ),
    Slip(
        "from-zero",
        "The innovation's bearing runs from 0 to 2π, so that a landmark a little to the right looks as if "
        "it were almost a full turn to the left.",
        (WRAP, "v[1] %= 2 * np.pi"),
    ),
    Slip(
        "range-wrapped",
        "The range was wrapped as well: it is a length. Only the bearing counts modulo 2π.",
        (WRAP, "v = wrap(v)"),
    ),
    Slip(
        "degrees",
        "The innovation's bearing is in degrees, while H and R speak of radians.",
        (WRAP, "v[1] = np.degrees(wrap(v[1]))"),
    ),
    Slip(
        "no-S",
        "The gain lacks S⁻¹: the larger the innovation's doubt, the less it must move the pose.",
        (K, "K = P @ H.T"),
        (X, "x + P @ H.T @ v"),
    ),
    Slip(
        "S-not-inverted",
        "The gain is multiplied by S where it should be divided by it.",
        (K, "K = P @ H.T @ S"),
    ),
    Slip("R-forgotten", "S lacks R: the sight was taken for exact.", (S, "S = H @ P @ H.T")),
    Slip(
        "R-only",
        "S is R alone. The pose errs as well, and its error is in the innovation.",
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
        "P-by-its-diagonal",
        "Only the variances of P were used. What x, y and θ share in their errors stands beside the "
        "diagonal.",
        (H, H + "\n    P = np.diag(np.diag(P))"),
        (S, "S = H @ np.diag(np.diag(P)) @ H.T + R"),
    ),
    Slip(
        "standard-deviation",
        "R holds variances already: look where you take a root or a square of it.",
        (S, "S = H @ P @ H.T + np.sqrt(np.abs(R))"),
        (S, "S = H @ P @ H.T + R @ R"),
        (S, "S = H @ P @ H.T + R**2"),
    ),
    Slip(
        "H-wrong",
        "H is not that of the pose before the sight: it says how range and bearing change with x, y and θ "
        "(in this order) of the belief you were given.",
        (H, "H = np.column_stack([H_landmark(x, p), [0, 0]])"),
        (H, "H = np.column_stack([H_landmark(x, p), [0, -1]])"),
        (H, "H = H_robot(x, g(x, z))"),
        (H, "H = H_robot(np.zeros(3), p)"),
    ),
    Slip(
        "heading-column",
        "H's column of θ is not right: turning left by a degree moves what is seen a degree to the right, "
        "and changes no range.",
        (H, H + "\n    H[:, 2] = 0"),
        (H, H + "\n    H[1, 2] = 1"),
    ),
    Slip(
        "P-stays",
        "P comes back as it went in: who has seen something is less unsure.",
        (P_AFTER, "P.copy()"),
    ),
    Slip(
        "P-grows",
        "P grew: seeing something makes nobody less sure. Look at the sign of K S Kᵀ.",
        (P_AFTER, "P + K @ S @ K.T"),
    ),
    Slip(
        "S-inverted",
        "Not S⁻¹ stands between K and Kᵀ, but S: look at the units of K S Kᵀ.",
        (P_AFTER, "P - K @ np.linalg.inv(S) @ K.T"),
        (P_AFTER, "P - K @ K.T"),
    ),
    Slip(
        "R-between-the-gains",
        "P shrinks by K R Kᵀ instead of K S Kᵀ: the whole innovation's covariance counts.",
        (P_AFTER, "P - K @ R @ K.T"),
    ),
    Slip(
        "P-missing",
        "Something of P is missing: I − K H says how much of the old error is left, and has still to be "
        "multiplied by P.",
        (P_AFTER, "P - K @ H"),
        (P_AFTER, "np.eye(3) - K @ H"),
    ),
    Slip(
        "half-of-joseph",
        "(I − K H) P (I − K H)ᵀ alone leaves out the sight's own noise: Joseph's form adds a term of R.",
        (P_AFTER, "(np.eye(3) - K @ H) @ P @ (np.eye(3) - K @ H).T"),
        Edit("Joseph's form", ((" + K @ R @ K.T", " + K @ R @ R @ K.T"),)),
    ),
    Slip(
        "H-after-the-update",
        "P was made with H at the new pose: the gain that moved x belongs to H at the old one, and so does "
        "the covariance.",
        (OUT, f"x = {X}\n    return x, P - K @ H_robot(x, p) @ P"),
        (OUT, f"x = {X}\n    H = H_robot(x, p)\n    S = H @ P @ H.T + R\n    return x, {P_AFTER}"),
    ),
    Slip(
        "repeated",
        "The same sight was used twice. Once used, it is part of the belief, and cannot be new again.",
        (OUT, f"x, P = {X}, {P_AFTER}\n    " + "\n    ".join([V, WRAP, H, S, K, OUT])),
    ),
    Slip(
        "refused",
        "Sights that contradict the belief were not used. Here each one is to be believed, as far as R says.",
        (OUT, "if abs(v[0]) > 1:\n        return x.copy(), P.copy()\n    " + OUT),
        (OUT, "if abs(v[1]) > 1:\n        return x.copy(), P.copy()\n    " + OUT),
    ),
    Slip(
        "R-for-S",
        "The gain is divided by R alone. An innovation scatters by the sensor's noise and by the doubt of "
        "the pose: that is S.",
        (K, "K = P @ H.T @ np.linalg.inv(R)"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (OUT, "return None"),
        (OUT, "return x"),
        (OUT, "return (x + K @ v)[None], P"),
        (OUT, "return (x + K @ v) * np.nan, P"),
        (OUT, "return P - K @ S @ K.T, x + K @ v"),
    ),
    Stumble(
        "raised",
        (OUT, "return undefined"),
        (P_AFTER, "P - K @ S @ K"),
        (H, "H = H_robot(x, p).T"),
        (H, "H = H_landmark(x, p)"),
    ),
    Stumble("not attempted", "def locate(x, P, z, p, R):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
