"""Right ways and slips of 09-ghosts: some methods that draw clean maps, and some that do not."""

from course.tasks import Slip, Stumble

TASK = "09-ghosts"

FILTER = """
def clean_map(x, P, drives, C, scans, R, far):
    walls = []  # of each that is in the state: a list of its own
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, drives[t - 1], C)
        had = set()
        for z in scan:
            n = np.array([np.cos(x[4::2]), np.sin(x[4::2])])
            v = np.column_stack([z[0] - x[3::2] + x[:2] @ n, wrap(z[1] - x[4::2] + x[2])])
            d = np.abs(v / [0.5, 0.16]).max(axis=1)
            d[list(had)] = np.inf
            if len(d) and d.min() < 1:
                j = int(d.argmin())
                BELIEVE
            else:
                j = len(walls)
                x, P = add(x, P, z, R)
                walls.append(NEW)
            had.add(j)
"""

WAYS = {
    "lives that only walls in view pay": FILTER.replace("NEW", "[0, 0]").replace(
        "BELIEVE", "if walls[j][0] > 1:\n                    x, P = update(x, P, z, j, R)"
    )
    + """
        gap = x[3::2] - np.cos(x[4::2]) * x[0] - np.sin(x[4::2]) * x[1]
        for j, wall in enumerate(walls):
            if j in had:
                wall[0], wall[1] = wall[0] + 1, 0
            elif 0.1 < gap[j] < far - 0.1:
                wall[1] += 1
        keep = [j for j, wall in enumerate(walls) if wall[1] < (3 if wall[0] < 5 else 5)]
        at = [0, 1, 2] + [k for j in keep for k in (3 + 2 * j, 4 + 2 * j)]
        x, P, walls = x[at], P[at][:, at], [walls[j] for j in keep]
    return [[x[3 + 2 * j], x[4 + 2 * j]] for j in range(len(walls)) if walls[j][0] > 4]
""",
    "all kept, judged at the end": FILTER.replace("NEW", "[t]")
    .replace(
        "BELIEVE",
        "walls[j].append(t)\n                if len(walls[j]) > 2:\n"
        "                    x, P = update(x, P, z, j, R)",
    )
    .replace("x, P = predict", "way.append(x[:3])\n            x, P = predict")
    .replace("walls = []", "way, walls = [], []")
    + """
        young = [len(w) > 2 or t - w[-1] < 8 for w in walls]
        at = np.append([0, 1, 2], 3 + np.flatnonzero(np.repeat(np.array(young, dtype=bool), 2)))
        x, P, walls = x[at], P[np.ix_(at, at)], [w for w, y in zip(walls, young) if y]
    way = np.array([*way, x[:3]])
    kept = []
    for (rho, alpha), times in zip(x[3:].reshape(-1, 2), walls):
        gap = rho - way[:, 0] * np.cos(alpha) - way[:, 1] * np.sin(alpha)
        due = ((gap > 0.05) & (gap < far - 0.05)).sum()
        if len(times) > 4 and len(times) > 0.6 * due:
            kept.append((rho, alpha))
    return np.array(kept)
""",
    "odds": FILTER.replace("NEW", "[0.0, 0]").replace(
        "BELIEVE", "if walls[j][1] > 1:\n                    x, P = update(x, P, z, j, R)"
    )
    + """
        gap = x[3::2] - np.cos(x[4::2]) * x[0] - np.sin(x[4::2]) * x[1]
        for j, wall in enumerate(walls):
            if j in had:
                wall[0], wall[1] = min(wall[0] + 1.0, 6), wall[1] + 1
            elif 0.1 < gap[j] < far - 0.1:
                wall[0] -= 1.6  # a wall that is in view is missed once in five scans
        good = np.array([wall[0] > -1 for wall in walls], dtype=bool)
        at = np.append([0, 1, 2], 3 + np.flatnonzero(np.repeat(good, 2)))
        x, P, walls = x[at], P[np.ix_(at, at)], [w for w, g in zip(walls, good) if g]
    return x[3:].reshape(-1, 2)[[wall[0] > 1.5 and wall[1] > 4 for wall in walls]]
""",
}

