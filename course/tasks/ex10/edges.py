"""Programs of 10-edges: where the four edges stand, which way they look, how far they move out."""

from course.tasks import Slip, Stumble

TASK = "10-edges"

WAYS = {
    "every corner tried": """
def edges(z, bounds, heading, box):
    (r, beta), (d_r, d_beta), (right, left) = z, bounds, heading
    u, d = (right + left) / 2 + beta, d_beta + (left - right) / 2
    found = []
    for angle, c in (
        (u, r + d_r),
        (u + np.pi, -(r - d_r) * np.cos(d)),
        (u + d + np.pi / 2, 0.0),
        (u - d - np.pi / 2, 0.0),
    ):
        a, b = np.cos(angle), np.sin(angle)
        found.append((a, b, c + max(a * x + b * y for x in box[:2] for y in box[2:])))
    return found
""",
    "pushed by half the sides": """
def edges(z, bounds, heading, box):
    direction = np.mean(heading) + z[1]
    d_abs = bounds[1] + np.ptp(heading) / 2
    angles = direction + np.array([0, np.pi, d_abs + np.pi / 2, -d_abs - np.pi / 2])
    n = np.column_stack([np.cos(angles), np.sin(angles)])
    middle, half = np.reshape(box, (2, 2)).mean(axis=1), np.ptp(np.reshape(box, (2, 2)), axis=1) / 2
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d_abs), 0, 0])
    return np.column_stack([n, c + n @ middle + np.abs(n) @ half])
""",
    "normals of any length": """
def edges(z, bounds, heading, box):
    r, d_r = z[0], bounds[0]
    low, high = heading[0] + z[1] - bounds[1], heading[1] + z[1] + bounds[1]
    u = (low + high) / 2
    rows = [
        (np.cos(u), np.sin(u), r + d_r),
        (-np.cos(u), -np.sin(u), -(r - d_r) * np.cos((high - low) / 2)),
        (-np.sin(high), np.cos(high), 0),
        (np.sin(low), -np.cos(low), 0),
    ]
    out = []
    for a, b, c in rows:
        x, y = box[1] if a > 0 else box[0], box[3] if b > 0 else box[2]
        out.append([3 * a, 3 * b, 3 * (c + a * x + b * y)])
    return np.array(out)
""",
    "through the points of the ring": """
def edges(z, bounds, heading, box):
    u, d = (heading[0] + heading[1]) / 2 + z[1], bounds[1] + (heading[1] - heading[0]) / 2
    ahead = np.array([np.cos(u), np.sin(u)])
    to_left = np.array([np.cos(u + d), np.sin(u + d)])
    to_right = np.array([np.cos(u - d), np.sin(u - d)])
    tip, corner = (z[0] + bounds[0]) * ahead, (z[0] - bounds[0]) * to_left
    normals = [ahead, -ahead, np.array([-to_left[1], to_left[0]]), np.array([to_right[1], -to_right[0]])]
    through = [tip, corner, to_left, to_right]
    corners = np.array([[x, y] for x in box[:2] for y in box[2:]])
    return [[*n, n @ p + (corners @ n).max()] for n, p in zip(normals, through)]
""",
}

DIRECTION = "direction = (heading[0] + heading[1]) / 2 + z[1]"
D_ABS = "d_abs = bounds[1] + (heading[1] - heading[0]) / 2"
FAR = "np.sin(direction), z[0] + bounds[0]]"
NEAR = "-(z[0] - bounds[0]) * np.cos(d_abs)"
NEAR_ROW = "[-np.cos(direction), -np.sin(direction), "
SIDES = "[-np.sin(left), np.cos(left), 0]", "[np.sin(right), -np.cos(right), 0]"
PUSH = "row[2] += max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])"

