"""Solutions of exercise 13 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

FIT = """
def best_motion(source, target):
    a, b = {centroids}
    p, q = {centred}
    U, _, Vt = np.linalg.svd({H})
    {fix}
    R = {R}
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = {t}
    return {result}
"""


def fit(**changes):
    parts = {
        "centroids": "source.mean(axis=0), target.mean(axis=0)",
        "centred": "source - a, target - b",
        "H": "p.T @ q",
        "fix": "Vt[1] *= np.sign(np.linalg.det(Vt.T @ U.T))",
        "R": "Vt.T @ U.T",
        "t": "b - R @ a",
        "result": "T",
    }
    return FIT.format(**(parts | changes))


ICP = """
def icp(source, target, T, rounds):
    {before}
    for k in range(rounds):
        moved = carry(T, source)
        rows = {rows}
        step = best_motion({pairs})
        T = {T}
    return {result}
"""


def icp(**changes):
    parts = {
        "before": "pass",
        "rows": "nearest(moved, target)[1]",
        "pairs": "moved, target[rows]",
        "T": "step @ T",
        "result": "T",
    }
    return ICP.format(**(parts | changes))


TRIMMED = """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        kept = {kept}
        T = {T}
    return T
"""


def trimmed(
    kept="np.argsort(distances)[:keep]", T="best_motion(moved[kept], target[rows[kept]]) @ T"
):
    return TRIMMED.format(kept=kept, T=T)


WALK = """
def walk(scans, steps, rounds):
    poses = [np.eye(3)]
    for i, guess in enumerate(steps):
        T = icp(scans[i + 1], scans[i], guess, rounds)
        poses.append({pose})
    return {result}
