"""Right ways and slips of 05-map."""

from course.tasks import Slip, Stumble

TASK = "05-map"

HEAD = "def build_map(xs, ids, zs, R):\n"
WAYS = {
    "by landmark, not by time": HEAD
    + """    beliefs = {}
    for id in set(ids.tolist()):
        first, *later = np.flatnonzero(ids == id)
        J = J_z(xs[first], zs[first])
        belief = g(xs[first], zs[first]), J @ R @ J.T
        for k in later:
            belief = update_landmark(*belief, xs[k], zs[k], R)
        beliefs[id] = belief
    return beliefs
""",
    "from vague beginnings": HEAD
    + """    beliefs = {}
    for x, id, z in zip(xs, ids, zs):
        if id not in beliefs:
            beliefs[id] = g(x, z), 1e4 * np.eye(2)
        beliefs[id] = update_landmark(*beliefs[id], x, z, R)
    return beliefs
""",
    "places fused": HEAD
    + """    beliefs = {}
    for k in range(len(ids)):
        id = int(ids[k])
        J = J_z(xs[k], zs[k])
        p, P = g(xs[k], zs[k]), J @ R @ J.T
        if id in beliefs:
            q, Q = beliefs[id]
            both = np.linalg.inv(np.linalg.inv(P) + np.linalg.inv(Q))
            p, P = both @ (np.linalg.solve(P, p) + np.linalg.solve(Q, q)), both
        beliefs[id] = [p.tolist(), P.tolist()]
    return beliefs
""",
    "gains": HEAD
    + """    from collections import defaultdict
    beliefs = defaultdict(lambda: None)
    for x, id, z in zip(xs, ids, zs):
        if beliefs[id] is None:
            Hi = np.linalg.inv(H_landmark(x, g(x, z)))
            beliefs[id] = g(x, z), Hi @ R @ Hi.T
            continue
        p, P = beliefs[id]
        v = z - h(x, p)
        v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
        H = H_landmark(x, p)
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        beliefs[id] = p + K @ v, (np.eye(2) - K @ H) @ P
    return dict(beliefs)
""",
    "all sights of a landmark at once": HEAD
    + """    beliefs = {}
    for id in np.unique(ids):
        rows = np.flatnonzero(ids == id)
        p = np.mean([g(xs[k], zs[k]) for k in rows], axis=0)
        for _ in range(3):
            Y, y = np.zeros((2, 2)), np.zeros(2)
            for k in rows:
                H, v = H_landmark(xs[k], p), zs[k] - h(xs[k], p)
                v[1] = wrap(v[1])
                Y, y = Y + H.T @ np.linalg.inv(R) @ H, y + H.T @ np.linalg.inv(R) @ v
            p = p + np.linalg.solve(Y, y)
        beliefs[id] = p, np.linalg.inv(Y)
    return beliefs
""",
}

LOOP = "for x, id, z in zip(xs, ids, zs, strict=True):"
KNOWN = "if id in beliefs:"
AGAIN = "beliefs[id] = update_landmark(*beliefs[id], x, z, R)"
J = "J = J_z(x, z)"
FIRST = "beliefs[id] = g(x, z), J @ R @ J.T"
OUT = "return beliefs"
LINE = "\n            "

