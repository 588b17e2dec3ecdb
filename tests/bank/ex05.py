"""Solutions of exercise 05 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

PREDICT = """
def predict(x, P, u, C):
    {before}
    A, W = {jacobians}
    moved = {moved}
    P = {P}
    return {result}
"""


def predict(**changes):
    parts = {
        "before": "pass",
        "jacobians": "A_odometry(x, u), W_odometry(x, u)",
        "moved": "f_odometry(x, u)",
        "P": "A @ P @ A.T + W @ C @ W.T",
        "result": "moved, P",
    }
    return PREDICT.format(**(parts | changes))


UPDATE = """
def {head}:
    v = {v}
    {wrap}
    H = {H}
    S = {S}
    K = {K}
    P_after = {P}
    return {result}
"""


def update(state, head, H, changes):
    parts = {
        "head": head,
        "v": "z - h(x, p)",
        "wrap": "v[1] = wrap(v[1])",
        "H": H,
        "S": "H @ P @ H.T + R",
        "K": "P @ H.T @ np.linalg.inv(S)",
        "P": "P - K @ S @ K.T",
        "result": f"{state} + K @ v, P_after",
    }
    return UPDATE.format(**(parts | changes))


def locate(**changes):
    return update("x", "locate(x, P, z, p, R)", "H_robot(x, p)", changes)


def landmark(**changes):
    return update("p", "update_landmark(p, P, x, z, R)", "H_landmark(x, p)", changes)


LOCALISE = """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    x0, P0 = x, P
    for k in range(len(drives)):
        {drive}
        {look}
        xs.append(x)
        Ps.append(P)
    return {result}
"""


def localise(**changes):
    parts = {
        "drive": "x, P = predict(x, P, drives[k], C)",
        "look": "x, P = locate(x, P, zs[k], landmarks[ids[k]], R) if ids[k] >= 0 else (x, P)",
        "result": "np.array(xs), np.array(Ps)",
    }
    return LOCALISE.format(**(parts | changes))


MAP = """
def build_map(xs, ids, zs, R):
    beliefs = {{}}
    for k, id in enumerate(ids):
        x, z = {seen}
        if {new}:
            J = J_z(x, z)
            beliefs[id] = g(x, z), {P}
            {then}
        else:
            {again}
    return {result}
"""


def build_map(**changes):
    parts = {
        "seen": "xs[k], zs[k]",
        "new": "id not in beliefs",
        "P": "J @ R @ J.T",
        "then": "pass",
        "again": "beliefs[id] = update_landmark(*beliefs[id], x, z, R)",
        "result": "beliefs",
    }
    return MAP.format(**(parts | changes))


P_OF_DRIVE = {"05-predict:covariance"}
MEANS = {"mean", "behind"}
BAD_K = {"mean", "behind", "covariance"}
UNSEEN, CLOSE, FITS = "05-localise:unseen", "05-localise:close", "05-localise:consistent"
FIRST, AGAIN, APART = "05-map:first", "05-map:again", "05-map:apart"


def both_updates(name, loses, diagnosis, problem=None, **changes):
    """The same mistake in the update of a pose and in that of a landmark."""

    def of(state):
        return {key: text.replace("STATE", state) for key, text in changes.items()}

    return [
        Wrong(f"{name}, pose", locate(**of("x")), loses, diagnosis, problem),
        Wrong(f"{name}, landmark", landmark(**of("p")), loses, diagnosis, problem),
    ]


def blunders(name, wrong, task, of):
    """What is no mistake of the subject: nothing returned, a wrong shape, NaN, half of it."""
    return [
        Wrong(f"{name} returns nothing", wrong(result="None"), {task}, None, "malformed"),
        Wrong(f"{name} returns the mean alone", wrong(result=of), {task}, None, "malformed"),
        Wrong(f"{name} returns NaN", wrong(result=f"{of} * np.nan, P"), {task}, None, "malformed"),
        Wrong(f"{name} returns rows", wrong(result=f"{of}[None], P"), {task}, None, "malformed"),
        Wrong(f"{name} fails", wrong(result="undefined"), {task}, None, "raised"),
    ]


WRONG = [
    *blunders("predict", predict, "05-predict", "moved"),
    *blunders("locate", locate, "05-locate", "x"),
    *blunders("update_landmark", landmark, "05-landmark", "p"),
    *blunders("localise", localise, "05-localise", "np.array(xs)"),
    # predict
    Wrong("pose not moved", predict(moved="x"), {"05-predict:mean"}, "not-moved"),
    Wrong(
        "turned before it drives",
        predict(moved="f_odometry(x + [0, 0, u[1]], u * [1, 0])"),
        {"05-predict:mean"},
        "turned-first",
    ),
    Wrong(
        "lesson 05's arc, mean alone",
        predict(moved="f_odometry(x + [0, 0, u[1] / 2], u) - [0, 0, u[1] / 2]"),
        {"05-predict:mean"},
        "arc",
    ),
    Wrong(
        "lesson 05's arc",
        """
