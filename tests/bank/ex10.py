"""Solutions of exercise 10: boxes that lose the truth, boxes too wide, and other right ways."""

from tests.bank import Right, Wrong

PREDICT = """
def cosine_range(low, high, whole=True):
    def met(angle):
        return {met}
    ends = np.cos([low, high])
    return np.array([{least}, {most}])

def predict(box, heading, way, direction):
    low, high = {course}
    c, s = cosine_range(low, high), cosine_range(low - np.pi / 2, high - np.pi / 2)
    dx, dy = {products}
    return {result}
"""


def predict(**changes):
    parts = {
        "met": "(angle - low) % (2 * np.pi) <= high - low",
        "least": "-1 if met(np.pi) else ends.min()",
        "most": "1 if met(0) else ends.max()",
        "course": "heading[0] + direction[0], heading[1] + direction[1]",
        "products": "np.outer(way, c), np.outer(way, s)",
        "result": "np.array([box[0] + dx.min(), box[1] + dx.max(), "
        "box[2] + dy.min(), box[3] + dy.max()])",
    }
    return PREDICT.format(**(parts | changes))


EDGES = """
def edges(z, bounds, heading, box):
    (r, beta), (dr, db), (first, last) = z, bounds, heading
    u = {direction}
    d = {d_abs}
    left, right = u + d, u - d
    rows = [
        [np.cos(u), np.sin(u), {far}],
        [-np.cos(u), -np.sin(u), -{near}],
        [-np.sin(left), np.cos(left), 0.0],
        [np.sin(right), -np.cos(right), 0.0],
    ]
    rows = {rows}
    for row in rows:
        a, b, _ = row
        row[2] = row[2] + {push}
    return {result}
"""


def edges(**changes):
    parts = {
        "direction": "(first + last) / 2 + beta",
        "d_abs": "db + (last - first) / 2",
        "far": "(r + dr)",
        "near": "(r - dr) * np.cos(d)",
        "rows": "rows",
        "push": "max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])",
        "result": "np.array(rows)",
    }
    return EDGES.format(**(parts | changes))


CLIP = """
def clip(box, edge):
    x0, x1, y0, y1 = box
    a, b, c = edge
    ax, by = {pick}(a * x0, a * x1), {pick}(b * y0, b * y1)
    if {none}:
        return None
    {x}
    {y}
    return {result}
"""

INWARDS = """
    if a > 0:
        x1 = min(x1, (c - by) / a)
    elif a < 0:
        x0 = max(x0, (c - by) / a)
"""


def clip(x=INWARDS, y=None, **changes):
    if y is None:
        swapped = {"x1": "y1", "x0": "y0", "by": "ax", " a ": " b ", "/ a": "/ b"}
        y = x
        for old, new in swapped.items():
            y = y.replace(old, new)
    parts = {"pick": "min", "none": "ax + by > c", "result": "np.array([x0, x1, y0, y1])"}
    return CLIP.format(**(parts | {"x": x.strip(), "y": y.strip()} | changes))


HEADING = """
def sharpen(heading, robot, box, bearing, bound):
    {overlap}
    corners = [(x, y) for x in robot[:2] for y in robot[2:]]
    seen = np.array([{seen} for x, y in corners for u in box[:2] for v in box[2:]])
    off = {off}
    right, left = {told}
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    {turns}
    return {result}
"""
APART = (
    "if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]): "
    "return heading"
)


def sharpen(**changes):
    parts = {
        "overlap": APART,
        "seen": "np.arctan2(v - y, u - x)",
        "off": "wrap(seen - seen[0])",
        "told": "seen[0] + off.min() - bearing - bound, seen[0] + off.max() - bearing + bound",
        "turns": "turns = here + wrap(there - here) - there; right += turns; left += turns",
        "result": "np.array([max(heading[0], right), min(heading[1], left)])",
    }
    return HEADING.format(**(parts | changes))


SEE = """
def see(robot, heading, box, z, bounds):
    if {guard}:
        new = {object}
        if new is None:
            return None
        around = {around}
        box = new
        robot = {robot}
        if robot is None:
            return None
    return {result}
"""


