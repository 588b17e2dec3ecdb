"""Right ways and slips of 15-jacobians."""

from course.tasks import Edit, Slip, Stumble

TASK = "15-jacobians"

BLOCKS = """
def jacobians(x_i, x_j, z):
    a = x_i[2] + z[2]
    c, s = np.cos(a), np.sin(a)
    dx, dy = x_j[:2] - x_i[:2]
    A = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]], dtype=float)
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]], dtype=float)
    return A, B
"""

WAYS = {
    "entry by entry": BLOCKS,
    "differences": """
def jacobians(x_i, x_j, z):
    def slope(f, x):
        columns = []
        for h in 1e-6 * np.eye(3):
            d = f(x + h) - f(x - h)
            d[2] = wrap(float(d[2]))
            columns.append(d / 2e-6)
        return np.column_stack(columns)

    return slope(lambda v: error(v, x_j, z), x_i), slope(lambda v: error(x_i, v, z), x_j)
""",
    "matrices": """
def jacobians(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    quarter = np.array([[0, -1], [1, 0]])
    A, B = np.zeros((3, 3)), np.eye(3)
    B[:2, :2] = R(x_i[2] + z[2]).T
    A[:2, :2] = -B[:2, :2]
    A[:2, 2] = R(z[2]).T @ (quarter @ R(x_i[2])).T @ (x_j - x_i)[:2]
    A[2, 2] = -1
    return A, B
""",
    "by the chain rule": """
def jacobians(x_i, x_j, z):
    def back(angle):
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])

    way = back(x_i[2]) @ (x_j - x_i)
    swing = np.array([way[1], -way[0], 0])
    by_i = -back(x_i[2]) + np.column_stack([np.zeros((3, 2)), swing])
    return [back(z[2]) @ by_i, back(z[2]) @ back(x_i[2])]
""",
    "A of B and the way": """
def jacobians(x_i, x_j, z):
    a = x_i[2] + z[2]
    B = np.diag([np.cos(a), np.cos(a), 1.0])
    B[0, 1] = np.sin(a)
    B[1, 0] = -B[0, 1]
    dx, dy, _ = x_j - x_i
    T = np.eye(3)
    T[:2, 2] = -dy, dx
    return -B @ T, B
""",
}


def _in(*pairs):
    return Edit("entry by entry", pairs)


ANGLE, RESULT = "a = x_i[2] + z[2]", "return A, B"
COLUMN_X, COLUMN_Y = "c * dy - s * dx", "-c * dx - s * dy"


def _heading(x, y):
    """A with another heading column."""
    return _in((f"{COLUMN_X}], [s, -c, {COLUMN_Y}", f"{x}], [s, -c, {y}"))


