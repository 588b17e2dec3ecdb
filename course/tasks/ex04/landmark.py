"""Programs of 04-new-landmark: the covariances of a new landmark."""

from course.tasks import Slip, Stumble

TASK = "04-new-landmark"

WAYS = {
    "one product of blocks, as a list": """
def new_landmark(x, P, z, R):
    G = np.block([[np.eye(3), np.zeros((3, 2))], [J_xr(x, z), J_z(x, z)]])
    joint = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    joint = G @ joint @ G.T
    return [joint[3:, 3:], joint[:3, 3:]]
""",
    "Cholesky factors": """
def new_landmark(x, P, z, R):
    pose, noise = J_xr(x, z) @ np.linalg.cholesky(P), J_z(x, z) @ np.linalg.cholesky(R)
    return pose @ pose.T + noise @ noise.T, np.einsum("ij,kj->ik", P, J_xr(x, z))
""",
    "loops": """
def new_landmark(x, P, z, R):
    A, B = np.asarray(J_xr(x, z)), np.asarray(J_z(x, z))
    P_nn, P_rn = np.zeros((2, 2)), np.zeros((3, 2))
    for i in range(2):
        for j in range(2):
            P_nn[i, j] = sum(A[i, k] * P[k, l] * A[j, l] for k in range(3) for l in range(3))
            P_nn[i, j] += sum(B[i, k] * R[k, l] * B[j, l] for k in range(2) for l in range(2))
        for k in range(3):
            P_rn[k, i] = A[i] @ P[:, k]
    return P_nn, P_rn
""",
    "cross first": """
def new_landmark(x, P, z, R):
    J = J_xr(x, z)
    P_rn = (J @ P).T
    return J @ P_rn + np.linalg.multi_dot([J_z(x, z), R, np.transpose(J_z(x, z))]), P_rn
""",
    "sigma points": """
def new_landmark(x, P, z, R):
    joint = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    at, root = np.concatenate([x, z]), 1e-2 * np.linalg.cholesky(joint).T
    points = np.vstack([at + root, at - root])
    places = np.array([g(v[:3], v[3:]) for v in points])
    off, moved = places - places.mean(axis=0), points[:, :3] - x
    return off.T @ off / 2e-4, moved.T @ off / 2e-4
""",
    "differences": """
def new_landmark(x, P, z, R):
    def slopes(f, v):
        return np.array([(f(v + step) - f(v - step)) / 2e-6 for step in 1e-6 * np.eye(len(v))])
    A, B = slopes(lambda v: g(v, z), x), slopes(lambda v: g(x, v), z)
    return A.T @ P @ A + B.T @ R @ B, P @ A
""",
}

NN, RN = "Jxr @ P @ Jxr.T + Jz @ R @ Jz.T", "P_rn = P @ Jxr.T"


def _nn(wrong):
    return (NN, wrong)


def _rn(wrong):
    return (RN, f"P_rn = {wrong}")


