"""Solutions of exercise 06 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

PREDICT = """
def predict(x, P, u, C):
    A, W = A_odometry(x[:3], u), W_odometry(x[:3], u)
    Q = {Q}
    x, P = x.copy(), P.copy()
    x[:3] = f_odometry(x[:3], u)
    {late}
    P[:3, :3] = {P_rr}
    P[:3, 3:] = {P_ri}
    P[3:, :3] = {P_ir}
    {after}
    return {result}
"""


def predict(**changes):
    parts = {
        "Q": "W @ C @ W.T",
        "late": "pass",
        "P_rr": "A @ P[:3, :3] @ A.T + Q",
        "P_ri": "A @ P[:3, 3:]",
        "P_ir": "P[:3, 3:].T",
        "after": "pass",
        "result": "x, P",
    }
    return PREDICT.format(**(parts | changes))


AUGMENT = """
def augment(x, P, z, R):
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    p = {p}
    row = {row}
    {turn}
    P_nn = {P_nn}
    P_grown = np.block([[P, {column}], [row, P_nn]])
    {after}
    return np.append(x, p), P_grown
"""


def augment(**changes):
    parts = {
        "p": "g(x[:3], z)",
        "row": "Jxr @ P[:3]",
        "turn": "pass",
        "P_nn": "Jxr @ P[:3, :3] @ Jxr.T + Jz @ R @ Jz.T",
        "column": "row.T",
        "after": "pass",
    }
    return AUGMENT.format(**(parts | changes))


H_FULL = """
def H_full(x, j):
    robot, at, p = {robot}, {at}, {p}
    H = np.zeros((2, len(x)))
    H[:, robot : robot + 3] = {H_r}
    H[:, at : at + 2] = {H_p}
    return H
"""


def H_full(**changes):
    parts = {
        "robot": "0",
        "at": "3 + 2 * j",
        "p": "x[3 + 2 * j : 5 + 2 * j]",
        "H_r": "H_robot(x[:3], p)",
        "H_p": "H_landmark(x[:3], p)",
    }
    return H_FULL.format(**(parts | changes))


UPDATE = """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    {wrap}
    H = H_full(x, j)
    S = {S}
    K = {K}
    {only}
    x = {x}
    P = {P}
    return x, P
"""


def update(**changes):
    parts = {
        "wrap": "v[1] = wrap(v[1])",
        "S": "H @ P @ H.T + R",
        "K": "P @ H.T @ np.linalg.inv(S)",
        "only": "pass",
        "x": "x + K @ v",
        "P": "P - K @ S @ K.T",
    }
    return UPDATE.format(**(parts | changes))


SLAM = """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids, had = list(ids), list(ids)
    {before}
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if {known}:
            {update}
        else:
            {augment}
            {keep}
    {after}
    return x, P, {ids}
