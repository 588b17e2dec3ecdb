"""Programs of task 07-two-updates."""

from course.tasks import Edit, Slip, Stumble

TASK = "07-two-updates"

WAYS = {
    "information": """
def two_updates(P, H_1, H_2, R):
    I = np.linalg.inv(P)
    W = np.linalg.inv(R)
    first = I + H_1.T @ W @ H_1
    return np.linalg.inv(first), np.linalg.inv(first + H_2.T @ W @ H_2)
""",
    "one number after the other": """
def two_updates(P, H_1, H_2, R):
    P = P.copy()
    L = np.linalg.cholesky(R)
    out = []
    for H in (H_1, H_2):
        for row in np.linalg.solve(L, H):
            PH = P @ row
            P -= np.outer(PH, PH) / (row @ PH + 1)
        out.append(P.copy())
    return out
""",
    "block by block": """
def two_updates(P, H_1, H_2, R):
    P = [[P[a, b] for b in SLICES] for a in SLICES]
    first = seen(P, H_1[:, :3], H_1[:, 3:5], 1, R)
    both = seen(first, H_2[:, :3], H_2[:, 5:], 2, R)
    return np.block(first), np.block(both)

SLICES = slice(0, 3), slice(3, 5), slice(5, 7)

def seen(P, H_r, H_p, k, R):
    S = H_r @ P[0][0] @ H_r.T + H_r @ P[0][k] @ H_p.T + H_p @ P[k][0] @ H_r.T
    S = S + H_p @ P[k][k] @ H_p.T + R
    W = [(P[i][0] @ H_r.T + P[i][k] @ H_p.T) @ np.linalg.inv(S) for i in range(3)]
    return [[P[i][j] - W[i] @ S @ W[j].T for j in range(3)] for i in range(3)]
""",
    "joseph": """
def two_updates(P, H_1, H_2, R):
    found = []
    for H in (H_1, H_2):
        S = H @ P @ H.T + R
        K = np.linalg.solve(S.T, H @ P).T
        L = np.eye(len(P)) - K @ H
        P = L @ P @ L.T + K @ R @ K.T
        found.append(P)
    return found[0], found[1]
""",
    "short": """
def two_updates(P, H_1, H_2, R):
    K = P @ H_1.T @ np.linalg.inv(H_1 @ P @ H_1.T + R)
    P_first = (np.eye(7) - K @ H_1) @ P
    K = P_first @ H_2.T @ np.linalg.inv(H_2 @ P_first @ H_2.T + R)
    P_both = P_first - K @ H_2 @ P_first
    return P_first.tolist(), P_both.tolist()
""",
    "both at once": """
def two_updates(P, H_1, H_2, R):
    H = np.vstack([H_1, H_2])
    noise = np.kron(np.eye(2), R)
    P_first = P - P @ H_1.T @ np.linalg.solve(H_1 @ P @ H_1.T + R, H_1 @ P)
    return P_first, P - P @ H.T @ np.linalg.solve(H @ P @ H.T + noise, H @ P)
""",
}

_UPDATE = """
def two_updates(P, H_1, H_2, R):
    def unlinked(P, robot):
        P = P.copy()
        P[3:5, 5:] = P[5:, 3:5] = 0
        if robot:
            P[:3, 3:] = P[3:, :3] = 0
        return P

    def update(P, H, unseen):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        new = P - K @ S @ K.T
        {kept}
        return new

    P_first = {first}
    P_both = {both}
    return P_first, P_both
"""


def _linked(
    kept="pass", first="update(P, H_1, slice(5, 7))", both="update(P_first, H_2, slice(3, 5))"
):
    return _UPDATE.format(kept=kept, first=first, both=both)


_K, _P, _S = "P @ H.T @ np.linalg.inv(S)", "P - K @ S @ K.T", "H @ P @ H.T + R"
_BOTH, _FIRST_S = "update(P_first, H_2)", "np.linalg.inv(H_1 @ P @ H_1.T + R)"
_OWN_BLOCKS = (
    "H[:, :3] @ P[:3, :3] @ H[:, :3].T + H[:, 3:5] @ P[3:5, 3:5] @ H[:, 3:5].T"
    " + H[:, 5:] @ P[5:, 5:] @ H[:, 5:].T + R"
)

