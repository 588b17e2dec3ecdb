"""Exercise 01: what students write for dead reckoning, the map and the drift."""

from tests.bank import Right, Wrong


def next_pose(x, y, heading="np.arctan2(np.sin(t + turn), np.cos(t + turn))"):
    """The source of a next_pose with these formulas of x, y, t and f, l, turn."""
    return f"""
def next_pose(pose, step):
    x, y, t = pose
    f, l, turn = step
    c, s = np.cos(t), np.sin(t)
    return np.array([{x}, {y}, {heading}])
"""


X, Y = "x + c * f - s * l", "y + s * f + c * l"
MOVED = {"direction", "01-track"}


def place(body):
    """The source of a place with that result, of p (n, 2), t (2,) and the rotation R."""
    return f"""
def place(pose, points):
    x, y, theta = pose
    t, p = np.array([x, y]), np.asarray(points)
    c, s = np.cos(theta), np.sin(theta)
    R = np.array([[c, -s], [s, c]])
    return {body}
"""


def seen_from(x, y, heading="np.arctan2(np.sin(tb - ta), np.cos(tb - ta))"):
    """The source of a seen_from with these formulas of dx, dy, ta, tb."""
    return f"""
def seen_from(a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    ta, tb = a[2], b[2]
    c, s = np.cos(ta), np.sin(ta)
    return np.array([{x}, {y}, {heading}])
"""


SX, SY = "c * dx + s * dy", "-s * dx + c * dy"


def drift(formula):
    """The source of a drift with that formula of n, d, sigma."""
    return f"""
def drift(n, d, sigma):
    return {formula}
"""


STEP = [
    Wrong(
        "added as it is",
        next_pose("x + f", "y + l"),
        MOVED,
        "added without turning",
    ),
    Wrong(
        "all three added",
        "def next_pose(pose, step):\n    return pose + step",
        {*MOVED, "wrapped"},
        "added without turning",
    ),
    Wrong(
        "moves along the new heading",
        "def next_pose(pose, step):\n"
        "    t = pose[2] + step[2]\n"
        "    c, s = np.cos(t), np.sin(t)\n"
        "    x, y = pose[:2] + np.array([[c, -s], [s, c]]) @ step[:2]\n"
        "    return np.array([x, y, np.arctan2(s, c)])",
        MOVED,
        "turned before moving",
    ),
    Wrong(
        "rotation matrix transposed",
        next_pose("x + c * f + s * l", "y - s * f + c * l"),
        MOVED,
        "turned the wrong way",
    ),
    Wrong(
        "heading converted to degrees",
        next_pose(X, Y).replace(
            "np.cos(t), np.sin(t)", "np.cos(np.degrees(t)), np.sin(np.degrees(t))", 1
        ),
        MOVED,
        "degrees",
    ),
    Wrong(
        "heading taken for degrees",
        next_pose(X, Y).replace(
            "c, s = np.cos(t), np.sin(t)",
            "c, s = np.cos(t * np.pi / 180), np.sin(t * np.pi / 180)",
            1,
        ),
        MOVED,
        "degrees",
    ),
    Wrong(
        "cosine and sine changed places",
        next_pose("x + s * f - c * l", "y + c * f + s * l"),
        MOVED,
        "sine and cosine swapped",
    ),
    Wrong(
        "only forward",
        next_pose("x + c * f", "y + s * f"),
        {"distance", *MOVED},
        "left forgotten",
    ),
    Wrong(
        "left to the right",
        next_pose("x + c * f + s * l", "y + s * f - c * l"),
        MOVED,
        "left taken for right",
    ),
    Wrong(
        "the pose placed in the step's frame",
        "def next_pose(pose, step):\n"
        "    c, s = np.cos(step[2]), np.sin(step[2])\n"
        "    x, y = step[:2] + np.array([[c, -s], [s, c]]) @ pose[:2]\n"
        "    t = pose[2] + step[2]\n"
        "    return np.array([x, y, np.arctan2(np.sin(t), np.cos(t))])",
        {"distance", *MOVED},
        "the wrong way round",
    ),
    Wrong("heading kept", next_pose(X, Y, "t"), {"heading", "01-track"}, "turn forgotten"),
    Wrong(
        "heading less the turn",
        next_pose(X, Y, "np.arctan2(np.sin(t - turn), np.cos(t - turn))"),
        {"heading", "01-track"},
        "turn subtracted",
    ),
    Wrong("heading runs away", next_pose(X, Y, "t + turn"), {"wrapped"}, "not wrapped"),
    Wrong(
        "wrapped by arctan, which knows half the directions",
        next_pose(X, Y, "np.arctan(np.tan(t + turn))"),
        {"heading", "01-track"},
    ),
    Wrong(
        "wrapped to 0 to 2π",
        next_pose(X, Y, "(t + turn) % (2 * np.pi)"),
        {"wrapped"},
        "not wrapped",
    ),
    Wrong(
        "one sign wrong in x",
        next_pose("x + c * f + s * l", Y),
        {"distance", *MOVED},
    ),
    Wrong(
        "a tuple of three and a comma too many",
        "def next_pose(pose, step):\n    return (pose + step, )",
        {"01-next-pose"},
        problem="malformed",
    ),
    Wrong(
        "nothing returned",
        "def next_pose(pose, step):\n    new = pose + step",
        {"01-next-pose"},
        problem="malformed",
    ),
]