def see(**changes):
    parts = {
        "guard": "bounds[1] + (heading[1] - heading[0]) / 2 < np.pi / 2",
        "object": "cut(box, edges(z, bounds, heading, robot))",
        "around": "new",
        "robot": "cut(robot, edges(z, bounds, np.add(heading, np.pi), around))",
        "result": "robot, sharpen(heading, robot, box, z[1], bounds[1]), box",
    }
    return SEE.format(**(parts | changes))


BOTH = {"10-predict:holds", "10-predict:tight"}
NORMALS, FAR, NEAR, SIDES = ({f"10-edges:{law}"} for law in ("normals", "far", "near", "sides"))
PLACED = FAR | NEAR | SIDES
KEEPS, SMALLEST, EMPTY = ({f"10-clip:{law}"} for law in ("keeps", "smallest", "empty"))
HOLDS, TIGHT, OVERLAP = ({f"10-heading:{law}"} for law in ("holds", "tight", "overlap"))
ANGLES = HOLDS | TIGHT
SHARP = {"10-see:sharp"}
GUARANTEE = {"10-see:guarantee"}
MALFORMED = {"problem": "malformed"}

IN_PREDICT = [
    Wrong("ends only", predict(least="ends.min()", most="ends.max()"), BOTH, "corners-only"),
    Wrong(
        "extremes once round",
        predict(met="low <= angle <= high").replace(
            "cosine_range(low - np.pi / 2, high - np.pi / 2)",
            "np.array([-1 if low <= -np.pi / 2 <= high else min(np.sin(low), np.sin(high)),"
            " 1 if low <= np.pi / 2 <= high else max(np.sin(low), np.sin(high))])",
        ),
        BOTH,
        "once-round",
    ),
    Wrong("−1 to 1 always", predict(met="True"), {"10-predict:tight"}, "any-direction"),
    Wrong(
        "low with low, high with high",
        predict(products="np.sort(np.multiply(way, c)), np.sort(np.multiply(way, s))"),
        BOTH,
        "two-products",
    ),
    Wrong(
        "start left out",
        predict(result="np.array([dx.min(), dx.max(), dy.min(), dy.max()])"),
        BOTH,
        "box-forgotten",
    ),
    Wrong("δ left out", predict(course="heading"), BOTH, "direction-forgotten"),
    Wrong(
        "middle of the heading",
        predict(course="np.mean(heading) + np.asarray(direction)"),
        BOTH,
        "heading-narrow",
    ),
    Wrong(
        "sine for cosine", predict(products="np.outer(way, s), np.outer(way, c)"), BOTH, "exchanged"
    ),
    Wrong(
        "radians twice",
        predict(course="np.radians([heading[0] + direction[0], heading[1] + direction[1]])"),
        BOTH,
        "degrees",
    ),
    Wrong(
        "x_min, y_min, x_max, y_max",
        predict(
            result="np.array([box[0] + dx.min(), box[2] + dy.min(), "
            "box[1] + dx.max(), box[3] + dy.max()])"
        ),
        BOTH,
        "order",
    ),
    Wrong("two intervals", predict(result="[(0, 1), (0, 1)]"), BOTH, **MALFORMED),
    Wrong(
        "a box far too wide",
        predict(result="np.array([-99, 99, -99, 99])"),
        BOTH,
        "idle",
    ),
    Wrong("made-up box", predict(result="np.array([1, 2, 3, 4])"), BOTH, "idle"),
]

IN_PREDICT += [
    Wrong(
        "a grid of headings",
        """
def predict(box, heading, way, direction):
    course = np.linspace(heading[0] + direction[0], heading[1] + direction[1], 500)
    x, y = np.outer(way, np.cos(course)), np.outer(way, np.sin(course))
    return np.array([box[0] + x.min(), box[1] + x.max(), box[2] + y.min(), box[3] + y.max()])
""",
        {"10-predict:holds"},
        "sampled",
    ),
    Wrong(
        "many drives",
        """
def predict(box, heading, way, direction):
    rng, n = np.random.default_rng(0), 20_000
    course, w = rng.uniform(*heading, n) + rng.uniform(*direction, n), rng.uniform(*way, n)
    x, y = w * np.cos(course), w * np.sin(course)
    return np.array([box[0] + x.min(), box[1] + x.max(), box[2] + y.min(), box[3] + y.max()])
""",
        BOTH,
        "sampled",
    ),
]