SLIPS = (
    Slip(
        "swapped",
        "A and B have changed places: A is the derivative by x_i, and B that by x_j.",
        _in((RESULT, "return B, A")),
    ),
    Slip(
        "both-transposed",
        "Both are transposed: a Jacobian has a row per component of e and a column per component of "
        "the pose.",
        _in((RESULT, "return A.T, B.T")),
    ),
    Slip(
        "b-transposed",
        "This is the transpose of B: a row per component of e, a column per component of x_j. "
        "Or it is R for Rᵀ: what is seen from a frame is turned back.",
        _in((RESULT, "return A, B.T")),
    ),
    Slip(
        "a-transposed",
        "This is the transpose of A: a row per component of e, a column per component of x_i.",
        _in((RESULT, "return A.T, B")),
    ),
    Slip(
        "angle",
        "The frame of e has another heading. From pose i one turns by θ_i, and from there z turns by "
        "θ_z more.",
        _in((ANGLE, "a = x_i[2]")),
        _in((ANGLE, "a = z[2]")),
        _in((ANGLE, "a = x_i[2] - z[2]")),
        _in((ANGLE, "a = x_j[2]")),
        _in((ANGLE, "a = x_j[2] + z[2]")),
    ),
    Slip(
        "turned-forwards",
        "The angle is right, but you turn the wrong way: e is what is seen from a frame with that heading, "
        "and (15.2) has the transpose of its rotation.",
        _in((ANGLE, "a = -(x_i[2] + z[2])")),
    ),
    Slip(
        "degrees",
        "Degrees and radians are mixed: angles come in radians, and np.sin and np.cos take radians.",
        _in((ANGLE, "a = np.radians(x_i[2] + z[2])")),
        _in((ANGLE, "a = np.degrees(x_i[2] + z[2])")),
    ),
    Slip(
        "a-sign",
        "A has B's sign. Move pose i towards pose j: does pose j come nearer, or does it go farther?",
        _in(("[[-c, -s, c", "[[c, s, c"), ("[s, -c, -c", "[-s, c, -c")),
    ),
    Slip(
        "all-of-a-sign",
        "A has the opposite sign everywhere: more of x_i makes e smaller, because it is taken off.",
        _in((RESULT, "return -A, B")),
    ),
    Slip(
        "b-sign",
        "B has the opposite sign: if pose j moves, e moves with it.",
        _in((RESULT, "return A, -B")),
    ),
    Slip(
        "a-turned-forth",
        "A's block turns the wrong way: what is seen *from* a frame is turned back, by Rᵀ.",
        _in(("[[-c, -s, c", "[[-c, s, c"), ("[s, -c, -c", "[-s, -c, -c")),
    ),
    Slip(
        "a-angle",
        "The first two columns of A are turned by another angle than those of B. Move both poses by "
        "the same: e must not change.",
        _in(
            (RESULT, "C = B @ T(z).T; A[:, :2] = -C[:, :2]; return A, B"),
            (
                ANGLE,
                "T = lambda p: np.array([[np.cos(p[2]), -np.sin(p[2]), 0], "
                "[np.sin(p[2]), np.cos(p[2]), 0], [0, 0, 1]]).T; a = x_i[2] + z[2]",
            ),
        ),
        _in((RESULT, "A[:2, :2] = -np.eye(2); return A, B")),
    ),
    Slip(
        "a-is-minus-b",
        "A's heading column is empty, as if A were −B: turn the robot at pose i, and all that it "
        "sees swings round it.",
        _in((RESULT, "return -B, B")),
    ),
    Slip(
        "a-heading-angle",
        "A's heading column is turned by another angle: it is the derivative of R(θ_i)ᵀ times the "
        "way from i to j, and that is turned by −θ_z afterwards.",
        _heading(
            "np.cos(x_i[2]) * dy - np.sin(x_i[2]) * dx",
            "-np.cos(x_i[2]) * dx - np.sin(x_i[2]) * dy",
        ),
        _heading("np.cos(z[2]) * dy - np.sin(z[2]) * dx", "-np.cos(z[2]) * dx - np.sin(z[2]) * dy"),
        _heading("dy", "-dx"),
    ),
    Slip(
        "a-heading-of-e",
        "A's heading column was taken of e itself, but z's shift does not swing: only the way from "
        "pose i to pose j does.",
        _heading("error(x_i, x_j, z)[1]", "-error(x_i, x_j, z)[0]"),
    ),
    Slip(
        "a-heading-not-derived",
        "A's heading column holds the way itself, not what becomes of it when pose i turns: the "
        "derivative of Rᵀ stands at right angles to it.",
        _heading("c * dx + s * dy", "c * dy - s * dx"),
        _heading("-c * dx - s * dy", "s * dx - c * dy"),
    ),
    Slip(
        "a-heading-swapped",
        "The two entries of A's heading column have changed places, or sine and cosine have.",
        _heading("-c * dx - s * dy", "c * dy - s * dx"),
        _heading("s * dy - c * dx", "-s * dx - c * dy"),
    ),
    Slip(
        "a-heading-sign",
        "A sign in A's heading column is turned: if pose i turns to the left, what it sees moves to "
        "the right.",
        _heading("s * dx - c * dy", "c * dx + s * dy"),
        _in((COLUMN_X, "s * dx - c * dy")),
        _in((COLUMN_Y, "c * dx + s * dy")),
        _in(("dx, dy = x_j[:2] - x_i[:2]", "dx, dy = x_i[:2] - x_j[:2]")),
        _in((COLUMN_X, "c * dy + s * dx")),
        _in((COLUMN_Y, "-c * dx + s * dy")),
        _in((COLUMN_X, "-c * dy - s * dx")),
    ),
    Slip(
        "a-heading-column-is-x",
        "The sine belongs to the other difference: derive each entry of R(θ_i)ᵀ by θ_i, and only then "
        "multiply it by the way.",
        _in((COLUMN_X, "c * dx - s * dy")),
        _in((COLUMN_Y, "-c * dy - s * dx")),
        _heading("c * dx - s * dy", "-c * dy - s * dx"),
    ),
    Slip(
        "a-heading-in-row",
        "A's heading column stands in its last row: A has a row per component of e, and θ_e does not "
        "depend on the place of pose i.",
        _in((RESULT, "A[2, :2], A[:2, 2] = A[:2, 2].copy(), 0; return A, B")),
    ),
    Slip(
        "a-turn",
        "The last entry of A: by what does θ_j − θ_i − θ_z change when θ_i grows by one?",
        _in((COLUMN_Y + "], [0, 0, -1]]", COLUMN_Y + "], [0, 0, 1]]")),
        _in((COLUMN_Y + "], [0, 0, -1]]", COLUMN_Y + "], [0, 0, 0]]")),
    ),
    Slip(
        "b-turn",
        "The last entry of B: by what does θ_j − θ_i − θ_z change when θ_j grows by one?",
        _in(("[-s, c, 0], [0, 0, 1]]", "[-s, c, 0], [0, 0, -1]]")),
        _in(("[-s, c, 0], [0, 0, 1]]", "[-s, c, 0], [0, 0, 0]]")),
    ),
    Slip(
        "b-heading",
        "B's heading column is filled as if pose j carried a frame in which e is seen. Turning pose j "
        "on the spot moves it nowhere: only its heading changes.",
        _in((RESULT, "B[:2, 2] = -A[:2, 2]; return A, B")),
        _in((RESULT, "B[:2, 2] = A[:2, 2]; return A, B")),
    ),
)

STUMBLES = (
    Stumble("malformed", _in((RESULT, "return A")), _in((RESULT, "return np.hstack([A, B])"))),
    Stumble("malformed", _in((RESULT, "return A[:2], B[:2]")), _in((RESULT, "pass"))),
    Stumble("raised", _in((ANGLE, "a = x_i[3] + z[2]"))),
)

EQUIVALENT = {
    "error(x_i, v, z), z)": "B is the same wherever pose j lies, so also at the place of z",
}