TRACK = [
    Wrong(
        "start left out",
        """
def track(start, steps):
    pose, poses = start, []
    for step in steps:
        pose = next_pose(pose, step)
        poses.append(pose)
    return np.array(poses)
""",
        {"01-track"},
        "start missing",
    ),
    Wrong(
        "appended before the step",
        """
def track(start, steps):
    pose, poses = start, []
    for step in steps:
        poses.append(pose)
        pose = next_pose(pose, step)
    return np.array(poses)
""",
        {"01-track"},
        "last step missing",
    ),
    Wrong(
        "one array changed in place",
        """
def track(start, steps):
    pose = np.array(start)
    poses = [pose]
    for step in steps:
        pose[:] = next_pose(pose, step)
        poses.append(pose)
    return np.array(poses)
""",
        {"start", "steps"},
        "one pose many times",
    ),
    Wrong(
        "every step from the start",
        """
def track(start, steps):
    return np.array([start] + [next_pose(start, step) for step in steps])
""",
        {"steps", "home"},
        "not chained",
    ),
    Wrong(
        "cumulative sum",
        """
def track(start, steps):
    return np.cumsum(np.vstack([start, steps]), axis=0)
""",
        {"steps", "home"},
        "added up",
    ),
    Wrong(
        "begins at the origin",
        """
def track(start, steps):
    poses = [np.zeros(3)]
    for step in steps:
        poses.append(next_pose(poses[-1], step))
    return np.array(poses)
""",
        {"start", "home"},
        "start ignored",
    ),
    Wrong(
        "steps taken backwards",
        """
def track(start, steps):
    poses = [start]
    for step in steps[::-1]:
        poses.append(next_pose(poses[-1], step))
    return np.array(poses)
""",
        {"steps", "home"},
    ),
    Wrong(
        "only the end",
        """
def track(start, steps):
    for step in steps:
        start = next_pose(start, step)
    return start
""",
        {"01-track"},
        problem="malformed",
    ),
]

PLACE = [
    Wrong("only moved", place("p + t"), {"bearing", "one wall"}, "not turned"),
    Wrong("only turned", place("p @ R.T"), {"range", "bearing", "one wall"}, "not moved"),
    Wrong(
        "rotation of columns put on rows",
        place("p @ R + t"),
        {"bearing", "one wall"},
        "turned the wrong way",
    ),
    Wrong(
        "moved, then turned",
        place("(p + t) @ R.T"),
        {"range", "bearing", "one wall"},
        "moved before turning",
    ),
    Wrong(
        "the way back",
        place("(p - t) @ R"),
        {"range", "bearing", "one wall"},
        "into the robot's frame",
    ),
    Wrong(
        "heading in degrees",
        place("p @ R.T + t").replace(
            "np.cos(theta), np.sin(theta)", "np.cos(np.rad2deg(theta)), np.sin(np.rad2deg(theta))"
        ),
        {"bearing", "one wall"},
        "degrees",
    ),
    Wrong(
        "heading from degrees",
        place("p @ R.T + t").replace(
            "np.cos(theta), np.sin(theta)", "np.cos(np.deg2rad(theta)), np.sin(np.deg2rad(theta))"
        ),
        {"bearing", "one wall"},
        "degrees",
    ),
    Wrong(
        "sine for cosine",
        place("p @ R.T + t").replace(
            "np.cos(theta), np.sin(theta)", "np.sin(theta), np.cos(theta)"
        ),
        {"bearing", "one wall"},
        "sine and cosine swapped",
    ),
    Wrong(
        "left and right exchanged",
        place("(p * [1, -1]) @ R.T + t"),
        {"bearing", "one wall"},
        "mirrored",
    ),
    Wrong(
        "a shear instead of a turn",
        place("p @ np.array([[c, s], [s, c]]) + t"),
        {"rigid", "range", "bearing", "one wall"},
    ),
    Wrong("transposed", place("(p @ R.T + t).T"), {"01-place"}, problem="malformed"),
]

