"""Right ways and slips of 05-localise."""

from course.tasks import Slip, Stumble

TASK = "05-localise"

HEAD = "def localise(x, P, drives, ids, zs, landmarks, C, R):\n"
WAYS = {
    "by indices, arrays filled": HEAD
    + """    n = len(ids)
    xs, Ps = np.zeros((n, 3)), np.zeros((n, 3, 3))
    for k in range(n):
        x, P = predict(x, P, drives[k], C)
        if ids[k] != -1:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    "lists of lists, symmetry kept": HEAD
    + """    beliefs = []
    for k, id in enumerate(ids):
        x, P = predict(x, P, drives[k], C)
        x, P = locate(x, P, zs[k], landmarks[int(id)], R) if id > -1 else (x, P)
        P = (P + P.T) / 2
        beliefs.append([x.tolist(), P.tolist()])
    return [b[0] for b in beliefs], [b[1] for b in beliefs]
""",
    "all in one, in copies": HEAD
    + """    x, P, history = x.copy(), P.copy(), []
    for u, id, z in zip(drives, ids, zs):
        c, s = np.cos(x[2]), np.sin(x[2])
        A = np.array([[1, 0, -u[0] * s], [0, 1, u[0] * c], [0, 0, 1]])
        W = np.array([[c, 0], [s, 0], [0, 1]])
        x += [u[0] * c, u[0] * s, u[1]]
        P[:] = A @ P @ A.T + W @ C @ W.T
        if id >= 0:
            v = z - h(x, landmarks[id])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[id])
            K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
            x += K @ v
            P -= K @ H @ P
        history.append((x.copy(), P.copy()))
    return np.array([x for x, _ in history]), np.array([P for _, P in history])
""",
    "blind sights are worth nothing": HEAD
    + """    xs, Ps = [x], [P]
    for k in range(len(drives)):
        x, P = predict(xs[-1], Ps[-1], drives[k], C)
        if ids[k] in range(len(landmarks)):
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs, Ps = xs + [x], Ps + [P]
    return np.array(xs[1:]), np.array(Ps[1:])
