"""Programs of 10-ring: least and most of a difference, two pieces, and the robot's own box."""

from course.tasks import Slip, Stumble

TASK = "10-ring"

WAYS = {
    "arrays": """
def ring(robot, box, r, bound):
    robot, box = np.reshape(robot, (2, 2)), np.reshape(box, (2, 2))
    near, far = max(0.0, r - bound), r + bound
    low, high = box[:, 0] - robot[:, 1], box[:, 1] - robot[:, 0]
    least, most = np.maximum(0, np.maximum(low, -high)), np.maximum(abs(low), abs(high))
    if np.hypot(*least) > far or np.hypot(*most) < near:
        return None
    outer = np.sqrt(far**2 - least[::-1] ** 2)
    inner = np.sqrt(np.clip(near**2 - most[::-1] ** 2, 0, None))
    west = np.array([robot[:, 0] - outer, robot[:, 1] - inner]).T
    east = np.array([robot[:, 0] + inner, robot[:, 1] + outer]).T
    found = []
    for k in range(2):
        kept = [np.clip(side[k], *box[k]) for side in (west, east) if meets(side[k], box[k])]
        found += [min(k[0] for k in kept), max(k[1] for k in kept)]
    return np.array(found)
def meets(a, b):
    return a[0] <= b[1] and b[0] <= a[1]
""",
    "differences first": """
def ring(robot, box, r, bound):
    near, far = r - bound, r + bound
    x = box[0] - robot[1], box[1] - robot[0]
    y = box[2] - robot[3], box[3] - robot[2]
    def smallest(low, high):
        return 0.0 if low <= 0 <= high else min(abs(low), abs(high))
    def allowed(along, across):
        most = far**2 - smallest(*across) ** 2
        least = near**2 - max(across[0] ** 2, across[1] ** 2) if near > 0 else 0
        if most < 0:
            return []
        a, b = np.sqrt(max(least, 0)), np.sqrt(most)
        pieces = [(max(along[0], s), min(along[1], t)) for s, t in ((-b, -a), (a, b))]
        return [piece for piece in pieces if piece[0] <= piece[1]]
    found = []
    for k, along, across in ((0, x, y), (2, y, x)):
        pieces = allowed(along, across)
        if not pieces:
            return None
        found.append(max(box[k], robot[k] + pieces[0][0]))
        found.append(min(box[k + 1], robot[k + 1] + pieces[-1][1]))
    return found
""",
    "side by side": """
def ring(robot, box, r, bound):
    found = []
    near, far = max(r - bound, 0), r + bound
    for k, m in ((0, 2), (2, 0)):
        dy = [box[m] - robot[m + 1], box[m + 1] - robot[m]]
        off = 0 if dy[0] * dy[1] < 0 else min(np.abs(dy))
        if off > far:
            return None
        reach = (far**2 - off**2) ** 0.5
        hole = max(near**2 - max(np.abs(dy)) ** 2, 0) ** 0.5
        low, high = max(box[k], robot[k] - reach), min(box[k + 1], robot[k + 1] + reach)
        # what lies between the two pieces, if anything does
        gap = robot[k + 1] - hole, robot[k] + hole
        if gap[0] < gap[1]:
            low = gap[1] if gap[0] < low < gap[1] else low
            high = gap[0] if gap[0] < high < gap[1] else high
        if low > high:
            return None
        found.extend((low, high))
    return tuple(found)
""",
}

NEAR = "near, far = max(r - bound, 0), r + bound"
DIFFERENCE = "low, high = box[k] - robot[k + 1], box[k + 1] - robot[k]"
APART = "return max(0, low, -high), max(-low, high)"
FAR_GUARD = "        if least > far:\n            return None\n"
ROOTS = "outer, inner = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))"
SIDES = "sides = (robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)"
PIECES = "[(max(low, box[k]), min(high, box[k + 1])) for low, high in sides]"
KEPT = "kept = [(low, high) for low, high in pieces if low <= high]"
RETURN = "return (kept[0][0], kept[-1][1]) if kept else None"
LAST = "return None if x is None or y is None else np.array([*x, *y])"
ALONG = "x, y = left_along(0, 2), left_along(2, 0)"

