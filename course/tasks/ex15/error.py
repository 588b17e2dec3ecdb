"""Right ways and slips of 15-error."""

from course.tasks import Edit, Slip, Stumble

TASK = "15-error"

MATRICES = """
def error(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    ti, tj, tz = x_i[:2], x_j[:2], z[:2]
    way = R(z[2]).T @ (R(x_i[2]).T @ (tj - ti) - tz)
    turn = wrap(float(x_j[2] - x_i[2] - z[2]))
    return np.array([way[0], way[1], turn])
"""

WAYS = {
    "matrices": MATRICES,
    "by the package's ⊕": """
def error(x_i, x_j, z):
    from slamlab.geometry import between
    return between(z, between(x_i, x_j))
""",
    "inverse and compose": """
def error(x_i, x_j, z):
    from slamlab.geometry import compose, inverse
    return compose(inverse(z), compose(inverse(x_i), x_j))
""",
    "from where z leads to": """
def error(x_i, x_j, z):
    from slamlab.geometry import between, compose
    there = compose(x_i, z)
    return between(there, x_j)
""",
    "as a list, atan2 for wrap": """
def error(x_i, x_j, z):
    angle = x_i[2] + z[2]
    dx = x_j[0] - x_i[0] - z[0] * np.cos(x_i[2]) + z[1] * np.sin(x_i[2])
    dy = x_j[1] - x_i[1] - z[0] * np.sin(x_i[2]) - z[1] * np.cos(x_i[2])
    turn = x_j[2] - angle
    e_x = np.cos(angle) * dx + np.sin(angle) * dy
    e_y = np.cos(angle) * dy - np.sin(angle) * dx
    return [e_x, e_y, np.arctan2(np.sin(turn), np.cos(turn))]
""",
    "homogeneous matrices": """
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.inv(T(z)) @ np.linalg.inv(T(x_i)) @ T(x_j)
    return np.array([E[0, 2], E[1, 2], np.arctan2(E[1, 0], E[0, 0])])
""",
    "complex numbers": """
def error(x_i, x_j, z):
    seen = complex(*(x_j - x_i)[:2]) * np.exp(-1j * x_i[2])
    way = (seen - complex(z[0], z[1])) * np.exp(-1j * z[2])
    turn = np.angle(np.exp(1j * (x_j[2] - x_i[2] - z[2])))
    return np.array([way.real, way.imag, turn])
""",
    "a copy is changed": """
def error(x_i, x_j, z):
    e = np.array(x_j, dtype=float)
    for pose in (x_i, z):
        e -= pose
        c, s = np.cos(pose[2]), np.sin(pose[2])
        e[:2] = np.array([[c, s], [-s, c]]) @ e[:2]
    while e[2] > np.pi:
        e[2] -= 2 * np.pi
    while e[2] < -np.pi:
        e[2] += 2 * np.pi
    return e
""",
}


def _in(*pairs):
    return Edit("matrices", pairs)


WAY = "R(z[2]).T @ (R(x_i[2]).T @ (tj - ti) - tz)"
TURN = "wrap(float(x_j[2] - x_i[2] - z[2]))"
RESULT = "np.array([way[0], way[1], turn])"