SLIPS = (
    Slip(
        "near-without-cosine",
        "The near edge stands at r − d_r and cuts off the two ends of the inner arc. How near do they "
        "come, measured along the middle direction?",
        (NEAR, "-(z[0] - bounds[0])"),
    ),
    Slip(
        "near-plus",
        "The near edge is made from r + d_r: it stands too far out.",
        (NEAR, "-(z[0] + bounds[0]) * np.cos(d_abs)"),
        (NEAR, "-(z[0] + bounds[0])"),
    ),
    Slip(
        "near-at-r",
        "The near edge leaves the range's bound out: the object may be nearer than r.",
        (NEAR, "-z[0] * np.cos(d_abs)"),
        (NEAR, "-z[0]"),
    ),
    Slip(
        "near-divided",
        "The near edge is divided by the cosine: the inner corners come nearer, not farther away.",
        (NEAR, "-(z[0] - bounds[0]) / np.cos(d_abs)"),
    ),
    Slip(
        "near-bearing-only",
        "The near edge's cosine is that of d_β alone: the heading is not known exactly either.",
        (NEAR, "-(z[0] - bounds[0]) * np.cos(bounds[1])"),
    ),
    Slip(
        "near-sine",
        "The near edge stands at the sine of d_abs: that is how far the inner corners lie aside.",
        (NEAR, "-(z[0] - bounds[0]) * np.sin(d_abs)"),
    ),
    Slip(
        "near-c",
        "The near edge points back, but its c is positive: nothing is forbidden by it. With (a, b) the "
        "sign of the distance turns as well.",
        (NEAR, "(z[0] - bounds[0]) * np.cos(d_abs)"),
    ),
    Slip(
        "near-ahead",
        "The near edge points ahead: it allows what is nearer, and forbids the object itself.",
        (
            NEAR_ROW + NEAR,
            "[np.cos(direction), np.sin(direction), (z[0] - bounds[0]) * np.cos(d_abs)",
        ),
        (NEAR_ROW, "[np.cos(direction), np.sin(direction), "),
    ),
    Slip(
        "far-cosine",
        "The far edge has a cosine: straight ahead the arc reaches r + d_r itself. Only the near edge "
        "has to stand back.",
        (FAR, "np.sin(direction), (z[0] + bounds[0]) * np.cos(d_abs)]"),
    ),
    Slip(
        "far-short",
        "The far edge stands too near: the object may be as far away as r and its bound together.",
        (FAR, "np.sin(direction), z[0]]"),
        (FAR, "np.sin(direction), z[0] - bounds[0]]"),
    ),
    Slip(
        "not-pushed",
        "These are the edges as seen from the origin. The robot stands anywhere in its box: how far "
        "must each edge be moved so that it holds from every point of it?",
        (PUSH, "pass"),
    ),
    Slip(
        "pushed-by-middle",
        "The edges are those seen from the middle of the box. From its other points more may be seen, "
        "and for each edge another point decides.",
        (PUSH, "row[2] += a * (box[0] + box[1]) / 2 + b * (box[2] + box[3]) / 2"),
    ),
    Slip(
        "pulled-in",
        "The edges are moved by the least of a x + b y over the box: what is seen from its far points "
        "is cut off.",
        (PUSH, "row[2] += min(a * box[0], a * box[1]) + min(b * box[2], b * box[3])"),
        (PUSH, "row[2] -= max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])"),
    ),
    Slip(
        "one-corner",
        "All edges are moved by the same corner of the box. Which corner is farthest out depends on "
        "where the edge looks.",
        (PUSH, "row[2] += a * box[0] + b * box[2]"),
        (PUSH, "row[2] += a * box[1] + b * box[3]"),
        (PUSH, "row[2] += max(a * box[0] + b * box[2], a * box[1] + b * box[3])"),
    ),
    Slip(
        "pushed-by-size",
        "The edges are moved by the size of the box, wherever it lies. What counts is how far out its "
        "points are, seen from the origin.",
        (PUSH, "row[2] += abs(a) * (box[1] - box[0]) / 2 + abs(b) * (box[3] - box[2]) / 2"),
        (PUSH, "row[2] += abs(a) * (box[1] - box[0]) + abs(b) * (box[3] - box[2])"),
    ),
    Slip(
        "pushed-in-x-only",
        "The edges are moved by the box's extent along one axis only.",
        (PUSH, "row[2] += max(a * box[0], a * box[1])"),
        (PUSH, "row[2] += max(b * box[2], b * box[3])"),
    ),
    Slip(
        "pushed-without-sign",
        "The edges are moved by the largest x and y times |a| and |b|. Where a or b is negative, it is "
        "the smallest x or y that is farthest out.",
        (PUSH, "row[2] += abs(a) * max(box[0], box[1]) + abs(b) * max(box[2], box[3])"),
    ),
    Slip(
        "inside-out",
        "Every edge allows just what it should forbid: (a, b) must point out of the region.",
        ("return rows", "return -rows"),
    ),
    Slip(
        "sides-exchanged",
        "Left and right have changed places: left is counter-clockwise, at direction + d_abs.",
        ("return rows", "return rows[[0, 1, 3, 2]]"),
        ("direction + d_abs, direction - d_abs", "direction - d_abs, direction + d_abs"),
    ),
    Slip(
        "sides-inward",
        "The side edges point inward: they forbid the region between the two rays.",
        [
            (SIDES[0], "[np.sin(left), -np.cos(left), 0]"),
            (SIDES[1], "[-np.sin(right), np.cos(right), 0]"),
        ],
        (SIDES[0], "[np.sin(left), -np.cos(left), 0]"),
        (SIDES[1], "[-np.sin(right), np.cos(right), 0]"),
    ),
    Slip(
        "sides-along",
        "The side edges' (a, b) point along the rays. A normal stands at a right angle to its line.",
        [
            (SIDES[0], "[np.cos(left), np.sin(left), 0]"),
            (SIDES[1], "[np.cos(right), np.sin(right), 0]"),
        ],
    ),
    Slip(
        "sides-at-range",
        "The side edges have a range as their c. They are rays from the robot itself: at 0.",
        (SIDES[0], "[-np.sin(left), np.cos(left), z[0]]"),
        [
            (SIDES[0], "[-np.sin(left), np.cos(left), z[0]]"),
            (SIDES[1], "[np.sin(right), -np.cos(right), z[0]]"),
        ],
    ),
    Slip(
        "order",
        "Near and far have changed places: far comes first.",
        ("return rows", "return rows[[1, 0, 2, 3]]"),
    ),
    Slip(
        "heading-width-forgotten",
        "The half-width is d_β alone. The heading is not known exactly either.",
        (D_ABS, "d_abs = bounds[1]"),
    ),
    Slip(
        "whole-width",
        "The heading's whole width is added to d_β. How far is it from the middle to an end?",
        (D_ABS, "d_abs = bounds[1] + heading[1] - heading[0]"),
    ),
    Slip(
        "bound-forgotten",
        "The half-width is the heading's alone: the bearing is off by d_β, too.",
        (D_ABS, "d_abs = (heading[1] - heading[0]) / 2"),
    ),
    Slip(
        "halved",
        "d_β is halved together with the heading's width: it is a half-width already.",
        (D_ABS, "d_abs = (bounds[1] + heading[1] - heading[0]) / 2"),
    ),
    Slip(
        "range-for-bearing",
        "The range's bound is taken for the bearing's: bounds is d_r, d_β.",
        (D_ABS, "d_abs = bounds[0] + (heading[1] - heading[0]) / 2"),
    ),
    Slip(
        "heading-forgotten",
        "The edges look along the bearing, which counts from the robot's heading.",
        (DIRECTION, "direction = z[1]"),
    ),
    Slip(
        "bearing-forgotten",
        "The edges look along the heading. The object is seen at the bearing β from it.",
        (DIRECTION, "direction = (heading[0] + heading[1]) / 2"),
    ),
    Slip(
        "bearing-taken-off",
        "The bearing has the wrong sign: it counts counter-clockwise from the heading.",
        (DIRECTION, "direction = (heading[0] + heading[1]) / 2 - z[1]"),
    ),
    Slip(
        "one-end",
        "The direction is counted from one end of the heading, not from its middle.",
        (DIRECTION, "direction = heading[0] + z[1]"),
        (DIRECTION, "direction = heading[1] + z[1]"),
    ),
    Slip(
        "wrapped-ends",
        "The middle is taken of wrapped ends: between 3.1 and −3.1 it is 0, and not π.",
        (DIRECTION, "direction = (wrap(float(heading[0])) + wrap(float(heading[1]))) / 2 + z[1]"),
    ),
    Slip(
        "degrees",
        "The angles are in radians already, and np.cos wants radians.",
        [
            (DIRECTION, DIRECTION.replace("= (", "= np.radians((") + ")"),
            (D_ABS, f"d_abs = np.radians({D_ABS[8:]})"),
        ],
        [
            (DIRECTION, DIRECTION.replace("= (", "= np.degrees((") + ")"),
            (D_ABS, f"d_abs = np.degrees({D_ABS[8:]})"),
        ],
        (NEAR, "-(z[0] - bounds[0]) * np.cos(np.radians(d_abs))"),
        (NEAR, "-(z[0] - bounds[0]) * np.cos(np.degrees(d_abs))"),
    ),
    Slip(
        "exchanged",
        "Sine and cosine have changed places in the normals: a goes with x and is the cosine.",
        ("return rows", "return rows[:, [1, 0, 2]]"),
    ),
)

STUMBLES = (
    Stumble("malformed", ("return rows", "return rows[:3]"), ("return rows", "return rows[:, :2]")),
    Stumble("raised", (PUSH, "row[3] += 0")),
    Stumble("not attempted", "def edges(z, bounds, heading, box):\n    raise NotImplementedError"),
)

MUTANTS = 1000