SEEN = [
    Wrong("difference", seen_from("dx", "dy"), {"direction"}, "only subtracted"),
    Wrong(
        "difference of all three",
        "def seen_from(a, b):\n    return b - a",
        {"direction", "wrapped"},
        "only subtracted",
    ),
    Wrong(
        "turned by plus the heading",
        seen_from("c * dx - s * dy", "s * dx + c * dy"),
        {"direction"},
        "turned the wrong way",
    ),
    Wrong(
        "turned by the heading of b",
        seen_from(SX, SY).replace("np.cos(ta), np.sin(ta)", "np.cos(tb), np.sin(tb)"),
        {"direction"},
        "turned by the other heading",
    ),
    Wrong(
        "a seen from b",
        seen_from(SX, SY, "np.arctan2(np.sin(ta - tb), np.cos(ta - tb))")
        .replace("np.cos(ta), np.sin(ta)", "np.cos(tb), np.sin(tb)")
        .replace("b[0] - a[0], b[1] - a[1]", "a[0] - b[0], a[1] - b[1]"),
        {"direction", "heading"},
        "the wrong way round",
    ),
    Wrong(
        "a minus b",
        seen_from(SX, SY).replace("b[0] - a[0], b[1] - a[1]", "a[0] - b[0], a[1] - b[1]"),
        {"direction"},
        "the wrong way round",
    ),
    Wrong(
        "degrees again",
        seen_from(SX, SY).replace(
            "np.cos(ta), np.sin(ta)", "np.cos(np.degrees(ta)), np.sin(np.degrees(ta))"
        ),
        {"direction"},
        "degrees",
    ),
    Wrong(
        "sine and cosine exchanged",
        seen_from(SX, SY).replace("np.cos(ta), np.sin(ta)", "np.sin(ta), np.cos(ta)"),
        {"direction"},
        "sine and cosine swapped",
    ),
    Wrong("heading of b kept", seen_from(SX, SY, "tb"), {"heading"}, "heading not relative"),
    Wrong(
        "sum of headings",
        seen_from(SX, SY, "np.arctan2(np.sin(tb + ta), np.cos(tb + ta))"),
        {"heading"},
        "headings added",
    ),
    Wrong(
        "heading of a less that of b",
        seen_from(SX, SY, "np.arctan2(np.sin(ta - tb), np.cos(ta - tb))"),
        {"heading"},
        "heading backwards",
    ),
    Wrong("heading not brought back", seen_from(SX, SY, "tb - ta"), {"wrapped"}, "not wrapped"),
    Wrong(
        "not turned and one coordinate forgotten",
        seen_from("dx", "0.0"),
        {"distance", "direction"},
    ),
]

DRIFT = [
    Wrong(
        "error of each step alone",
        drift("sigma * d * np.sqrt(n)"),
        {"simulated", "longer"},
        "each error bends one step",
    ),
    Wrong(
        "all errors to one side",
        drift("sigma * d * n * (n - 1) / 2"),
        {"simulated", "longer"},
        "errors added up",
    ),
    Wrong(
        "turns, then moves",
        drift("sigma * d * np.sqrt(sum(k**2 for k in range(1, n + 1)))"),
        {"simulated", "longer"},
        "first step bent too",
    ),
    Wrong(
        "a single error",
        drift("n * d * sigma"),
        {"simulated", "longer"},
        "one error at the start",
    ),
    Wrong(
        "the last heading for the whole way",
        drift("n * d * sigma * np.sqrt(n)"),
        {"simulated", "longer"},
        "whole heading error from the start",
    ),
    Wrong(
        "variance",
        drift("sigma**2 * d**2 * sum(k**2 for k in range(n))"),
        {"simulated", "linear", "longer"},
        "root forgotten",
    ),
    Wrong(
        "error in degrees",
        drift("np.degrees(sigma) * d * np.sqrt(sum(k**2 for k in range(n)))"),
        {"simulated"},
        "degrees",
    ),
    Wrong("nothing", drift("0.0"), {"simulated", "linear", "longer"}, "idle"),
    Wrong(
        "an array",
        drift("sigma * d * np.arange(n)"),
        {"01-drift"},
        problem="malformed",
    ),
]

