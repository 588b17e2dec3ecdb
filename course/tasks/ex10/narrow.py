"""Programs of 10-narrow: many ways to smaller boxes, and ways that give up what is possible."""

from course.tasks import Slip, Stumble

TASK = "10-narrow"

WAYS = {
    "where lines cross": """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(2):
        ends, found = np.linspace(*heading, 25), []
        for piece in zip(ends[:-1], ends[1:]):
            lines = [(-1, 0, -robot[0]), (1, 0, robot[1]), (0, -1, -robot[2]), (0, 1, robot[3])]
            for place, sight in zip(objects, z):
                lines += list(edges(sight, bounds, np.add(piece, np.pi), np.repeat(place, 2)))
            lines = np.array(lines)
            k, m = np.triu_indices(len(lines), 1)
            (a, b, c), (d, e, f) = lines[k].T, lines[m].T
            with np.errstate(all="ignore"):
                points = np.array([c * e - b * f, a * f - c * d]) / (a * e - b * d)
                points = points[:, (lines[:, :2] @ points <= lines[:, 2:] + 1e-9).all(axis=0)]
            if points.size:
                found.append([*points.min(axis=1), piece[0], *points.max(axis=1), piece[1]])
        low, high = np.min(found, axis=0)[:3], np.max(found, axis=0)[3:]
        robot, heading = np.array([low[0], high[0], low[1], high[1]]), np.array([low[2], high[2]])
    return robot, heading
""",
    "a grid of cells": """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(4):
        sides = [np.linspace(*side, 13) for side in (robot[:2], robot[2:], heading)]
        low = np.array(np.meshgrid(*(s[:-1] for s in sides))).reshape(3, -1)
        high = np.array(np.meshgrid(*(s[1:] for s in sides))).reshape(3, -1)
        for place, (r, bearing) in zip(objects, z):
            x, y = np.array([low[:2], high[:2]]).swapaxes(0, 1) - place[:, None, None]
            aside = [np.maximum(0, np.maximum(s[0], -s[1])) for s in (x, y)]
            most = np.hypot(np.abs(x).max(axis=0), np.abs(y).max(axis=0))
            middle = np.arctan2(-y.sum(axis=0), -x.sum(axis=0))
            off = wrap(np.arctan2(-y[[0, 0, 1, 1]], -x[[0, 1, 0, 1]]) - middle)
            turn = wrap(middle - bearing - (low[2] + high[2]) / 2)
            slack = bounds[1] + (high[2] - low[2]) / 2
            seen = (turn + off.min(axis=0) <= slack) & (turn + off.max(axis=0) >= -slack)
            seen |= np.hypot(*aside) == 0
            keep = seen & (np.hypot(*aside) <= r + bounds[0]) & (most >= r - bounds[0])
            low, high = low[:, keep], high[:, keep]
        ends = np.array([low.min(axis=1), high.max(axis=1)])
        robot, heading = ends[:, :2].T.ravel(), ends[:, 2]
    return robot, heading
""",
    "pieces after many rounds": """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(12):
        robot, heading = look(robot, heading, objects, z, bounds)

    def rest(polygon, a, b, c):
        kept = []
        for k, (x, y) in enumerate(polygon):
            u, v = polygon[k - 1]
            here, before = a * x + b * y - c, a * u + b * v - c
            if here * before < 0:
                t = before / (before - here)
                kept.append((u + t * (x - u), v + t * (y - v)))
            if here <= 0:
                kept.append((x, y))
        return kept

    boxes = []
    width = (heading[1] - heading[0]) / 40
    for k in range(40):
        piece = heading[0] + k * width, heading[0] + (k + 1) * width
        polygon = [(robot[0], robot[2]), (robot[1], robot[2]), (robot[1], robot[3]), (robot[0], robot[3])]
        for place, sight in zip(objects, z):
            for a, b, c in edges(sight, bounds, np.add(piece, np.pi), place[[0, 0, 1, 1]]):
                polygon = rest(polygon, a, b, c)
            if not polygon:
                break
        if polygon:
            boxes.append((*np.min(polygon, axis=0), *np.max(polygon, axis=0), *piece))
    x0, y0, x1, y1, right, left = np.transpose(boxes)
    return (x0.min(), x1.max(), y0.min(), y1.max()), (right.min(), left.max())
""",
}
PUSHED = "edges(sight, bounds, np.add(piece, np.pi), np.repeat(place, 2))"
PASSES = "for _ in range(2):"
PIECES = "np.linspace(*heading, 25)"
ROBOT = "robot = np.array([x.min(), x.max(), y.min(), y.max()])"
HEADING = "heading = np.array([angles[0][0], angles[-1][1]])"
RETURN = "    return robot, heading"
CROSSING = "if (here >= 0) != (there >= 0):"
ROUND = "look(robot, heading, objects, z, bounds)"

