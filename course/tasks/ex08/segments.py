"""Programs of 08-segments."""

from course.tasks import Slip, Stumble

TASK = "08-segments"

_FIT = """
def fitted(points, weight):
    centre = weight @ points / weight.sum()
    x, y = (points - centre).T * np.sqrt(weight)
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    return normal, centre @ normal
"""

_CHOSEN = """
def chosen(points, share, lines, far, beams):
    if not lines:
        return np.full(len(points), -1)
    off = []
    for normal, rho in lines:
        off.append(np.abs(points @ normal - rho) / (share * far * np.abs(beams @ normal) + 0.005))
    off = np.array(off)
    labels = np.where(off.min(axis=0) < 3, off.argmin(axis=0), -1)
    for k in range(len(lines)):
        if np.sum(labels == k) < 7:
            labels[labels == k] = -1
    return labels
"""

WAYS = {
    "guesses at random, refined in rounds": _FIT
    + _CHOSEN
    + """
def segment(points, share):
    rng, n = np.random.default_rng(3), len(points)
    far = np.hypot(*points.T)
    beams = points / far[:, None]
    labels, lines = np.full(n, -1), []
    for _ in range(14):
        free = np.flatnonzero(labels < 0)
        if len(free) < 9:
            break
        first = rng.integers(0, len(free), 700)
        second = (first + rng.integers(2, 17, 700)) % len(free)
        way = points[free[second]] - points[free[first]]
        ok = np.hypot(*way.T) > 1e-6
        normals = np.column_stack([-way[ok, 1], way[ok, 0]]) / np.hypot(*way[ok].T)[:, None]
        rho = np.sum(normals * points[free[first[ok]]], axis=1)
        sigma = share * far[free] * np.abs(normals @ beams[free].T) + 0.005
        near = np.abs(normals @ points[free].T - rho[:, None]) < 2.5 * sigma
        best = near.sum(axis=1).argmax()
        if near[best].sum() < 9:
            break
        lines.append(fitted(points[free[near[best]]], 1 / far[free[near[best]]] ** 2))
        labels = chosen(points, share, lines, far, beams)
        for k in np.unique(labels[labels >= 0]):
            mine = labels == k
            lines[k] = fitted(points[mine], 1 / far[mine] ** 2)
        labels = chosen(points, share, lines, far, beams)
    return labels.tolist()
""",
    "a table of votes, then least squares": _FIT
    + _CHOSEN
    + """
def segment(points, share):
    far = np.hypot(*points.T)
    beams = points / far[:, None]
    alpha = np.arange(0, np.pi, np.radians(1.25))
    normal = np.column_stack([np.cos(alpha), np.sin(alpha)])
    level = np.arange(-8, 8, 0.05)
    free, lines = np.ones(len(points), dtype=bool), []
    rho = normal @ points.T
    sigma = share * far * np.abs(normal @ beams.T) + 0.01
    for _ in range(14):
        best, where = 0, None
        for a in range(len(alpha)):
            low, high = rho[a, free] - 2.5 * sigma[a, free], rho[a, free] + 2.5 * sigma[a, free]
            there = np.searchsorted(np.sort(low), level, "right") - np.searchsorted(np.sort(high), level)
            if there.max() > best:
                best, where = there.max(), (a, level[there.argmax()])
        if best < 9:
            break
        a, r = where
        inside = free & (np.abs(rho[a] - r) < 2.5 * sigma[a])
        for _ in range(4):
            line = fitted(points[inside], 1 / far[inside] ** 2)
            off = np.abs(points @ line[0] - line[1]) / (share * far * np.abs(beams @ line[0]) + 0.005)
            inside = free & (off < 3)
            if inside.sum() < 3:
                break
        lines.append(line)
        free = free & (off >= 3) & ~inside
        if inside.sum() < 3:
            free[np.abs(rho[a] - r) < 2.5 * sigma[a]] = False
    for _ in range(3):
        labels = chosen(points, share, lines, far, beams)
        for k in np.unique(labels[labels >= 0]):
            lines[k] = fitted(points[labels == k], 1 / far[labels == k] ** 2)
    return chosen(points, share, lines, far, beams)
""",
    "all pairs of readings, loops": _FIT
    + _CHOSEN
    + """
def segment(points, share):
    n = len(points)
    far = np.hypot(points[:, 0], points[:, 1])
    beams = points / far[:, None]
    free, lines = np.ones(n, dtype=bool), []
    guesses = []
    for i in range(n):
        for step in (5, 11, 20):
            j = (i + step) % n
            way = points[j] - points[i]
            length = np.hypot(*way)
            if length < 1e-6:
                continue
            normal = np.array([way[1], -way[0]]) / length
            off = points @ normal - points[i] @ normal
            guesses.append(np.abs(off) < 2.6 * (share * far * np.abs(beams @ normal) + 0.005))
    guesses = np.array(guesses)
    for _ in range(14):
        votes = guesses @ free.astype(float)
        inside = guesses[votes.argmax()] & free
        if inside.sum() < 9:
            break
        for _ in range(3):
            line = fitted(points[inside], 1 / far[inside] ** 2)
            off = np.abs(points @ line[0] - line[1]) / (share * far * np.abs(beams @ line[0]) + 0.005)
            inside = free & (off < 3)
        lines.append(line)
        free = free & (off >= 3) & ~guesses[votes.argmax()]
    return chosen(points, share, lines, far, beams)
""",
}

