"""Programs of 04-jxr-jz: the Jacobians of a new landmark."""

from course.tasks import Edit, Slip, Stumble

TASK = "04-jxr-jz"

WAYS = {
    "columns": """
def J_xr(x, z):
    r, phi = z[0], x[2] + z[1]
    return np.column_stack([[1, 0], [0, 1], [-r * np.sin(phi), r * np.cos(phi)]])

def J_z(x, z):
    c, s, r = np.cos(x[2] + z[1]), np.sin(x[2] + z[1]), z[0]
    return np.column_stack([[c, s], [-r * s, r * c]])
""",
    "central differences": """
def slopes(f, x):
    steps = 1e-6 * np.eye(len(x))
    return np.column_stack([(f(x + step) - f(x - step)) / 2e-6 for step in steps])

def J_xr(x, z):
    return slopes(lambda v: g(v, z), x)

def J_z(x, z):
    return slopes(lambda v: g(x, v), z)
""",
    "one-sided differences": """
def J_xr(x, z):
    return np.array([(g(x + step, z) - g(x, z)) / 1e-6 for step in 1e-6 * np.eye(3)]).T

def J_z(x, z):
    return np.array([(g(x, z + step) - g(x, z)) / 1e-6 for step in 1e-6 * np.eye(2)]).T
""",
    "complex step": """
def place(x, z):
    phi = x[2] + z[1]
    return np.array([x[0] + z[0] * np.cos(phi), x[1] + z[0] * np.sin(phi)])

def J_xr(x, z):
    return np.column_stack([place(x + 1e-30j * one, z).imag / 1e-30 for one in np.eye(3)])

def J_z(x, z):
    return np.column_stack([place(x, z + 1e-30j * one).imag / 1e-30 for one in np.eye(2)])
""",
    "from the place itself": """
def J_xr(x, z):
    dx, dy = g(x, z) - x[:2]
    return [[1, 0, -dy], [0, 1, dx]]

def J_z(x, z):
    dx, dy = g(x, z) - x[:2]
    return [[dx / z[0], -dy], [dy / z[0], dx]]
""",
    "a turn that is stretched": """
def J_z(x, z):
    c, s = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.array([[c, -s], [s, c]]) @ np.diag([1, z[0]])

def J_xr(x, z):
    return np.hstack([np.eye(2), J_z(x, z)[:, 1:]])
""",
    "complex numbers": """
def J_xr(x, z):
    beam = z[0] * np.exp(1j * (x[2] + z[1]))
    columns = np.array([1, 1j, 1j * beam])
    return np.array([columns.real, columns.imag])

def J_z(x, z):
    turn = np.exp(1j * (x[2] + z[1]))
    columns = np.array([turn, 1j * z[0] * turn])
    return np.array([columns.real, columns.imag])
""",
    "sympy": """
import functools
import sympy as sp

@functools.cache
def derived():
    x, y, t, r, b = sp.symbols("x y t r b", real=True)
    model = sp.Matrix([x + r * sp.cos(t + b), y + r * sp.sin(t + b)])
    arguments = [(x, y, t), (r, b)]
    return [sp.lambdify(arguments, model.jacobian(sp.Matrix(by))) for by in arguments]

def J_xr(x, z):
    return derived()[0](x, z)

def J_z(x, z):
    return derived()[1](x, z)
""",
}

XR = "[[1, 0, -r * np.sin(direction)], [0, 1, r * np.cos(direction)]]"
DIRECTION = "r, direction = z[0], x[2] + z[1]"
Z = "[[c, -r * s], [s, r * c]]"
ANGLE = "np.cos(x[2] + z[1]), np.sin(x[2] + z[1])"


def _heading(sx, sy):
    return (XR, f"[[1, 0, {sx}], [0, 1, {sy}]]")


def _direction(angle):
    return (DIRECTION, f"r, direction = z[0], {angle}")


def _angle(angle):
    return (ANGLE, f"np.cos({angle}), np.sin({angle})")


def _both(angle):
    return [_direction(angle), _angle(angle)]