def predict(x, P, u, C):
    d, turn = u
    c, s = np.cos(x[2] + turn / 2), np.sin(x[2] + turn / 2)
    A = np.array([[1, 0, -d * s], [0, 1, d * c], [0, 0, 1]])
    W = np.array([[c, -d / 2 * s], [s, d / 2 * c], [0, 1]])
    return x + np.array([d * c, d * s, turn]), A @ P @ A.T + W @ C @ W.T
""",
        {"05-predict:mean", "05-predict:covariance"},
        "arc",
    ),
    Wrong(
        "Jacobians after the drive",
        predict(jacobians="A_odometry(f_odometry(x, u), u), W_odometry(f_odometry(x, u), u)"),
        P_OF_DRIVE,
        "jacobian-after",
    ),
    Wrong(
        "A after the drive",
        predict(jacobians="A_odometry(f_odometry(x, u), u), W_odometry(x, u)"),
        P_OF_DRIVE,
        "jacobian-after",
    ),
    Wrong(
        "W after the drive",
        predict(jacobians="A_odometry(x, u), W_odometry(f_odometry(x, u), u)"),
        P_OF_DRIVE,
        "jacobian-after",
    ),
    Wrong("no Q", predict(P="A @ P @ A.T"), P_OF_DRIVE, "noise-forgotten"),
    Wrong(
        "C added to x and y",
        predict(P="A @ P @ A.T + np.diag([C[0, 0], C[1, 1], 0])"),
        P_OF_DRIVE,
        "noise-not-carried",
    ),
    Wrong(
        "C added to x and θ",
        predict(P="A @ P @ A.T + np.diag([C[0, 0], 0, C[1, 1]])"),
        P_OF_DRIVE,
        "noise-not-carried",
    ),
    Wrong(
        "C's distance added to x and y",
        predict(P="A @ P @ A.T + np.diag([C[0, 0], C[0, 0], C[1, 1]])"),
        P_OF_DRIVE,
        "noise-not-carried",
    ),
    Wrong(
        "root of C",
        predict(P="A @ P @ A.T + W @ np.sqrt(C) @ W.T"),
        P_OF_DRIVE,
        "standard-deviation",
    ),
    Wrong("C squared", predict(P="A @ P @ A.T + W @ C**2 @ W.T"), P_OF_DRIVE, "standard-deviation"),
    Wrong("Aᵀ P A", predict(P="A.T @ P @ A + W @ C @ W.T"), P_OF_DRIVE, "transposed"),
    Wrong("P not driven", predict(P="P + W @ C @ W.T"), P_OF_DRIVE, "not-levered"),
    Wrong("Q taken off", predict(P="A @ P @ A.T - W @ C @ W.T"), P_OF_DRIVE, "noise-subtracted"),
    Wrong("A P without Aᵀ", predict(P="A @ P + W @ C @ W.T"), P_OF_DRIVE),
    Wrong("Wᵀ C W", predict(P="A @ P @ A.T + W.T @ C @ W"), {"05-predict"}, None, "raised"),
    # the two updates
    *both_updates("not wrapped", {"behind"}, "unwrapped", wrap="pass"),
    *both_updates("bearing from 0 to 2π", MEANS, "from-zero", wrap="v[1] %= 2 * np.pi"),
    *both_updates(
        "wrapped as if in degrees", {"behind"}, "unwrapped", wrap="v[1] = (v[1] + 180) % 360 - 180"
    ),
    *both_updates("predicted minus measured", MEANS, "sign", v="h(x, p) - z"),
    *both_updates("correction taken off", MEANS, "sign", result="STATE - K @ v, P_after"),
    *both_updates("bearing in degrees", MEANS, "degrees", wrap="v[1] = np.degrees(wrap(v[1]))"),
    *both_updates("gain without S⁻¹", BAD_K, "no-S", K="P @ H.T"),
    *both_updates("S without R", BAD_K, "R-forgotten", S="H @ P @ H.T"),
    *both_updates("root of R", BAD_K, "standard-deviation", S="H @ P @ H.T + np.sqrt(R)"),
    *both_updates("R squared", BAD_K, "standard-deviation", S="H @ P @ H.T + R @ R"),
    *both_updates("correction alone", MEANS, "correction-only", result="K @ v, P_after"),
    *both_updates("P as it was", {"covariance"}, "P-not-updated", P="P"),
    *both_updates("P grows", {"covariance"}, "P-added", P="P + K @ S @ K.T"),
    *both_updates(
        "S⁻¹ between the gains", {"covariance"}, "S-inverted", P="P - K @ np.linalg.inv(S) @ K.T"
    ),
    *both_updates("P − K H", {"covariance"}, "P-missing", P="P - K @ H"),
    *both_updates("I − K H", {"covariance"}, "P-missing", P="np.eye(len(P)) - K @ H"),
    *both_updates(
        "half of Joseph's form",
        {"covariance"},
        "half-of-joseph",
        P="(np.eye(len(P)) - K @ H) @ P @ (np.eye(len(P)) - K @ H).T",
    ),
    Wrong("K S K", locate(P="P - K @ S @ K"), {"05-locate"}, None, "raised"),
    Wrong("H transposed, pose", locate(H="H_robot(x, p).T"), {"05-locate"}, None, "raised"),
    Wrong("landmark's H for the pose", locate(H="H_landmark(x, p)"), {"05-locate"}, None, "raised"),
    Wrong(
        "robot's H for the landmark", landmark(H="H_robot(x, p)"), {"05-landmark"}, None, "raised"
    ),
    Wrong("robot's H, cut", landmark(H="H_robot(x, p)[:, :2]"), MEANS, "sign"),
    Wrong("H transposed, landmark", landmark(H="H_landmark(x, p).T"), BAD_K, "H-transposed"),
    Wrong("J_z for H", landmark(H="J_z(x, z)"), BAD_K, "J_z-for-H"),
    Wrong("J_z at the belief for H", landmark(H="J_z(x, h(x, p))"), BAD_K, "J_z-for-H"),
    Wrong(
        "placed anew",
        landmark(result="g(x, z), J_z(x, z) @ R @ J_z(x, z).T"),
        BAD_K,
        "overwritten",
    ),
    Wrong("mean placed anew", landmark(result="g(x, z), P_after"), MEANS, "overwritten"),
    Wrong(
        "P as at first sight",
        landmark(P="J_z(x, z) @ R @ J_z(x, z).T"),
        {"covariance"},
        "first-sight",
    ),
    # localise
    Wrong(
        "one step late",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, id, z in zip(drives, ids, zs):
        xs.append(x)
        Ps.append(P)
        x, P = predict(x, P, u, C)
        if id >= 0:
            x, P = locate(x, P, z, landmarks[id], R)
    return np.array(xs), np.array(Ps)
""",
        {UNSEEN, CLOSE, FITS},
        "one-behind",
    ),
    Wrong(
        "looks before it drives",
        localise(
            drive="x, P = locate(x, P, zs[k], landmarks[ids[k]], R) if ids[k] >= 0 else (x, P)",
            look="x, P = predict(x, P, drives[k], C)",
        ),
        {CLOSE, FITS},
        "look-first",
    ),
    Wrong("eyes shut", localise(look="pass"), {CLOSE, FITS}, "drives-only"),
    Wrong(
        "landmark 0 ignored",
        localise(look="x, P = locate(x, P, zs[k], landmarks[ids[k]], R) if ids[k] > 0 else (x, P)"),
        {CLOSE, FITS},
        "zero-skipped",
    ),
    Wrong(
        "last landmark ignored",
        localise(
            look="x, P = locate(x, P, zs[k], landmarks[ids[k]], R) "
            "if 0 <= ids[k] < len(landmarks) - 1 else (x, P)"
        ),
        {CLOSE, FITS},
        "sighting-skipped",
    ),
    Wrong(
        "every second sighting skipped",
        localise(
            look="x, P = locate(x, P, zs[k], landmarks[ids[k]], R) "
            "if ids[k] >= 0 and k % 2 else (x, P)"
        ),
        {CLOSE, FITS},
        "sighting-skipped",
    ),
    Wrong(
        "id taken for a truth value",
        localise(look="x, P = locate(x, P, zs[k], landmarks[ids[k]], R) if ids[k] else (x, P)"),
        {UNSEEN, CLOSE, FITS},
        "id-as-truth",
    ),
    Wrong(
        "z by id instead of step",
        localise(
            look="x, P = locate(x, P, zs[ids[k]], landmarks[ids[k]], R) if ids[k] >= 0 else (x, P)"
        ),
        {CLOSE, FITS},
        "z-by-id",
    ),
    Wrong(
        "one array changed in place",
        localise(
            look="""
        if ids[k] >= 0:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        x0[:], P0[:] = x, P
        x, P = x0, P0
"""
        ),
        {UNSEEN, CLOSE, FITS},
        "aliased",
    ),
    Wrong(
        "predict changes its pose in place",
        predict(moved="np.add(f_odometry(x, u), 0, out=x)") + localise(),
        {UNSEEN, CLOSE, FITS},
        "aliased",
    ),
    Wrong(
        "−1 taken for a landmark",
        localise(look="x, P = locate(x, P, zs[k], landmarks[ids[k]], R)"),
        {UNSEEN, CLOSE, FITS},
        "minus-one-seen",
    ),
    Wrong(
        "no drive where nothing is seen",
        localise(drive="x, P = predict(x, P, drives[k], C) if ids[k] >= 0 else (x, P)"),
        {UNSEEN, CLOSE, FITS},
        "blind-drive-lost",
    ),
    Wrong(
        "rows left out where nothing is seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, id, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if id < 0:
            continue
        x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
        {"05-localise"},
        None,
        "malformed",
    ),
    Wrong(
        "first P in every step",
        localise(drive="x, P = predict(x, P0, drives[k], C)"),
        {FITS},
        "covariance-restarted",
        may_lose={CLOSE},
    ),
    Wrong(
        "first pose and P in every step",
        localise(drive="x, P = predict(x0, P0, drives[k], C)"),
        {UNSEEN, CLOSE, FITS},
        "pose-restarted",
    ),
    Wrong(
        "P of the sighting thrown away",
        localise(
            look="x, _ = locate(x, P, zs[k], landmarks[ids[k]], R) if ids[k] >= 0 else (x, P)"
        ),
        {FITS},
        "sighting-keeps-P",
        may_lose={CLOSE},
    ),
    Wrong(
        "P of the drive thrown away",
        localise(drive="x, _ = predict(x, P, drives[k], C)"),
        {FITS},
        "drive-keeps-P",
        may_lose={CLOSE},
    ),
    Wrong(
        "landmark by step instead of id",
        localise(look="x, P = locate(x, P, zs[k], landmarks[k], R)"),
        {"05-localise"},
        None,
        "raised",
    ),
    Wrong("last belief alone", localise(result="x, P"), {"05-localise"}, None, "malformed"),
    # the map
    Wrong("R as the first P", build_map(P="R"), {FIRST, AGAIN}, "R-for-P"),
    Wrong(
        "first sighting counted twice",
        build_map(then="beliefs[id] = update_landmark(*beliefs[id], x, z, R)"),
        {FIRST, AGAIN},
        "counted-twice",
    ),
    Wrong("placed anew each time", build_map(new="True"), {AGAIN}, "overwritten"),
    Wrong("never corrected", build_map(again="pass"), {AGAIN}, "first-only"),
    Wrong(
        "P never corrected",
        build_map(again="beliefs[id] = update_landmark(*beliefs[id], x, z, R)[0], beliefs[id][1]"),
        {AGAIN},
        "P-kept",
    ),
    Wrong(
        "all corrected by every sighting",
        build_map(again="beliefs = {i: update_landmark(*b, x, z, R) for i, b in beliefs.items()}"),
        {FIRST, AGAIN, APART},
        "all-updated",
    ),
    Wrong(
        "all seen from the first pose",
        build_map(seen="xs[0], zs[k]"),
        {FIRST, AGAIN},
        "pose-of-start",
        may_lose={APART},
    ),
    Wrong(
        "list instead of dict",
        build_map(result="list(beliefs.values())"),
        {"05-map"},
        None,
        "malformed",
    ),
    Wrong("no map at all", build_map(result="None"), {"05-map"}, None, "malformed"),
    Wrong(
        "means only",
        build_map(result="{i: b[0] for i, b in beliefs.items()}"),
        {"05-map"},
        None,
        "malformed",
    ),
    Wrong(
        "ids counted from 0",
        build_map(result="dict(enumerate(beliefs.values()))"),
        {"05-map"},
        None,
        "malformed",
    ),
    Wrong("J_zᵀ R J_z", build_map(P="J.T @ R @ J"), {FIRST, AGAIN}, None),
]