STAYS = "stays = (due < 6) | (found >= 0.6 * due)"
UPDATE = "x, P = update(x, P, z, j, R)"
END = "return x[3:].reshape(-1, 2)[found >= 5]"
BOOK = """
def clean_map(x, P, drives, C, scans, R, far):
    book = []  # sightings and lives of each wall in the state
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, drives[t - 1], C)
        seen = set()
        for z in scan:
            a = x[4::2]
            ahead = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
            off = np.hypot((z[0] - ahead) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
            j = int(off.argmin()) if len(off) else -1
            if j >= 0 and off[j] < 1:
                x, P = update(x, P, z, j, R)
            else:
                j = len(book)
                x, P = add(x, P, z, R)
                book.append((0, LIVES))
            book[j] = (book[j][0] + (j not in seen), LIVES)
            seen.add(j)
        book = [(n, k if j in seen or FREE else k - 1) for j, (n, k) in enumerate(book)]
        alive = [j for j, (n, k) in enumerate(book) if k > 0]
        at = [0, 1, 2] + [k for j in alive for k in (3 + 2 * j, 4 + 2 * j)]
        x, P, book = x[at], P[np.ix_(at, at)], [book[j] for j in alive]
    return x[3:].reshape(-1, 2)[[n >= N_ for n, k in book]]
"""


def _book(lives, free, n):
    return BOOK.replace("LIVES", lives).replace("FREE", free).replace("N_", n)


SLIPS = (
    Slip(
        "every-line-believed",
        "Every line that was seen is in the map, the false ones too. How often should a wall have been "
        "sighted that is one?",
        [(STAYS, "stays = due >= 0"), (END, "return x[3:].reshape(-1, 2)")],
        _book("3", "True", "1"),
    ),
    Slip(
        "sightings-only",
        "Sightings are counted, but no scan counts against a wall. A thing that stands for a while is "
        "sighted as often as some walls: what tells it from them is what comes before and after.",
        (STAYS, "stays = due >= 0"),
        _book("3", "n >= 3", "3"),
        _book("3", "n >= 8", "8"),
    ),
    Slip(
        "out-of-view-is-no-fault",
        "Walls lose lives in scans that could not have held them. Behind the robot or beyond far, no "
        "wall can be sighted.",
        _book("3", "False", "3"),
    ),
    Slip(
        "inequality-turned",
        "Walls that were found as they should be were thrown out, and the others kept.",
        (STAYS, "stays = (due < 6) | (found < 0.6 * due)"),
    ),
    Slip(
        "odometry-only",
        "The pose is never corrected: the wheels drift, and when the robot comes round again the walls "
        "are elsewhere.",
        (UPDATE, "pass"),
    ),
    Slip(
        "never-predicted",
        "The drives are not used: the robot is believed to stand where it started.",
        ("x, P = predict(x, P, drives[t - 1], C)", "pass"),
    ),
    Slip(
        "unwrapped",
        "Differences of angles are not wrapped: 179° and −179° are 2° apart.",
        ("wrap(z[1] - alpha + x[2])", "(z[1] - alpha + x[2])"),
    ),
)

STUMBLES = (
    Stumble("malformed", (END, "return x"), (END, "return x[3:].reshape(-1, 2)[found >= 5].T[:1]")),
    Stumble("raised", (END, "return x[3:].reshape(-1, 3)")),
    Stumble(
        "not attempted",
        "def clean_map(x, P, drives, C, scans, R, far):\n    raise NotImplementedError",
    ),
)

PASTED = {
    "the lesson's rule: three sightings, then for good": _book("3", "n >= 3", "3"),
    "the book of 09-life": _book("3", "False", "3"),
    "no wall at all": "def clean_map(x, P, drives, C, scans, R, far):\n    return np.empty((0, 2))\n",
    "all that the first scan saw": """
def clean_map(x, P, drives, C, scans, R, far):
    return [place(x, P, z, R)[0] for z in scans[0]]
""",
}

MUTANTS = 24

EQUIVALENT = {"": "the task is open: whatever reaches the highest step is right"}