def _each(angle):
    """The same mistake in both functions, in the first, in the second."""
    return _both(angle), _direction(angle), _angle(angle)


_DEGREES = (
    "Degrees and radians are mixed. Angles come in radians, np.sin and np.cos take radians, and a "
    "derivative by an angle is per radian."
)

SLIPS = (
    Slip(
        "jxr-printed-10",
        "J_xr as printed in Smolec's (10): neither range nor bearing is in it. Does a turn of the "
        "robot move a landmark at 8 m as little as one at 1 m?",
        _heading("-np.sin(x[2])", "np.cos(x[2])"),
    ),
    Slip(
        "jxr-range-missing",
        "J_xr without the range: a small turn would move a landmark at 8 m as little as one at 1 m.",
        _heading("-np.sin(direction)", "np.cos(direction)"),
    ),
    Slip(
        "bearing-missing",
        "The bearing is missing: this landmark would lie straight ahead of the robot. In which "
        "direction does the beam leave?",
        *_each("x[2]"),
    ),
    Slip(
        "heading-missing",
        "The heading is missing: this is the landmark in the robot's frame. g gives it in the world's.",
        *_each("z[1]"),
    ),
    Slip(
        "bearing-sign",
        "The sign of the bearing: it counts counter-clockwise from the heading. Where does a beam "
        "point at β = +0.1?",
        *_each("x[2] - z[1]"),
        *_each("z[1] - x[2]"),
    ),
    Slip(
        "degrees",
        _DEGREES,
        *_each("np.radians(x[2] + z[1])"),
        *_each("np.degrees(x[2] + z[1])"),
        *_each("x[2] + np.radians(z[1])"),
        *_each("x[2] + np.degrees(z[1])"),
        _heading("-np.radians(r * np.sin(direction))", "np.radians(r * np.cos(direction))"),
        _heading("-np.degrees(r * np.sin(direction))", "np.degrees(r * np.cos(direction))"),
        (Z, "[[c, -np.radians(r) * s], [s, np.radians(r) * c]]"),
        (Z, "[[c, -np.degrees(r) * s], [s, np.degrees(r) * c]]"),
    ),
    Slip(
        "jxr-sine-cosine",
        "Sine and cosine have changed places in J_xr. Take θ + β = 0 and look along x: which "
        "coordinate of the landmark feels a small change of heading, x or y?",
        _heading("-r * np.cos(direction)", "r * np.sin(direction)"),
        _heading("r * np.cos(direction)", "-r * np.sin(direction)"),
        _heading("r * np.cos(direction)", "r * np.sin(direction)"),
    ),
    Slip(
        "jxr-sign",
        "The heading column of J_xr has a wrong sign. Take θ + β = 0 and look along x, then turn a "
        "little to the left: does the landmark move to +y or to −y?",
        _heading("r * np.sin(direction)", "-r * np.cos(direction)"),
        _heading("r * np.sin(direction)", "r * np.cos(direction)"),
        _heading("-r * np.sin(direction)", "-r * np.cos(direction)"),
    ),
    Slip(
        "jxr-no-heading",
        "The heading column of J_xr is empty: turn the robot while its beam holds a landmark. Does "
        "the place it points at stay?",
        _heading("0", "0"),
    ),
    Slip(
        "jxr-identity-missing",
        "The new x is the old x plus something. What is its derivative by the old x?",
        (XR, "[[0, 0, -r * np.sin(direction)], [0, 0, r * np.cos(direction)]]"),
    ),
    Slip(
        "jxr-identity-sign",
        "A robot that is shifted shifts what it places, by as much and to the same side: look at the "
        "first two columns of J_xr.",
        (XR, "[[-1, 0, -r * np.sin(direction)], [0, -1, r * np.cos(direction)]]"),
        (XR, "[[0, 1, -r * np.sin(direction)], [1, 0, r * np.cos(direction)]]"),
        (XR, "[[1, 1, -r * np.sin(direction)], [1, 1, r * np.cos(direction)]]"),
    ),
    Slip(
        "jxr-whole-place",
        "The heading column of J_xr holds the landmark's coordinates in the world: the robot turns "
        "about itself, not about the origin. Which offset swings?",
        _heading("-g(x, z)[1]", "g(x, z)[0]"),
    ),
    Slip(
        "jz-printed-11",
        "J_z as printed in Smolec's (11) is a pure rotation. Look at the units of its second column: "
        "metres of landmark per radian of bearing. Where do the metres come from?",
        (Z, "[[c, -s], [s, c]]"),
        [(Z, "[[c, -s], [s, c]]"), _angle("x[2]")],
    ),
    Slip(
        "jz-transposed",
        "This is the transpose of J_z: a row per coordinate of the landmark, a column per component "
        "of z.",
        (Z, "[[c, s], [-r * s, r * c]]"),
    ),
    Slip(
        "jz-columns-swapped",
        "The columns of J_z have changed places: z is range first, bearing second.",
        (Z, "[[-r * s, c], [r * c, s]]"),
    ),
    Slip(
        "jz-sine-cosine",
        "Sine and cosine have changed places in J_z. Take θ + β = 0: the beam points along x. Which "
        "coordinate does a longer range change, which one a larger bearing?",
        (Z, "[[s, -r * c], [c, r * s]]"),
        (Z, "[[s, r * c], [c, -r * s]]"),
        (Z, "[[c, r * c], [s, -r * s]]"),
        (Z, "[[c, r * c], [s, r * s]]"),
    ),
    Slip(
        "jz-sign",
        "Every entry of J_z has the right size, and a sign is wrong. Take θ + β = 0: the beam points "
        "along x. What does a longer range do, what a larger bearing?",
        (Z, "[[c, r * s], [s, r * c]]"),
        (Z, "[[c, r * s], [s, -r * c]]"),
        (Z, "[[c, -r * s], [s, -r * c]]"),
        (Z, "[[c, -r * s], [-s, r * c]]"),
        (Z, "[[-c, -r * s], [-s, r * c]]"),
    ),
    Slip(
        "jz-range-twice",
        "The first column of J_z holds the range: a metre more of range moves the landmark by a metre, "
        "however far it is.",
        (Z, "[[r * c, -r * s], [r * s, r * c]]"),
        (Z, "[[r * c, -s], [r * s, c]]"),
    ),
    Slip(
        "whole-numbers",
        "The result is cut down to whole numbers: an array that was made of integers stays one.",
        (f"np.array({Z})", f"np.array({Z}).astype(int)"),
        (f"np.array({XR})", f"np.array({XR}).astype(int)"),
    ),
    Slip(
        "bearing-before-range",
        "Range and bearing have changed places: z is range first, bearing second.",
        [
            (DIRECTION, "r, direction = z[1], x[2] + z[0]"),
            ("r, c, s = z[0], " + ANGLE, "r, c, s = z[1], " + ANGLE.replace("z[1]", "z[0]")),
        ],
    ),
    Slip(
        "sines-for-cosines",
        "Sine and cosine have changed places: a beam along the world's x axis, at the angle 0, leads to "
        "(r, 0).",
        [
            (XR, "[[1, 0, -r * np.cos(direction)], [0, 1, r * np.sin(direction)]]"),
            (Z, "[[s, -r * c], [c, r * s]]"),
        ],
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (f"np.array({XR})", f"np.array({XR}).T"),
        (XR, "[[1, 0, -r * np.sin(direction)], [0, 1, r * np.cos(direction)], [0, 0, 1]]"),
        (XR, "[[-r * np.sin(direction)], [r * np.cos(direction)]]"),
        (f"return np.array({Z})", f"np.array({Z})"),
        (f"np.array({Z})", f"np.array({Z}) / 0"),
    ),
    Stumble("missing", "del J_z"),
    Stumble("not attempted", "def J_z(x, z):\n    raise NotImplementedError('your turn')"),
    Stumble("raised", Edit("solution", ((DIRECTION, "r, direction = z"), (Z, "[c, [s, r]]")))),
)

EQUIVALENT = {}