"""


def slam(**changes):
    parts = {
        "before": "pass",
        "known": "i in ids",
        "update": "x, P = update(x, P, one, ids.index(i), R)",
        "augment": "x, P = augment(x, P, one, R)",
        "keep": "ids.append(i)",
        "after": "pass",
        "ids": "ids",
    }
    return SLAM.format(**(parts | changes))


APART = "P * (np.repeat([0, *range(1, len(P) // 2)], [3] + [2] * (len(P) // 2 - 1))[:, None]"
APART += " == np.repeat([0, *range(1, len(P) // 2)], [3] + [2] * (len(P) // 2 - 1)))"

ENDS = {"06-slam:pose", "06-slam:map", "06-slam:sure"}
MEANS = {"06-update:mean", "06-update:wrapped"}

WRONG = [
    # predict
    Wrong(
        "pose not moved",
        predict(late="x[:3] = before", Q="W @ C @ W.T; before = x[:3].copy()"),
        {"06-predict:mean"},
        "pose-stays",
    ),
    Wrong(
        "landmarks driven along",
        predict(after="x[3::2] += u[0]"),
        {"06-predict:mean"},
        "landmarks-moved",
    ),
    Wrong(
        "noise added to the whole map",
        predict(after="P[3:, 3:] += 1e-3 * np.eye(len(P) - 3)"),
        {"06-predict:map"},
        "map-changed",
    ),
    Wrong(
        "map multiplied too",
        predict(after="P[3:5, 3:5] = A[:2, :2] @ P[3:5, 3:5] @ A[:2, :2] + Q[:2, :2]"),
        {"06-predict:map"},
        "map-changed",
    ),
    Wrong("upper cross blocks only", predict(P_ir="P[3:, :3]"), {"06-predict:P_ri"}, "one-side"),
    Wrong(
        "lower cross blocks only",
        predict(P_ri="P[:3, 3:]", P_ir="P[3:, :3] @ A.T"),
        {"06-predict:P_ri"},
        "one-side",
    ),
    Wrong(
        "no A at all",
        predict(P_rr="P[:3, :3] + Q", P_ri="P[:3, 3:]"),
        {"P_rr", "P_ri"},
        "A-missing",
    ),
    Wrong("no noise", predict(Q="0"), {"06-predict:P_rr"}, "noise-missing"),
    Wrong(
        "A after the motion",
        predict(late="A = A_odometry(x[:3], u)"),
        {"P_rr", "P_ri"},
        "after-motion",
    ),
    Wrong(
        "A and W after the motion",
        predict(late="A, W = A_odometry(x[:3], u), W_odometry(x[:3], u); Q = W @ C @ W.T"),
        {"P_rr", "P_ri"},
        "after-motion",
    ),
    Wrong(
        "A transposed", predict(P_rr="A.T @ P[:3, :3] @ A + Q"), {"06-predict:P_rr"}, "A-transposed"
    ),
    Wrong(
        "A transposed everywhere",
        predict(P_rr="A.T @ P[:3, :3] @ A + Q", P_ri="A.T @ P[:3, 3:]"),
        {"P_rr", "P_ri"},
        "A-transposed",
    ),
    Wrong(
        "C added to x and y",
        predict(Q="np.pad(C, (0, 1))"),
        {"06-predict:P_rr"},
        "noise-not-carried",
    ),
    Wrong("C squared", predict(Q="W @ C @ C @ W.T"), {"06-predict:P_rr"}, "standard-deviation"),
    Wrong("cross blocks forgotten", predict(P_ri="P[:3, 3:]"), {"06-predict:P_ri"}, "cross-stays"),
    Wrong("cross blocks zero", predict(P_ri="0"), {"06-predict:P_ri"}, "cross-zero"),
    Wrong(
        "cross blocks by the transpose",
        predict(P_ri="A.T @ P[:3, 3:]"),
        {"06-predict:P_ri"},
        "cross-transposed",
    ),
    Wrong("predict returns P only", predict(result="P"), {"06-predict"}, None, "malformed"),
    Wrong("predict returns nothing", predict(result="None"), {"06-predict"}, None, "malformed"),
    Wrong(
        "predict returns the robot's part",
        predict(result="x[:3], P[:3, :3]"),
        {"06-predict"},
        None,
        "malformed",
    ),
    Wrong(
        "predict returns NaN", predict(after="P[0, 0] = np.nan"), {"06-predict"}, None, "malformed"
    ),
    Wrong(
        "predict not written",
        "def predict(x, P, u, C):\n    raise NotImplementedError",
        {"06-predict"},
        None,
        "not attempted",
    ),
    # augment
    Wrong(
        "old blocks changed",
        augment(after="P_grown[:3, :3] += Jxr.T @ R @ Jxr"),
        {"06-augment:old"},
        "old-changed",
    ),
    Wrong(
        "bearing without heading",
        augment(p="x[:2] + z[0] * np.array([np.cos(z[1]), np.sin(z[1])])"),
        {"06-augment:place"},
        "elsewhere",
    ),
    Wrong(
        "in the robot's frame",
        augment(p="z[0] * np.array([np.cos(z[1]), np.sin(z[1])])"),
        {"06-augment:place"},
        "elsewhere",
    ),
    Wrong("the sight itself appended", augment(p="z"), {"06-augment:place"}, "elsewhere"),
    Wrong("no cross terms", augment(row="np.zeros((2, len(x)))"), {"P_nr", "P_ni"}, "born-alone"),
    Wrong(
        "related to the robot only",
        augment(turn="row[:, 3:] = 0"),
        {"06-augment:P_ni"},
        "only-robot",
    ),
    Wrong("new columns zero", augment(column="0 * row.T"), {"P_nr", "P_ni"}, "one-side"),
    Wrong(
        "cross terms without the heading", augment(row="P[:2]"), {"P_nr", "P_ni"}, "heading-dropped"
    ),
    Wrong(
        "blocks transposed, as in (18)",
        augment(turn="row[:, 3:] = row[:, 3:].reshape(2, -1, 2).transpose(2, 1, 0).reshape(2, -1)"),
        {"06-augment:P_ni"},
        "blocks-turned",
    ),
    Wrong(
        "R added as it is",
        augment(P_nn="Jxr @ P[:3, :3] @ Jxr.T + R"),
        {"06-augment:P_nn"},
        "noise-not-carried",
    ),
    Wrong("no R", augment(P_nn="Jxr @ P[:3, :3] @ Jxr.T"), {"06-augment:P_nn"}, "noise-missing"),
    Wrong("no pose in P_nn", augment(P_nn="Jz @ R @ Jz.T"), {"06-augment:P_nn"}, "pose-missing"),
    Wrong(
        "J_z transposed",
        augment(P_nn="Jxr @ P[:3, :3] @ Jxr.T + Jz.T @ R @ Jz"),
        {"06-augment:P_nn"},
        "sandwich-reversed",
    ),
    Wrong(
        "R squared",
        augment(P_nn="Jxr @ P[:3, :3] @ Jxr.T + Jz @ R @ R @ Jz.T"),
        {"06-augment:P_nn"},
        "standard-deviation",
    ),
    Wrong(
        "P not grown",
        "def augment(x, P, z, R):\n    return np.append(x, g(x[:3], z)), P",
        {"06-augment"},
        None,
        "malformed",
    ),
    # H
    Wrong("(4.9) as printed", H_full(robot="2 * j"), {"robot", "others"}, "printed-4-9"),
    Wrong("one landmark too far", H_full(at="5 + 2 * j"), {"seen", "others"}, "off-by-one"),
    Wrong(
        "one landmark too near",
        H_full(at="1 + 2 * j"),
        {"06-h:seen"},
        "off-by-one",
        may_lose={"06-h:robot", "06-h:others"},
    ),
    Wrong(
        "the next landmark, place and all",
        H_full(at="5 + 2 * j", p="x[5 + 2 * j : 7 + 2 * j]"),
        {"06-h"},
        "off-by-one",
    ),
    Wrong("one column per landmark", H_full(at="3 + j"), {"seen", "others"}, "robot-not-counted"),
    Wrong(
        "one number per landmark",
        H_full(at="3 + j", p="x[3 + j : 5 + j]"),
        {"06-h"},
        "robot-not-counted",
    ),
    Wrong(
        "robot not counted, place and all",
        H_full(at="2 * j", p="x[2 * j : 2 + 2 * j]"),
        {"06-h"},
        "robot-not-counted",
        may_lose={"06-h:robot", "06-h:others"},
    ),
    Wrong(
        "robot's columns not counted",
        H_full(at="2 * j"),
        {"06-h:seen"},
        "robot-not-counted",
        may_lose={"06-h:robot", "06-h:others"},
    ),
    Wrong(
        "landmark's part with the robot's sign",
        H_full(H_p="H_robot(x[:3], p)[:, :2]"),
        {"06-h:seen"},
        "sign",
    ),
    Wrong("a known map", H_full(H_p="0"), {"06-h:seen"}, "landmark-missing"),
    Wrong("a known pose", H_full(H_r="0"), {"06-h:robot"}, "robot-missing"),
    Wrong(
        "at the next landmark's place",
        H_full(p="x[5 + 2 * j : 7 + 2 * j]"),
        {"robot", "seen"},
        "wrong-landmark",
    ),
    Wrong(
        "H transposed",
        "def H_full(x, j):\n    return np.zeros((len(x), 2))",
        {"06-h"},
        None,
        "malformed",
    ),
    Wrong(
        "H of robot and landmark only",
        "def H_full(x, j):\n    p = x[3 + 2 * j : 5 + 2 * j]\n"
        "    return np.hstack([H_robot(x[:3], p), H_landmark(x[:3], p)])",
        {"06-h"},
        None,
        "malformed",
    ),
    # update
    Wrong("(15) as printed", update(x="K @ v"), MEANS, "printed-15"),
    Wrong("x minus K v", update(x="x - K @ v"), MEANS, "sign"),
    Wrong(
        "predicted minus measured",
        update(wrap="v = h(x[:3], x[3 + 2 * j : 5 + 2 * j]) - z; v[1] = wrap(v[1])"),
        MEANS,
        "sign",
    ),
    Wrong("gain without S", update(x="x + P @ H.T @ v"), MEANS, "S-missing"),
    Wrong("gain without S, used throughout", update(K="P @ H.T"), {"06-update"}, "S-missing"),
    Wrong("S without R", update(S="H @ P @ H.T"), {"06-update"}, "R-missing"),
    Wrong(
        "S without cross blocks", update(S=f"H @ ({APART}) @ H.T + R"), {"06-update"}, "kept-apart"
    ),
    Wrong(
        "kept apart",
        update(S=f"H @ ({APART}) @ H.T + R", K=f"({APART}) @ H.T @ np.linalg.inv(S)"),
        {"06-update"},
        "kept-apart",
    ),
    Wrong("x not updated", update(x="x.copy()"), MEANS, "x-stays"),
    Wrong(
        "robot and landmark only",
        update(only="K = K * (np.abs(H).max(axis=0) > 0)[:, None]"),
        {"06-update"},
        "some-rows-only",
    ),
    Wrong("robot only", update(only="K[3:] = 0"), {"06-update"}, "some-rows-only"),
    Wrong("map only", update(only="K[:3] = 0"), {"06-update"}, "some-rows-only"),
    Wrong("bearing not wrapped", update(wrap="pass"), {"06-update:wrapped"}, "unwrapped"),
    Wrong("P not updated", update(P="P.copy()"), {"06-update:P"}, "P-stays"),
    Wrong("P grows", update(P="P + K @ S @ K.T"), {"06-update:P"}, "P-sign"),
    Wrong(
        "S inverted between the gains",
        update(P="P - K @ np.linalg.inv(S) @ K.T"),
        {"06-update:P"},
        "S-inverse",
    ),
    Wrong("S missing between the gains", update(P="P - K @ K.T"), {"06-update:P"}, "S-inverse"),
    Wrong(
        "Joseph's form without R",
        update(P="(np.eye(len(x)) - K @ H) @ P @ (np.eye(len(x)) - K @ H).T"),
        {"06-update:P"},
        "half-of-joseph",
    ),
    Wrong(
        "only the robot's block of P",
        update(P="np.block([[(P - K @ S @ K.T)[:3, :3], P[:3, 3:]], [P[3:, :3], P[3:, 3:]]])"),
        {"06-update:P"},
        "P-in-part",
    ),
    Wrong(
        "cross blocks thrown away",
        update(P=f"({APART.replace('P * (', '(P - K @ S @ K.T) * (', 1)})"),
        {"06-update:P"},
        "cross-zero",
    ),
    Wrong(
        "robot and map unlinked",
        update(P="P - K @ S @ K.T; P[:3, 3:] = P[3:, :3] = 0"),
        {"06-update:P"},
        "cross-zero",
    ),
    Wrong("P not symmetric", update(P="P - np.triu(K @ S @ K.T)"), {"06-update:P"}, "P-in-part"),
    Wrong(
        "update returns x only",
        "def update(x, P, z, j, R):\n    return x",
        {"06-update"},
        None,
        "malformed",
    ),
    Wrong("update returns complex", update(x="x + K @ v + 0j"), {"06-update"}, None, "malformed"),
    Wrong("update raises", update(x="x + K @ v[:1]"), {"06-update"}, None, "raised"),
    # the whole filter
    Wrong("ids not kept", slam(keep="pass"), {"06-slam"}, "ids-behind"),
    Wrong("augmented again and again", slam(known="False"), {"06-slam"}, "re-augmented"),
    Wrong(
        "asks whether the id is below the count",
        slam(known="i < len(ids)"),
        {"06-slam"},
        "re-augmented",
    ),
    Wrong("first of a scan only", slam(before="seen = seen[:1]"), {"06-slam"}, "too-few"),
    Wrong("newest id first", slam(keep="ids.insert(0, i)"), ENDS, "far-off"),
    Wrong(
        "ids sorted",
        slam(ids="sorted(ids)"),
        {"06-slam:map", "06-slam:sure"},
        "far-off",
        may_lose={"06-slam:pose"},
    ),
    Wrong(
        "first sight for all",
        slam(before="z = [z[0]] * len(z) if len(z) else z"),
        ENDS,
        "far-off",
    ),
    Wrong(
        "placed before the drive",
        slam(
            before="""for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)""",
            known="i in had",
            augment="pass",
            keep="pass",
        ),
        ENDS,
        "placed-too-early",
    ),
    Wrong(
        "placed before the drive, and all updated after it",
        slam(
            before="""for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)""",
            augment="pass",
            keep="pass",
        ),
        ENDS,
        "placed-too-early",
    ),
    Wrong(
        "updated before the drive",
        slam(
            before="""for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)""",
            known="i in had",
            update="pass",
        ),
        ENDS,
        "predicted-last",
    ),
    Wrong(
        "predicted within the loop",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    for i, one in zip(seen, z):
        x, P = predict(x, P, u, C)
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
        ENDS,
        "predicted-for-each",
    ),
    Wrong(
        "predicted at the end",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
        {"06-slam:map", "06-slam:sure"},
        "predicted-last",
        may_lose={"06-slam:pose"},
    ),
    Wrong("never updated", slam(update="pass"), {"06-slam:sure"}, "never-updated"),
    Wrong(
        "never predicted",
        slam(before="drive, u, C = u, 0 * u, 0 * C"),
        {"06-slam:pose", "06-slam:map", "06-slam:sure"},
        "never-predicted",
    ),
    Wrong(
        "new ones updated as well",
        slam(keep="ids.append(i); x, P = update(x, P, one, ids.index(i), R)"),
        {"06-slam:sure"},
        "counted-twice",
        may_lose={"06-slam:map"},
    ),
    Wrong(
        "predicted once for each",
        slam(update="x, P = predict(x, P, u, C); x, P = update(x, P, one, ids.index(i), R)"),
        ENDS,
        "predicted-for-each",
    ),
    Wrong(
        "slam_step without ids",
        "def slam_step(x, P, ids, u, seen, z, C, R):\n    return x, P",
        {"06-slam"},
        None,
        "malformed",
    ),
    Wrong(
        "id taken for the index",
        slam(update="x, P = update(x, P, one, i, R)"),
        {"06-slam"},
        None,
        "raised",
    ),
    Wrong("x returned twice", slam(after="P = x"), {"06-slam"}, None, "malformed"),
]

RIGHT = [
    Right(
        "F P Fᵀ in full",
        """
