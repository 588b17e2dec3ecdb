"""Programs of 04-camera: the column of a landmark in a camera's image, and its derivatives."""

from course.tasks import Slip, Stumble

TASK = "04-camera"

WAYS = {
    "chain rule over the camera's pose": """
def camera(x, p, mount, F):
    (a, b), c, s = mount, np.cos(x[2]), np.sin(x[2])
    place = np.array([x[0] + c * a - s * b, x[1] + s * a + c * b, x[2]])
    by_robot = np.array([[1, 0, -s * a - c * b], [0, 1, c * a - s * b], [0, 0, 1]])
    r, bearing = h(place, p)
    row = H_robot(place, p)[1]
    slope = -F / np.cos(bearing) ** 2
    return -F * np.tan(bearing), slope * np.concatenate([row @ by_robot, -row[:2]])
""",
    "complex numbers": """
def camera(x, p, mount, F):
    turn = np.exp(-1j * x[2])
    seen = (complex(*p) - complex(*x[:2])) * turn
    w = seen - complex(*mount)
    by = np.array([-turn, -1j * turn, -1j * seen, turn, 1j * turn])
    H = -F * (by.imag * w.real - w.imag * by.real) / w.real**2
    return -F * w.imag / w.real, H
""",
    "complex step, one row": """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (c * dy - s * dx - mount[1]) / (c * dx + s * dy - mount[0])
    v = np.concatenate([x, p])
    H = [column(v + 1e-30j * one).imag / 1e-30 for one in np.eye(5)]
    return np.array([column(v)]), np.array([H])
""",
    "central differences": """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        X, Y = np.array([[c, s], [-s, c]]) @ (v[3:] - v[:2]) - mount
        return -F * Y / X
    v, step = np.concatenate([x, p]), 1e-6
    return column(v), [(column(v + e) - column(v - e)) / (2 * step) for e in step * np.eye(5)]
""",
    "entry by entry": """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    R = np.array([[c, s], [-s, c]])
    X, Y = R @ (p - x[:2]) - mount
    at = np.array([F * Y, -F * X]) / X**2
    H = np.zeros(5)
    H[3:] = at @ R
    H[:2] = -H[3:]
    H[2] = at @ [Y + mount[1], -X - mount[0]]
    return -F * Y / X, H
""",
}

OFFSET = "dx, dy = p[0] - x[0], p[1] - x[1]"
XY = "X, Y = ahead - mount[0], left - mount[1]"
X_BY, Y_BY = "[-c, -s, left, c, s]", "[s, -c, -ahead, -s, c]"
RETURNS = "return -F * Y / X, -F * (Y_by * X - Y * X_by) / X**2"
QUOTIENT = "-F * (Y_by * X - Y * X_by) / X**2"


def _returns(u, H):
    return (RETURNS, f"u, H = -F * Y / X, {QUOTIENT}\n    return {u}, {H}")


