"""Programs of task 07-fuse."""

from course.tasks import Edit, Slip, Stumble

TASK = "07-fuse"

WAYS = {
    "least squares": """
def fuse(a, P_a, b, P_b, P_ab):
    J = np.vstack([np.eye(2), np.eye(2)])
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    P = np.linalg.inv(J.T @ W @ J)
    return P @ J.T @ W @ np.concatenate([a, b]), P
""",
    "from b": """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = np.linalg.solve(S.T, (P_b - P_ab.T).T).T
    b = b + K @ (a - b)
    return [b.tolist(), (P_b - K @ (P_b - P_ab)).tolist()]
""",
    "mixed terms": """
def fuse(a, P_a, b, P_b, P_ab):
    K = np.linalg.lstsq(P_a + P_b - P_ab - P_ab.T, P_a - P_ab.T, rcond=None)[0].T
    L = np.eye(2) - K
    P = L @ P_a @ L.T + K @ P_b @ K.T + L @ P_ab @ K.T + K @ P_ab.T @ L.T
    return L @ a + K @ b, P
""",
    "two sights of one state": """
def fuse(a, P_a, b, P_b, P_ab):
    P = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    H = np.hstack([np.eye(2), -np.eye(2)])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    x = np.concatenate([a, b]) - K @ (a - b)
    return x[:2], (P - K @ H @ P)[:2, :2]
""",
    "b without its share": """
def fuse(a, P_a, b, P_b, P_ab):
    # what b says beyond a: its error less what follows that of a
    F = P_ab.T @ np.linalg.inv(P_a)
    H, news, R = np.eye(2) - F, b - F @ a, P_b - F @ P_ab
    P = np.linalg.inv(np.linalg.inv(P_a) + H.T @ np.linalg.inv(R) @ H)
    return a + P @ H.T @ np.linalg.inv(R) @ (news - H @ a), P
""",
}

_S, _C = "P_a + P_b - P_ab - P_ab.T", "(P_a - P_ab)"
_x, _P = "a + K @ (b - a)", "P_a - K @ S @ K.T"
_PAIR = "return a + K @ (b - a), P_a - K @ S @ K.T"
_CI = """
def fuse(a, P_a, b, P_b, P_ab):
    I_a, I_b = np.linalg.inv(P_a), np.linalg.inv(P_b)
    shares = {shares}
    found = [np.linalg.inv(w * I_a + (1 - w) * I_b) for w in shares]
    k = int(np.argmin([np.trace(P) for P in found]))
    w, P = shares[k], found[k]
    return P @ (w * I_a @ a + (1 - w) * I_b @ b), P
"""