SLIPS = (
    Slip(
        "one-round",
        "This is what one round of look leaves: sound, and wide. Nothing has been done yet about the width "
        "of the heading, nor about the boxes that are put round what is left.",
        f"def narrow(robot, heading, objects, z, bounds):\n    return {ROUND}",
    ),
    Slip(
        "many-rounds",
        "Rounds help until nothing shrinks any more, and then no more. What would the edges look like if "
        "the heading were known better than that?",
        *(
            f"""
def narrow(robot, heading, objects, z, bounds):
    for _ in range({rounds}):
        robot, heading = {ROUND}
    return robot, heading
"""
            for rounds in (2, 3, 5, 10, 20)
        ),
    ),
    Slip(
        "boxes-between",
        "A box is put round what each edge leaves. Places that had been given up come back by that.",
        (
            "corners = rest(corners, edge)",
            "x, y = np.transpose(rest(corners, edge)) if rest(corners, edge) else ((), ())\n"
            "                corners = [(u, v) for u, v in ((min(x), min(y)), (max(x), min(y)), "
            "(max(x), max(y)), (min(x), max(y)))] if len(x) else []",
        ),
    ),
    Slip(
        "one-pass",
        "The pieces of the heading are as wide as before once most of them are gone. What is left of it "
        "can be cut into pieces again.",
        (PASSES, "for _ in range(1):"),
    ),
    Slip(
        "few-pieces",
        "The heading is cut into a few wide pieces only: the edges of each allow much that no single "
        "heading allows.",
        *((PIECES, f"np.linspace(*heading, {n})") for n in (3, 5, 6)),
    ),
    Slip(
        "middles-of-pieces",
        "Each piece of the heading is taken for the heading in its middle. A heading between two middles "
        "allows other places: nobody has shown that these are impossible.",
        [
            (PASSES, "for _ in range(1):"),
            (PIECES, "np.linspace(*heading, 201)"),
            (
                PUSHED,
                "edges(sight, bounds, np.repeat(np.mean(piece), 2) + np.pi, np.repeat(place, 2))",
            ),
        ],
    ),
    Slip(
        "inner-ends",
        "The first and the last piece that are left are cut off the heading. Their headings are possible.",
        (HEADING, "heading = np.array([angles[0][1], angles[-1][0]])"),
    ),
    Slip(
        "one-piece",
        "Only one piece of the heading is kept. Each of the pieces that are left may hold the true one.",
        [
            (
                "x, y = np.array([corner for _, corners in pieces for corner in corners]).T",
                "pieces = [pair for pair in pieces if pair[1]][:1]\n"
                "        x, y = np.array(pieces[0][1]).T",
            ),
        ],
    ),
    Slip(
        "heading-kept",
        "The heading comes back as it was. Which pieces of it are left?",
        [(PASSES, "known = heading\n    " + PASSES), (RETURN, "    return robot, known")],
    ),
    Slip(
        "robot-kept",
        "The robot's box comes back as it was. Which places are left, over all pieces of the heading?",
        [(PASSES, "known = robot\n    " + PASSES), (RETURN, "    return known, heading")],
    ),
    Slip(
        "shaved",
        "Box and heading are shaved all round, as if poses near the rim did not count. A guarantee holds "
        "for them as well.",
        *(
            (RETURN, f"    return {k} * robot + {1 - k:.2f} * robot[[1, 0, 3, 2]], heading")
            for k in (0.9, 0.95)
        ),
        (RETURN, "    return robot, 0.9 * heading + 0.1 * heading[::-1]"),
    ),
    Slip(
        "sampled",
        "Poses were tried at random. Between those that agree, and beyond them, others agree as well: what "
        "was not tried is not impossible.",
        *(
            f"""
def narrow(robot, heading, objects, z, bounds):
    poses = np.random.default_rng(0).uniform(*np.reshape([*robot, *heading], (3, 2)).T, ({n}, 3))
    for (x, y), seen in zip(objects, z):
        dx, dy = x - poses[:, 0], y - poses[:, 1]
        off = np.array([np.hypot(dx, dy) - seen[0], wrap(np.arctan2(dy, dx) - poses[:, 2] - seen[1])])
        share = np.abs(off / bounds[:, None]).max(axis=0)
        poses = poses[share <= max(1, share.min())]
    low, high = poses.min(axis=0), poses.max(axis=0)
    return [low[0], high[0], low[1], high[1]], [low[2], high[2]]
"""
            for n in (10_000, 40_000)
        ),
    ),
)

PASTED = {
    "look": f"def narrow(robot, heading, objects, z, bounds):\n    return {ROUND}",
    "look until nothing shrinks": f"""
def narrow(robot, heading, objects, z, bounds):
    for _ in range(20):
        robot, heading = {ROUND}
    return robot, heading
""",
    "each sighting until nothing shrinks": """
def narrow(robot, heading, objects, z, bounds):
    for place, sight in zip(objects, z):
        for _ in range(10):
            robot, heading = look(robot, heading, place[None], sight[None], bounds)
    return robot, heading
""",
    "predict backwards": """
def narrow(robot, heading, objects, z, bounds):
    for place, (r, bearing) in zip(objects, z):
        way = -r - bounds[0], -r + bounds[0]
        back = predict(np.repeat(place, 2), heading, way, (bearing - bounds[1], bearing + bounds[1]))
        robot = np.where([1, 0, 1, 0], np.maximum(robot, back), np.minimum(robot, back))
        heading = sharpen(heading, robot, np.repeat(place, 2), bearing, bounds[1])
    return robot, heading
""",
}

STUMBLES = (
    Stumble("malformed", (RETURN, "    return robot"), (RETURN, "    return heading, robot")),
    Stumble(
        "raised",  # as nothing is left at all
        (PUSHED, "edges(sight, bounds, piece, np.repeat(place, 2))"),
        (PUSHED, "edges(sight, bounds / 2, np.add(piece, np.pi), np.repeat(place, 2))"),
        (CROSSING, "if not kept and (here >= 0) != (there >= 0):"),
    ),
    Stumble(
        "not attempted",
        "def narrow(robot, heading, objects, z, bounds):\n    raise NotImplementedError",
    ),
)

MUTANTS = 40

EQUIVALENT = {
    "": "any method is right whose boxes hold all poses that agree, and are small enough: that is what "
    "the laws ask",
}
