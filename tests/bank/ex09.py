"""Solutions of exercise 09 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

PLACE = """
def place(x, P, z, R):
    {before}
    alpha = {alpha}
    c, s = np.cos(alpha), np.sin(alpha)
    rho = {rho}
    lever = -x[0] * s + x[1] * c
    J_x = np.array([[{cx}, {sx}, {lever_x}], [0, 0, 1]])
    J_z = np.array([[1, {lever_z}], [0, 1]])
    C, X = {C}, {X}
    line = np.array([rho, alpha])
    {after}
    return {result}
"""


def place(**changes):
    parts = {
        "before": "pass",
        "alpha": "wrap(x[2] + z[1])",
        "rho": "z[0] + x[0] * c + x[1] * s",
        "cx": "c",
        "sx": "s",
        "lever_x": "lever",
        "lever_z": "lever",
        "C": "J_x @ P @ J_x.T + J_z @ R @ J_z.T",
        "X": "J_x @ P",
        "after": "pass",
        "result": "line, C, X",
    }
    return PLACE.format(**(parts | changes))


UPDATE = """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = {v}
    {wrap}
    H = np.zeros((2, len(x)))
    H[:, :3] = {H_r}
    H[:, at : at + 2] = [[1, {lever}], [0, 1]]
    S = {S}
    K = {K}
    {only}
    return {x}, {P}
"""


def update(**changes):
    parts = {
        "v": "z - np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])",
        "wrap": "v[1] = wrap(v[1])",
        "H_r": "[[-c, -s, 0], [0, 0, -1]]",
        "lever": "x[0] * s - x[1] * c",
        "S": "H @ P @ H.T + R",
        "K": "P @ H.T @ np.linalg.inv(S)",
        "only": "pass",
        "x": "x + K @ v",
        "P": "P - K @ S @ K.T",
    }
    return UPDATE.format(**(parts | changes))


LIFE = """
memory = {{}}

def keep_book(book, seen, N, lives):
    after = {{}}
    if not book:
        memory.clear()
    for i, (count, left) in book.items():
        if {loses}:
            left, count = left - 1, {missed}
        if {stays}:
            after[i] = (count, left)
        else:
            memory[i] = count
    for i in {ids}:
        count, left = book.get(i, {fresh})
        {again}
        after[i] = (count + 1, {restored})
    used = [i for i in {candidates} if {enough}]
    return {result}
"""


def life(**changes):
    parts = {
        "loses": "i not in seen",
        "missed": "count",
        "stays": "left > 0 or i in seen",
        "ids": "set(seen)",
        "fresh": "(0, lives)",
        "again": "pass",
        "restored": "lives",
        "candidates": "sorted(set(seen))",
        "enough": "after[i][0] >= N",
        "result": "after, used",
    }
    return LIFE.format(**(parts | changes))


STEP = """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids, had = list(ids), list(ids)
    {before}
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        {change}
        if {known}:
            {update}
        else:
            line, C_line, X = place(x[:3], P[:3, :3], one, R)
            row = {row}
            x, P = np.append(x, line), np.block([[P, row.T], [row, C_line]])
            {keep}
    {after}
    return x, P, {ids}
"""


def step(**changes):
    parts = {
        "before": "pass",
        "change": "pass",
        "known": "i in ids",
        "update": "x, P = update(x, P, one, ids.index(i), R)",
        "row": "X @ np.linalg.inv(P[:3, :3]) @ P[:3]",
        "keep": "ids.append(i)",
        "after": "pass",
        "ids": "ids",
    }
    return STEP.format(**(parts | changes))


EARLY = """for i, one in zip(seen, z):
        if i not in ids:
            line, C_line, X = place(x[:3], P[:3, :3], one, R)
            row = X @ np.linalg.inv(P[:3, :3]) @ P[:3]
            x, P = np.append(x, line), np.block([[P, row.T], [row, C_line]])
            ids.append(i)"""

THIN = """
def thin(kept, points, spacing):
    drawn, old = [p for p in kept], len(kept)
    for p in points:
        near = {near}
        if not any({close} for q in near):
            drawn.append({point})
    return {result}
