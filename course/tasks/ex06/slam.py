"""Right ways and slips of 06-slam."""

from course.tasks import Slip, Stumble

TASK = "06-slam"

WAYS = {
    "known ones first": """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids, known = list(ids), [i in ids for i in seen]
    for i, one, old in zip(seen, z, known):
        if old:
            x, P = update(x, P, one, ids.index(i), R)
    for i, one, old in zip(seen, z, known):
        if not old:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    "one update for the whole scan": """
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
    "new ones first": """
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
}

PREDICT = "    x, P = predict(x, P, u, C)\n"
UPDATE = "x, P = update(x, P, one, ids.index(i), R)"
AUGMENT = "x, P = augment(x, P, one, R)"
KEEP = "ids = [*ids, i]"
LOOP = "    for i, one in zip(seen, z, strict=True):\n"

SLIPS = (
    Slip(
        "ids-behind",
        "x has landmarks that ids does not name, or the other way round. Whenever you append to x, append "
        "to ids.",
        ("            " + KEEP + "\n", ""),
    ),
    Slip(
        "re-augmented",
        "The map holds a landmark more than once. One whose id is in ids already was seen before: update it.",
        ("if i in ids:", "if False:"),
        ("if i in ids:", "if i < len(ids):"),
    ),
    Slip(
        "too-few",
        "Some landmarks that were seen are not in the map: every id that is new is to be augmented, each "
        "with its own row of z.",
        (LOOP, "    for i, one in zip(seen[:1], z[:1], strict=True):\n"),
        ("zip(seen, z, strict=True)", "list(zip(seen, z, strict=True))[1:]"),
    ),
    Slip(
        "stops-early",
        "The loop ends before all that was seen has been used: look inside it for a break, or for a return.",
        (KEEP, KEEP + "\n            break"),
    ),
    Slip(
        "wrong-landmark",
        "Sights go to the wrong landmark: ids[j] names landmark j of x, new ones come last in both, and "
        "z[k] belongs to seen[k].",
        (KEEP, "ids = [i, *ids]"),
        ("return x, P, ids", "return x, P, sorted(ids)"),
        (LOOP, "    z = [z[0]] * len(z) if len(z) else z\n" + LOOP),
        (LOOP, "    z = z[::-1]\n" + LOOP),
        ("ids.index(i)", "len(ids) - 1"),
        ("ids.index(i)", "(ids.index(i) + 1) % len(ids)"),
    ),
    Slip(
        "placed-too-early",
        "New landmarks are placed before the pose is predicted: z was measured after the drive, so that "
        "everything new stands a step behind.",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    known = list(ids)
    for i, one in zip(seen, z, strict=True):
        if i not in known:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i in known:
            x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    for i, one in zip(seen, z, strict=True):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
    ),
    Slip(
        "predicted-last",
        "What is seen is used before the drive is predicted: z was measured after it. Predict first.",
        [(PREDICT, ""), ("    return x, P, ids", PREDICT + "    return x, P, ids")],
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    known = list(ids)
    for i, one in zip(seen, z, strict=True):
        if i in known:
            x, P = update(x, P, one, ids.index(i), R)
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i not in known:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
""",
    ),
    Slip(
        "never-updated",
        "Landmarks seen again teach the filter nothing: known ids are to be updated.",
        (UPDATE, "pass"),
        (UPDATE, "x, _ = update(x, P, one, ids.index(i), R)"),
        (UPDATE, "_, P = update(x, P, one, ids.index(i), R)"),
    ),
    Slip(
        "never-predicted",
        "The drive u is not used, or not all of it: predict comes first in every step, and moves x and P.",
        (PREDICT, ""),
        (PREDICT, "    x, _ = predict(x, P, u, C)\n"),
        (PREDICT, "    _, P = predict(x, P, u, C)\n"),
        (PREDICT, "    x, P = predict(x, P, u, 0 * C)\n"),
        (PREDICT, "    if len(seen):\n        x, P = predict(x, P, u, C)\n"),
    ),
    Slip(
        "counted-twice",
        "A sight is used twice: a new landmark is augmented and then updated with the same z, or a known "
        "one updated twice. Counted twice, it makes the filter surer than it may be.",
        (KEEP, KEEP + "\n            " + UPDATE),
        (UPDATE, UPDATE + "\n            " + UPDATE),
    ),
    Slip(
        "predicted-for-each",
        "The drive is predicted once for each landmark seen. It happened once in a step.",
        (UPDATE, "x, P = predict(x, P, u, C)\n            " + UPDATE),
        [(PREDICT, ""), (LOOP, LOOP + "    " + PREDICT)],
    ),
    Slip(
        "noises-exchanged",
        "C is the drive's covariance and R the sight's: one of them stands where the other belongs.",
        ("augment(x, P, one, R)", "augment(x, P, one, C)"),
        ("ids.index(i), R)", "ids.index(i), C)"),
        ("predict(x, P, u, C)", "predict(x, P, u, R)"),
    ),
    Slip(
        "links-thrown-away",
        "What robot and landmarks share was thrown away between two steps. Those blocks of P are what "
        "lets one sight correct everything.",
        ("    return x, P, ids", "    P[:3, 3:] = P[3:, :3] = 0\n    return x, P, ids"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return x, P, ids", "return x, P"),
        ("return x, P, ids", "return x, x, ids"),
        (UPDATE, "P = P[:3, :3]"),
    ),
    Stumble("raised", (UPDATE, "x, P = update(x, P, one, i, R)")),
)

MUTANTS = 120

EQUIVALENT = {}