"""


def walk(pose="poses[-1] @ T", result="poses"):
    return WALK.format(pose=pose, result=result)


BOTH = {"13-best-motion:exact", "13-best-motion:best"}
MIRROR = {"13-mirror:rotation"}
ICP_ALL, TRIMMED_ALL = {"13-icp"}, {"13-trimmed"}
LANDS = {"13-walk:lands"}

WRONG = [
    Wrong("U Vᵀ for V Uᵀ", fit(R="U @ Vt"), BOTH, "rotation-transposed"),
    Wrong("H with the target on the left", fit(H="q.T @ p"), BOTH, "rotation-transposed"),
    Wrong("centroids left on", fit(centred="source, target"), BOTH, "not-centred"),
    Wrong("centroid not turned", fit(t="b - a"), BOTH, "centroid-not-turned"),
    Wrong("centroids in the other order", fit(t="a - R @ b"), BOTH, "centroids-swapped"),
    Wrong("the inverse motion", fit(result="np.linalg.inv(T)"), BOTH, "inverted"),
    Wrong("T for row vectors", fit(result="T.T"), {"13-best-motion"}, "for-rows"),
    Wrong("S left in R", fit(R="Vt.T @ np.diag(_) @ U.T"), {"rigid", "13-best-motion:exact"}),
    Wrong("R and t as a tuple", fit(result="(R, T[:2, 2])"), {"13-best-motion"}, None, "malformed"),
    Wrong(
        "a pose instead of a matrix",
        fit(result="np.array([*T[:2, 2], np.arctan2(T[1, 0], T[0, 0])])"),
        {"13-best-motion"},
        None,
        "malformed",
    ),
    Wrong("no return", fit(result="None"), {"13-best-motion"}, None, "malformed"),
    Wrong("mirrors allowed", fit(fix="pass"), MIRROR, "mirrored"),
    Wrong(
        "Vᵀ taken for V, mirrors allowed", fit(R="Vt @ U.T", fix="pass"), {"13-mirror"}, "v-for-vt"
    ),
    Wrong(
        "whole R negated",
        fit(R="Vt.T @ U.T * np.sign(np.linalg.det(Vt.T @ U.T))", fix="pass"),
        {"13-mirror"},
        "negated",
    ),
    Wrong(
        "V's first column negated",
        fit(fix="Vt[0] *= np.sign(np.linalg.det(Vt.T @ U.T))"),
        {"13-mirror:best"},
        "first-flipped",
    ),
    Wrong(
        "a row of R negated",
        fit(R="Vt.T @ U.T * np.array([[1], [np.sign(np.linalg.det(Vt.T @ U.T))]])", fix="pass"),
        {"13-mirror:best"},
        "product-flipped",
    ),
    Wrong(
        "a column of R negated",
        fit(R="Vt.T @ U.T * np.array([np.sign(np.linalg.det(Vt.T @ U.T)), 1])", fix="pass"),
        {"13-mirror:best"},
        "product-flipped",
    ),
    Wrong("step on the wrong side", icp(T="T @ step"), ICP_ALL, "wrong-side"),
    Wrong("last step only", icp(result="step"), ICP_ALL, "step-only"),
    Wrong("pairs by row", icp(rows="np.arange(len(source))"), ICP_ALL, "by-row"),
    Wrong("first guess ignored", icp(before="T = np.eye(3)"), ICP_ALL, "guess-ignored"),
    Wrong(
        "pairs of the source as given",
        icp(rows="nearest(source, target)[1]"),
        ICP_ALL,
        "guess-ignored",
    ),
    Wrong("source moved twice", icp(pairs="source, target[rows]"), ICP_ALL, "source-not-moved"),
    Wrong("inverse of the match", icp(result="np.linalg.inv(T)"), ICP_ALL, "inverted"),
    Wrong(
        "the same step again and again",
        icp(
            before="first = carry(T, source)",
            rows="nearest(first, target)[1]",
            pairs="first, target[rows]",
        ),
        {"13-icp:lands"},
        "same-step-again",
    ),
    Wrong(
        "pairs sought once",
        icp(before="found = nearest(carry(T, source), target)[1]", rows="found"),
        {"13-icp:lands"},
        "one-round-only",
    ),
    Wrong(
        "returns in the first round",
        "def icp(source, target, T, rounds):\n"
        "    for _ in range(rounds):\n"
        "        moved = carry(T, source)\n"
        "        return best_motion(moved, target[nearest(moved, target)[1]]) @ T\n",
        {"13-icp:lands"},
        "one-round-only",
    ),
    Wrong("clouds of unequal length paired", icp(pairs="moved, target"), ICP_ALL, None, "raised"),
    Wrong("nothing trimmed", trimmed(kept="np.arange(len(source))"), TRIMMED_ALL, "not-trimmed"),
    Wrong(
        "longest pairs kept",
        trimmed(kept="np.argsort(distances)[-keep:]"),
        TRIMMED_ALL,
        "longest-kept",
    ),
    Wrong(
        "share dropped",
        trimmed(kept="np.argsort(distances)[:-keep]"),
        {"13-trimmed:first-round", "13-trimmed:sorted-anew"},
        "share-dropped",
    ),
    Wrong(
        "sorted once, before the rounds",
        """
def trimmed_icp(source, target, T, rounds, share):
    distances, _ = nearest(carry(T, source), target)
    source = source[np.argsort(distances)[: int(share * len(source))]]
    for _ in range(rounds):
        moved = carry(T, source)
        T = best_motion(moved, target[nearest(moved, target)[1]]) @ T
    return T