SLIPS = (
    Slip(
        "overwritten",
        "P_first was overwritten: it equals P_both. P -= … changes the array itself, and P_first "
        "is that array. Make a new array, or keep a copy.",
        ("return P - K @ S @ K.T", "P -= K @ S @ K.T\n        return P"),
        ("return P_first, P_both", "return P_both, P_both"),
    ),
    Slip(
        "gain-without-S",
        "The gain lacks S⁻¹, as in (4.19) of the thesis. P Hᵀ alone says how state and innovation "
        "err together; only when divided by how far the innovation errs is it a gain.",
        (_K, "P @ H.T"),
        [(_K, "P @ H.T"), (_P, "P - K @ H @ P")],
    ),
    Slip(
        "inverse-in-the-sandwich",
        "This is P − K S⁻¹ Kᵀ, as in (4.22) of the thesis. K and Kᵀ hold an S⁻¹ each already: what "
        "belongs between them?",
        (_P, "P - K @ np.linalg.inv(S) @ K.T"),
    ),
    Slip(
        "sandwich-empty",
        "This is P − K Kᵀ: between the two gains something is missing. Compare the units of K Kᵀ "
        "with those of P.",
        (_P, "P - K @ K.T"),
    ),
    Slip(
        "gain-by-S",
        "The gain is multiplied by S where it should be divided by it: the less sure the "
        "innovation, the less it should say.",
        (_K, "P @ H.T @ S"),
    ),
    Slip(
        "noise-forgotten",
        "S holds no R: these observations would have no noise. The innovation is unsure of both, "
        "the state and what was seen of it.",
        (_S, "H @ P @ H.T"),
        [(_S, "H @ P @ H.T"), (_P, "P - K @ H @ P")],
    ),
    Slip(
        "noise-squared",
        "R holds variances already, and you square it or take its root.",
        (_S, "H @ P @ H.T + R @ R"),
        [(_S, "H @ P @ H.T + R @ R"), (_P, "P - K @ H @ P")],
        (_S, "H @ P @ H.T + R**2"),
        (_S, "H @ P @ H.T + np.sqrt(np.abs(R))"),
    ),
    Slip(
        "noise-twice",
        "R is counted twice in S. Each sight has the noise R once.",
        (_S, "H @ P @ H.T + 2 * R"),
        [(_S, "H @ P @ H.T + 2 * R"), (_P, "P - K @ H @ P")],
    ),
    Slip(
        "noise-of-variances-only",
        "Only the diagonal of R was used. The two numbers of a sight may err together as well.",
        (_S, "H @ P @ H.T + np.diag(np.diag(R))"),
    ),
    Slip(
        "shares-ignored-in-S",
        "S leaves out what robot and landmark share. As long as P_rp = 0 this goes unnoticed; "
        "the whole H with the whole P is always right.",
        (_S, _OWN_BLOCKS),
        [(_S, _OWN_BLOCKS), (_P, "P - K @ H @ P")],
    ),
    Slip(
        "added",
        "What is learned was added to P. To see something makes more certain, so P gets smaller.",
        (_P, "P + K @ S @ K.T"),
    ),
    Slip(
        "correction-only",
        "This is only what was learned, K S Kᵀ: it has to be taken off from P.",
        (_P, "K @ S @ K.T"),
    ),
    Slip(
        "half",
        "Only half of what was learned was taken off: this would be one step of many towards the "
        "best estimate.",
        (_P, "P - K @ S @ K.T / 2"),
        (_P, "P - 0.5 * K @ S @ K.T"),
    ),
    Slip(
        "gain-halved",
        "The gain is half of the best one.",
        (_K, "P @ H.T @ np.linalg.inv(S) / 2"),
    ),
    Slip(
        "joseph-without-noise",
        "(I − K H) P (I − K H)ᵀ is only one part of Joseph's form: the noise that the gain lets in "
        "is missing.",
        Edit("joseph", ((" + K @ R @ K.T", ""),)),
    ),
    Slip(
        "joseph-one-sided",
        "Joseph's form with the factor on the left only and the noise added as well: the noise is "
        "counted although nothing was squared.",
        Edit("joseph", (("L @ P @ L.T", "L @ P"),)),
    ),
    Slip(
        "unlinked",
        "Cross blocks are zero that should not be. Both landmarks were seen from the same unsure "
        "robot: where it errs, both err with it. This is what the thesis' example is about.",
        _linked(
            first="unlinked(update(P, H_1, 0), False)",
            both="unlinked(update(P_first, H_2, 0), False)",
        ),
        _linked(
            first="unlinked(update(P, H_1, 0), True)",
            both="unlinked(update(P_first, H_2, 0), True)",
        ),
        _linked(both="unlinked(update(P_first, H_2, 0), False)"),
        _linked(both="unlinked(update(P_first, H_2, 0), True)"),
        _linked(both="update(unlinked(P_first, True), H_2, 0)"),
        _linked(first="update(unlinked(P, True), H_1, 0)"),
    ),
    Slip(
        "unseen-untouched",
        "The landmark that is not seen was left as it was. It shares an error with the robot, so "
        "what is learned of the robot is learned of it: K has rows for all of the state.",
        _linked(kept="new[unseen], new[:, unseen] = P[unseen], P[:, unseen]"),
        _linked(kept="new[unseen, unseen] = P[unseen, unseen]"),
    ),
    Slip(
        "covariance-before-the-first",
        "The second update works with the covariance from before the first one, as (4.37) of the "
        "thesis does for P_12. The second sight meets a robot that has seen p1: this concerns S "
        "and K as well.",
        (_BOTH, "update(P, H_2)"),
        (_BOTH, "P_first - (P - update(P, H_2))"),
        (_BOTH, "P_first - P @ H_2.T @ np.linalg.inv(H_2 @ P @ H_2.T + R) @ H_2 @ P_first"),
    ),
    Slip(
        "S-of-the-first",
        "The second update divides by the first one's S. The second sight has an H of its own.",
        (_BOTH, f"P_first - P_first @ H_2.T @ {_FIRST_S} @ H_2 @ P_first"),
        (_BOTH, f"P_first - P_first @ H_1.T @ {_FIRST_S} @ H_1 @ P_first"),
    ),
    Slip(
        "S-after-the-update",
        "S was made from the covariance after the update, as the thesis prints it for S(2|1): but "
        "that covariance is made from S.",
        (_P, "P - K @ (H @ (P - K @ S @ K.T) @ H.T + R) @ K.T"),
    ),
    Slip(
        "one-landmark-twice",
        "The second update uses H_1 again: p1 was seen twice, p2 never.",
        (_BOTH, "update(P_first, H_1)"),
    ),
    Slip(
        "second-first",
        "P_first is the covariance after seeing p2. The order does not matter for P_both, but "
        "P_first is asked for after p1.",
        [("update(P, H_1)", "update(P, H_2)"), (_BOTH, "update(P_first, H_1)")],
    ),
    Slip(
        "swapped-returns",
        "The two covariances are returned in the other order: first the one after p1 alone.",
        ("return P_first, P_both", "return P_both, P_first"),
    ),
    Slip(
        "gain-turned",
        "The matrix with which H meets P is turned the wrong way: K has a row for each entry of "
        "the state and a column for each number that was seen.",
        (_P, "P - (H.T @ np.linalg.inv(S) @ H)"),
        (_P, "P - H.T @ S @ H"),
    ),
    Slip(
        "nothing-learned",
        "P comes back as it was in one of the two places: nothing was learned there.",
        ("P_first = update(P, H_1)", "P_first = P"),
        (_BOTH, "P_first"),
        before=("overwritten",),
    ),
)

STUMBLES = (
    Stumble("raised", (_P, "P - K @ np.linalg.inv(S) @ K"), (_K, "H.T @ P @ np.linalg.inv(S)")),
    Stumble(
        "malformed",
        ("return P_first, P_both", "return P_both"),
        ("return P_first, P_both", "return P_first[:3, :3], P_both[:3, :3]"),
        ("return P_first, P_both", "return P_first, P_both * np.nan"),
        ("return P_first, P_both", "pass"),
    ),
)
