"""Programs of task 03-gain."""

from course.tasks import Edit, Slip, Stumble

TASK = "03-gain"

WAYS = {
    "inverse": """
def gain(P, H, R):
    return P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
""",
    "solve": """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S, H @ P).T
""",
    "Cholesky": """
def gain(P, H, R):
    S = H @ P @ H.T + R
    L = np.linalg.cholesky(S)
    return np.linalg.solve(L.T, np.linalg.solve(L, H @ P)).T
""",
    "pseudo-inverse": """
def gain(P, H, R):
    shared = np.dot(P, H.T)
    return np.matmul(shared, np.linalg.pinv(np.dot(H, shared) + R)).tolist()
""",
    "information": """
def gain(P, H, R):
    weight = H.T @ np.linalg.inv(R)
    return np.linalg.inv(np.linalg.inv(P) + weight @ H) @ weight
""",
    "matrix power": """
def gain(P, H, R):
    S = R.copy()
    S += H @ P @ H.T
    return P @ H.T @ np.linalg.matrix_power(S, -1)
""",
    "column by column": """
def gain(P, H, R):
    n, m = len(P), len(H)
    shared, S = np.zeros((n, m)), np.zeros((m, m))
    for j in range(m):
        for i in range(n):
            shared[i, j] = sum(P[i, k] * H[j, k] for k in range(n))
    for i in range(m):
        for j in range(m):
            S[i, j] = R[i, j] + sum(H[i, k] * shared[k, j] for k in range(n))
    return np.array([np.linalg.solve(S.T, row) for row in shared])
""",
    "one number after the other": """
def gain(P, H, R):
    white = np.linalg.inv(np.linalg.cholesky(R))
    left, rows, K = P, white @ H, np.zeros((len(P), len(H)))
    for k in range(len(rows)):
        row = rows[k]
        one = left @ row / (row @ left @ row + 1)
        K = K - np.outer(one, row @ K)
        K[:, k] = one
        left = left - np.outer(one, row @ left)
    return K @ white
""",
}

DEVIATION = (
    "R holds variances already, in squared units. It belongs into S as it is, without a square or a "
    "root."
)