WRONG = [*STEP, *TRACK, *PLACE, *SEEN, *DRIFT]

RIGHT = [
    Right(
        "complex numbers",
        """
def next_pose(pose, step):
    z = complex(*pose[:2]) + complex(*step[:2]) * np.exp(1j * pose[2])
    return [z.real, z.imag, np.angle(np.exp(1j * (pose[2] + step[2])))]

def place(pose, points):
    z = complex(*pose[:2]) + (points[:, 0] + 1j * points[:, 1]) * np.exp(1j * pose[2])
    return np.column_stack([z.real, z.imag])

def seen_from(a, b):
    z = (complex(*b[:2]) - complex(*a[:2])) * np.exp(-1j * a[2])
    return z.real, z.imag, np.angle(np.exp(1j * (b[2] - a[2])))
""",
    ),
    Right(
        "homogeneous matrices",
        """
def T(pose):
    x, y, t = pose
    return np.array([[np.cos(t), -np.sin(t), x], [np.sin(t), np.cos(t), y], [0, 0, 1]])

def pose_of(M):
    return np.array([M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])])

def next_pose(pose, step):
    return pose_of(T(pose) @ T(step))

def place(pose, points):
    rows = np.column_stack([points, np.ones(len(points))])
    return (T(pose) @ rows.T).T[:, :2]

def seen_from(a, b):
    return pose_of(np.linalg.inv(T(a)) @ T(b))

def track(start, steps):
    poses, M = [start], T(start)
    for step in steps:
        M = M @ T(step)
        poses.append(pose_of(M))
    return np.array(poses)
""",
    ),
    Right(
        "loops and the math module",
        """
import math

def wrap(angle):
    while angle > math.pi:
        angle -= 2 * math.pi
    while angle < -math.pi:
        angle += 2 * math.pi
    return angle

def next_pose(pose, step):
    x, y, t = pose
    return (x + step[0] * math.cos(t) + step[1] * math.cos(t + math.pi / 2),
            y + step[0] * math.sin(t) + step[1] * math.sin(t + math.pi / 2), wrap(t + step[2]))

def place(pose, points):
    out = []
    for px, py in points:
        r, b = math.hypot(px, py), math.atan2(py, px)
        out.append([pose[0] + r * math.cos(pose[2] + b), pose[1] + r * math.sin(pose[2] + b)])
    return out

def seen_from(a, b):
    r = math.hypot(b[0] - a[0], b[1] - a[1])
    beta = math.atan2(b[1] - a[1], b[0] - a[0]) - a[2]
    return [r * math.cos(beta), r * math.sin(beta), wrap(b[2] - a[2])]

def drift(n, d, sigma):
    total = 0
    for k in range(1, n):
        total += (k * d * sigma) ** 2
    return math.sqrt(total)
""",
    ),
    Right(
        "a track of cumulative sums",
        """
def track(start, steps):
    t = np.cumsum(np.r_[start[2], steps[:, 2]])
    moves = (steps[:, 0] + 1j * steps[:, 1]) * np.exp(1j * t[:-1])
    z = np.cumsum(np.r_[complex(*start[:2]), moves])
    return np.column_stack([z.real, z.imag, np.angle(np.exp(1j * t))])
""",
    ),
    Right(
        "headings of a track left to run, as the task of the track allows",
        """
def track(start, steps):
    t = np.cumsum(np.r_[start[2], steps[:, 2]])
    moves = (steps[:, 0] + 1j * steps[:, 1]) * np.exp(1j * t[:-1])
    z = np.cumsum(np.r_[complex(*start[:2]), moves])
    return np.column_stack([z.real, z.imag, t])
""",
    ),
    Right(
        "drift in closed form, as an array of one",
        "def drift(n, d, sigma):\n"
        "    return np.array([sigma * d * np.sqrt(n * (n - 1) * (2 * n - 1) / 6)])",
    ),
    Right(
        "drift by the sine of each error",
        "def drift(n, d, sigma):\n    return d * np.sin(sigma) * np.linalg.norm(np.arange(n))",
    ),
    Right(
        "drift as the root of a covariance",
        """
def drift(n, d, sigma):
    P = np.zeros((2, 2))
    A = np.array([[1, d], [0, 1]])
    for _ in range(n):
        P = A @ P @ A.T + np.diag([0, sigma**2])
    return np.sqrt(P[0, 0])
""",
    ),
]