"""


def thin(**changes):
    parts = {
        "near": "drawn",
        "close": "np.hypot(*(p - q)) <= spacing",
        "point": "p",
        "result": "np.array(drawn).reshape(-1, 2)",
    }
    return THIN.format(**(parts | changes))


CELL = "np.floor({} / spacing).astype(int)"
APART = "P * (np.repeat([0, *range(1, len(P) // 2)], [3] + [2] * (len(P) // 2 - 1))[:, None]"
APART += " == np.repeat([0, *range(1, len(P) // 2)], [3] + [2] * (len(P) // 2 - 1)))"
LINE, SPREAD = {"09-place:line"}, {"09-place:C", "09-place:X"}
MEANS = {"09-update:mean", "09-update:wrapped"}
ENDS = {"09-walls:pose", "09-walls:map", "09-walls:sure"}


def only_line(**wrong):
    """The line alone is wrong; C and X stay right."""
    return place(after="line = np.array([{rho}, {alpha}])".format(**wrong))


WRONG = [
    # place
    Wrong(
        "the foot",
        place(after="line = rho * np.array([c, s])"),
        LINE,
        "foot",
    ),
    Wrong(
        "normal turned where ρ < 0",
        place(after="line = np.array([-rho, alpha + np.pi]) if rho < 0 else line"),
        LINE,
        "turned",
    ),
    Wrong("heading forgotten", place(alpha="z[1]"), {"09-place"}, "heading"),
    Wrong("θ − α'", place(alpha="x[2] - z[1]"), {"09-place"}, "heading"),
    Wrong("ρ from the robot", place(rho="z[0]"), LINE, "not-moved"),
    Wrong("ρ' minus the robot's place", place(rho="z[0] - x[0] * c - x[1] * s"), LINE, "sign"),
    Wrong(
        "two frames",
        place(rho="z[0] + x[0] * np.cos(z[1]) + x[1] * np.sin(z[1])"),
        LINE,
        "two-frames",
    ),
    Wrong("nothing shared", place(X="np.zeros((2, 3))"), {"09-place:X"}, "cross-missing"),
    Wrong("no lever for θ", place(lever_x="0"), SPREAD, "lever-missing"),
    Wrong("no lever at all", place(lever_x="0", lever_z="0"), SPREAD, "lever-missing"),
    Wrong(
        "degrees",
        place(lever_x="lever * 180 / np.pi", lever_z="lever * 180 / np.pi"),
        SPREAD,
        "degrees",
    ),
    Wrong("π/180 too much", place(lever_x="np.radians(lever)"), SPREAD, "degrees"),
    Wrong("degrees in J_z", place(lever_z="np.degrees(lever)"), {"09-place:C"}, "degrees"),
    Wrong("lever's sign", place(lever_x="-lever", lever_z="-lever"), SPREAD, "lever-sign"),
    Wrong("lever's sign in J_z", place(lever_z="-lever"), {"09-place:C"}, "lever-sign"),
    Wrong(
        "J_x in the robot's frame",
        place(
            cx="np.cos(z[1])",
            sx="np.sin(z[1])",
            lever_x="-x[0] * np.sin(z[1]) + x[1] * np.cos(z[1])",
        ),
        SPREAD,
        "jacobian-in-robot-frame",
    ),
    Wrong("no R", place(C="J_x @ P @ J_x.T"), {"09-place:C"}, "noise-missing"),
    Wrong("no P", place(C="J_z @ R @ J_z.T"), {"09-place:C"}, "pose-missing"),
    Wrong("R alone", place(C="R"), {"09-place:C"}, "pose-missing"),
    Wrong("R as it is", place(C="J_x @ P @ J_x.T + R"), {"09-place:C"}, "noise-not-carried"),
    Wrong(
        "J_zᵀ R J_z",
        place(C="J_x @ P @ J_x.T + J_z.T @ R @ J_z"),
        {"09-place:C"},
        "sandwich-reversed",
    ),
    Wrong(
        "R squared",
        place(C="J_x @ P @ J_x.T + J_z @ R @ R @ J_z.T"),
        {"09-place:C"},
        "standard-deviation",
    ),
    Wrong("X transposed", place(X="P @ J_x.T"), {"09-place"}, None, "malformed"),
    Wrong("line only", place(result="line"), {"09-place"}, None, "malformed"),
    Wrong("NaN", place(after="C[0, 0] = np.nan"), {"09-place"}, None, "malformed"),
    Wrong("nothing returned", place(result="None"), {"09-place"}, None, "malformed"),
    # update
    Wrong("not wrapped", update(wrap="pass"), {"09-update:wrapped"}, "unwrapped",
          may_lose={"09-update:mean"}),
    Wrong("(15) as printed", update(x="K @ v"), MEANS, "printed-15"),
    Wrong("minus K v", update(x="x - K @ v"), MEANS, "sign"),
    Wrong(
        "the world's line compared",
        update(v="z - np.array([rho, alpha])"),
        MEANS,
        "pose-forgotten",
    ),
    Wrong("no lever in H", update(lever="0"), {"09-update"}, "lever-missing"),
    Wrong("lever in degrees", update(lever="np.degrees(x[0] * s - x[1] * c)"), {"09-update"},
          "degrees"),
    Wrong("lever times π/180", update(lever="np.radians(x[0] * s - x[1] * c)"), {"09-update"},
          "degrees"),
    Wrong("lever's sign in H", update(lever="x[1] * c - x[0] * s"), {"09-update"}, "lever-sign"),
    Wrong("robot's part turned", update(H_r="[[c, s, 0], [0, 0, 1]]"), {"09-update"}, "robot-sign"),
    Wrong("x and y turned", update(H_r="[[c, s, 0], [0, 0, -1]]"), {"09-update"}, "robot-sign"),
    Wrong("θ turned", update(H_r="[[-c, -s, 0], [0, 0, 1]]"), {"09-update"}, "robot-sign"),
    Wrong("pose taken for known", update(H_r="0"), {"09-update"}, "robot-missing"),
    Wrong("no S", update(x="x + P @ H.T @ v"), MEANS, "S-missing"),
    Wrong(
        "kept apart",
        update(S=f"H @ ({APART}) @ H.T + R", K=f"({APART}) @ H.T @ np.linalg.inv(S)"),
        {"09-update"},
        "kept-apart",
    ),
    Wrong("x stays", update(x="x"), MEANS, "x-stays"),
    Wrong(
        "robot and this wall only",
        update(only="K = K * (np.abs(H).max(axis=0) > 0)[:, None]"),
        {"09-update"},
        "unseen-stay",
    ),
    Wrong("P stays", update(P="P"), {"09-update:P"}, "P-stays"),
    Wrong("P grows", update(P="P + K @ S @ K.T"), {"09-update:P"}, "P-sign"),
    Wrong("raises", update(x="x + K @ v[:1]"), {"09-update"}, None, "raised"),
    Wrong(
        "not written",
        "def update(x, P, z, j, R):\n    raise NotImplementedError",
        {"09-update"},
        None,
        "not attempted",
    ),
    # life
    Wrong("counted twice", life(ids="seen", again="count = after[i][0] if i in after and "
          "after[i][1] == lives and seen.count(i) > 1 and i in done else count; done.add(i)",
          fresh="(0, lives)").replace("after = {}", "after, done = {}, set()", 1),
          {"09-life:sightings"}, "twice", may_lose={"09-life:used"}),
    Wrong("lives not restored", life(restored="left", stays="left > 0"),
          {"09-life:alive", "09-life:left"}, "not-restored",
          may_lose={"09-life:sightings", "09-life:used"}),
    Wrong("one life back", life(restored="min(left + 1, lives)"), {"09-life:left"},
          "restored-by-one", may_lose={"09-life:alive", "09-life:sightings", "09-life:used"}),
    Wrong("the seen pay as well", life(restored="lives - 1"), {"09-life:left"}, "seen-pays",
          may_lose={"09-life:alive", "09-life:sightings", "09-life:used"}),
    Wrong("dies late", life(stays="left >= 0 or i in seen"), {"09-life:sightings"}, "late",
          may_lose={"09-life:alive", "09-life:left", "09-life:used"}),
    Wrong("never dies", life(stays="True"), {"09-life:alive", "09-life:left", "09-life:sightings"},
          "immortal", may_lose={"09-life:used"}),
    Wrong("remembers its old life", life(fresh="(memory.get(i, 0), lives)"),
          {"09-life:sightings"}, "reborn", may_lose={"09-life:used"}),
    Wrong("sightings in a row", life(missed="0"), {"09-life:sightings"}, "consecutive",
          may_lose={"09-life:used"}),
    Wrong("more than N", life(enough="after[i][0] > N"), {"09-life:used"}, "one-too-many"),
    Wrong("at once", life(enough="True"), {"09-life:used"}, "at-once"),
    Wrong("unseen ones used", life(candidates="after"), {"09-life:used"}, "unseen-used"),
    Wrong("used twice", life(candidates="seen"), {"09-life:used"}, "used-twice"),
    Wrong("book only", life(result="after"), {"09-life"}, None, "malformed"),
    Wrong("a list of sightings", life(result="{i: c for i, (c, _) in after.items()}, used"),
          {"09-life"}, None, "malformed"),
    # the filter
    Wrong("ids not kept", step(keep="pass"), {"09-walls"}, "ids-behind"),
    Wrong("placed again and again", step(known="False"), {"09-walls"}, "re-placed"),
    Wrong("first of a scan only", step(before="seen = seen[:1]"), {"09-walls"}, "too-few"),
    Wrong("placed before the drive", step(before=EARLY, known="i in had", change="if i not in "
          "had: continue"), {"09-walls:map", "09-walls:sure"}, "placed-too-early",
          may_lose={"09-walls:pose", "09-walls:map"}),
    Wrong(
        "predicted at the end",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    had = list(ids)
    for i, one in zip(seen, z):
        if i in had:
            x, P = update(x, P, one, ids.index(i), R)
    for i, one in zip(seen, z):
        if i not in had:
            line, C_line, X = place(x[:3], P[:3, :3], one, R)
            row = X @ np.linalg.inv(P[:3, :3]) @ P[:3]
            x, P = np.append(x, line), np.block([[P, row.T], [row, C_line]])
            ids = ids + [i]
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
        {"09-walls:sure"},
        "predicted-last",
        may_lose={"09-walls:pose", "09-walls:map"},
    ),
    Wrong(
        "never updated",
        step(update="pass"),
        {"09-walls:sure"},
        "never-updated",
    ),
    Wrong("never predicted", step(before="u, C = 0 * u, 0 * C"),
          {"09-walls:pose", "09-walls:sure"}, "never-predicted", may_lose={"09-walls:map"}),
    Wrong("counted twice in the filter", step(keep="ids.append(i); x, P = update(x, P, one, "
          "ids.index(i), R)"), {"09-walls:sure"}, "counted-twice", may_lose=ENDS),
    Wrong(
        "nothing inherited",
        step(row="np.zeros((2, len(x)))", after="P[3:, :3] = 0; P[:3, 3:] = 0"),
        {"09-walls:sure"},
        "born-alone",
        may_lose=ENDS,
    ),
    Wrong("ids sorted", step(ids="sorted(ids)"), {"09-walls:map", "09-walls:sure"}, "mispaired",
          may_lose=ENDS),
    Wrong(
        "sure of its way",
        step(after="""if ids:
        a = x[4]
        H = np.zeros((1, len(x)))
        H[0, :2] = -np.sin(a), np.cos(a)
        K = P @ H.T / (H @ P @ H.T + 1e-4)
        P = P - K @ H @ P"""),
        {"09-walls:pose", "09-walls:sure"},
        "sure-along",
        may_lose=ENDS,
    ),
    Wrong(
        "without ids",
        "def slam_step(x, P, ids, u, seen, z, C, R):\n    return x, P",
        {"09-walls"},
        None,
        "malformed",
    ),
    # thin
    Wrong("compared with the last", thin(near="drawn[-1:]"), {"09-thin:apart"}, "last-only"),
    Wrong("with the old only", thin(near="drawn[:old]"), {"09-thin:apart"}, "old-only"),
    Wrong("with the new only", thin(near="drawn[old:]"), {"09-thin:apart"}, "new-only"),
    Wrong("all kept", thin(near="[]"), {"09-thin:apart"}, "all-kept"),
    Wrong(
        "one a cell",
        thin(close=f"({CELL.format('p')} == {CELL.format('q')}).all()"),
        {"09-thin:apart"},
        "one-per-cell",
        may_lose={"09-thin:covering"},
    ),
    Wrong(
        "own cell only",
        thin(
            close=f"({CELL.format('p')} == {CELL.format('q')}).all() "
            "and np.hypot(*(p - q)) <= spacing"
        ),
        {"09-thin:apart"},
        "own-cell",
    ),
    Wrong(
        "a cell near by is enough",
        thin(close=f"abs({CELL.format('p')} - {CELL.format('q')}).max() <= 1"),
        {"09-thin:covering"},
        "cells-for-distance",
    ),
    Wrong("along the axes", thin(close="abs(p - q).max() <= spacing"), {"09-thin:covering"},
          "along-axes"),
    Wrong("new ones only returned", thin(result="np.array(drawn[old:]).reshape(-1, 2)"),
          {"09-thin:faithful"}, "forgot", may_lose={"09-thin:covering", "09-thin:apart"}),
    Wrong("new ones first", thin(result="np.array(drawn[old:] + drawn[:old]).reshape(-1, 2)"),
          {"09-thin:faithful"}, "forgot"),
    Wrong("rounded to a grid", thin(point="np.round(p / spacing) * spacing"),
          {"09-thin:given", "09-thin:faithful"}, "moved",
          may_lose={"09-thin:apart", "09-thin:covering"}),
    Wrong("flat", thin(result="np.array(drawn).ravel()"), {"09-thin"}, None, "malformed"),
]  # fmt: skip

RIGHT = [
    Right(
        "place by differences",
        """