SLIPS = (
    Slip(
        "one-number",
        "S is taken for one number, which it is with a single measured number only. With more of them it "
        "is a matrix, and its inverse is needed.",
        """
def gain(P, H, R):
    return P @ H.T / (H @ P @ H.T + R)[0, 0]
""",
    ),
    Slip(
        "S-missing",
        "Nothing is divided by S. P Hᵀ is what error and innovation have in common; how large "
        "innovations are anyway must be divided out. Try the units: what does K make of metres?",
        (" @ np.linalg.inv(S)", ""),
    ),
    Slip(
        "H-undone",
        "You undo H, and so correct only what is measured. P Hᵀ has rows for the rest as well: how much does "
        "its error share with what is measured?",
        ("P @ H.T @", "np.linalg.pinv(H) @ H @ P @ H.T @"),
    ),
    Slip(
        "S-not-inverted",
        "You multiply by S where you have to divide by it: the larger the innovations are anyway, the "
        "less may one of them correct.",
        ("np.linalg.inv(S)", "S"),
    ),
    Slip(
        "one-over",
        "1 / S and S ** -1 take each entry alone. That is not the inverse of a matrix; NumPy has a "
        "function for that.",
        ("np.linalg.inv(S)", "(1 / S)"),
    ),
    Slip(
        "S-from-the-left",
        "The inverse of S stands on the wrong side of H P or P Hᵀ, or K is transposed after all: K is "
        "applied to an innovation, and turns m numbers into n.",
        "def gain(P, H, R):\n    S = H @ P @ H.T + R\n    W = np.linalg.inv(S)\n"
        "    return (W @ W @ H @ P).T",
    ),
    Slip(
        "P-missing",
        "P is missing. By how much the state is to be corrected depends on how wrong it may be.",
        ("return P @ H.T", "return H.T"),
    ),
    Slip(
        "P-missing-in-S",
        "P is missing in S. Innovations scatter because the sensor errs and because the belief does.",
        ("H @ P @ H.T", "H @ H.T"),
    ),
    Slip(
        "R-forgotten",
        "R is missing in S: this gain takes every measurement for exact.",
        ("S = H @ P @ H.T + R", "S = H @ P @ H.T"),
    ),
    Slip(
        "H-inverted",
        "An inverse of H turns a measurement into a state as if there were neither noise nor a belief. "
        "How sure both are must decide.",
        "def gain(P, H, R):\n    return np.linalg.pinv(H)",
        """
def gain(P, H, R):
    W = np.linalg.inv(R)
    return np.linalg.pinv(H.T @ W @ H) @ H.T @ W
""",
    ),
    Slip(
        "R-for-S",
        "R stands where S belongs. An innovation scatters by the sensor's noise and by the doubt of "
        "the belief itself.",
        ("S = H @ P @ H.T + R", "S = R"),
        ("np.linalg.inv(S)", "np.linalg.inv(R)"),
    ),
    Slip(
        "R-deviation",
        DEVIATION,
        ("H.T + R", "H.T + R @ R"),
        ("H.T + R", "H.T + R**2"),
        ("H.T + R", "H.T + np.sqrt(R)"),
    ),
    Slip(
        "R-subtracted",
        "R has the wrong sign in S: covariances of unrelated errors add, whichever sign the errors "
        "have.",
        ("H.T + R", "H.T - R"),
    ),
    Slip(
        "sign",
        "K has the wrong sign. K v is added to x, and an innovation above zero says that x is too "
        "small.",
        ("return P", "return -P"),
    ),
    Slip(
        "half",
        "This is half of the best gain: the mean of belief and measurement, in place of a mean that is "
        "weighted by how sure they are.",
        ("np.linalg.inv(S)", "np.linalg.inv(2 * S)"),
    ),
    Slip(
        "root-of-S",
        "You divide by a root of S. A gain is a covariance divided by a covariance; roots are for "
        "drawing and for numbers of one σ.",
        ("np.linalg.inv(S)", "np.linalg.inv(np.linalg.cholesky(S))"),
    ),
    Slip(
        "cross-terms",
        "The covariances between the states are gone: only the diagonal of P is used. Through them "
        "a measurement of one state corrects the others.",
        [("S = H @ P", "P = np.diag(np.diag(P))\n    S = H @ P")],
        ("return P @", "return np.diag(np.diag(P)) @"),
    ),
    Slip(
        "S-diagonal",
        "Only the diagonal of S, or of R, is used: innovations of several numbers are related, and "
        "what they share may count only once.",
        ("np.linalg.inv(S)", "np.diag(1 / np.diag(S))"),
        ("H.T + R", "H.T + np.diag(np.diag(R))"),
    ),
    Slip(
        "P-afterwards",
        "This gain is made of the P that is left after the measurement, and of S once more: the "
        "measurement would count twice.",
        "def gain(P, H, R):\n    S = H @ P @ H.T + R\n    P = P - P @ H.T @ np.linalg.inv(S) @ H @ P\n"
        "    return P @ H.T @ np.linalg.inv(S)",
        "def gain(P, H, R):\n    S = H @ P @ H.T + R\n    P = P - P @ H.T @ np.linalg.inv(S) @ H @ P\n"
        "    return P @ H.T @ np.linalg.inv(H @ P @ H.T + R)",
    ),
    Slip(
        "identity-for-R",
        "There is a fixed number where R should be: this sensor's noise has variance 1 whatever R says.",
        ("H.T + R", "H.T + np.eye(len(R))"),
    ),
    Slip(
        "normalised",
        "The gain is divided by one number, such as the trace or the largest entry. S is a matrix: each "
        "direction of an innovation has its own size.",
        ("@ np.linalg.inv(S)", "/ np.trace(S)"),
        ("@ np.linalg.inv(S)", "/ np.linalg.det(S)"),
        ("@ np.linalg.inv(S)", "/ np.linalg.norm(S)"),
    ),
)

STUMBLES = (
    Stumble(
        "raised",
        ("P @ H.T @ np.linalg.inv(S)", "P @ H @ np.linalg.inv(S)"),
        ("S = H @ P @ H.T + R", "S = H.T @ P @ H + R"),
        Edit("solve", (("H @ P).T", "P @ H.T)"),)),
    ),
    Stumble(
        "malformed",
        ("P @ H.T @ np.linalg.inv(S)", "(P @ H.T @ np.linalg.inv(S)).T"),
        ("P @ H.T @ np.linalg.inv(S)", "'K'"),
        ("return P @ H.T @ np.linalg.inv(S)", "pass"),
        ("return P @ H.T @ np.linalg.inv(S)", "return S, P @ H.T @ np.linalg.inv(S)"),
        ("P @ H.T @ np.linalg.inv(S)", "np.nan * P @ H.T"),
    ),
)

EQUIVALENT = {}