SLIPS = (
    Slip(
        "square",
        "The ring is taken for the square round it. Where the object must lie aside as well, less is left "
        "of the range for the other axis.",
        (ROOTS, "outer, inner = far, np.sqrt(max(near**2 - most**2, 0))"),
        (ROOTS, "outer, inner = far, 0"),
    ),
    Slip(
        "square-hole",
        "The inner circle is taken for a square: |dx| may be less than near if |dy| is large.",
        (ROOTS, "outer, inner = np.sqrt(far**2 - least**2), near"),
        (ROOTS, "outer, inner = far, near"),
    ),
    Slip(
        "no-hole",
        "The inner circle forbids nothing here. What is nearer than r − bound is not allowed either.",
        (ROOTS, "outer, inner = np.sqrt(far**2 - least**2), 0"),
        (NEAR, "near, far = 0, r + bound"),
    ),
    Slip(
        "disc-only-hole",
        "The outer circle forbids nothing here. What is farther away than r + bound is not allowed either.",
        [(NEAR, "near, far = max(r - bound, 0), 1e3")],
    ),
    Slip(
        "bound-forgotten",
        "The range is taken as exact: it may be off by the bound, either way.",
        (NEAR, "near, far = r, r"),
    ),
    Slip(
        "bound-inwards",
        "The bound makes the ring thinner. A range that may be off allows more places.",
        (NEAR, "near, far = r + bound, r + bound"),
        (NEAR, "near, far = max(r - bound, 0), r"),
        (NEAR, "near, far = r, r + bound"),
    ),
    Slip(
        "negative-range",
        "r − bound may be negative, and its square is not: then no place is too near.",
        (NEAR, "near, far = r - bound, r + bound"),
        (NEAR, "near, far = abs(r - bound), r + bound"),
    ),
    Slip(
        "most-for-outer",
        "The largest |dy| is taken for both circles. With the least |dy| the outer one leaves more room.",
        (
            ROOTS,
            "outer, inner = np.sqrt(max(far**2 - most**2, 0)), np.sqrt(max(near**2 - most**2, 0))",
        ),
    ),
    Slip(
        "least-for-inner",
        "The least |dy| is taken for both circles. With the largest |dy| the object may be nearer in x.",
        (ROOTS, "outer, inner = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - least**2, 0))"),
    ),
    Slip(
        "least-never-zero",
        "The least |dy| is that at an end. Where dy may be negative and positive, it may be 0 as well.",
        (APART, "return min(abs(low), abs(high)), max(-low, high)"),
    ),
    Slip(
        "squares-forgotten",
        "Lengths along x and y are subtracted like numbers. They stand at a right angle to each other.",
        (ROOTS, "outer, inner = far - least, max(near - most, 0)"),
    ),
    Slip(
        "root-forgotten",
        "dx² is taken for dx: the root is missing.",
        (ROOTS, "outer, inner = far**2 - least**2, max(near**2 - most**2, 0)"),
    ),
    Slip(
        "own-axis",
        "What is left for dx is worked out from dx itself. It is dy that takes its share of the range.",
        (ALONG, "x, y = left_along(0, 0), left_along(2, 2)"),
    ),
    Slip(
        "axes-exchanged",
        "x and y have changed places in what is returned.",
        ("np.array([*x, *y])", "np.array([*y, *x])"),
    ),
    Slip(
        "order",
        "The numbers are right, their order is not: x_min, x_max, y_min, y_max.",
        ("np.array([*x, *y])", "np.array([x[0], y[0], x[1], y[1]])"),
    ),
    Slip(
        "robot-in-the-middle",
        "The robot is taken to stand in the middle of its box. It may stand anywhere in it.",
        (NEAR, f"robot = np.repeat([np.mean(robot[:2]), np.mean(robot[2:])], 2)\n    {NEAR}"),
        (
            SIDES,
            "sides = (m - outer, m - inner), (m + inner, m + outer)\n        ".replace(
                "m", "np.mean(robot[k : k + 2])"
            ),
        ),
    ),
    Slip(
        "robot-at-a-corner",
        "The robot is taken to stand at one corner of its box. It may stand anywhere in it.",
        (NEAR, f"robot = np.array(robot)[[0, 0, 2, 2]]\n    {NEAR}"),
        (NEAR, f"robot = np.array(robot)[[1, 1, 3, 3]]\n    {NEAR}"),
    ),
    Slip(
        "robot-inwards",
        "The robot's box is used the wrong way round: places that only its far end allows are cut off.",
        (
            SIDES,
            "sides = (robot[k + 1] - outer, robot[k] - inner), (robot[k + 1] + inner, robot[k] + outer)",
        ),
    ),
    Slip(
        "differences",
        "These are differences. The robot's place has to be added to get the object's.",
        (SIDES, "sides = (-outer, -inner), (inner, outer)"),
    ),
    Slip(
        "one-side",
        "Only one side of the robot is looked at. The object may be on either, and where both are possible "
        "the box holds both.",
        (SIDES, "sides = [(robot[k] + inner, robot[k + 1] + outer)]"),
        (SIDES, "sides = [(robot[k] - outer, robot[k + 1] - inner)]"),
        (RETURN, "return kept[0] if kept else None"),
        (RETURN, "return kept[-1] if kept else None"),
    ),
    Slip(
        "nearer-side",
        "The side on which the middle of the box lies is taken. Places on the other side may be possible, too.",
        (
            SIDES,
            f"{SIDES}\n        sides = [sides[int(sum(box[k : k + 2]) > sum(robot[k : k + 2]))]]",
        ),
    ),
    Slip(
        "not-intersected",
        "This is what the range says alone. What was known of the object's box still holds.",
        (PIECES, "[side for side in sides if side[0] <= box[k + 1] and box[k] <= side[1]]"),
    ),
    Slip(
        "corners-only",
        "This is the box round those corners that the ring allows. Places between corners are allowed, too.",
        """
def ring(robot, box, r, bound):
    kept = [
        (x, y)
        for x in box[:2]
        for y in box[2:]
        if any(abs(np.hypot(x - u, y - v) - r) <= bound for u in robot[:2] for v in robot[2:])
    ]
    if not kept:
        return None
    x, y = np.transpose(kept)
    return np.array([x.min(), x.max(), y.min(), y.max()])
""",
    ),
    Slip(
        "never-none",
        "Nothing is left of some boxes, and a box comes back all the same.",
        (LAST, "return box if x is None or y is None else np.array([*x, *y])"),
        (LAST, "return np.zeros(4) if x is None or y is None else np.array([*x, *y])"),
    ),
    Slip(
        "none-if-near",
        "None comes back although some of the box is allowed: it is enough that one place is.",
        (FAR_GUARD, "        if most > far:\n            return None\n"),
    ),
    Slip(
        "sampled",
        "The box is a little too small: that of many places that were tried. Find the extremes themselves.",
        *(
            f"""
def ring(robot, box, r, bound):
    rng = np.random.default_rng({seed})
    place = rng.uniform(box[::2], box[1::2], ({n}, 2))
    stands = rng.uniform(robot[::2], robot[1::2], ({n}, 2))
    kept = place[np.abs(np.hypot(*(place - stands).T) - r) <= bound]
    if not len(kept):
        return None
    return np.array([kept[:, 0].min(), kept[:, 0].max(), kept[:, 1].min(), kept[:, 1].max()])
"""
            for seed, n in ((0, 1000), (0, 10_000), (1, 10_000))
        ),
    ),
)

PASTED = {
    "the drive's box": """
def ring(robot, box, r, bound):
    seen = predict(robot, (-np.pi, np.pi), (r - bound, r + bound), (0.0, 0.0))
    low, high = np.maximum(box, seen)[::2], np.minimum(box, seen)[1::2]
    if (low > high).any():
        return None
    return np.array([low[0], high[0], low[1], high[1]])
""",
    "the square's edges": """
def ring(robot, box, r, bound):
    for a, b in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
        c = r + bound + max(a * robot[0], a * robot[1]) + max(b * robot[2], b * robot[3])
        box = None if box is None else clip(box, (a, b, c))
    return box
""",
}

STUMBLES = (
    Stumble("malformed", (LAST, "return x"), ("np.array([*x, *y])", "np.array([*x, *y]) * np.nan")),
    Stumble("raised", (LAST, "return np.array([*x, *y])")),
    Stumble("not attempted", "def ring(robot, box, r, bound):\n    raise NotImplementedError"),
)

MUTANTS = 1000
