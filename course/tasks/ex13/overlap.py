"""Right ways and slips of 13-overlap: some methods that find home, and some that do not."""

from course.tasks import Slip, Stumble

TASK = "13-overlap"
MUTANTS = 24

FINISH = """
def match(source, target, T):
    tree, normals, Q = cKDTree(target), normals_of(target), np.diag([1.0, 1.0, 1.0])

    def near(T, gate=0.1):
        return np.sum(tree.query(carry(T, source))[0] < gate)

    def across(T, gates):
        for gate in gates:
            distances, rows = tree.query(carry(T, source))
            k = distances < gate
            sigma = np.full(k.sum(), 0.02)
            x, y, turn = line_step(source[k], target[rows[k]], normals[rows[k]], sigma, T, Q)[0]
            c, s = np.cos(turn), np.sin(turn)
            T = T @ np.array([[c, -s, x], [s, c, y], [0, 0, 1]])
        return T

    def motion(angle, shift):
        T = np.eye(3)
        T[:2, :2], T[:2, 2] = turned(angle), shift
        return T

    def best(starts, rounds=(0.5, 0.4, 0.3, 0.25, 0.2)):
        ends = [across(start, rounds) for start in starts]
        return across(max(ends, key=near), (0.15, 0.12, 0.1, 0.1, 0.1, 0.1))
"""

WAYS = {
    "votes, then trimmed ICP, then across": FINISH
    + """
    voted = []
    for angle in np.radians(np.arange(0, 360, 8)):
        shifts = (target[::2, None] - source[::2] @ turned(angle).T).reshape(-1, 2)
        H, x, y = np.histogram2d(*shifts.T, bins=(np.arange(-9, 9, 0.3), np.arange(-9, 9, 0.3)))
        i, j = np.unravel_index(H.argmax(), H.shape)
        voted.append((H[i, j], angle, x[i] + 0.15, y[j] + 0.15))
    starts = [motion(angle, (x, y)) for _, angle, x, y in sorted(voted)[-10:]]
    return best([trimmed_icp(source, target, start, 10, 0.5) for start in starts], (0.15, 0.15))
""",
    "turns by the walls' directions, shifts by votes": FINISH
    + """
    def directions(points):
        n = normals_of(points)
        return np.bincount(np.floor(np.degrees(np.arctan2(*n.T[::-1])) / 4).astype(int) % 90, minlength=90)

    first, now = directions(target), directions(source)
    alike = [now @ np.roll(np.convolve(np.tile(first, 3), [1, 2, 1], "same")[90:180], -k) for k in range(90)]
    starts = []
    for k in np.argsort(alike)[-36:]:
        angle = np.radians(4 * k)
        shifts = (target[:, None] - source[::2] @ turned(angle).T).reshape(-1, 2)
        cells, votes = np.unique(np.floor(shifts / 0.3) @ [1, 1j], return_counts=True)
        cell = cells[votes.argmax()]
        starts.append((votes.max(), k, motion(angle, 0.3 * np.array([cell.real, cell.imag]) + 0.15)))
    return best([start for _, _, start in sorted(starts, key=lambda s: s[:2])[-12:]])
""",
    "grids correlated by FFT": FINISH
    + """
    size, cell = 96, 0.2

    def raster(points):
        grid = np.zeros((size, size))
        i, j = np.floor(points / cell).astype(int).T % size
        grid[i, j] = 1
        return grid

    walls = raster(target)
    walls = np.maximum(walls, 0.5 * sum(np.roll(walls, s, a) for s in (-1, 1) for a in (0, 1)).clip(0, 1))
    seen, found = np.fft.rfft2(walls), []
    for angle in np.radians(np.arange(0, 360, 6)):
        score = np.fft.irfft2(seen * np.conj(np.fft.rfft2(raster(source @ turned(angle).T))))
        ij = np.array(np.unravel_index(score.argmax(), score.shape))
        found.append((score.max(), angle, (ij + size // 2) % size - size // 2))
    return best([motion(angle, cell * ij) for _, angle, ij in sorted(found, key=lambda f: f[:2])[-12:]])
""",
    "steps across from many turns and places": FINISH
    + """
    starts = []
    for x, y in ((0, 0), (0.6, 0), (-0.6, 0), (0, 0.6), (0, -0.6)):
        for angle in np.radians(np.arange(0, 360, 12)):
            starts.append(across(motion(angle, T[:2, 2] + [x, y]), (0.6, 0.5, 0.4)))
    starts = sorted(starts, key=lambda start: near(start, 0.2))[-30:]
    return best([across(start, (0.4, 0.3, 0.3)) for start in starts], (0.25, 0.2))
""",
}