IN_EDGES = [
    Wrong("near without cosine", edges(near="(r - dr)"), NEAR, "near-without-cosine"),
    Wrong("near at r + d_r", edges(near="(r + dr) * np.cos(d)"), NEAR, "near-plus"),
    Wrong("far with cosine", edges(far="(r + dr) * np.cos(d)"), FAR, "far-cosine"),
    Wrong("not pushed", edges(push="0"), PLACED, "not-pushed"),
    Wrong(
        "pushed by the middle",
        edges(push="a * (box[0] + box[1]) / 2 + b * (box[2] + box[3]) / 2"),
        PLACED,
        "pushed-by-middle",
    ),
    Wrong(
        "pulled in",
        edges(push="min(a * box[0], a * box[1]) + min(b * box[2], b * box[3])"),
        PLACED,
        "pulled-in",
    ),
    Wrong("inside out", edges(result="-np.array(rows)"), NORMALS | PLACED, "inside-out"),
    Wrong(
        "left for right",
        edges(rows="[rows[0], rows[1], rows[3], rows[2]]"),
        NORMALS,
        "sides-exchanged",
    ),
    Wrong("d_β only", edges(d_abs="db"), NORMALS | NEAR | SIDES, "heading-width-forgotten"),
    Wrong("whole width", edges(d_abs="db + last - first"), NORMALS | NEAR | SIDES, "whole-width"),
    Wrong("d_θ only", edges(d_abs="(last - first) / 2"), NORMALS | NEAR | SIDES, "bound-forgotten"),
    Wrong("along the bearing", edges(direction="beta"), NORMALS | PLACED, "heading-forgotten"),
    Wrong(
        "radians of radians",
        edges(
            direction="np.radians((first + last) / 2 + beta)",
            d_abs="np.radians(db + (last - first) / 2)",
        ),
        NORMALS | PLACED,
        "degrees",
    ),
    Wrong("made-up lines", edges(result="np.ones((4, 3))"), NORMALS | PLACED, "idle"),
    Wrong("three edges", edges(result="np.array(rows)[:3]"), NORMALS | PLACED, **MALFORMED),
]

IN_CLIP = [
    Wrong(
        "wrong side",
        clip(
            "if a > 0:\n        x0 = max(x0, (c - by) / a)\n"
            "    elif a < 0:\n        x1 = min(x1, (c - by) / a)"
        ),
        KEEPS | SMALLEST,
        "wrong-side",
    ),
    Wrong(
        "the other half-plane",
        clip(
            "if a > 0:\n        x0 = max(x0, (c - by) / a)\n"
            "    elif a < 0:\n        x1 = min(x1, (c - by) / a)",
            pick="max",
            none="ax + by < c",
        ),
        KEEPS | SMALLEST | EMPTY,
        "wrong-side",
    ),
    Wrong(
        "most for least",
        clip(none="min(a * x0, a * x1) + min(b * y0, b * y1) > c", pick="max"),
        KEEPS,
        "most-for-least",
        may_lose={"10-clip:smallest"},
    ),
    Wrong(
        "y left out",
        clip(
            "if a > 0:\n        x1 = min(x1, c / a)\n    elif a < 0:\n        x0 = max(x0, c / a)",
        ),
        KEEPS | SMALLEST,
        "y-forgotten",
        may_lose={"10-clip:keeps", "10-clip:smallest"},
    ),
    Wrong(
        "sides move outwards",
        clip("if a > 0:\n        x1 = (c - by) / a\n    elif a < 0:\n        x0 = (c - by) / a"),
        SMALLEST,
        "grows",
    ),
    Wrong(
        "always the upper side",
        clip("if a != 0:\n        x1 = min(x1, (c - by) / a)"),
        KEEPS | SMALLEST,
        "always-upper",
    ),
    Wrong(
        "round the allowed corners",
        """
def clip(box, edge):
    a, b, c = edge
    kept = [(x, y) for x in box[:2] for y in box[2:] if a * x + b * y <= c]
    if not kept:
        return None
    x, y = np.transpose(kept)
    return np.array([x.min(), x.max(), y.min(), y.max()])
""",
        KEEPS,
        "corners-only",
    ),
    Wrong("never None", clip(none="False"), EMPTY, "never-none"),
    Wrong(
        "None unless all is allowed",
        clip(none="max(a*x0, a*x1) + max(b*y0, b*y1) > c"),
        KEEPS | SMALLEST | EMPTY,
        "none-too-often",
    ),
    Wrong("the box as it was", clip("pass", "pass"), SMALLEST),
    Wrong("not clipped by an axis", clip().replace("a > 0", "a > 0.01 and b != 0"), SMALLEST),
    Wrong("two numbers", clip(result="np.array([x0, x1])"), KEEPS | SMALLEST | EMPTY, **MALFORMED),
]

