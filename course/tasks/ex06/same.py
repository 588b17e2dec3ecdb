"""Right ways and slips of 06-same."""

from course.tasks import Slip, Stumble

TASK = "06-same"

WAYS = {
    "least squares over fewer unknowns": """
def merge(x, P, i, j):
    n = len(x)
    M = np.eye(n)
    M[3 + 2 * j : 5 + 2 * j] = M[3 + 2 * i : 5 + 2 * i]
    M = np.delete(M, [3 + 2 * j, 4 + 2 * j], axis=1)
    W = np.linalg.inv(P)
    small = np.linalg.inv(M.T @ W @ M)
    return small @ M.T @ W @ x, small
""",
    "j stays, and takes the place of i": """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    B = P[:, a] - P[:, b]
    S = B[a] - B[b]
    K = np.linalg.solve(S, B.T).T
    x, P = x + K @ (x[b] - x[a]), P - K @ B.T
    order = [k for k in range(len(x)) if k not in (3 + 2 * i, 4 + 2 * i)]
    at = order.index(3 + 2 * j)
    both = order[at : at + 2]
    rest = order[:at] + order[at + 2 :]
    to = 3 + 2 * (i - (j < i))
    order = rest[:to] + both + rest[to:]
    return x[order], P[np.ix_(order, order)]
""",
    "one coordinate after the other": """
def merge(x, P, i, j):
    x, P = x.copy(), P.copy()
    for k in range(2):
        d = np.zeros(len(x))
        d[3 + 2 * i + k], d[3 + 2 * j + k] = 1, -1
        gain = P @ d / (d @ P @ d)
        x = x - gain * (d @ x)
        P = P - np.outer(gain, d @ P)
    keep = np.ones(len(x), dtype=bool)
    keep[3 + 2 * j : 5 + 2 * j] = False
    return x[keep], P[keep][:, keep]
""",
    "Joseph's form": """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    for k in range(2):
        D[k, 3 + 2 * j + k], D[k, 3 + 2 * i + k] = 1, -1
    K = P @ D.T @ np.linalg.inv(D @ P @ D.T)
    I_KD = np.eye(len(x)) - K @ D
    gone = np.s_[3 + 2 * j : 5 + 2 * j]
    new = I_KD @ P @ I_KD.T
    return np.delete(I_KD @ x, gone), np.delete(np.delete(new, gone, 0), gone, 1)
""",
}

S = "S = D @ P @ D.T"
OF_I, OF_J = "D[:, 3 + 2 * i : 5 + 2 * i]", "D[:, 3 + 2 * j : 5 + 2 * j]"
GONE = "gone = [3 + 2 * j, 4 + 2 * j]"
STEP = "x, P = x - K @ D @ x, P - K @ S @ K.T"