CHOICE = "ends.append((np.sum(distances < 0.1), k, Rot, shift))"
FINISHED = "Rot, shift = slid(Rot, shift, (0.15, 0.12, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1))"
FIRST = "Rot, shift = slid(Rot, shift, (0.5, 0.4, 0.3, 0.25, 0.2))"
TURNS = "Rot = turned(2 * np.pi * k / 48)"
RETURN = "return T"
FROM_GUESS = "def match(source, target, T):\n    return {}\n"
MANY = """
def match(source, target, T):
    best, least = T, np.inf
    for k in range(12):
        start = T.copy()
        start[:2, :2] = turned(np.pi * k / 6) @ T[:2, :2]
        end = {icp}
        distances, _ = nearest(carry(end, source), target)
        cost = {cost}
        if cost < least:
            best, least = end, cost
    return best
"""
TRIM = "trimmed_icp(source, target, start, 10, 0.5)"

SLIPS = (
    Slip(
        "from-the-guess",
        "ICP goes downhill from where it starts, and your guess lies in another valley: more rounds do "
        "not help, other beginnings do.",
        FROM_GUESS.format("icp(source, target, T, 40)"),
        FROM_GUESS.format("trimmed_icp(source, target, T, 40, 0.8)"),
        FROM_GUESS.format("trimmed_icp(source, target, T, 60, 0.5)"),
    ),
    Slip(
        "all-points-judge",
        "The best end was chosen by a mean over all points. Half of the points have no partner, and they "
        "decide: judge by those that fit.",
        MANY.format(icp="icp(source, target, start, 15)", cost="distances.mean()"),
        MANY.format(icp=TRIM, cost="distances.mean()"),
        (CHOICE, "ends.append((-distances.mean(), k, Rot, shift))"),
    ),
    Slip(
        "turns-only",
        "Turns were tried, but all from the place of the guess, and the end is not finished across the "
        "walls. That is a good beginning: where would the votes of all pairs put the source?",
        MANY.format(icp=TRIM, cost="-np.sum(distances < 0.06)"),
        MANY.format(icp=TRIM, cost="np.sort(distances)[: len(distances) // 2].mean()"),
    ),
    Slip(
        "votes-only",
        "The votes tell turn and shift as coarsely as their cells. Let ICP go on from there.",
        [(FIRST, "pass"), (FINISHED, "pass")],
    ),
    Slip(
        "worst-chosen",
        "Of all ends the worst was chosen: does your number grow or fall when a match gets better?",
        ("= max(ends)", "= min(ends)"),
        ("sorted(voted)[-8:]", "sorted(voted)[:8]"),
    ),
    Slip(
        "turns-in-degrees",
        "The turns do not go round: radians and degrees are mixed, or the range of turns is too small.",
        (TURNS, "Rot = turned(np.radians(2 * np.pi * k / 48))"),
        (TURNS, "Rot = turned(np.pi / 4 * (k / 24 - 1))"),
    ),
    Slip(
        "inverted",
        "These are the inverse motions: they lay the target over the source. T carries the source.",
        (RETURN, "return np.linalg.inv(T)"),
    ),
    Slip(
        "mirrored-shift",
        "Rot and the shift do not belong together: the shift is that of a source that was turned by Rot "
        "before.",
        ("T[:2, :2], T[:2, 2] = Rot, shift", "T[:2, :2], T[:2, 2] = Rot, -shift"),
        ("T[:2, :2], T[:2, 2] = Rot, shift", "T[:2, :2], T[:2, 2] = Rot.T, shift"),
        ("T[:2, :2], T[:2, 2] = Rot, shift", "T[:2, :2], T[:2, 2] = Rot, Rot @ shift"),
    ),
)

STUMBLES = (
    Stumble("malformed", (RETURN, "return Rot, shift"), (RETURN, "return T[:2]"), (RETURN, "pass")),
    Stumble("raised", (RETURN, "return best_motion(source, target[:, 0])")),
)

PASTED = {
    "plain ICP": FROM_GUESS.format("icp(source, target, T, 60)"),
    "trimmed ICP": FROM_GUESS.format("trimmed_icp(source, target, T, 60, 0.6)"),
    "the best motion of the rows": FROM_GUESS.format(
        "best_motion(source, target[: len(source)])"
    ).replace("best_motion(source,", "best_motion(source[: len(target)],"),
    "the lesson's steps across the walls, best 80 %": """
def match(source, target, T):
    tree, n = cKDTree(target), normals_of(target)
    for _ in range(25):
        moved = carry(T, source)
        distances, rows = tree.query(moved)
        k = distances <= np.quantile(distances, 0.8)
        arm, wall = (moved - T[:2, 2])[k], n[rows[k]]
        r = np.sum(wall * (moved[k] - target[rows[k]]), axis=1)
        J = np.column_stack([wall, arm[:, 0] * wall[:, 1] - arm[:, 1] * wall[:, 0]])
        x, y, turn = np.linalg.lstsq(J, -r, rcond=None)[0]
        T = T.copy()
        T[:2, :2], T[:2, 2] = turned(turn) @ T[:2, :2], T[:2, 2] + [x, y]
    return T
""",
}

EQUIVALENT = {
    " -> ": "any method goes: what finds home as often is a right way of its own",
}