""",
}

PREDICT, LOCATE = "x, P = predict(x, P, u, C)", "x, P = locate(x, P, z, landmarks[id], R)"
IF, LOOP = "if id >= 0:", "for u, id, z in zip(drives, ids, zs, strict=True):"
LINE = "\n        "
SEEN = f"{IF}{LINE}    {LOCATE}"
KEEP = f"xs.append(x){LINE}Ps.append(P)"
OUT = "return np.array(xs), np.array(Ps)"

SLIPS = (
    Slip(
        "start-not-used",
        "The run begins at the origin, or with a covariance of its own. x and P at the start are given.",
        (HEAD, f"{HEAD}    x, P = np.zeros(3), np.eye(3)\n"),
        (HEAD, f"{HEAD}    x, P = np.zeros(3), np.zeros((3, 3))\n"),
        (HEAD, f"{HEAD}    x = np.zeros(3)\n"),
        (HEAD, f"{HEAD}    P = np.eye(3)\n"),
    ),
    Slip(
        "one-behind",
        "Each entry is one step late: xs[0] is the start. Keep what is believed after the drive and the "
        "sight, not before.",
        [(f"{LINE}{KEEP}", ""), (PREDICT, f"{KEEP}{LINE}{PREDICT}")],
    ),
    Slip(
        "kept-before-the-sight",
        "What is kept is the belief before the sight, or half of it: look first, then keep x and P.",
        [(f"{LINE}{KEEP}", ""), (PREDICT, f"{PREDICT}{LINE}{KEEP}")],
        [(f"{LINE}xs.append(x)", ""), (PREDICT, f"{PREDICT}{LINE}xs.append(x)")],
        [(f"{LINE}Ps.append(P)", ""), (PREDICT, f"{PREDICT}{LINE}Ps.append(P)")],
    ),
    Slip(
        "look-first",
        "You look, then drive. Sight k was made after drive k: predict first.",
        [(f"{PREDICT}{LINE}", ""), (SEEN, f"{SEEN}{LINE}{PREDICT}")],
    ),
    Slip(
        "drives-only",
        "The sights are not used: this is odometry, with a P that grows and grows.",
        (LOCATE, "pass"),
    ),
    Slip(
        "never-driven",
        "The drives are not used, or not all of what they say: predict moves x and P in every step.",
        (PREDICT, "pass"),
        (PREDICT, "x, P = predict(x, P, u, 0 * C)"),
        (PREDICT, "x, P = x, predict(x, P, u, C)[1]"),
    ),
    Slip(
        "zero-skipped",
        "Landmark 0 is a landmark like the others, row 0 of landmarks. Only −1 says that nothing was seen.",
        (IF, "if id > 0:"),
    ),
    Slip(
        "id-as-truth",
        "if id: takes −1 for true and 0 for false. Nothing was seen where ids[k] is −1, and 0 is a landmark.",
        (IF, "if id:"),
    ),
    Slip(
        "minus-one-seen",
        "Where ids[k] is −1 nothing was seen, but you update all the same: landmarks[-1] is the last "
        "landmark to Python, without a complaint.",
        (IF, "if True:"),
        (IF, "if id is not None:"),
    ),
    Slip(
        "sight-skipped",
        "Some sights are not used: update in every step where ids[k] is not −1, whichever landmark it is.",
        (IF, "if 0 <= id < len(landmarks) - 1:"),
        (IF, "if id >= 0 and len(xs) % 2:"),
        (IF, "if id >= 0 and xs:"),
        (IF, "if id >= 0 and id not in ids[: len(xs)]:"),
        (IF, "if id >= 0 and id != ids[len(xs) - 1]:"),
    ),
    Slip(
        "z-by-id",
        "You take row ids[k] of zs. zs has a row for each step, landmarks one for each id.",
        (LOCATE, "x, P = locate(x, P, zs[id % len(zs)], landmarks[id], R)"),
    ),
    Slip(
        "wrong-landmark",
        "Another landmark's place is used: ids[k] is the row of landmarks, counted from 0.",
        (LOCATE, "x, P = locate(x, P, z, landmarks[id - 1], R)"),
        (LOCATE, "x, P = locate(x, P, z, landmarks[0], R)"),
        (LOCATE, "x, P = locate(x, P, z, landmarks[len(xs) % len(landmarks)], R)"),
    ),
    Slip(
        "blind-drive-lost",
        "Where nothing is seen, the drive is skipped, too. The robot moves with its eyes shut: predict in "
        "every step.",
        [(f"{PREDICT}{LINE}", ""), (LOCATE, f"{PREDICT}{LINE}    {LOCATE}")],
    ),
    Slip(
        "blind-steps-not-kept",
        "Where nothing was seen, nothing was kept, or the entry before it once more. The robot has driven, "
        "and its belief after that drive is asked for as well.",
        HEAD
        + """    xs, Ps = np.zeros((len(drives), 3)), np.zeros((len(drives), 3, 3))
    for k in range(len(drives)):
        x, P = predict(x, P, drives[k], C)
        if ids[k] < 0:
            continue
        x, P = xs[k], Ps[k] = locate(x, P, zs[k], landmarks[ids[k]], R)
    return xs, Ps