SLIPS = (
    Slip(
        "pose-ignored",
        "P_nn holds the measurement's noise only. Nobody knows exactly where the robot stood when it "
        "measured: what carries that doubt over to the landmark?",
        _nn("Jz @ R @ Jz.T"),
    ),
    Slip(
        "noise-ignored",
        "P_nn holds the pose's uncertainty only: the measurement is noisy too, and R says how much.",
        _nn("Jxr @ P @ Jxr.T"),
    ),
    Slip(
        "noise-not-carried",
        "R is added as it is, but it is in range and bearing while P_nn is in x and y. Look at the "
        "units: what turns one into the other?",
        _nn("Jxr @ P @ Jxr.T + R"),
        _nn("P[:2, :2] + R"),
        _nn("R"),
    ),
    Slip(
        "heading-ignored",
        "The pose's position is in P_nn, its heading is not: a robot that is unsure of its heading is "
        "unsure of everything it sees far away. Look at which block of P you use.",
        _nn("P[:2, :2] + Jz @ R @ Jz.T"),
        _nn("P[:2, :2]"),
    ),
    Slip(
        "pose-correlations-ignored",
        "Only the diagonal of P, or its position and its heading apart, is carried over. Errors of x, "
        "y and θ go together: which entries of P say so?",
        _nn("Jxr @ np.diag(np.diag(P)) @ Jxr.T + Jz @ R @ Jz.T"),
        _nn("P[:2, :2] + P[2, 2] * np.outer(Jxr[:, 2], Jxr[:, 2]) + Jz @ R @ Jz.T"),
        _rn("np.diag(np.diag(P)) @ Jxr.T"),
        [
            _nn("Jxr @ np.diag(np.diag(P)) @ Jxr.T + Jz @ R @ Jz.T"),
            _rn("np.diag(np.diag(P)) @ Jxr.T"),
        ],
    ),
    Slip(
        "noise-correlations-ignored",
        "Only the diagonal of R is used. Where errors of range and bearing go together, R is a full "
        "matrix.",
        _nn("Jxr @ P @ Jxr.T + Jz @ np.diag(np.diag(R)) @ Jz.T"),
    ),
    Slip(
        "standard-deviation",
        "R and P hold variances already: look whether you take a root or a square of one.",
        _nn("Jxr @ P @ Jxr.T + Jz @ np.sqrt(R) @ Jz.T"),
        _nn("Jxr @ P @ Jxr.T + Jz @ R**2 @ Jz.T"),
        _nn("Jxr @ P @ Jxr.T + Jz @ R @ R @ Jz.T"),
        _nn("Jxr @ P**2 @ Jxr.T + Jz @ R @ Jz.T"),
        _nn("Jxr @ P @ P @ Jxr.T + Jz @ R @ Jz.T"),
        _nn("np.sqrt(np.abs(Jxr @ P @ Jxr.T + Jz @ R @ Jz.T))"),
        _rn("P**2 @ Jxr.T"),
    ),
    Slip(
        "sandwich-reversed",
        "J_zᵀ R J_z has the shape of J_z R J_zᵀ, and another meaning. R must be multiplied by the side "
        "of J_z that is made for range and bearing: which of its sides is that?",
        _nn("Jxr @ P @ Jxr.T + Jz.T @ R @ Jz"),
    ),
    Slip(
        "transpose-missing",
        "A covariance has a Jacobian on either side, and the right one is transposed. Is your P_nn "
        "symmetric?",
        _nn("Jxr @ P @ Jxr.T + Jz @ R @ Jz"),
        _nn("Jxr @ P @ Jxr.T + Jz @ R"),
        _nn("Jxr @ P @ Jxr.T + R @ Jz.T"),
    ),
    Slip(
        "noise-subtracted",
        "Two independent doubts add up, they do not cancel: look at the sign between the two terms.",
        _nn("Jxr @ P @ Jxr.T - Jz @ R @ Jz.T"),
    ),
    Slip(
        "halved-or-doubled",
        "P_nn has a factor too many. A sum of independent errors has the sum of their covariances, "
        "neither their mean nor twice that.",
        _nn("(Jxr @ P @ Jxr.T + Jz @ R @ Jz.T) / 2"),
        _nn("2 * (Jxr @ P @ Jxr.T + Jz @ R @ Jz.T)"),
        _nn("4 * (Jxr @ P @ Jxr.T + Jz @ R @ Jz.T)"),
    ),
    Slip(
        "inverse",
        "This is the inverse, an information matrix: a landmark that is seen badly would have a small "
        "covariance.",
        _nn("np.linalg.inv(Jxr @ P @ Jxr.T + Jz @ R @ Jz.T)"),
        _nn("np.linalg.inv(np.linalg.inv(Jxr @ P @ Jxr.T) + np.linalg.inv(Jz @ R @ Jz.T))"),
    ),
    Slip(
        "diagonal-only",
        "P_nn is a diagonal matrix: the streak of where the landmark may be would lie along x or y, "
        "whatever the line of sight.",
        _nn("np.diag(np.diag(Jxr @ P @ Jxr.T + Jz @ R @ Jz.T))"),
    ),
    Slip(
        "own-cross-in-p-nn",
        "P_nn holds the covariance with the pose once more: its upper rows have the shape of P_nn, but "
        "they say something else.",
        _nn("(P @ Jxr.T)[:2] + Jz @ R @ Jz.T"),
    ),
    Slip(
        "identity",
        "P_nn is a fixed matrix: how unsure a landmark is must depend on how unsure the robot is.",
        _nn("np.eye(2)"),
        _nn("0 * R"),
    ),
    Slip(
        "cross-zero",
        "P_rn is zero: this says that robot and landmark err independently. But the landmark was "
        "placed from the robot's pose: had the robot stood 1 m farther left, where would it be?",
        _rn("np.zeros((3, 2))"),
    ),
    Slip(
        "cross-without-heading",
        "P_rn takes over the position's share only: a heading error moves the new landmark as well. "
        "Look at which Jacobian says by how much.",
        _rn("P[:, :2]"),
        _rn("P[:, :2] @ Jxr[:, :2].T"),
        _rn("np.vstack([P[:2] @ Jxr.T, np.zeros((1, 2))])"),
    ),
    Slip(
        "cross-sign",
        "P_rn has the wrong sign: where the robot errs to the right, so does its landmark.",
        _rn("-P @ Jxr.T"),
    ),
    Slip(
        "cross-not-weighted",
        "P_rn is the bare Jacobian. How far the two err together also depends on how far the robot "
        "errs at all: where is P?",
        _rn("Jxr.T"),
    ),
    Slip(
        "cross-with-noise",
        "P_rn holds the measurement's noise, of which the pose knows nothing. Which of the landmark's "
        "errors does the pose share?",
        _rn("P @ Jxr.T + np.vstack([Jz @ R @ Jz.T, [0, 0]])"),
        _rn("P @ Jxr.T @ P_nn"),
        _rn("np.vstack([P_nn, (P @ Jxr.T)[2]])"),
        _rn("np.vstack([P_nn, np.zeros((1, 2))])"),
    ),
    Slip(
        "cross-inverse",
        "P_rn is divided by a covariance: this is a regression or a gain, not a covariance.",
        _rn("P @ Jxr.T @ np.linalg.inv(P_nn)"),
        _rn("np.linalg.inv(P) @ Jxr.T"),
    ),
    Slip(
        "robot-for-world",
        "J_z was turned into the robot's frame, or R into the world's, once more than g does.",
        (
            "Jxr, Jz = J_xr(x, z), J_z(x, z)",
            "Jxr, Jz = J_xr(x, z), J_z(0 * x, z)",
        ),
        (
            "Jxr, Jz = J_xr(x, z), J_z(x, z)",
            "Jxr, Jz = J_xr(0 * x, z), J_z(0 * x, z)",
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return P_nn, P_rn", "return P_nn"),
        ("return P_nn, P_rn", "return P_rn, P_nn"),
        ("return P_nn, P_rn", "return P_nn, P_rn.T"),
        ("return P_nn, P_rn", "P_nn"),
        ("return P_nn, P_rn", "return {'P_nn': P_nn, 'P_rn': P_rn}"),
        ("return P_nn, P_rn", "return P_nn, P_rn, P_rn.T"),
    ),
    Stumble("not attempted", ("return P_nn, P_rn", "raise NotImplementedError")),
    Stumble("raised", (NN, "(Jxr @ P @ Jxr.T) @ P"), (RN, "P_rn = P @ Jxr")),
)

_SUM_ZERO = "the deviations sum to zero: what is added to the other factor drops out"
EQUIVALENT = dict.fromkeys(
    ("points[:, :3] + x", "points[:, :3] - x ** 2", "off.T @ places", "places.T @ off"), _SUM_ZERO
)