_THESIS = """
def line_of(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    return centre @ [np.cos(alpha), np.sin(alpha)], alpha

def guess(points, middle, window):
    rows = (middle + np.arange(window) - window // 2) % len(points)
    return rows, line_of(points[rows])

def across(points, line):
    rho, alpha = line
    return points @ [np.cos(alpha), np.sin(alpha)] - rho

def segment(points, share):
    labels = np.full(len(points), -1)
    for middle in range(len(points)):
        rows, line = guess(points, middle, 25)
        inside = rows[np.abs(across(points[rows], line)) <= 0.015]
        if len(inside) >= 21:
            free = inside[labels[inside] < 0]
            labels[free] = labels.max() + 1
    return labels
"""

SLIPS = (
    Slip(
        "one-wall",
        "All readings have one number. Where one wall ends and the next begins, the number has to "
        "change.",
        "def segment(points, share):\n    return np.where(np.arange(len(points)) % 180 < 179, 0, 1)",
    ),
    Slip(
        "clutter-kept",
        "Every reading got a wall, also those of clutter. Who is too far from every line is of no wall: "
        "−1.",
        (
            "np.where(distances.min(axis=0) < 3, distances.argmin(axis=0), -1)",
            "distances.argmin(axis=0)",
        ),
    ),
    Slip(
        "blocks",
        "The scan is cut into pieces of equal length. Where a wall ends, only the readings can tell.",
        "def segment(points, share):\n    return np.arange(len(points)) // 22",
        "def segment(points, share):\n    return np.arange(len(points)) // 12",
    ),
    Slip(
        "jumps",
        "The number changes where the range jumps. Each reading of clutter is such a jump, and round a "
        "corner there is none.",
        "def segment(points, share):\n"
        "    r = np.hypot(*points.T)\n"
        "    return np.cumsum(np.abs(np.diff(r, prepend=r[-1])) > 0.3)",
    ),
    Slip(
        "narrow",
        "The band is far narrower than the noise, so that most readings of a wall miss it. How far off "
        "are they when the range errs by `share`?",
        (
            "sigma = share * far * np.abs(normal @ beams.T) + 0.005",
            "sigma = np.full(far.shape, 0.002)",
        ),
        ("+ 0.005", "* 0.1"),
    ),
    Slip(
        "wide",
        "The band is far wider than the noise, so that clutter and other walls are taken in. How far off "
        "are readings when the range errs by `share`?",
        ("* np.abs(normal @ beams.T) + 0.005", "* 0 + 0.3"),
        ("* np.abs(normal @ beams.T) + 0.005", "* 20"),
    ),
    Slip(
        "one-line",
        "Only the first wall is found. Take its readings away, and look for the next.",
        ("    if not lines:", "    lines = lines[:1]\n    if not lines:"),
        ("    if not lines:", "    lines = lines[:2]\n    if not lines:"),
    ),
    Slip(
        "needs-too-many",
        "A wall is found only if very many readings agree: a narrow one, or one far away, has some "
        "ten.",
        (".max() < 9:", ".max() < 60:"),
    ),
    Slip(
        "bearing-of-the-wall",
        "Each run of readings between two pieces of clutter is taken for a wall of its own. All "
        "readings of one straight line are of one wall.",
        "def segment(points, share):\n"
        "    r = np.hypot(*points.T)\n"
        "    out = np.abs(r - (np.roll(r, 1) + np.roll(r, -1)) / 2) > 0.2\n"
        "    return np.where(out, -1, np.cumsum(out))",
    ),
)

STUMBLES = (
    Stumble("malformed", "def segment(points, share):\n    return None"),
    Stumble("malformed", "def segment(points, share):\n    return np.zeros(len(points) - 1)"),
    Stumble("malformed", "def segment(points, share):\n    return np.full(len(points), -2)"),
    Stumble("malformed", "def segment(points, share):\n    return points[:, 0]"),
    Stumble("not attempted", "def segment(points, share):\n    raise NotImplementedError"),
)

_GROWN = (
    _THESIS[: _THESIS.index("def segment")]
    + """
def segment(points, share):
    labels, band = np.full(len(points), -1), 2.8 * share * np.hypot(*points.T)
    for middle in range(len(points)):
        rows, line = guess(points, middle, 9)
        inside = rows[np.abs(across(points[rows], line)) <= band[rows]]
        if len(inside) < 8 or (labels[rows] >= 0).any():
            continue
        for _ in range(4):
            line = line_of(points[inside])
            near = np.flatnonzero((np.abs(across(points, line)) <= band) & (labels < 0))
            inside = near if len(near) > 3 else inside
        labels[inside] = labels.max() + 1
    return labels
"""
)

PASTED = {"the windows of the thesis": _THESIS, "the lesson's guess, count and grow": _GROWN}

EQUIVALENT = {
    " -> ": "any method will do: what keeps the share above the highest step is as right",
}

MUTANTS = 30