SLIPS = (
    Slip(
        "only-removed",
        "Landmark j was crossed out and nothing was learned: that two landmarks stand in one place "
        "tells something of both, of the robot, and of all that is related to them.",
        (STEP, "pass"),
    ),
    Slip(
        "mean-of-both",
        "The post was put in the middle. The surer of the two must count for more, and what their errors "
        "share decides as well: let the gain say where it stands.",
        (
            STEP,
            "x = x.copy()\n    x[3 + 2 * i : 5 + 2 * i] = (x[3 + 2 * i : 5 + 2 * i] + x[3 + 2 * j : 5 + 2 * j]) / 2",
        ),
        (
            STEP,
            "x, P = x.copy(), P - K @ S @ K.T\n"
            "    x[3 + 2 * i : 5 + 2 * i] = (x[3 + 2 * i : 5 + 2 * i] + x[3 + 2 * j : 5 + 2 * j]) / 2",
        ),
    ),
    Slip(
        "weighed-apart",
        "The two were averaged by their own covariances, as if their errors shared nothing. In a map "
        "built by one robot they share much.",
        """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    Wa, Wb = np.linalg.inv(P[a, a]), np.linalg.inv(P[b, b])
    x, P = x.copy(), P.copy()
    P[a, a] = np.linalg.inv(Wa + Wb)
    x[a] = P[a, a] @ (Wa @ x[a] + Wb @ x[b])
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    ),
    Slip(
        "sign",
        "The state moves away from what was told: the difference of the two places is 0, so that the "
        "innovation is 0 minus the difference that was believed.",
        ("x - K @ D @ x", "x + K @ D @ x"),
    ),
    Slip(
        "sum-for-difference",
        "It is the difference of the two places that is zero, not their sum: the two blocks of H have "
        "opposite signs.",
        ("= -np.eye(2)", "= np.eye(2)"),
    ),
    Slip(
        "one-landmark-in-D",
        "H looks at one landmark only: that would say that it stands at the origin.",
        ("D[:, 3 + 2 * j : 5 + 2 * j] = -np.eye(2)", "pass"),
        ("D[:, 3 + 2 * i : 5 + 2 * i] = np.eye(2)", "pass"),
    ),
    Slip(
        "noise-added",
        "Something was added to S. What was told does not err at all: its R is zero.",
        (S, "S = D @ P @ D.T + np.eye(2)"),
        (S, "S = D @ P @ D.T + 0.01 * np.eye(2)"),
        (S, "S = D @ P @ D.T + 0.001 * np.eye(2)"),
    ),
    Slip(
        "cross-ignored",
        "S was made of the two landmarks' own blocks. What their errors share is no part of their "
        "difference: P_ij counts, twice.",
        (
            S,
            "S = P[3 + 2 * i : 5 + 2 * i, 3 + 2 * i : 5 + 2 * i] + P[3 + 2 * j : 5 + 2 * j, 3 + 2 * j : 5 + 2 * j]",
        ),
    ),
    Slip(
        "only-the-pair",
        "Robot and the other landmarks stayed where they were, or as unsure as they were. Whoever shares "
        "an error with one of the two learns as well.",
        (STEP, "K = K * (np.abs(D).sum(axis=0) > 0)[:, None]\n    " + STEP),
        (STEP, "old = x.copy()\n    " + STEP + "\n    x[:3] = old[:3]"),
    ),
    Slip(
        "P-stays",
        "P lost two rows and columns and is else as it was: being told something makes surer.",
        (STEP, "x = x - K @ D @ x"),
    ),
    Slip(
        "x-stays",
        "x lost two numbers and is else as it was: the two stood apart, and now stand in one place.",
        (STEP, "P = P - K @ S @ K.T"),
    ),
    Slip(
        "P-grows",
        "P grew: being told something makes nobody less sure.",
        ("P - K @ S @ K.T", "P + K @ S @ K.T"),
    ),
    Slip(
        "S-missing",
        "The gain lacks S⁻¹, or is multiplied by S: what is told exactly must be obeyed exactly, so that "
        "both stand in one place afterwards.",
        ("np.linalg.inv(S)", "S"),
        ("@ np.linalg.inv(S)", ""),
    ),
    Slip(
        "other-order",
        "The landmarks' order is not that of the text: j leaves, those behind it move up, and i keeps "
        "its place among the rest.",
        (GONE, "gone = [3 + 2 * i, 4 + 2 * i]"),
        (
            GONE,
            "i, j = min(i, j), max(i, j)\n    gone = [3 + 2 * j, 4 + 2 * j]",
        ),
        (GONE, "gone = [len(x) - 2, len(x) - 1]"),
    ),
    Slip(
        "counted-from-the-start",
        "The landmark's columns begin elsewhere: the robot takes the first three, and landmarks are "
        "counted from 0.",
        (GONE, "gone = [2 * j, 1 + 2 * j]"),
        (GONE, "gone = [3 + j, 4 + j]"),
        [(OF_I, "D[:, 2 * i : 2 * i + 2]"), (OF_J, "D[:, 2 * j : 2 * j + 2]")],
        *(
            [
                (OF_I, f"D[:, {i} : {i} + 2]"),
                (OF_J, f"D[:, {j} : {j} + 2]"),
                (GONE, f"gone = [{j}, {j} + 1]"),
            ]
            for i, j in (("2 * i", "2 * j"), ("1 + 2 * i", "1 + 2 * j"), ("3 + i", "3 + j"))
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        "def merge(x, P, i, j):\n    return x, P",
        "def merge(x, P, i, j):\n    return np.delete(x, [3 + 2 * j, 4 + 2 * j])",
    ),
)

PASTED = {
    "the lesson's update, the two compared as sights": """
def merge(x, P, i, j):
    a, b = 3 + 2 * i, 3 + 2 * j
    H = np.zeros((2, len(x)))
    H[:, :3], H[:, a : a + 2] = H_robot(x[:3], x[a : a + 2]), H_landmark(x[:3], x[a : a + 2])
    v = h(x[:3], x[b : b + 2]) - h(x[:3], x[a : a + 2])
    S = H @ P @ H.T + 1e-9 * np.eye(2)
    K = P @ H.T @ np.linalg.inv(S)
    x, P = x + K @ v, P - K @ S @ K.T
    gone = [b, b + 1]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    "the lesson's removal of a landmark": """
def merge(x, P, i, j):
    keep = [k for k in range(len(x)) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]
""",
}

EQUIVALENT = {}