def place(x, P, z, R):
    def f(s):
        n = np.array([np.cos(s[2] + s[4]), np.sin(s[2] + s[4])])
        return np.array([(s[:2] + s[3] * n) @ n, s[2] + s[4]])
    s = np.concatenate([x, z])
    J = np.column_stack([(f(s + e) - f(s - e)) / 2e-6 for e in 1e-6 * np.eye(5)])
    full = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    return f(s), J @ full @ J.T, J[:, :3] @ P
""",
    ),
    Right(
        "place in sums, α not wrapped",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    J = np.array([[np.cos(a), np.sin(a), 0], [0, 0, 1.0]])
    J[0, 2] = -x[0] * np.sin(a) + x[1] * np.cos(a)
    G = np.eye(2)
    G[0, 1] = J[0, 2]
    C = [[sum(J[i, k] * P[k, l] * J[m, l] for k in range(3) for l in range(3))
          + sum(G[i, k] * R[k, l] * G[m, l] for k in range(2) for l in range(2))
          for m in range(2)] for i in range(2)]
    return [z[0] + x[0] * J[0, 0] + x[1] * J[0, 1], a], np.array(C), (P @ J.T).T
""",
    ),
    Right(
        "Joseph's form and solve",
        update(
            K="np.linalg.solve(S, H @ P).T",
            P="(np.eye(len(x)) - K @ H) @ P @ (np.eye(len(x)) - K @ H).T + K @ R @ K.T",
        ),
    ),
    Right(
        "by information, in place",
        """
def update(x, P, z, j, R):
    a = x[4 + 2 * j]
    n, t = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
    H = np.zeros((2, len(x)))
    H[0, :2], H[1, 2], H[0, 3 + 2 * j], H[1, 4 + 2 * j] = -n, -1, 1, 1
    H[0, 4 + 2 * j] = -t @ x[:2]
    v = z - [x[3 + 2 * j] - n @ x[:2], a - x[2]]
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    Y = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    P[:] = np.linalg.inv(Y)
    x += P @ H.T @ np.linalg.inv(R) @ v
    x[2] = wrap(x[2])
    x[4::2] = wrap(x[4::2])
    return x, P
""",
    ),
    Right(
        "a book kept in place, used as a set",
        """
def keep_book(book, seen, N, lives):
    seen = set(seen)
    for i in list(book):
        if i not in seen:
            count, left = book[i]
            book[i] = [count, left - 1]
            if left == 1:
                del book[i]
    for i in seen:
        book[i] = [book.get(i, [0, 0])[0] + 1, lives]
    return book, {i for i in seen if book[i][0] >= N}
""",
    ),
    Right("used as a tuple", life(result="after, tuple(used)")),
    Right("used as an array", life(result="after, np.array(used, dtype=int)")),
    Right(
        "known walls first",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    had = list(ids)
    for i, one in zip(seen, z):
        if i in had:
            x, P = update(x, P, one, had.index(i), R)
    for i, one in zip(seen, z):
        if i not in had:
            line, C_line, X = place(x[:3], P[:3, :3], one, R)
            row = np.linalg.solve(P[:3, :3], X.T).T @ P[:3]
            x, P = np.append(x, line), np.block([[P, row.T], [row, C_line]])
            ids.append(i)
    return x, P, np.array(ids)
""",
    ),
    Right(
        "its own Jacobian",
        step(
            row="np.array([[np.cos(line[1]), np.sin(line[1]), x[1] * np.cos(line[1]) - x[0] * "
            "np.sin(line[1])], [0, 0, 1]]) @ P[:3]"
        ),
    ),
    Right("all pairs", thin()),
    Right("the new ones in another order", thin().replace("in points", "in points[::-1]")),
    Right(
        "by arrays, returned as lists",
        """
def thin(kept, points, spacing):
    for p in points:
        if not len(kept) or np.sqrt(((kept - p) ** 2).sum(axis=1)).min() > spacing:
            kept = np.vstack([kept, p])
    return kept.tolist()
""",
    ),
]