JOSEPH = "(np.eye(len(P)) - K @ H) @ P @ (np.eye(len(P)) - K @ H).T + K @ R @ K.T"
SOLVED = "np.linalg.solve(S, H @ P).T"
BY_SINE = "v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))"

RIGHT = [
    Right(
        "drive written out, heading not wrapped",
        predict(
            moved="np.array([x[0] + u[0] * np.cos(x[2]), x[1] + u[0] * np.sin(x[2]), x[2] + u[1]])"
        ),
    ),
    Right(
        "sums in place of products",
        predict(
            P="np.einsum('ij,jk,lk->il', A, P, A) + sum(C[k, k] * np.outer(W[:, k], W[:, k]) "
            "for k in range(2))"
        ),
    ),
    Right(
        "joint covariance of pose and drive",
        """
def predict(x, P, u, C):
    J = np.hstack([A_odometry(x, u), W_odometry(x, u)])
    joint = np.zeros((5, 5))
    joint[:3, :3], joint[3:, 3:] = P, C
    return list(f_odometry(x, u)), (J @ joint @ J.T).tolist()
""",
    ),
    Right(
        "argument overwritten, drive",
        """
def predict(x, P, u, C):
    A, W = A_odometry(x, u), W_odometry(x, u)
    x[:] = f_odometry(x, u)
    P[:] = A @ P @ A.T + W @ C @ W.T
    return x, P


def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, id, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x.copy())
        Ps.append(P.copy())
    return xs, Ps
""",
    ),
    Right(
        "differences for A and W",
        """
def predict(x, P, u, C):
    def slopes(f, at):
        return np.column_stack(
            [wrapped(f(at + e) - f(at - e)) / 2e-6 for e in 1e-6 * np.eye(len(at))]
        )

    def wrapped(pose):
        return np.array([pose[0], pose[1], wrap(pose[2])])

    A, W = slopes(lambda a: f_odometry(a, u), x), slopes(lambda a: f_odometry(x, a), u)
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T
""",
    ),
    *(
        Right(f"{name}, {which}", of(**changes))
        for which, of in (("pose", locate), ("landmark", landmark))
        for name, changes in {
            "Joseph's form": {"P": JOSEPH},
            "solve for the gain": {"K": SOLVED, "wrap": BY_SINE},
            "(I − K H) P": {"P": "(np.eye(len(P)) - K @ H) @ P"},
            "P − P Hᵀ S⁻¹ H P": {"P": "P - P @ H.T @ np.linalg.solve(S, H @ P)"},
            "information": {
                "P": "np.linalg.inv(np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H)",
                "wrap": "v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi",
            },
        }.items()
    ),
    Right(
        "range and bearing one after the other",
        """
def locate(x, P, z, p, R):
    at, here = x.copy(), x.copy()
    H = H_robot(at, p)
    v = z - h(at, p)
    v[1] = wrap(v[1])
    for k in range(2):
        s = H[k] @ P @ H[k] + R[k, k]
        K = P @ H[k] / s
        here = here + K * (v[k] - H[k] @ (here - at))
        P = P - np.outer(K, K) * s
    return here, P
""",
    ),
    Right(
        "heading wrapped",
        locate(result="np.array([*(x + K @ v)[:2], wrap((x + K @ v)[2])]), P_after"),
    ),
    Right("argument overwritten, sighting", locate(v="np.subtract(z, h(x, p), out=z)")),
    Right(
        "landmark by least squares",
        """
def update_landmark(p, P, x, z, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    L_P, L_R = np.linalg.cholesky(np.linalg.inv(P)).T, np.linalg.cholesky(np.linalg.inv(R)).T
    M = np.vstack([L_P, L_R @ H_landmark(x, p)])
    step = np.linalg.lstsq(M, np.concatenate([np.zeros(2), L_R @ v]), rcond=None)[0]
    return p + step, np.linalg.inv(M.T @ M)
""",
    ),
    Right(
        "run by indices, arrays filled",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    n = len(ids)
    xs, Ps = np.zeros((n, 3)), np.zeros((n, 3, 3))
    for k in range(n):
        x, P = predict(x, P, drives[k], C)
        if ids[k] != -1:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
    Right("run as lists", localise(result="xs, Ps")),
    Right(
        "run with symmetry kept",
        localise(
            look="""
        if ids[k] >= 0:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
            P = (P + P.T) / 2
"""
        ),
    ),
    Right(
        "map by landmark, not by time",
        """
def build_map(xs, ids, zs, R):
    beliefs = {}
    for id in set(ids.tolist()):
        first, *later = np.flatnonzero(ids == id)
        J = J_z(xs[first], zs[first])
        belief = g(xs[first], zs[first]), J @ R @ J.T
        for k in later:
            belief = update_landmark(*belief, xs[k], zs[k], R)
        beliefs[id] = belief
    return beliefs
""",
    ),
    Right(
        "map from vague beginnings",
        build_map(
            P="1e4 * np.eye(2)", then=("beliefs[id] = update_landmark(*beliefs[id], x, z, R)")
        ),
    ),
    Right(
        "map of lists",
        build_map(
            again="beliefs[id] = [part.tolist() for part in "
            "update_landmark(*map(np.array, beliefs[id]), x, z, R)]"
        ),
    ),
    Right(
        "H inverted at first sight",
        build_map(
            P="np.linalg.inv(H_landmark(x, g(x, z))) @ R @ np.linalg.inv(H_landmark(x, g(x, z))).T"
        ),
    ),
]
