"""Right ways and slips of 01-seen-from."""

from course.tasks import Edit, Slip, Stumble

TASK = "01-seen-from"

WAYS = {
    "complex numbers": """
def seen_from(a, b):
    z = (complex(*b[:2]) - complex(*a[:2])) * np.exp(-1j * a[2])
    return z.real, z.imag, np.angle(np.exp(1j * (b[2] - a[2])))
""",
    "homogeneous matrices": """
def seen_from(a, b):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    M = np.linalg.inv(T(a)) @ T(b)
    return np.array([M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])])
""",
    "distance and bearing": """
def seen_from(a, b):
    import math

    r = math.hypot(b[0] - a[0], b[1] - a[1])
    beta = math.atan2(b[1] - a[1], b[0] - a[0]) - a[2]
    turn = b[2] - a[2]
    if turn > math.pi:
        turn -= 2 * math.pi
    if turn < -math.pi:
        turn += 2 * math.pi
    return [r * math.cos(beta), r * math.sin(beta), turn]
""",
    "a rotation back, on a copy": """
def seen_from(a, b):
    seen = b - a
    c, s = np.cos(a[2]), np.sin(a[2])
    R = np.array([[c, -s], [s, c]])
    seen[:2] = R.T @ seen[:2]
    seen[2] = (seen[2] + np.pi) % (2 * np.pi) - np.pi
    return seen
""",
    "equations solved": """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    ahead, left = np.linalg.solve(np.array([[c, -s], [s, c]]), b[:2] - a[:2])
    cosine = np.cos(b[2]) * c + np.sin(b[2]) * s
    sine = np.sin(b[2]) * c - np.cos(b[2]) * s
    return np.array([ahead, left, np.arctan2(sine, cosine)])
""",
    "by the package": """
def seen_from(a, b):
    from slamlab.geometry import between
    return between(a, b)
""",
}

CS = "c, s = np.cos(a[2]), np.sin(a[2])"
D = "dx, dy = b[0] - a[0], b[1] - a[1]"
XY = "c * dx + s * dy, -s * dx + c * dy"
DIFFERENCE = "turn = b[2] - a[2]"
TURN = "np.arctan2(np.sin(turn), np.cos(turn))"
BEARING = "distance and bearing"