IN_HEADING = [
    Wrong(
        "not widened",
        sharpen(told="seen[0] + off.min() - bearing, seen[0] + off.max() - bearing"),
        ANGLES,
        "bound-forgotten",
    ),
    Wrong(
        "narrowed",
        sharpen(
            told="seen[0] + off.min() - bearing + bound, seen[0] + off.max() - bearing - bound"
        ),
        ANGLES,
        "bound-inwards",
    ),
    Wrong(
        "bearing added",
        sharpen(
            told="seen[0] + off.min() + bearing - bound, seen[0] + off.max() + bearing + bound"
        ),
        ANGLES,
        "bearing-added",
    ),
    Wrong("from the object", sharpen(seen="np.arctan2(y - v, x - u)"), ANGLES, "from-the-object"),
    Wrong(
        "middle to middle",
        sharpen(seen="np.arctan2(sum(box[2:]) - sum(robot[2:]), sum(box[:2]) - sum(robot[:2]))"),
        ANGLES,
        "middles-only",
    ),
    Wrong("least and largest number", sharpen(off="seen - seen[0]"), ANGLES, "seam-bearings"),
    Wrong(
        "right wrapped, then compared",
        sharpen(turns="left += wrap(right) - right; right = wrap(right)"),
        ANGLES,
        "seam-intersection",
    ),
    Wrong(
        "both wrapped, then compared",
        sharpen(turns="right, left = wrap(float(right)), wrap(float(left))"),
        ANGLES,
        "seam-intersection",
    ),
    Wrong("not intersected", sharpen(result="np.array([right, left])"), TIGHT, "not-intersected"),
    Wrong("as it was", sharpen(result="np.array(heading)"), {"10-heading"}, "unchanged"),
    Wrong(
        "left, right",
        sharpen(result="np.array([min(heading[1], left), max(heading[0], right)])"),
        ANGLES,
        "exchanged",
    ),
    Wrong(
        "left wrapped",
        sharpen(result="wrap(np.array([max(heading[0], right), min(heading[1], left)]))"),
        ANGLES,
        "left-wrapped",
        may_lose={"10-heading:overlap"},
    ),
    Wrong("overlap not thought of", sharpen(overlap="pass"), OVERLAP, "overlap"),
    Wrong("one angle", sharpen(result="right"), ANGLES | OVERLAP, **MALFORMED),
    Wrong("made-up angles", sharpen(result="np.array([0.3, 0.5])"), ANGLES),
]

