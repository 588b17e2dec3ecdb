"""Right ways and slips of 06-augment."""

from course.tasks import Slip, Stumble

TASK = "06-augment"

WAYS = {
    "one Jacobian": """
def augment(x, P, z, R):
    n = len(x)
    G = np.zeros((n + 2, n + 2))
    G[:n, :n], G[n:, :3], G[n:, n:] = np.eye(n), J_xr(x, z), J_z(x, z)
    full = np.zeros((n + 2, n + 2))
    full[:n, :n], full[n:, n:] = P, R
    return np.concatenate([x, g(x, z)]), G @ full @ G.T
""",
    "block by block": """
def augment(x, P, z, R):
    n = len(x)
    new = np.zeros((n + 2, n + 2))
    new[:n, :n] = P
    for rows in [slice(0, 3)] + [slice(k, k + 2) for k in range(3, n, 2)]:
        new[rows, n:] = P[rows, :3] @ J_xr(x, z).T
        new[n:, rows] = new[rows, n:].T
    new[n:, n:] = J_xr(x, z) @ P[:3, :3] @ J_xr(x, z).T + J_z(x, z) @ R @ J_z(x, z).T
    return [list(x) + list(g(x, z)), new]
""",
    "differences": """
def augment(x, P, z, R):
    place = lambda s: g(s[:3], s[3:])
    s, e = np.append(x[:3], z), 1e-6
    J = np.column_stack([(place(s + d) - place(s - d)) / (2 * e) for d in e * np.eye(5)])
    cross = P[:, :3] @ J[:, :3].T
    corner = J[:, :3] @ P[:3, :3] @ J[:, :3].T + J[:, 3:] @ R @ J[:, 3:].T
    return np.append(x, place(s)), np.vstack([np.hstack([P, cross]), np.hstack([cross.T, corner])])
""",
    "sines and cosines": """
def augment(x, P, z, R):
    c, s = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    A = np.array([[1, 0, -z[0] * s], [0, 1, z[0] * c]])
    B = np.array([[c, -z[0] * s], [s, z[0] * c]])
    new = np.pad(P, (0, 2))
    new[-2:, :-2] = A @ P[:3, :]
    new[:-2, -2:] = P[:, :3] @ A.T
    new[-2:, -2:] = A @ P[:3, :3] @ A.T + B @ R @ B.T
    return np.append(x, [x[0] + z[0] * c, x[1] + z[0] * s]), new
""",
}

P_NN = "Jxr @ P[:3, :3] @ Jxr.T + Jz @ R @ Jz.T"
PLACE = "g(x[:3], z)"
BLOCKS = "np.block([[P, row.T], [row, P_nn]])"