def predict(x, P, u, C):
    n = len(x)
    F, G = np.eye(n), np.zeros((n, 2))
    F[:3, :3], G[:3] = A_odometry(x[:3], u), W_odometry(x[:3], u)
    return np.append(f_odometry(x[:3], u), x[3:]), F @ P @ F.T + G @ C @ G.T
""",
    ),
    Right(
        "predict in place",
        """
def predict(x, P, u, C):
    A, W = A_odometry(x, u), W_odometry(x, u)
    x[:3] = f_odometry(x, u)
    P[:3] = A @ P[:3]
    P[:, :3] = P[:, :3] @ A.T
    P[:3, :3] += W @ C @ W.T
    return x, P
""",
    ),
    Right(
        "predict in loops, heading not wrapped",
        """
def predict(x, P, u, C):
    A, W = A_odometry(x[:3], u), W_odometry(x[:3], u)
    new = P.copy()
    new[:3, :3] = A @ P[:3, :3] @ A.T + W @ C @ W.T
    for j in range(3, len(x), 2):
        new[:3, j : j + 2] = A @ P[:3, j : j + 2]
        new[j : j + 2, :3] = P[j : j + 2, :3] @ A.T
    moved = [x[0] + u[0] * np.cos(x[2]), x[1] + u[0] * np.sin(x[2]), x[2] + u[1]]
    return np.array(moved + list(x[3:])), new