SLIPS = (
    Slip(
        "mount-forgotten",
        "The camera sits at the robot's centre in your formulas. Where is the landmark, seen from a "
        "camera that is mounted 30 cm farther ahead?",
        (XY, "X, Y = ahead, left"),
    ),
    Slip(
        "turns-about-itself",
        "Your camera turns about itself when the robot turns. It is mounted off the centre: it also "
        "swings sideways. Which of the offsets that stand in X and Y does a turn not change?",
        [(X_BY, "[-c, -s, Y, c, s]"), (Y_BY, "[s, -c, -X, -s, c]")],
    ),
    Slip(
        "mount-in-the-world",
        "The mount is added to the robot's x and y as it is, but it is given ahead and left of the "
        "robot: it turns with the heading.",
        [
            (OFFSET, "dx, dy = p[0] - x[0] - mount[0], p[1] - x[1] - mount[1]"),
            (XY, "X, Y = ahead, left"),
        ],
    ),
    Slip(
        "mount-sign",
        "The mount goes in with the wrong sign: a camera farther ahead is nearer to what is ahead.",
        (XY, "X, Y = ahead + mount[0], left + mount[1]"),
        (XY, "X, Y = ahead - mount[0], left + mount[1]"),
        (XY, "X, Y = ahead + mount[0], left - mount[1]"),
    ),
    Slip(
        "mount-swapped",
        "The two numbers of the mount have changed places: it is ahead first, then left.",
        (XY, "X, Y = ahead - mount[1], left - mount[0]"),
    ),
    Slip(
        "left-for-right",
        "The sign of u: columns count to the right, and Y counts to the left.",
        [_returns("-u", "-H")],
        _returns("-u", "H"),
    ),
    Slip(
        "sign-of-H",
        "u is right, and every entry of H has the wrong sign. The derivative of Y/X is (Y' X − Y X')/X², "
        "in this order, and u has a minus before it.",
        _returns("u", "-H"),
    ),
    Slip(
        "upside-down",
        "The quotient is upside down: a landmark straight ahead, with Y = 0, appears in the middle of the "
        "image, at u = 0.",
        _returns("-F * X / Y", "H"),
        _returns("-F * X / Y", "-F * (X_by * Y - X * Y_by) / Y**2"),
    ),
    Slip(
        "turned-the-wrong-way",
        "The offset is turned by +θ; to see the world in the robot's frame it must be turned back. "
        "Take θ = 90° and a landmark to the north: it is straight ahead.",
        ("c, s = np.cos(x[2]), np.sin(x[2])", "c, s = np.cos(x[2]), -np.sin(x[2])"),
    ),
    Slip(
        "not-turned",
        "The offset in the world's frame is taken for the one in the robot's: where does the heading "
        "come in?",
        ("c, s = np.cos(x[2]), np.sin(x[2])", "c, s = 1.0, 0.0"),
        ("ahead, left = c * dx + s * dy, c * dy - s * dx", "ahead, left = dx, dy"),
    ),
    Slip(
        "ahead-for-left",
        "X and Y have changed places: what is far ahead must appear near the middle of the image.",
        (XY, "Y, X = ahead - mount[0], left - mount[1]"),
    ),
    Slip(
        "bearing-for-column",
        "This is the bearing, or F times it. An image is flat: its column is the tangent of the angle, "
        "not the angle.",
        (RETURNS, "return -np.arctan2(Y, X), -(Y_by * X - Y * X_by) / (X**2 + Y**2)"),
        (RETURNS, "return -F * np.arctan2(Y, X), -F * (Y_by * X - Y * X_by) / (X**2 + Y**2)"),
        (RETURNS, f"return -F * np.arctan2(Y, X), {QUOTIENT}"),
        (RETURNS, "return -F * Y / X, -F * (Y_by * X - Y * X_by) / (X**2 + Y**2)"),
    ),
    Slip(
        "focal-missing",
        "F is missing: look at the units. u is in pixels, and H in pixels per metre and per radian.",
        _returns("u / F", "H / F"),
        _returns("u", "H / F"),
        _returns("u / F", "H"),
    ),
    Slip(
        "focal-inverse",
        "F divides where it should multiply: a longer lens shows the same landmark farther from the "
        "middle.",
        _returns("u / F**2", "H / F**2"),
    ),
    Slip(
        "quotient-rule",
        "The derivative of a quotient Y/X is (Y' X − Y X')/X²: compare term by term.",
        (QUOTIENT, "-F * (Y_by * X + Y * X_by) / X**2"),
        (QUOTIENT, "-F * (Y_by * X - Y * X_by) / X"),
        (QUOTIENT, "-F * Y_by / X_by"),
        (QUOTIENT, "-F * (Y_by - Y * X_by) / X**2"),
        (QUOTIENT, "-F * (X_by * Y - X * Y_by) / Y**2"),
        (QUOTIENT, "-F * (Y_by * X - Y * X_by)"),
    ),
    Slip(
        "only-the-numerator",
        "You differentiate the numerator only: X changes as well when robot or landmark moves.",
        (QUOTIENT, "-F * Y_by / X"),
    ),
    Slip(
        "only-the-denominator",
        "You differentiate the denominator only: Y changes as well when robot or landmark moves.",
        (QUOTIENT, "F * Y * X_by / X**2"),
    ),
    Slip(
        "heading-sign",
        "The third entry has the wrong sign: the robot turns left, and what it sees moves to the right "
        "in the image.",
        _returns("u", "H * [1, 1, -1, 1, 1]"),
        [(X_BY, "[-c, -s, -left, c, s]"), (Y_BY, "[s, -c, ahead, -s, c]")],
    ),
    Slip(
        "heading-zero",
        "The heading's entry is empty: turn the camera, and the image moves.",
        _returns("u", "H * [1, 1, 0, 1, 1]"),
    ),
    Slip(
        "heading-as-of-a-bearing",
        "The heading's entry is a constant. For a bearing it would be −1; a column in a flat image "
        "changes the faster the farther from the middle it is, and the mount swings it besides.",
        _returns("u", "np.array([*H[:2], -1, *H[3:]])"),
        _returns("u", "np.array([*H[:2], F, *H[3:]])"),
        _returns("u", "np.array([*H[:2], 1, *H[3:]])"),
        _returns("u", "np.array([*H[:2], -F, *H[3:]])"),
    ),
    Slip(
        "heading-degrees",
        "The heading's entry is per degree: a derivative by an angle is per radian.",
        _returns("u", "H * [1, 1, np.pi / 180, 1, 1]"),
        _returns("u", "H * [1, 1, 180 / np.pi, 1, 1]"),
    ),
    Slip(
        "robot-for-landmark",
        "The entries of the robot's place and of the landmark have changed places, or have the same "
        "sign: if both move by the same step, the image stays.",
        _returns("u", "np.array([*H[3:], H[2], *H[:2]])"),
        _returns("u", "H * [-1, -1, 1, 1, 1]"),
        _returns("u", "H * [1, 1, 1, -1, -1]"),
        (OFFSET, "dx, dy = x[0] - p[0], x[1] - p[1]"),
    ),
    Slip(
        "own-axes",
        "The derivatives are along the robot's own axes, ahead and left; x and y, p_x and p_y are "
        "coordinates of the world.",
        [(X_BY, "[-1, 0, left, 1, 0]"), (Y_BY, "[0, -1, -ahead, 0, 1]")],
    ),
    Slip(
        "order-of-entries",
        "The entries of H are in another order: x, y, θ, p_x, p_y.",
        _returns("u", "np.array([*H[3:], *H[:3]])"),
        _returns("u", "H[[1, 0, 2, 4, 3]]"),
        _returns("u", "H[::-1]"),
    ),
    Slip(
        "whole-pixels",
        "A column need not be a whole number: rounded values have no derivative, and a filter needs "
        "both to fit.",
        _returns("np.round(u)", "H"),
        _returns("int(u)", "H"),
        _returns("np.round(u)", "np.round(H)"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        _returns("H", "u"),
        _returns("u", "H[:3]"),
        (RETURNS, "return -F * Y / X"),
        (RETURNS, f"return {QUOTIENT}"),
        _returns("u", "None"),
        _returns("u", "np.array([H, H])"),
    ),
    Stumble("raised", ("p[1] - x[1]", "p[2] - x[1]")),
    Stumble("not attempted", (RETURNS, "raise NotImplementedError")),
)

PASTED = {
    "the lesson's bearing row": """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx**2 + dy**2
    u = np.arctan2(dy, dx) - x[2]
    return u, np.array([dy / q, -dx / q, -1, -dy / q, dx / q])
""",
    "h and H of the exercise, times F": """
def camera(x, p, mount, F):
    row = H_robot(x, p)[1]
    return -F * h(x, p)[1], -F * np.concatenate([row, -row[:2]])
""",
    "h and H at the camera's place": """
def camera(x, p, mount, F):
    place = np.array([*g(x, [np.hypot(*mount), np.arctan2(mount[1], mount[0])]), x[2]])
    row = H_robot(place, p)[1]
    return -F * h(place, p)[1], -F * np.concatenate([row, -row[:2]])
""",
    "the lesson's slopes of h": """
def camera(x, p, mount, F):
    def slopes(f, x, step=1e-6):
        return np.array([(f(x + e) - f(x - e)) / (2 * step) for e in step * np.eye(len(x))])
    H = slopes(lambda v: h(v[:3], v[3:])[1], np.concatenate([x, p]))
    return F * h(x, p)[1], F * H
""",
    "the tangent of the lesson's bearing": """
def camera(x, p, mount, F):
    row, bearing = H_robot(x, p)[1], h(x, p)[1]
    H = -F / np.cos(bearing) ** 2 * np.concatenate([row, -row[:2]])
    return -F * np.tan(bearing), H
""",
}

EQUIVALENT = {
    "1e-06) -> v, step": "a step half or twice as long serves as well",
}