SLIPS = (
    Slip(
        "old-changed",
        "Something that was in the state before has changed. Seeing a new landmark tells nothing about "
        "pose or map: append to x and P, and leave the rest.",
        (BLOCKS, "np.block([[P + np.pad(Jxr.T @ R @ Jxr, (0, len(x) - 3)), row.T], [row, P_nn]])"),
        (BLOCKS, "np.block([[P + 0.01 * np.eye(len(x)), row.T], [row, P_nn]])"),
    ),
    Slip(
        "elsewhere",
        "The new landmark stands elsewhere than g puts it. g takes a pose (the first three numbers of "
        "x) and a z = [r, β] in the robot's frame, and gives a place in the world.",
        (PLACE, "x[:2] + z[0] * np.array([np.cos(z[1]), np.sin(z[1])])"),
        (PLACE, "x[:2] + z[0] * np.array([np.cos(x[2]), np.sin(x[2])])"),
        (PLACE, "x[:2] + z[0] * np.array([np.cos(x[2] - z[1]), np.sin(x[2] - z[1])])"),
        (PLACE, "x[:2] + z[0] * np.array([np.sin(x[2] + z[1]), np.cos(x[2] + z[1])])"),
        (PLACE, "z[0] * np.array([np.cos(z[1]), np.sin(z[1])])"),
        (PLACE, "z[0] * np.array([np.cos(x[2] + z[1]), np.sin(x[2] + z[1])])"),
        (PLACE, "z"),
        (PLACE, "x[:2] + z"),
        (PLACE, "x[:2]"),
    ),
    Slip(
        "born-alone",
        "The new rows are zero: this landmark would share nothing with anyone. But the robot placed it, "
        "with the error the robot has. Which Jacobian hands that on?",
        ("row = Jxr @ P[:3]", "row = np.zeros((2, len(x)))"),
    ),
    Slip(
        "only-robot",
        "P_nr is right, and P_ni is zero. The robot's error is in the new landmark; whatever shares in "
        "that error (P_ri) now shares in the landmark too.",
        ("row = Jxr @ P[:3]", "row = np.pad(Jxr @ P[:3, :3], ((0, 0), (0, len(x) - 3)))"),
    ),
    Slip(
        "not-the-robot",
        "The old landmarks' columns are there and the robot's are zero: but it is through the robot "
        "alone that the new landmark is related to anyone.",
        ("row = Jxr @ P[:3]", "row = Jxr @ P[:3]\n    row[:, :3] = 0"),
    ),
    Slip(
        "one-side",
        "The new rows are right on one side of the diagonal only: P is symmetric, so the new columns "
        "are the new rows transposed.",
        (BLOCKS, "np.block([[P, 0 * row.T], [row, P_nn]])"),
        (BLOCKS, "np.block([[P, row.T], [0 * row, P_nn]])"),
    ),
    Slip(
        "heading-dropped",
        "The new rows are the robot's x and y rows: as if the landmark were carried along, but never "
        "swung. What does an error of θ do to a landmark some metres away?",
        ("row = Jxr @ P[:3]", "row = P[:2]"),
        ("row = Jxr @ P[:3]", "row = Jxr[:, :2] @ P[:2]"),
        [("row = Jxr @ P[:3]", "Jxr = Jxr * [1, 1, 0]\n    row = Jxr @ P[:3]")],
        before=("name",),
    ),
    Slip(
        "Jacobian-at-wrong-pose",
        "The Jacobians were taken elsewhere than at this pose and this sight: both depend on the "
        "heading, the range and the bearing.",
        ("J_xr(x[:3], z), J_z(x[:3], z)", "J_xr(np.zeros(3), z), J_z(np.zeros(3), z)"),
        ("J_xr(x[:3], z), J_z(x[:3], z)", "J_xr(x[:3], z), J_z(np.zeros(3), z)"),
        ("J_xr(x[:3], z), J_z(x[:3], z)", "J_xr(x[:3], g(x[:3], z)), J_z(x[:3], g(x[:3], z))"),
    ),
    Slip(
        "sign-of-the-rows",
        "The new rows have the opposite sign: when the robot is really further right than believed, so "
        "is the landmark it placed.",
        ("row = Jxr @ P[:3]", "row = -Jxr @ P[:3]"),
    ),
    Slip(
        "blocks-turned",
        "P_ni is transposed in its 2 × 2 blocks. They are square, so that both multiply: which of P_ir "
        "and P_ri stands in the robot's rows?",
        (
            "row = Jxr @ P[:3]",
            "row = Jxr @ P[:3]\n    row[:, 3:] = row[:, 3:].reshape(2, -1, 2).transpose(2, 1, 0)"
            ".reshape(2, -1)",
        ),
    ),
    Slip(
        "noise-not-carried",
        "R was added as it is, but it is in range and bearing while P_nn is in x and y: a Jacobian turns "
        "one into the other.",
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + R"),
    ),
    Slip(
        "noise-missing",
        "P_nn holds the pose's error only. The sight errs too: R says how much, and a Jacobian carries it.",
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T"),
    ),
    Slip(
        "pose-missing",
        "P_nn holds the sight's error only. It was measured from a pose that errs as well, and there is "
        "a Jacobian for that.",
        (P_NN, "Jz @ R @ Jz.T"),
    ),
    Slip(
        "sandwich-reversed",
        "JᵀRJ has the shape of JRJᵀ, and another meaning: R must meet the side of J_z that is made for "
        "range and bearing.",
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + Jz.T @ R @ Jz"),
    ),
    Slip(
        "standard-deviation",
        "R and P hold variances already: look whether you take a root or a square of one.",
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + Jz @ R @ R @ Jz.T"),
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + Jz @ R**2 @ Jz.T"),
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + Jz @ np.sqrt(np.abs(R)) @ Jz.T"),
    ),
    Slip(
        "diagonal-only",
        "Of R, or of P_rr, only the variances were used. What range and bearing, or x, y and heading, "
        "share in their errors stands beside the diagonal.",
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + Jz @ np.diag(np.diag(R)) @ Jz.T"),
        (P_NN, "Jxr @ np.diag(np.diag(P[:3, :3])) @ Jxr.T + Jz @ R @ Jz.T"),
    ),
    Slip(
        "noise-subtracted",
        "The two errors of a new landmark are independent: their covariances add up, and none is taken "
        "from the other.",
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T - Jz @ R @ Jz.T"),
    ),
    Slip(
        "half-a-sandwich",
        "P_nn has only one Jacobian in one of its terms: a covariance is carried by J on both sides, "
        "J P Jᵀ.",
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + Jz @ R"),
        (P_NN, "Jxr @ P[:3, :3] @ Jxr.T + R @ Jz.T"),
    ),
    Slip(
        "in-front",
        "The new landmark's rows stand before the map instead of behind it: it comes last, in x and in P.",
        (
            "return np.append(x, g(x[:3], z)), " + BLOCKS,
            "order = [0, 1, 2, len(x), len(x) + 1, *range(3, len(x))]\n"
            "    grown = " + BLOCKS + "\n"
            "    return np.append(x, g(x[:3], z))[order], grown[np.ix_(order, order)]",
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        "def augment(x, P, z, R):\n    return np.append(x, g(x[:3], z)), P",
        "def augment(x, P, z, R):\n    return np.append(x, g(x[:3], z))",
        "def augment(x, P, z, R):\n    print(x)",
        (PLACE, "g(x[:3], z) * np.nan"),
    ),
    Stumble("raised", ("Jxr @ P[:3]\n", "Jxr @ P\n")),
)

EQUIVALENT = {}