""",
    ),
    Right(
        "Jacobians by differences",
        """
def predict(x, P, u, C):
    f = lambda s: np.append(f_odometry(s[:3], s[-2:]), s[3:-2])
    s, e = np.append(x, u), 1e-6
    J = np.column_stack([(f(s + d) - f(s)) / e for d in e * np.eye(len(s))])
    full = np.zeros((len(s), len(s)))
    full[:-2, :-2], full[-2:, -2:] = P, C
    return f(s), J @ full @ J.T
""",
    ),
    Right(
        "augment by one Jacobian",
        """
def augment(x, P, z, R):
    n = len(x)
    G = np.zeros((n + 2, n + 2))
    G[:n, :n], G[n:, :3], G[n:, n:] = np.eye(n), J_xr(x, z), J_z(x, z)
    full = np.zeros((n + 2, n + 2))
    full[:n, :n], full[n:, n:] = P, R
    return np.concatenate([x, g(x, z)]), G @ full @ G.T
""",
    ),
    Right(
        "augment block by block, as a list",
        """
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
    ),
    Right(
        "H by differences",
        """
def H_full(x, j):
    f = lambda s: h(s[:3], s[3 + 2 * j : 5 + 2 * j])
    return np.column_stack([
        [(a - b) / 2e-6 if k == 0 else wrap(a - b) / 2e-6 for k, (a, b) in
         enumerate(zip(f(x + e), f(x - e)))]
        for e in 1e-6 * np.eye(len(x))
    ])
""",
    ),
    Right(
        "H by a selection matrix",
        """
def H_full(x, j):
    F = np.zeros((5, len(x)))
    F[:3, :3], F[3:, 3 + 2 * j : 5 + 2 * j] = np.eye(3), np.eye(2)
    s = F @ x
    return np.hstack([H_robot(s[:3], s[3:]), H_landmark(s[:3], s[3:])]) @ F
""",
    ),
    Right(
        "Joseph's form and solve",
        update(
            K="np.linalg.solve(S, H @ P).T",
            P="(np.eye(len(x)) - K @ H) @ P @ (np.eye(len(x)) - K @ H).T + K @ R @ K.T",
        ),
    ),
    Right("(I − K H) P", update(P="(np.eye(len(x)) - K @ H) @ P")),
    Right(
        "by information",
        """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = wrap(v[1])
    H, Y = H_full(x, j), np.linalg.inv(P)
    P = np.linalg.inv(Y + H.T @ np.linalg.inv(R) @ H)
    return x + P @ H.T @ np.linalg.inv(R) @ v, P
""",
    ),
    Right(
        "Cholesky, wrapped by atan2, in place",
        """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    H = H_full(x, j)
    root = np.linalg.cholesky(H @ P @ H.T + R)
    B = np.linalg.solve(root, H @ P).T
    x += B @ np.linalg.solve(root, v)
    P -= B @ B.T
    x[2] = np.arctan2(np.sin(x[2]), np.cos(x[2]))
    return x, P
""",
    ),
    Right(
        "known ones first, new ones then",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    known = [i in ids for i in seen]
    for i, one, old in zip(seen, z, known):
        if old:
            x, P = update(x, P, one, ids.index(i), R)
    for i, one, old in zip(seen, z, known):
        if not old:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    Right(
        "one batch update of the scan",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    old = [k for k, i in enumerate(seen) if i in ids]
    if old:
        js = [ids.index(seen[k]) for k in old]
        H = np.vstack([H_full(x, j) for j in js])
        v = np.array([z[k] - h(x[:3], x[3 + 2 * j : 5 + 2 * j]) for k, j in zip(old, js)])
        v[:, 1] = wrap(v[:, 1])
        S = H @ P @ H.T + np.kron(np.eye(len(js)), R)
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v.ravel(), P - K @ S @ K.T
    for k, i in enumerate(seen):
        if k not in old:
            x, P = augment(x, P, z[k], R)
            ids = ids + [i]
    return x, P, np.array(ids)
""",
    ),
    Right(
        "new ones first, then the known",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    known = list(ids)
    for i, one in zip(seen, z):
        if i not in known:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    for i, one in zip(seen, z):
        if i in known:
            x, P = update(x, P, one, ids.index(i), R)
    return x, P, tuple(ids)
""",
    ),
]