""",
        {"13-trimmed:sorted-anew"},
        "sorted-once",
        may_lose={"13-trimmed:lands"},  # a lucky first choice leads home
    ),
    Wrong("first rows kept", trimmed(kept="np.arange(keep)"), TRIMMED_ALL, "first-rows"),
    Wrong(
        "pairs torn apart",
        trimmed(T="best_motion(moved[kept], target[rows[:keep]]) @ T"),
        TRIMMED_ALL,
        "torn-pairs",
    ),
    Wrong(
        "trimmed step on the wrong side",
        trimmed(T="T @ best_motion(moved[kept], target[rows[kept]])"),
        TRIMMED_ALL,
        "wrong-side",
    ),
    Wrong(
        "second scan's motion lost",
        "def walk(scans, steps, rounds):\n"
        "    poses = [np.eye(3), np.eye(3)]\n"
        "    for i in range(1, len(steps)):\n"
        "        poses.append(poses[-1] @ icp(scans[i + 1], scans[i], steps[i], rounds))\n"
        "    return poses\n",
        LANDS,
        "first-motion-lost",
    ),
    Wrong("matches not put together", walk(pose="T"), LANDS, "not-accumulated"),
    Wrong("match on the wrong side", walk(pose="T @ poses[-1]"), LANDS, "wrong-side"),
    Wrong("odometry only", walk(pose="poses[-1] @ guess"), LANDS, "odometry-only"),
    Wrong("poses inverted", walk(result="np.linalg.inv(poses)"), LANDS, "inverted"),
    Wrong(
        "odometry's steps ignored",
        walk(pose="poses[-1] @ icp(scans[i + 1], scans[i], np.eye(3), rounds)"),
        LANDS,
        "steps-ignored",
    ),
    Wrong("first pose missing", walk(result="poses[1:]"), {"13-walk"}, "first-pose-missing"),
]

RIGHT = [
    Right(
        "mirror mended by a diagonal",
        fit(fix="D = np.linalg.det(Vt.T @ U.T)", R="Vt.T @ np.diag([1, D]) @ U.T"),
    ),
    Right(
        "mirror mended in U", fit(fix="U[:, 1] *= np.sign(np.linalg.det(U) * np.linalg.det(Vt))")
    ),
    Right(
        "angle in closed form",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    p, q = source - a, target - b
    sine, cosine = np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]), np.sum(p * q)
    theta = np.arctan2(sine, cosine)
    c, s = np.cos(theta), np.sin(theta)
    x, y = b - np.array([[c, -s], [s, c]]) @ a
    return np.array([[c, -s, x], [s, c, y], [0, 0, 1]])
""",
    ),
    Right(
        "complex numbers",
        """
def best_motion(source, target):
    z, w = source @ [1, 1j], target @ [1, 1j]
    turn = np.vdot(z - z.mean(), w - w.mean())
    turn /= abs(turn)
    t = w.mean() - turn * z.mean()
    return np.array(
        [[turn.real, -turn.imag, t.real], [turn.imag, turn.real, t.imag], [0, 0, 1]]
    )
""",
    ),
    Right(
        "scipy's Kabsch",
        """
def best_motion(source, target):
    from scipy.spatial.transform import Rotation

    a, b = source.mean(axis=0), target.mean(axis=0)
    flat = lambda points: np.column_stack([points, np.zeros(len(points))])
    wide = Rotation.align_vectors(
        np.vstack([flat(target - b), [0, 0, 1e3]]), np.vstack([flat(source - a), [0, 0, 1e3]])
    )[0].as_matrix()
    T = np.eye(3)
    T[:2, :2] = wide[:2, :2]
    T[:2, 2] = b - T[:2, :2] @ a
    return T
""",
    ),
    Right(
        "brute force neighbours",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        apart = np.linalg.norm(moved[:, None] - target, axis=2)
        T = best_motion(moved, target[apart.argmin(axis=1)]) @ T
    return T
""",
    ),
    Right(
        "homogeneous columns, refitted at the end as the thesis does",
        """
def icp(source, target, T, rounds):
    moved = T @ np.vstack([source.T, np.ones(len(source))])
    tree = cKDTree(target)
    for _ in range(rounds):
        _, rows = tree.query(moved[:2].T)
        moved = best_motion(moved[:2].T, target[rows]) @ moved
    return best_motion(source, moved[:2].T)
""",
    ),
    Right("the fit alone, from the source as given", icp(pairs="source, target[rows]", T="step")),
    Right(
        "stops when nothing changes",
        """
def icp(source, target, T, rounds):
    last = np.inf
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
        if abs(last - distances.mean()) < 1e-12:
            break
        last = distances.mean()
    return T
""",
    ),
    Right("kept by a quantile", trimmed(kept="distances <= np.quantile(distances, share)")),
    Right(
        "kept by partition, rounded up",
        trimmed(kept="np.argpartition(distances, keep)[: keep + 1]"),
    ),
    Right(
        "matched with the first scan",
        """
def walk(scans, steps, rounds):
    poses = [np.eye(3)]
    for scan, before, guess in zip(scans[1:], scans, steps):
        T = icp(scan, before, guess, rounds)
        poses.append(icp(scan, scans[0], poses[-1] @ T, rounds))
    return np.stack(poses)
""",
    ),
    Right(
        "matched in the map's frame",
        """
def walk(scans, steps, rounds):
    poses = [np.eye(3)]
    for i, guess in enumerate(steps):
        before = carry(poses[i], scans[i])
        poses.append(icp(scans[i + 1], before, poses[i] @ guess, rounds))
    return poses
""",
    ),
]