SLIPS = (
    Slip(
        "only subtracted",
        "The difference of the positions is measured along the world's axes. Turn it into a's frame.",
        (XY, "dx, dy"),
        "def seen_from(a, b):\n    return b - a\n",
    ),
    Slip(
        "turned the wrong way",
        "You turn from a's frame into the world. Here the way is back: turn by minus a's heading.",
        (XY, "c * dx - s * dy, s * dx + c * dy"),
    ),
    Slip(
        "turned by the other heading",
        "You turn by b's heading, or by the difference. It is a who looks: turn by minus a's heading.",
        (CS, "c, s = np.cos(b[2]), np.sin(b[2])"),
        (CS, "c, s = np.cos(b[2] - a[2]), np.sin(b[2] - a[2])"),
    ),
    Slip(
        "the wrong way round",
        "You tell where a is. Asked is where b is, seen from a: position of b minus position of a.",
        (D, "dx, dy = a[0] - b[0], a[1] - b[1]"),
        "def seen_from(a, b):\n    from slamlab.geometry import between\n    return between(b, a)\n",
    ),
    Slip(
        "forth, not back",
        "This puts b, as if it were a step, on top of a. Asked is the way back: which step leads from a "
        "to b?",
        "def seen_from(a, b):\n    return next_pose(a, b)\n",
        "def seen_from(a, b):\n    return next_pose(a, b - a)\n",
    ),
    Slip(
        "turned before subtracting",
        "b's place was turned before a's was taken off, so that a does not stand in its own origin. "
        "Subtract first, then turn.",
        (XY, "c * b[0] + s * b[1] - a[0], -s * b[0] + c * b[1] - a[1]"),
    ),
    Slip(
        "a's place forgotten",
        "b's place was turned, but a does not stand at the origin: what counts is the way from a to b.",
        (D, "dx, dy = b[0], b[1]"),
    ),
    Slip(
        "degrees",
        "Angles are in radians everywhere: cosine and sine take them as they are, and nothing is "
        "converted.",
        (CS, "c, s = np.cos(np.degrees(a[2])), np.sin(np.degrees(a[2]))"),
        (CS, "c, s = np.cos(np.radians(a[2])), np.sin(np.radians(a[2]))"),
        (TURN, "np.degrees(np.arctan2(np.sin(turn), np.cos(turn)))"),
    ),
    Slip(
        "sine and cosine swapped",
        "Sine and cosine have changed places. A robot with heading 0 looks along +x, so that ahead goes "
        "with the cosine of the heading.",
        (CS, "c, s = np.sin(a[2]), np.cos(a[2])"),
    ),
    Slip(
        "one sign",
        "One of the two places has a wrong sign at its sine. In a rotation both sines stand there with "
        "opposite signs, so that the distance stays what it was.",
        (XY, "c * dx - s * dy, -s * dx + c * dy"),
        (XY, "c * dx + s * dy, s * dx + c * dy"),
    ),
    Slip(
        "right for left",
        "The second number is positive to the right. Left of a's heading is a quarter turn "
        "counter-clockwise from it.",
        (XY, "c * dx + s * dy, s * dx - c * dy"),
    ),
    Slip(
        "ahead and left swapped",
        "The numbers have changed places: first how far ahead, then how far to the left, then the turn.",
        (XY, "-s * dx + c * dy, c * dx + s * dy"),
        Edit("a rotation back, on a copy", (("return seen", "return seen[[2, 0, 1]]"),)),
    ),
    Slip(
        "distance and bearing told",
        "These are b's distance and its bearing. Asked is how far ahead it is and how far to the left.",
        Edit(BEARING, (("r * math.cos(beta), r * math.sin(beta)", "r, beta"),)),
        Edit(
            BEARING,
            (
                (
                    "r * math.cos(beta), r * math.sin(beta)",
                    "r, math.atan2(math.sin(beta), math.cos(beta))",
                ),
            ),
        ),
        [(XY, "np.hypot(dx, dy), 0.0")],
    ),
    Slip(
        "one coordinate only",
        "One of the two coordinates is missing: b is somewhere ahead and somewhere to the left of a.",
        (XY, "dx, 0.0"),
        (XY, "c * dx, c * dy"),
        (XY, "c * dx + s * dy, 0.0"),
    ),
    Slip(
        "half the directions of a bearing",
        "The arcus tangent of a quotient cannot tell a place ahead from the one opposite, behind the "
        "robot. np.arctan2 takes both coordinates and can.",
        Edit(
            BEARING,
            (
                (
                    "math.atan2(b[1] - a[1], b[0] - a[0])",
                    "np.arctan((b[1] - a[1]) / (b[0] - a[0] + 1e-300))",
                ),
            ),
        ),
    ),
    Slip(
        "heading not relative",
        "You give b's heading in the world. Seen from a it is what a has to turn.",
        (DIFFERENCE, "turn = b[2]"),
    ),
    Slip(
        "headings added",
        "The headings are added. What a has to turn to look where b looks is a difference.",
        (DIFFERENCE, "turn = b[2] + a[2]"),
    ),
    Slip(
        "heading backwards",
        "The turn goes the wrong way: it leads from b's heading to a's.",
        (DIFFERENCE, "turn = a[2] - b[2]"),
    ),
    Slip(
        "turn to see b",
        "That is the turn after which a looks *at* b. Asked is the turn after which a looks where b "
        "looks.",
        (DIFFERENCE, "turn = np.arctan2(dy, dx) - a[2]"),
    ),
    Slip(
        "not wrapped",
        "The turn leaves the range from −π to π: a robot that has to turn by 350° would do better to "
        "turn by −10°. Wrap the difference.",
        (TURN, "turn"),
        (TURN, "turn % (2 * np.pi)"),
    ),
    Slip(
        "wrapped on one side",
        "Turns beyond π come back, but not those below −π, or the other way round.",
        Edit(BEARING, (("if turn < -math.pi", "if turn < -9"),)),
        Edit(BEARING, (("if turn > math.pi", "if turn > 9"),)),
    ),
    Slip(
        "half a turn too much",
        "A turn comes back that leads the opposite way: a remainder of π, or an arcus of one number, "
        "knows half the directions only. A full turn is 2π.",
        (TURN, "np.arctan(np.tan(turn))"),
        (TURN, "(turn + np.pi / 2) % np.pi - np.pi / 2"),
        (TURN, "turn - np.pi * np.sign(turn) * (abs(turn) > np.pi)"),
        (TURN, "np.arcsin(np.sin(turn))"),
    ),
    Slip(
        "arccos loses the sign",
        "The arcus cosine tells how far to turn, but not to which side.",
        (TURN, "np.arccos(np.cos(turn))"),
    ),
    Slip(
        "clipped",
        "A turn beyond π was cut off at π. 190° is not 180° but −170°.",
        (TURN, "np.clip(turn, -np.pi, np.pi)"),
    ),
    Slip(
        "arctan2 turned",
        "np.arctan2 takes the sine first and the cosine second.",
        (TURN, "np.arctan2(np.cos(turn), np.sin(turn))"),
    ),
    Slip(
        "place wrapped",
        "Metres were wrapped as if they were angles. Only the third number is an angle.",
        """
def seen_from(a, b):
    from slamlab.geometry import between, wrap
    return wrap(between(a, b))
""",
    ),
    Slip(
        "arctan of a quotient",
        "The arctangent of a quotient cannot tell ahead from behind, and has nothing to divide by where "
        "both poses are in one place: np.arctan2 takes both sides. Or do without angles: turn the vector.",
        Edit(
            "distance and bearing",
            (
                (
                    "math.atan2(b[1] - a[1], b[0] - a[0])",
                    "math.atan((b[1] - a[1]) / (b[0] - a[0]))",
                ),
            ),
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        "def seen_from(a, b):\n    print(b - a)\n",
        (XY, "c * dx + s * dy"),
        (TURN, "np.nan"),
        "def seen_from(a, b):\n    return b - a, 0\n",
    ),
    Stumble("raised", (D, "dx, dy = b - a")),
    Stumble("not attempted", "def seen_from(a, b):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