IN_SEE = [
    Wrong("no guard", see(guard="True"), GUARANTEE, "no-guard", may_lose=SHARP),
    Wrong(
        "not reversed",
        see(robot="cut(robot, edges(z, bounds, heading, around))"),
        GUARANTEE | SHARP,
        "robot-cut-away",
    ),
    Wrong("pushed by itself", see(around="robot"), GUARANTEE | SHARP, "robot-cut-away"),
    Wrong("robot left alone", see(robot="robot"), SHARP, "robot-left", may_lose=SHARP),
    Wrong(
        "object left alone",
        see(object="box"),
        SHARP,
        "object-left",
        may_lose=SHARP,
    ),
    Wrong(
        "heading left alone",
        see(result="robot, heading, box"),
        SHARP,
        "heading-left",
        may_lose=SHARP,
    ),
    Wrong(
        "early return",
        see().replace(
            "    if bounds",
            "    if bounds[1] + (heading[1] - heading[0]) / 2 >= np.pi / 2:\n"
            "        return robot, heading, box\n    if bounds",
            1,
        ),
        SHARP,
        "heading-waits",
    ),
    Wrong("always None", see(result="None"), GUARANTEE | SHARP, "none"),
    Wrong("nothing done", see(guard="False", result="robot, heading, box"), SHARP),
    Wrong("two of three", see(result="(robot, box)"), GUARANTEE | SHARP, **MALFORMED),
]

WRONG = [*IN_PREDICT, *IN_EDGES, *IN_CLIP, *IN_HEADING, *IN_SEE]

RIGHT = [
    Right("predict: everything else the same", predict()),
    Right(
        "predict: extremes listed",
        """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    first, last = np.ceil(low / (np.pi / 2)), np.floor(high / (np.pi / 2))
    course = [low, high, *np.arange(first, last + 1) * np.pi / 2]
    x = [w * np.cos(a) for w in way for a in course]
    y = [w * np.sin(a) for w in way for a in course]
    return box[0] + min(x), box[1] + max(x), box[2] + min(y), box[3] + max(y)
""",
    ),
    Right(
        "predict: rounded outwards",
        predict()
        + """
inner = predict
def predict(*args):
    return inner(*args) + np.array([-1e-9, 1e-9, -1e-9, 1e-9])
""",
    ),
    Right("edges: normals of any length", edges(result="3 * np.array(rows)")),
    Right("edges: a list of tuples", edges(result="[tuple(row) for row in rows]")),
    Right(
        "edges: pushed by every corner",
        edges(push="max(a * x + b * y for x in box[:2] for y in box[2:])"),
    ),
    Right("clip: a tuple", clip(result="x0, x1, y0, y1")),
    Right(
        "clip: the outline cut",
        """
def clip(box, edge):
    a, b, c = edge
    corners = [(box[i], box[j]) for i, j in ((0, 2), (1, 2), (1, 3), (0, 3))]
    kept = []
    for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1]):
        here, there = c - a * x - b * y, c - a * u - b * v
        if here >= 0:
            kept.append((x, y))
        if here * there < 0:
            t = here / (here - there)
            kept.append((x + t * (u - x), y + t * (v - y)))
    if not kept:
        return None
    x, y = np.transpose(kept)
    return np.array([x.min(), x.max(), y.min(), y.max()])
""",
    ),
    Right(
        "heading: by the box of differences",
        sharpen(
            seen="np.arctan2(v - y, u - x)",
            off="np.angle(np.exp(1j * (seen - seen[0])))",
        ),
    ),
    Right(
        "heading: turns counted",
        sharpen(turns="n = 2 * np.pi * round((here - there) / (2 * np.pi)); right += n; left += n"),
    ),
    Right("see: the object's old box pushes the robot's edges", see(around="box")),
    Right(
        "see: as a list", see(result="[robot, sharpen(heading, robot, box, z[1], bounds[1]), box]")
    ),
    Right(
        "see: the heading first",
        """
def see(robot, heading, box, z, bounds):
    heading = sharpen(heading, robot, box, z[1], bounds[1])
    if bounds[1] + (heading[1] - heading[0]) / 2 < np.pi / 2:
        box = cut(box, edges(z, bounds, heading, robot))
        robot = None if box is None else cut(robot, edges(z, bounds, np.add(heading, np.pi), box))
        if robot is None:
            return None
    return robot, sharpen(heading, robot, box, z[1], bounds[1]), box
""",
    ),
    Right(
        "see: twice each time",
        see()
        + """
once = see
def see(robot, heading, box, z, bounds):
    found = once(robot, heading, box, z, bounds)
    return None if found is None else once(*found, z, bounds)
""",
    ),
]