SLIPS = (
    Slip(
        "backwards",
        "This is the error seen from the other end: z as seen from where pose j really is. The "
        "error is pose j as seen from where z puts it.",
        """
def error(x_i, x_j, z):
    from slamlab.geometry import between
    return between(between(x_i, x_j), z)
""",
    ),
    Slip(
        "i-j-swapped",
        "The two poses have changed places: z is pose j as seen from pose i, not the other way round.",
        """
def error(x_i, x_j, z):
    from slamlab.geometry import between
    return between(z, between(x_j, x_i))
""",
    ),
    Slip(
        "z-inverted",
        "z is laid on top instead of taken off. It has to be undone: the error starts with z⁻¹.",
        """
def error(x_i, x_j, z):
    from slamlab.geometry import between, compose
    return compose(z, between(x_i, x_j))
""",
    ),
    Slip(
        "z-last",
        "z⁻¹ stands on the wrong side. ⊕ does not commute: what is laid on the left is the frame, "
        "and e is written in the frame that z leads to.",
        """
def error(x_i, x_j, z):
    from slamlab.geometry import between, compose, inverse
    return compose(between(x_i, x_j), inverse(z))
""",
    ),
    Slip(
        "sign",
        "Every number has the wrong sign: this is measured minus believed instead of believed minus "
        "measured.",
        _in((RESULT, "-np.array([way[0], way[1], turn])")),
    ),
    Slip(
        "differences-only",
        "Three differences are no error: the poses are written in the world's frame and z in that of "
        "pose i. Turn the way between the poses before you take z off.",
        _in((WAY, "tj - ti - tz")),
    ),
    Slip(
        "z-in-world-frame",
        "z's shift was taken off in the world's frame, but z is written in the frame of pose i: turn "
        "the way between the poses back by θ_i first.",
        _in((WAY, "R(z[2]).T @ R(x_i[2]).T @ (tj - ti - tz)")),
        _in((WAY, "R(z[2]).T @ (tj - ti - tz)")),
        _in((WAY, "R(x_i[2]).T @ (tj - ti - tz)")),
    ),
    Slip(
        "not-into-z",
        "The difference is right, but it is written in pose i's frame. z⁻¹ also turns, by −θ_z, into "
        "the frame of where z leads to.",
        _in((WAY, "R(x_i[2]).T @ (tj - ti) - tz")),
    ),
    Slip(
        "turned-forth",
        "A rotation goes the wrong way. To see something *from* a pose, turn it back: by Rᵀ, which "
        "is R of the negative angle.",
        _in((WAY, "R(z[2]).T @ (R(x_i[2]) @ (tj - ti) - tz)")),
        _in((WAY, "R(z[2]) @ (R(x_i[2]).T @ (tj - ti) - tz)")),
        _in((WAY, "R(z[2]) @ (R(x_i[2]) @ (tj - ti) - tz)")),
    ),
    Slip(
        "z-after-turn",
        "z's shift was taken off after the turn by θ_z, but z⁻¹ takes the shift off first and then "
        "turns.",
        _in((WAY, "R(z[2]).T @ R(x_i[2]).T @ (tj - ti) - tz")),
    ),
    Slip(
        "turned-by-j",
        "The way is turned into the frame of pose j. z is what pose i sees, so it is pose i's heading "
        "that counts.",
        _in((WAY, "R(z[2]).T @ (R(x_j[2]).T @ (tj - ti) - tz)")),
    ),
    Slip(
        "into-world",
        "The error is turned back into the world's frame. It is wanted in the frame that z leads to.",
        _in((WAY, "(tj - ti) - R(x_i[2]) @ tz")),
    ),
    Slip(
        "not-wrapped",
        "The turn is not wrapped: θ_j − θ_i − θ_z may be 350° where it means −10°, and the graph "
        "would be bent by it. There is wrap.",
        _in((TURN, "x_j[2] - x_i[2] - z[2]")),
    ),
    Slip(
        "wrapped-too-early",
        "Only a part of the turn is wrapped: wrap the whole difference, once z's turn has been taken "
        "off as well.",
        _in((TURN, "wrap(float(x_j[2] - x_i[2])) - z[2]")),
    ),
    Slip(
        "wrapped-to-a-turn",
        "The turn comes back between 0 and 2π: −10° has become 350°. It has to lie between −π and π.",
        _in((TURN, "(x_j[2] - x_i[2] - z[2]) % (2 * np.pi)")),
    ),
    Slip(
        "turn-without-sign",
        "The turn has lost its sign: −10° has become 10°. To which side a pose is turned wrongly "
        "matters as much as how far.",
        _in((TURN, "abs(wrap(float(x_j[2] - x_i[2] - z[2])))")),
    ),
    Slip(
        "wrapped-to-half-a-turn",
        "The remainder was taken of π: an error of more than half a turn is taken for a small one.",
        _in((TURN, "(x_j[2] - x_i[2] - z[2] + np.pi / 2) % np.pi - np.pi / 2")),
    ),
    Slip(
        "z-turn-forgotten",
        "The turn is that from pose i to pose j. The edge has measured a part of it, θ_z, which is no "
        "error.",
        _in((TURN, "wrap(float(x_j[2] - x_i[2]))")),
    ),
    Slip(
        "turn-sign",
        "The turn has the wrong sign: e tells how far pose j has turned beyond what z says.",
        _in((TURN, "wrap(float(z[2] - x_j[2] + x_i[2]))")),
    ),
    Slip(
        "z-turn-added",
        "θ_z is added where it has to be taken off.",
        _in((TURN, "wrap(float(x_j[2] - x_i[2] + z[2]))")),
    ),
    Slip(
        "place-wrapped",
        "Metres are wrapped as if they were angles: only the third component of e is one.",
        _in((RESULT, "wrap(np.array([way[0], way[1], turn]))")),
        """
def error(x_i, x_j, z):
    from slamlab.geometry import between
    return wrap(4 * between(z, between(x_i, x_j))) / 4
""",
    ),
    Slip(
        "degrees",
        "Degrees and radians are mixed. NumPy's sine and cosine take radians, and e's turn is wanted "
        "in radians.",
        _in((RESULT, "np.array([way[0], way[1], np.degrees(turn)])")),
        _in((WAY, "R(np.radians(z[2])).T @ (R(np.radians(x_i[2])).T @ (tj - ti) - tz)")),
    ),
    Slip(
        "order",
        "The components have changed places: e is [x, y, θ].",
        _in((RESULT, "np.array([way[1], way[0], turn])")),
        _in((RESULT, "np.array([turn, way[0], way[1]])")),
    ),
)

STUMBLES = (
    Stumble("malformed", _in((RESULT, "way")), _in((RESULT, "None")), _in((RESULT, "way, turn"))),
    Stumble("raised", _in((TURN, "wrap(x_j[3])"))),
    Stumble("not attempted", "def error(x_i, x_j, z):\n    raise NotImplementedError"),
)