SLIPS = (
    Slip(
        "P-of-one",
        "x is right, but P is that of one of the two estimates. Both together are surer than either.",
        (_PAIR, "return a + K @ (b - a), P_a"),
        (_PAIR, "return a + K @ (b - a), P_b"),
        (_PAIR, "return a + K @ (b - a), min(P_a, P_b, key=np.trace)"),
    ),
    Slip(
        "correlations-ignored",
        "a and b were fused as if independent: P_ab is not in it. What both err by together "
        "cannot be averaged away; this P claims that it was.",
        [(_S, "P_a + P_b"), (_C, "P_a")],
    ),
    Slip(
        "gain-of-strangers",
        "The gain leaves P_ab out, and only the covariance knows of it. This P is what such a mean has, "
        "but another gain leaves less.",
        """
def fuse(a, P_a, b, P_b, P_ab):
    K = P_a @ np.linalg.inv(P_a + P_b)
    L = np.eye(2) - K
    shared = L @ P_ab @ K.T
    return a + K @ (b - a), L @ P_a @ L.T + K @ P_b @ K.T + shared + shared.T
""",
    ),
    Slip(
        "common-part-taken-off",
        "What both share was taken off, the rests were fused as if independent, and it was put back. That "
        "is right only where both err by one common error *and* something of their own. P_ab may be any "
        "matrix: P_a − P_ab need not be a covariance.",
        *(
            f"""
def fuse(a, P_a, b, P_b, P_ab):
    common = {common}
    own_a, own_b = P_a - common, P_b - common
    K = own_a @ np.linalg.inv(own_a + own_b)
    return a + K @ (b - a), own_a - K @ own_a + common
"""
            for common in ("P_ab", "(P_ab + P_ab.T) / 2")
        ),
    ),
    Slip(
        "one-of-the-two",
        "This is one of the two estimates, the other is thrown away. Even the worse one knows "
        "something.",
        (_PAIR, "return a, P_a - K @ S @ K.T"),
        (_PAIR, "return b, P_a - K @ S @ K.T"),
        (_PAIR, "return (a, P_a) if np.trace(P_a) < np.trace(P_b) else (b, P_b)"),
    ),
    Slip(
        "covariance-intersection",
        "This P lies between P_a and P_b, as covariance intersection puts it: the way out when "
        "P_ab is unknown. You have P_ab, and it makes surer.",
        _CI.format(shares="[0.5]"),
        _CI.format(shares="np.linspace(0.01, 0.99, 25)"),
    ),
    Slip(
        "averaged",
        "This is the mean of a and b. The better one deserves more weight, and how much, K tells.",
        (_PAIR, "return (a + b) / 2, (P_a + P_b + P_ab + P_ab.T) / 4"),
        (_PAIR, "return (a + b) / 2, (P_a + P_b) / 4"),
        (_PAIR, "return (a + b) / 2, P_a - K @ S @ K.T"),
    ),
    Slip(
        "one-weight-for-x-and-y",
        "The weight of b is a single number. Errors of x and y differ in size and are correlated, so K has "
        "to be a matrix.",
        *(
            f"""
def fuse(a, P_a, b, P_b, P_ab):
    w = {weight}
    P = (1 - w) ** 2 * P_a + w**2 * P_b + w * (1 - w) * (P_ab + P_ab.T)
    return a + w * (b - a), P
"""
            for weight in (
                "np.trace(P_a - P_ab) / np.trace(P_a + P_b - 2 * P_ab)",
                "np.trace(P_a) / np.trace(P_a + P_b)",
                "np.linalg.det(P_a) / (np.linalg.det(P_a) + np.linalg.det(P_b))",
            )
        ),
    ),
    Slip(
        "weights-swapped",
        "a and b have changed places in x. Test it: if P_a is tiny, x must be close to a.",
        (_x, "b + K @ (a - b)"),
    ),
    Slip(
        "gain-sign",
        "x is led away from b: the sign of S_xv. Errors are truth less estimate, so the innovation "
        "b − a errs by ã − b̃, and E[ã (ã − b̃)ᵀ] begins with + P_a.",
        (_C, "(P_ab - P_a)"),
        (_x, "a - K @ (b - a)"),
        (_x, "a + K @ (a - b)"),
    ),
    Slip(
        "added",
        "What b teaches was added to P_a. To learn makes more certain, so P is smaller than P_a.",
        (_P, "P_a + K @ S @ K.T"),
    ),
    Slip(
        "plus-for-minus",
        "The sign of P_ab: the more a and b share, the less they differ. Write out the square of "
        "ã − b̃.",
        [(_S, "P_a + P_b + P_ab + P_ab.T"), (_C, "(P_a + P_ab)")],
        (_S, "P_a + P_b + P_ab + P_ab.T"),
        (_C, "(P_a + P_ab)"),
    ),
    Slip(
        "transpose-missing",
        "P_ab is turned the wrong way somewhere. E[b̃ ãᵀ] is P_abᵀ: a square of ã − b̃ has both in "
        "it, while S_xv has only one of them. Which?",
        (_S, "P_a + P_b - 2 * P_ab"),
        (_S, "P_a + P_b - 2 * P_ab.T"),
        (_C, "(P_a - P_ab.T)"),
        [(_C, "(P_a - P_ab.T)"), (_S, "P_a + P_b - 2 * P_ab")],
    ),
    Slip(
        "cross-in-one-place",
        "P_ab is missing in one place. It belongs into the innovation's covariance, twice, and into "
        "what the error of a shares with the innovation.",
        (_S, "P_a + P_b"),
        (_C, "P_a"),
        (_S, "P_a + P_b - P_ab"),
        (_S, "P_a + P_b - P_ab.T"),
    ),
    Slip(
        "standard-formula",
        "x is the best there is, P is not its covariance. P − K H P holds where the noise of what "
        "is seen is independent of the state; here b errs together with a.",
        (_P, "P_a - K @ P_a"),
        (_P, "(np.eye(2) - K) @ P_a"),
    ),
    Slip(
        "honest-but-for-the-share",
        "x is the best there is, P forgets P_ab: (I − K) P_a (I − K)ᵀ + K P_b Kᵀ lacks the two "
        "mixed terms.",
        Edit("mixed terms", ((" + L @ P_ab @ K.T + K @ P_ab.T @ L.T", ""),)),
    ),
    Slip(
        "one-mixed-term",
        "The square of a sum has two mixed terms, each the transpose of the other. One of them is "
        "missing here.",
        Edit("mixed terms", ((" + K @ P_ab.T @ L.T", ""),)),
        Edit("mixed terms", ((" + L @ P_ab @ K.T", ""),)),
    ),
    Slip(
        "gain-without-S",
        "The gain lacks S⁻¹: how a and the innovation err together has to be divided by how far the "
        "innovation errs.",
        (" @ np.linalg.inv(S)", ""),
    ),
    Slip(
        "gain-by-S",
        "The gain is multiplied by S where it should be divided by it.",
        ("np.linalg.inv(S)", "S"),
    ),
    Slip(
        "gain-other-side",
        "S⁻¹ stands on the wrong side of S_xv: matrices do not commute, and a row of K belongs to "
        "an entry of a.",
        ("(P_a - P_ab) @ np.linalg.inv(S)", "np.linalg.inv(S) @ (P_a - P_ab)"),
    ),
    Slip(
        "inverse-in-the-sandwich",
        "K and Kᵀ hold an S⁻¹ each already: between them S stands, not its inverse.",
        (_P, "P_a - K @ np.linalg.inv(S) @ K.T"),
    ),
    Slip(
        "sandwich-empty",
        "Between K and Kᵀ something is missing: compare the units of K Kᵀ with those of P.",
        (_P, "P_a - K @ K.T"),
    ),
    Slip(
        "half",
        "Only half of the way was gone, or half of what is learned was taken off.",
        (_x, "a + K @ (b - a) / 2"),
        (_P, "P_a - K @ S @ K.T / 2"),
        [(_x, "a + K @ (b - a) / 2"), (_P, "P_a - K @ S @ K.T / 2")],
    ),
    Slip(
        "twice",
        "The correction is made twice over: b is overshot.",
        (_x, "a + 2 * K @ (b - a)"),
    ),
    Slip(
        "correction-only",
        "This is only the correction, K (b − a): it has to be added to a.",
        (_x, "K @ (b - a)"),
    ),
    Slip(
        "standard-deviations",
        "These are the roots of what P should hold: a covariance has variances on its diagonal.",
        (_P, "np.sqrt(np.abs(P_a - K @ S @ K.T))"),
    ),
    Slip(
        "from-b-mixed",
        "K is the share of b − a that is to be added to a, and P_a the covariance that it lowers. "
        "Here one of them starts from b.",
        (_P, "P_b - K @ S @ K.T"),
        (_x, "b + K @ (b - a)"),
    ),
    Slip(
        "variances-only",
        "Only the diagonals were used: x and y err together as well, and what b says of x can "
        "teach something about y.",
        [
            (_S, "np.diag(np.diag(P_a + P_b - P_ab - P_ab.T))"),
            (_C, "np.diag(np.diag(P_a - P_ab))"),
        ],
        (_P, "np.diag(np.diag(P_a - K @ S @ K.T))"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (_PAIR, "return a + K @ (b - a)"),
        (_PAIR, "return (a + K @ (b - a))[None], P_a - K @ S @ K.T"),
        (_PAIR, "return a + K @ (b - a), np.diag(P_a - K @ S @ K.T)"),
        (_PAIR, "return (a + K @ (b - a)) * np.nan, P_a"),
        (_PAIR, "return None, P_a"),
    ),
)