SLIPS = (
    Slip(
        "R-for-P",
        "The first P is R as it is, in metres and radians. P is that of x and y: which matrix says what an "
        "error of r and β does to the place?",
        (FIRST, "beliefs[id] = g(x, z), R"),
    ),
    Slip(
        "J-misplaced",
        "R is not carried over to the place as it should: J_z goes from r and β to x and y, and stands on "
        "both sides of R, transposed on the right.",
        (FIRST, "beliefs[id] = g(x, z), J.T @ R @ J"),
        (J, "J = H_landmark(x, g(x, z))"),
        (J, "J = J_z(np.zeros(3), z)"),
        (FIRST, "beliefs[id] = g(x, z), J @ R"),
        (FIRST, "beliefs[id] = g(x, z), J @ J.T"),
    ),
    Slip(
        "R-by-its-diagonal",
        "Only the variances of R were used. What range and bearing share in their errors stands beside "
        "the diagonal.",
        (FIRST, "beliefs[id] = g(x, z), J @ (R * np.eye(2)) @ J.T"),
        (LOOP, "R = np.diag(np.diag(R))\n    " + LOOP),
    ),
    Slip(
        "standard-deviation",
        "R holds variances already: look where you take a root or a square of it.",
        (FIRST, "beliefs[id] = g(x, z), J @ R @ R @ J.T"),
        (FIRST, "beliefs[id] = g(x, z), J @ np.sqrt(np.abs(R)) @ J.T"),
    ),
    Slip(
        "P-by-its-diagonal",
        "x and y of a place share errors: P has numbers beside the diagonal, and they are missing.",
        (FIRST, "beliefs[id] = g(x, z), np.diag(np.diag(J @ R @ J.T))"),
        (OUT, "return {i: (p, P * np.eye(2)) for i, (p, P) in beliefs.items()}"),
    ),
    Slip(
        "P-made-up",
        "The P of a new landmark has nothing to do with its sight: a fixed number is no covariance.",
        (FIRST, "beliefs[id] = g(x, z), np.eye(2)"),
        (FIRST, "beliefs[id] = g(x, z), 1e-6 * np.eye(2)"),
        (FIRST, "beliefs[id] = g(x, z), np.trace(R) * np.eye(2)"),
    ),
    Slip(
        "counted-twice",
        "A sight is used twice: the first one both places the landmark and corrects it, or a later one "
        "corrects it twice. Counted twice, it makes the map surer than it may be.",
        (FIRST, f"{FIRST}{LINE}{AGAIN}"),
        (AGAIN, f"{AGAIN}{LINE}{AGAIN}"),
    ),
    Slip(
        "overwritten",
        "Each sight places the landmark anew, and what was known is lost. A landmark that is in the map "
        "already is corrected.",
        (KNOWN, "if False:"),
        (AGAIN, "beliefs[id] = g(x, z), beliefs[id][1]"),
    ),
    Slip(
        "first-only",
        "Only the first sight of a landmark counts: later ones correct it.",
        (AGAIN, "pass"),
    ),
    Slip(
        "P-kept",
        "Sights correct the place and leave P as it was: who has seen a landmark again is surer of it.",
        (AGAIN, "beliefs[id] = update_landmark(*beliefs[id], x, z, R)[0], beliefs[id][1]"),
    ),
    Slip(
        "place-kept",
        "Sights make P smaller and leave the place as it was.",
        (AGAIN, "beliefs[id] = beliefs[id][0], update_landmark(*beliefs[id], x, z, R)[1]"),
    ),
    Slip(
        "all-updated",
        "Every sight corrects all landmarks. With known poses a sight of one says nothing about another.",
        (AGAIN, "beliefs = {i: update_landmark(*b, x, z, R) for i, b in beliefs.items()}"),
    ),
    Slip(
        "pose-of-another-step",
        "Sights are taken as if they were made from another pose: zs[k] was seen from xs[k].",
        (LOOP, LOOP + "\n        x = xs[0]"),
        (LOOP, LOOP + "\n        x = xs[-1]"),
        (LOOP, LOOP.replace("zip(xs,", "zip(np.roll(xs, 1, axis=0),")),
        (AGAIN, "beliefs[id] = update_landmark(*beliefs[id], xs[0], z, R)"),
    ),
    Slip(
        "z-of-another-step",
        "A sight of another step is used: zs has one row for each step, not one for each landmark.",
        (LOOP, LOOP + "\n        z = zs[0]"),
        (LOOP, LOOP + "\n        z = zs[id % len(zs)]"),
        (LOOP, LOOP.replace("zs, strict", "zs[::-1], strict")),
    ),
    Slip(
        "in-the-robot's-frame",
        "Landmarks are placed as the robot sees them, not where they are: the pose's place and heading have "
        "to come in.",
        (FIRST, "beliefs[id] = g(np.zeros(3), z), J @ R @ J.T"),
        (FIRST, "beliefs[id] = g(x * [1, 1, 0], z), J @ R @ J.T"),
        (FIRST, "beliefs[id] = g(x * [0, 0, 1], z), J @ R @ J.T"),
        (FIRST, "beliefs[id] = z, J @ R @ J.T"),
    ),
    Slip(
        "zero-skipped",
        "Landmark 0 is a landmark like the others, and is missing or is kept apart: ask whether it is in the "
        "map, not whether it is true.",
        (KNOWN, "if id and id in beliefs:"),
    ),
    Slip(
        "last-sight-skipped",
        "The run's last sight, or its first one, is not used where the landmark was seen before.",
        (
            LOOP,
            "for x, id, z in list(zip(xs, ids, zs))[:-1] + [(xs[-1], i, zs[-1]) for i in ids[-1:] if i not in ids[:-1]] if len(ids) else []:",
        ),
    ),
    Slip(
        "plain-mean",
        "Sights are averaged as if all were equally good. A near one is worth more than a far one, and along "
        "the line of sight another than across it.",
        (AGAIN, "beliefs[id] = (beliefs[id][0] + g(x, z)) / 2, beliefs[id][1] / 2"),
        HEAD
        + """    beliefs = {}
    for id in set(ids.tolist()):
        rows = np.flatnonzero(ids == id)
        J = J_z(xs[rows[0]], zs[rows[0]])
        p = np.mean([g(xs[k], zs[k]) for k in rows], axis=0)
        beliefs[id] = p, J @ R @ J.T / len(rows)
    return beliefs
""",
    ),
    Slip(
        "covariances-added",
        "P grew with each sight: knowledge adds up in the inverses, not in the covariances.",
        (
            AGAIN,
            f"P_0 = beliefs[id][1]{LINE}p, P = update_landmark(*beliefs[id], x, z, R){LINE}beliefs[id] = p, P + P_0",
        ),
        (
            AGAIN,
            f"p, P = update_landmark(*beliefs[id], x, z, R){LINE}{J}{LINE}beliefs[id] = p, beliefs[id][1] + J @ R @ J.T",
        ),
    ),
    Slip(
        "unwrapped",
        "The innovation's bearing is not wrapped where a landmark is seen again: update_landmark does that "
        "for you.",
        HEAD
        + """    beliefs = {}
    for x, id, z in zip(xs, ids, zs):
        if id not in beliefs:
            J = J_z(x, z)
            beliefs[id] = g(x, z), J @ R @ J.T
            continue
        p, P = beliefs[id]
        H = H_landmark(x, p)
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        beliefs[id] = p + K @ (z - h(x, p)), P - K @ H @ P
    return beliefs
""",
    ),
    Slip(
        "R-altered",
        "R is made larger with each sight, or taken for something else: every sight errs by the same R.",
        (LOOP, LOOP + "\n        R = 1.1 * R"),
        (AGAIN, "beliefs[id] = update_landmark(*beliefs[id], x, z, 2 * R)"),
        (AGAIN, "beliefs[id] = update_landmark(*beliefs[id], x, z, R @ R)"),
    ),
    Slip(
        "seen-from-afar",
        "Landmarks beyond a certain distance or number are treated otherwise: the map has room for all.",
        (
            KNOWN,
            "if id in beliefs and z[0] > 20:" + LINE + "pass" + "\n        elif id in beliefs:",
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (OUT, "return list(beliefs.values())"),
        (OUT, "return None"),
        (OUT, "return {i: b[0] for i, b in beliefs.items()}"),
        (OUT, "return dict(enumerate(beliefs.values()))"),
        (OUT, "return {str(i): b for i, b in beliefs.items()}"),
        (OUT, "return beliefs | {-1: (np.zeros(2), np.eye(2))}"),
    ),
    Stumble(
        "raised",
        (KNOWN, "if True:"),
        (OUT, "return undefined"),
        (FIRST, "beliefs[id] = J @ R @ J.T, g(x, z)"),
    ),
)

EQUIVALENT = {
    "(g(x, z), np.eye(2))": "a metre is as vague as a hundred beside a tenth of a millimetre",
    "both.T @": "a covariance is its own transpose, to rounding",
    "np.linalg.solve(Q, q)) @ both": "a covariance is its own transpose, to rounding",
}
