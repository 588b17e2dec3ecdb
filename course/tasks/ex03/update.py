"""Programs of task 03-update."""

from course.tasks import Edit, Slip, Stumble

TASK = "03-update"

WAYS = {
    "anew": """
def update(x, P, z, H, R):
    v = z - H @ x
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    "Joseph": """
def update(x, P, z, H, R):
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    rest = np.eye(len(x)) - K @ H
    return x + K @ (z - H @ x), rest @ P @ rest.T + K @ R @ K.T
""",
    "short": """
def update(x, P, z, H, R):
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return [K @ z + x - K @ H @ x, (np.eye(len(P)) - K @ H) @ P]
""",
    "shared": """
def update(x, P, z, H, R):
    shared = P @ H.T
    K = shared @ np.linalg.inv(H @ shared + R)
    return x - K @ (H @ x - z), P - K @ shared.T
""",
    "information": """
def update(x, P, z, H, R):
    before, weight = np.linalg.inv(P), H.T @ np.linalg.inv(R)
    P = np.linalg.inv(before + weight @ H)
    return P @ (before @ x + weight @ z), P
""",
    "new P as a gain": """
def update(x, P, z, H, R):
    after = P - P @ H.T @ np.linalg.solve(H @ P @ H.T + R, H @ P)
    return x + after @ H.T @ np.linalg.inv(R) @ (z - H @ x), after
""",
    "least squares": """
def update(x, P, z, H, R):
    A, B = np.linalg.inv(np.linalg.cholesky(P)), np.linalg.inv(np.linalg.cholesky(R))
    M = np.vstack([A, B @ H])
    x = np.linalg.lstsq(M, np.concatenate([A @ x, B @ z]), rcond=None)[0]
    return x, np.linalg.inv(M.T @ M)
""",
    "one number after the other": """
def update(x, P, z, H, R):
    white = np.linalg.inv(np.linalg.cholesky(R))
    for row, seen in zip(white @ H, white @ z):
        K = P @ row / (row @ P @ row + 1)
        x, P = x + K * (seen - row @ x), P - np.outer(K, row @ P)
    return tuple(x), P.tolist()
""",
    "on copies": """
def update(x, P, z, H, R):
    x, P = x.copy(), P.copy()
    K = P @ H.T @ np.linalg.pinv(H @ P @ H.T + R)
    x += K @ (z - H @ x)
    P -= K @ H @ P
    return x, (P + P.T) / 2
""",
}


def anew(*pairs):
    """An edit of the update that is written anew."""
    return Edit("anew", pairs)


def _gated(far):
    """The update of those that refuse what is so far off."""
    gate = f"if v @ np.linalg.solve(S, v) {far}:\n        return x, P\n    "
    return "K = gain(P, H, R)", gate + "K = gain(P, H, R)"


SLIPS = (
    Slip(
        "x-lost",
        "x itself is missing: K v is the correction alone. The new estimate is the old one plus the "
        "correction.",
        ("x + K @ v", "K @ v"),
    ),
    Slip(
        "x-unchanged",
        "x has not been corrected. By how much, and in which direction, says K v.",
        ("x + K @ v", "x"),
    ),
    Slip(
        "sign",
        "The correction goes the wrong way: look at the sign of the innovation, measured minus "
        "expected, and at the one before K v.",
        ("x + K @ v", "x - K @ v"),
        anew(("z - H @ x", "H @ x - z")),
    ),
    Slip(
        "absolute",
        "The innovation has lost its sign: too far and too near have to be told apart.",
        ("x + K @ v", "x + K @ abs(v)"),
    ),
    Slip(
        "z-for-v",
        "K is multiplied by the measurement. Only what is new in it, the innovation, corrects.",
        anew(("v = z - H @ x", "v = z")),
    ),
    Slip(
        "half-the-way",
        "x is corrected by half of K v, as if measurement and belief counted the same. K holds the "
        "right share already.",
        ("x + K @ v", "x + K @ v / 2"),
        ("x + K @ v", "x + 0.5 * K @ v"),
    ),
    Slip(
        "twice",
        "The measurement has been taken in twice: it cannot say the same thing a second time.",
        ("x + K @ v", "x + 2 * K @ v"),
        "def update(x, P, z, H, R):\n    for _ in range(2):\n"
        "        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)\n"
        "        x, P = x + K @ (z - H @ x), P - K @ H @ P\n    return x, P",
    ),
    Slip(
        "S-missing",
        "The gain lacks S⁻¹: P Hᵀ alone corrects too much wherever innovations are large anyway.",
        anew((" @ np.linalg.inv(S)", "")),
    ),
    Slip(
        "S-not-inverted",
        "The gain multiplies by S where it has to divide by it.",
        anew(("np.linalg.inv(S)", "S")),
    ),
    Slip(
        "one-over",
        "1 / S and S ** -1 take each entry alone. That is not the inverse of a matrix.",
        anew(("np.linalg.inv(S)", "(1 / S)")),
    ),
    Slip(
        "P-missing-in-K",
        "The gain lacks P: by how much x is to be corrected depends on how wrong it may be.",
        anew(("K = P @ H.T", "K = H.T")),
    ),
    Slip(
        "half-gain",
        "The gain is half of the best one. The short forms of P hold for the best gain only.",
        anew(("np.linalg.inv(S)", "np.linalg.inv(S) / 2")),
    ),
    Slip(
        "R-forgotten",
        "R is missing in S: this update takes the measurement for exact.",
        anew(("S = H @ P @ H.T + R", "S = H @ P @ H.T")),
    ),
    Slip(
        "R-for-S",
        "R stands where S belongs. An innovation scatters by the sensor's noise and by the doubt of "
        "the belief itself.",
        anew(("S = H @ P @ H.T + R", "S = R")),
        anew(("np.linalg.inv(S)", "np.linalg.inv(R)")),
    ),
    Slip(
        "R-deviation",
        "R holds variances already, in squared units. It belongs into S as it is, without a square or "
        "a root.",
        anew(("H.T + R", "H.T + R @ R")),
        anew(("H.T + R", "H.T + R**2")),
        anew(("H.T + R", "H.T + R**0.5")),
    ),
    Slip(
        "R-subtracted",
        "R has the wrong sign in S: covariances of unrelated errors add.",
        anew(("H.T + R", "H.T - R")),
    ),
    Slip(
        "cross-terms",
        "The covariances between the states are gone: only the diagonal of P is used, or told. Through "
        "them a measurement of one state corrects the others.",
        anew(("v = z", "P = np.diag(np.diag(P))\n    v = z")),
        anew(("K = P @", "K = np.diag(np.diag(P)) @")),
        ("P - K @ S @ K.T", "np.diag(np.diag(P - K @ S @ K.T))"),
    ),
    Slip(
        "P-too-early",
        "x was corrected with a gain made of the new P. Gain and innovation belong to the belief "
        "before the measurement: compute both before you change x or P.",
        "def update(x, P, z, H, R):\n    S = H @ P @ H.T + R\n"
        "    P = P - P @ H.T @ np.linalg.inv(S) @ H @ P\n"
        "    return x + P @ H.T @ np.linalg.inv(S) @ (z - H @ x), P",
        "def update(x, P, z, H, R):\n"
        "    P = P - P @ H.T @ np.linalg.inv(H @ P @ H.T + R) @ H @ P\n"
        "    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)\n"
        "    return x + K @ (z - H @ x), P",
    ),
    Slip(
        "P-unchanged",
        "P has not been updated. After a measurement the robot knows more, and P must say so.",
        ("P - K @ S @ K.T", "P"),
    ),
    Slip(
        "P-grew",
        "P has grown. A measurement never makes a belief wider: look at the sign.",
        ("P - K @ S @ K.T", "P + K @ S @ K.T"),
        Edit("short", (("np.eye(len(P)) - K", "np.eye(len(P)) + K"),)),
    ),
    Slip(
        "one-for-identity",
        "The 1 in (1 − K H) P is the identity matrix, np.eye: the number 1 is taken from every entry.",
        Edit("short", (("(np.eye(len(P)) - K", "(1 - K"),)),
    ),
    Slip(
        "P-factor-lost",
        "I − K H is only what is left of P, as a factor. It has to be multiplied by P.",
        Edit("short", (("(np.eye(len(P)) - K @ H) @ P", "np.eye(len(P)) - K @ H"),)),
        ("P - K @ S @ K.T", "P - K @ H"),
    ),
    Slip(
        "P-other-side",
        "I − K H stands on the wrong side of P, or K H is transposed. Look at your P: is it symmetric?",
        Edit("short", (("(np.eye(len(P)) - K @ H) @ P", "P @ (np.eye(len(P)) - K @ H)"),)),
        Edit("short", (("- K @ H) @ P", "- K @ H).T @ P"),)),
    ),
    Slip(
        "S-inverted-in-P",
        "P − K S⁻¹ Kᵀ: S is inverted once too often. Its inverse is in K already; between the gains "
        "stands S itself.",
        ("K @ S @ K.T", "K @ np.linalg.inv(S) @ K.T"),
    ),
    Slip(
        "S-lost-in-P",
        "Between K and Kᵀ something is missing: what was learned is the covariance of K v, and v "
        "has one of its own.",
        ("K @ S @ K.T", "K @ K.T"),
    ),
    Slip(
        "R-in-P",
        "P − K R Kᵀ: what was learned is the share of the whole innovation, not of the noise alone.",
        ("K @ S @ K.T", "K @ R @ K.T"),
    ),
    Slip(
        "noise-lost",
        "Joseph's form has a second square: with the correction the measurement's noise comes into the "
        "estimate.",
        Edit("Joseph", ((" + K @ R @ K.T", ""),)),
    ),
    Slip(
        "noise-subtracted",
        "In Joseph's form both squares are added: the measurement's noise makes nothing surer.",
        Edit("Joseph", (("+ K @ R @ K.T", "- K @ R @ K.T"),)),
    ),
    Slip(
        "rest-once",
        "Joseph's form takes I − K H from the left and its transpose from the right. Here one of the two "
        "is missing, or the transpose is.",
        Edit("Joseph", (("rest @ P @ rest.T", "rest @ P"),)),
        Edit("Joseph", (("rest @ P @ rest.T", "rest @ P @ rest"),)),
        Edit("Joseph", (("rest @ P @ rest.T", "rest.T @ P @ rest"),)),
    ),
    Slip(
        "only-the-learned",
        "This is what was learned, K S Kᵀ. P is the doubt that is left.",
        ("P - K @ S @ K.T", "K @ S @ K.T"),
    ),
    Slip(
        "information-told",
        "This is the inverse of a covariance, the information. It has to be inverted once more.",
        Edit(
            "information",
            (("(before @ x + weight @ z), P", "(before @ x + weight @ z), np.linalg.inv(P)"),),
        ),
    ),
    Slip(
        "belief-lost",
        "Of what is known of x, the half that came with the belief is missing: in the information form "
        "belief and measurement are two terms, each weighted by its own information.",
        Edit("information", (("before @ x + weight @ z", "weight @ z"),)),
        Edit("information", (("before @ x + weight @ z", "x + weight @ z"),)),
    ),
    Slip(
        "refused",
        "Some measurements were refused because they are far off. All are to be taken in here.",
        *(_gated(f"> {most}") for most in ("9", "9 * len(v)", "16", "3.84", "13.8")),
    ),
)

STUMBLES = (
    Stumble(
        "raised",
        ("P - K @ S @ K.T", "P - K @ S @ K"),
        ("x + K @ v", "x + K.T @ v"),
        anew(("z - H @ x", "z - x")),
        anew(("H @ P @ H.T", "H.T @ P @ H")),
    ),
    Stumble(
        "malformed",
        ("x + K @ v, P - K @ S @ K.T", "K, P"),
        ("x + K @ v, P - K @ S @ K.T", "P - K @ S @ K.T, x + K @ v"),
        ("x + K @ v, P - K @ S @ K.T", "x + K @ v"),
        ("x + K @ v, P - K @ S @ K.T", "x + K @ v, np.diag(P - K @ S @ K.T)"),
        ("return x", "x"),
    ),
)

EQUIVALENT = {}