""",
        (
            KEEP,
            KEEP.replace("(x)", "(x if id >= 0 else (xs or [x])[-1])").replace(
                "(P)", "(P if id >= 0 else (Ps or [P])[-1])"
            ),
        ),
    ),
    Slip(
        "drive-of-another-step",
        "Step k uses another step's drive, or the first one in all steps.",
        (PREDICT, "x, P = predict(x, P, drives[0], C)"),
        (PREDICT, "x, P = predict(x, P, drives[len(xs) - 1], C)"),
        (LOOP, LOOP.replace("drives,", "np.roll(drives, -1, axis=0),")),
    ),
    Slip(
        "covariance-restarted",
        "Every step starts from the first P. Each step's P is made from the one before: hand it on as you "
        "do with x.",
        [("xs, Ps = [], []", "xs, Ps, P_0 = [], [], P"), (PREDICT, "x, P = predict(x, P_0, u, C)")],
    ),
    Slip(
        "pose-restarted",
        "Every step starts from the first pose, or from the first belief: hand both on.",
        [("xs, Ps = [], []", "xs, Ps, x_0 = [], [], x"), (PREDICT, "x, P = predict(x_0, P, u, C)")],
        [
            ("xs, Ps = [], []", "xs, Ps, start = [], [], (x, P)"),
            (PREDICT, "x, P = predict(*start, u, C)"),
        ],
    ),
    Slip(
        "sight-keeps-P",
        "The sight corrects x, and its P is thrown away.",
        (LOCATE, "x, _ = locate(x, P, z, landmarks[id], R)"),
    ),
    Slip(
        "sight-keeps-x",
        "The sight makes P smaller, and its x is thrown away, or kept and not handed on to the next step.",
        (LOCATE, "_, P = locate(x, P, z, landmarks[id], R)"),
    ),
    Slip(
        "drive-keeps-P",
        "The drive moves x, and its P is thrown away: who drives is less sure.",
        (PREDICT, "x, _ = predict(x, P, u, C)"),
    ),
    Slip(
        "sighted-at-the-old-belief",
        "The sight corrects the belief from before the drive, or the drive moves what was corrected: the "
        "drive's result has to go into the sight.",
        (LOCATE, "x, P = locate(xs[-1] if xs else x, P, z, landmarks[id], R)"),
        (LOCATE, "x, P = locate(x, Ps[-1] if Ps else P, z, landmarks[id], R)"),
    ),
    Slip(
        "noises-exchanged",
        "C is the drive's covariance and R the sight's: one of them stands where the other belongs.",
        (LOCATE, "x, P = locate(x, P, z, landmarks[id], C)"),
        (PREDICT, "x, P = predict(x, P, u, R)"),
        [
            (LOCATE, "x, P = locate(x, P, z, landmarks[id], C)"),
            (PREDICT, "x, P = predict(x, P, u, R)"),
        ],
    ),
    Slip(
        "counted-twice",
        "A sight or a drive is used twice in one step. Counted twice, it makes the filter surer than it may "
        "be, or moves it too far.",
        (LOCATE, f"{LOCATE}{LINE}    {LOCATE}"),
        (PREDICT, f"{PREDICT}{LINE}{PREDICT}"),
    ),
    Slip(
        "last-belief-only",
        "All entries are the same belief, the last one. Did you keep one array and change it in place? "
        "Keep a copy of each.",
        (OUT, "return np.array([x for _ in xs]), np.array([P for _ in Ps])"),
        (OUT, "return np.array(xs), np.array([P for _ in Ps])"),
    ),
    Slip(
        "arc",
        "Your robot drives half the turn off its old heading: that is the arc of the lesson's lap. Here the "
        "drive is lesson 04's, along the old heading and then the turn.",
        (
            PREDICT,
            "half = np.array([0, 0, u[1] / 2])"
            + LINE
            + "x, P = predict(x + half, P, u, C)"
            + LINE
            + "x = x - half",
        ),
    ),
    Slip(
        "backwards",
        "The run comes out in the wrong order, or was driven from its end: entry k belongs to step k.",
        (OUT, "return np.array(xs)[::-1], np.array(Ps)[::-1]"),
        (LOOP, "for u, id, z in zip(drives[::-1], ids[::-1], zs[::-1], strict=True):"),
    ),
    Slip(
        "only-so-many-steps",
        "Steps beyond a fixed number are missing or repeat the last one: a run has as many steps as drives.",
        (OUT, "return np.array(xs[:10] + xs[9:10] * (len(xs) - 10)), np.array(Ps)"),
    ),
    Slip(
        "forward-only",
        "Drives with d < 0 or d = 0 are taken for others: a robot may stand, turn on the spot or go "
        "backwards.",
        (PREDICT, "x, P = predict(x, P, np.abs(u) * [1, np.sign(u[1])], C)"),
        (PREDICT, "x, P = predict(x, P, u, C) if u[0] else (x, P)"),
    ),
    Slip(
        "start-included",
        "P of the start is added to every step, or the drive's noise only to the first: each step adds its "
        "own noise, once.",
        (PREDICT, "x, P = predict(x, P, u, C if not xs else 0 * C)"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (OUT, "return None"),
        (OUT, "return x, P"),
        (OUT, "return np.array(xs)"),
        (OUT, "return np.array(xs) * np.nan, np.array(Ps)"),
        (IF, "if id < 0:\n            continue\n        else:"),
        ("xs, Ps = [], []", "xs, Ps = [x], [P]"),
    ),
    Stumble(
        "raised",
        (LOCATE, "x, P = locate(x, P, z, landmarks[len(xs)], R)"),
        (OUT, "return undefined"),
    ),
)

EQUIVALENT = {}
