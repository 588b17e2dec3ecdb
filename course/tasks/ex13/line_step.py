"""Right ways and slips of 13-line-step."""

from course.tasks import Slip, Stumble
from course.tasks.ex13.line_step_ways import PASTED, WAYS

__all__ = ["PASTED", "WAYS"]

TASK = "13-line-step"

DISTANCE = "e = np.sum(normals * (source @ Rot.T + t - target), axis=1)"
SEEN = "seen = normals @ Rot"
LEVER = "lever = source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]"
JACOBIAN = "J = np.column_stack([seen, lever])"
WEIGHT = "w = np.diag(1 / sigma**2)"
P = "P = np.linalg.inv(np.linalg.inv(Q) + J.T @ w @ J)"
DELTA = "delta = -P @ J.T @ w @ e"
RETURN = "return delta, P"

SLIPS = (
    Slip(
        "lesson-frame",
        "This is the lesson's step, in the target's directions. Here the correction is wanted as the "
        "robot sees it: how do the normals look from there?",
        [
            (SEEN, "seen = normals"),
            (
                LEVER,
                "arm = source @ Rot.T\n    lever = arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]",
            ),
        ],
    ),
    Slip(
        "about-the-origin",
        "The turn is about the target's origin. The robot turns about itself: what is the arm then?",
        (
            LEVER,
            "p = source @ Rot.T + t\n    lever = p[:, 0] * normals[:, 1] - p[:, 1] * normals[:, 0]",
        ),
        [
            (SEEN, "seen = normals"),
            (
                LEVER,
                "p = source @ Rot.T + t\n    lever = p[:, 0] * normals[:, 1] - p[:, 1] * normals[:, 0]",
            ),
        ],
    ),
    Slip(
        "normals-not-turned",
        "The normals are told in the target's frame, while the points of the source and δ are in the "
        "robot's.",
        (SEEN, "seen = normals"),
    ),
    Slip(
        "normals-turned-back",
        "The normals are turned the wrong way: T leads from the robot's frame to the target's, and here "
        "they come back.",
        (SEEN, "seen = normals @ Rot.T"),
    ),
    Slip(
        "source-not-carried",
        "The distance is that of the source as the robot sees it: the target's points and normals lie in "
        "another frame, and T leads there.",
        (DISTANCE, "e = np.sum(normals * (source - target), axis=1)"),
    ),
    Slip(
        "carried-back",
        "The source is turned the wrong way, by the transpose of Rot.",
        (DISTANCE, "e = np.sum(normals * (source @ Rot + t - target), axis=1)"),
    ),
    Slip(
        "shift-forgotten",
        "T also shifts: t is missing in the distance.",
        (DISTANCE, "e = np.sum(normals * (source @ Rot.T - target), axis=1)"),
    ),
    Slip(
        "point-to-point",
        "This is how far each point lies from its partner, along the wall as well. Only the part across "
        "the wall counts, with its sign.",
        (DISTANCE, "e = np.linalg.norm(source @ Rot.T + t - target, axis=1)"),
    ),
    Slip(
        "absolute-distance",
        "The distances have lost their signs: on which side of its wall a point lies decides which way "
        "to go.",
        (DISTANCE, "e = np.abs(np.sum(normals * (source @ Rot.T + t - target), axis=1))"),
    ),
    Slip(
        "sign",
        "The correction leads away from the walls: it has the wrong sign.",
        (DELTA, "delta = P @ J.T @ w @ e"),
        (DISTANCE, "e = np.sum(normals * (target - source @ Rot.T - t), axis=1)"),
    ),
    Slip(
        "lever-sign",
        "The lever of the turn has the wrong sign: a positive turn is counter-clockwise, and a point "
        "ahead of the robot goes to its left.",
        (LEVER, "lever = source[:, 1] * seen[:, 0] - source[:, 0] * seen[:, 1]"),
    ),
    Slip(
        "lever-along",
        "The lever is the arm times the normal, component by component. What a turn does to a point "
        "stands at right angles to its arm.",
        (LEVER, "lever = np.sum(source * seen, axis=1)"),
        (LEVER, "lever = source[:, 0] * seen[:, 1] + source[:, 1] * seen[:, 0]"),
    ),
    Slip(
        "lever-is-range",
        "A turn moves a point by its range, but across a wall only as squarely as it meets it.",
        (LEVER, "lever = np.hypot(*source.T)"),
        (LEVER, "lever = np.ones(len(source))"),
    ),
    Slip(
        "turn-left-out",
        "The correction does not turn: J has no third column.",
        (LEVER, "lever = np.zeros(len(source))"),
    ),
    Slip(
        "turn-first",
        "The columns of J stand in another order than dx, dy, dθ.",
        (JACOBIAN, "J = np.column_stack([lever, seen])"),
    ),
    Slip(
        "degrees",
        "The turn is in degrees, or was converted though it was in radians already.",
        (DELTA, DELTA + "\n    delta[2] = np.degrees(delta[2])"),
        (LEVER, LEVER + "\n    lever = np.radians(lever)"),
    ),
    Slip(
        "sigma-not-squared",
        "A weight is one over the variance, and σ is no variance yet.",
        (WEIGHT, "w = np.diag(1 / sigma)"),
    ),
    Slip(
        "weights-inverted",
        "The worse a pair was measured, the more it counts here. It should be the other way round.",
        (WEIGHT, "w = np.diag(sigma**2)"),
        (WEIGHT, "w = np.diag(sigma)"),
    ),
    Slip(
        "weights-twice",
        "The weights enter twice: they stand once between Jᵀ and J, and once between Jᵀ and e.",
        (WEIGHT, "w = np.diag(1 / sigma**4)"),
    ),
    Slip(
        "one-sigma",
        "All pairs count alike, with one σ for all. Each has its own.",
        (WEIGHT, "w = np.eye(len(sigma))"),
        (WEIGHT, "w = np.eye(len(sigma)) / np.mean(sigma**2)"),
        (WEIGHT, "w = np.eye(len(sigma)) / np.mean(sigma) ** 2"),
    ),
    Slip(
        "weights-in-one",
        "The weights stand in one of the two places only: JᵀWJ and JᵀWr both have them.",
        (P, "P = np.linalg.inv(np.linalg.inv(Q) + J.T @ J)"),
        (DELTA, "delta = -P @ J.T @ e"),
    ),
    Slip(
        "odometry-ignored",
        "Q was not used: the walls alone decide. Odometry knows something as well, and where walls are "
        "silent it is all there is.",
        (P, "P = np.linalg.pinv(J.T @ w @ J)"),
        (P, "P = np.linalg.inv(J.T @ w @ J)"),
    ),
    Slip(
        "Q-not-inverted",
        "Q was added to an information. It is a covariance: what odometry knows is its inverse.",
        (P, "P = np.linalg.inv(Q + J.T @ w @ J)"),
    ),
    Slip(
        "target-frame-and-back",
        "You solved in the target's frame and turned δ and P back. But Q is told as the robot sees it, and "
        "the robot turns about itself, not about the target's origin.",
        [
            (SEEN, "seen = normals"),
            (
                LEVER,
                "p = source @ Rot.T + t\n    lever = p[:, 0] * seen[:, 1] - p[:, 1] * seen[:, 0]",
            ),
            (RETURN, "G = np.eye(3)\n    G[:2, :2] = Rot.T\n    return G @ delta, G @ P @ G.T"),
        ],
    ),
    Slip(
        "walls-first",
        "The walls' own correction was found first, by pinv, and then weighed against odometry. Where the "
        "walls leave a direction open, pinv makes its covariance 0, which says *known exactly*. Add up "
        "information before anything is inverted.",
        [
            (P, "C = np.linalg.pinv(J.T @ w @ J); K = Q @ np.linalg.inv(Q + C); P = Q - K @ Q"),
            (DELTA, "delta = -K @ C @ J.T @ w @ e"),
        ],
    ),
    Slip(
        "covariances-added",
        "The covariances of walls and odometry were added. Two who know something know more together: "
        "it is information that adds up.",
        (P, "P = Q + np.linalg.pinv(J.T @ w @ J)"),
    ),
    Slip(
        "Q-diagonal",
        "Of Q only the diagonal was used. The errors of x, y and θ are correlated.",
        (P, "P = np.linalg.inv(np.diag(1 / np.diag(Q)) + J.T @ w @ J)"),
    ),
    Slip(
        "Q-turned",
        "Q is the covariance of δ as the robot sees it. Yours meets walls that are told in the target's "
        "frame, or was turned though they are not: all has to be told in one frame.",
        (
            P,
            "G = np.eye(3)\n    G[:2, :2] = Rot\n    P = np.linalg.inv(np.linalg.inv(G @ Q @ G.T) + J.T @ w @ J)",
        ),
        (
            P,
            "G = np.eye(3)\n    G[:2, :2] = Rot\n    P = np.linalg.inv(np.linalg.inv(G.T @ Q @ G) + J.T @ w @ J)",
        ),
    ),
    Slip(
        "information-returned",
        "This is the information, the inverse of the covariance.",
        (RETURN, "return delta, np.linalg.inv(P)"),
    ),
    Slip(
        "walls-only-P",
        "δ uses odometry and P does not: P is what walls and odometry leave in doubt together.",
        (RETURN, "return delta, np.linalg.pinv(J.T @ w @ J)"),
    ),
    Slip(
        "P-is-Q",
        "P is odometry's covariance as it was: the walls have told something.",
        (RETURN, "return delta, Q.copy()"),
    ),
    Slip(
        "covariance-of-walls-noise",
        "This is how the walls' noise spreads into δ. The guess errs as well, and its part is missing.",
        (RETURN, "return delta, P @ J.T @ w @ J @ P"),
    ),
    Slip(
        "scaled-by-residuals",
        "P was multiplied by what the residuals spread. How far each pair errs is told by its σ.",
        (RETURN, "return delta, P * np.mean(e @ w @ e) / max(len(e), 1)"),
        (RETURN, "return delta, P * np.mean(e**2) if len(e) else P"),
        (RETURN, "return delta, P * np.mean(sigma**2) if len(e) else P"),
    ),
    Slip(
        "mean-for-sum",
        "The pairs' information was divided by their number: each pair adds its own.",
        (WEIGHT, "w = np.diag(1 / sigma**2) / max(len(sigma), 1)"),
    ),
    Slip(
        "half-or-double",
        "The correction has the right direction and another length, half or twice as long.",
        (DELTA, "delta = -0.5 * P @ J.T @ w @ e"),
        (DELTA, "delta = -2 * P @ J.T @ w @ e"),
    ),
    Slip(
        "gradient",
        "This is the slope only: P is what tells how far to go.",
        (DELTA, "delta = -J.T @ w @ e"),
    ),
    Slip(
        "in-the-targets-directions",
        "δ or P came back in the target's directions. Both are wanted as the robot sees them.",
        (RETURN, "return np.append(Rot @ delta[:2], delta[2]), P"),
        (RETURN, "G = np.eye(3)\n    G[:2, :2] = Rot\n    return delta, G @ P @ G.T"),
    ),
    Slip(
        "pose-returned",
        "This is the corrected pose: δ alone is asked for.",
        (RETURN, "return delta + [*t, np.arctan2(Rot[1, 0], Rot[0, 0])], P"),
    ),
    Slip(
        "no-pairs",
        "Where there is no pair, or only one, P is Q, or nearly so: no case of its own is needed.",
        (
            RETURN,
            "if len(source) < 1:\n        return np.zeros(3), np.zeros((3, 3))\n    return delta, P",
        ),
        (RETURN, "if len(source) < 3:\n        return np.zeros(3), Q\n    return delta, P"),
        (
            RETURN,
            "if len(source) < 1:\n        return np.zeros(3), 1e6 * np.eye(3)\n    return delta, P",
        ),
    ),
    Slip(
        "corridor-given-up",
        "Where the walls leave a direction open, nothing was corrected. They still tell something of the "
        "others, and odometry of all.",
        (
            RETURN,
            "if np.linalg.matrix_rank(J) < 3:\n        return np.zeros(3), Q\n    return delta, P",
        ),
    ),
)

STUMBLES = (
    Stumble("malformed", (RETURN, "return P, delta"), (RETURN, "return delta")),
    Stumble("malformed", (RETURN, "pass"), (RETURN, "return delta, np.sqrt(np.diag(P))")),
    Stumble("raised", (P, "P = np.linalg.inv(J @ w @ J.T)")),
)
