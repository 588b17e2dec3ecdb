"""Solutions of exercise 04: errata as printed, classic mistakes, other right ways."""

from tests.bank import Right, Wrong

_H = """
def {name}(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx**2 + dy**2
    r = np.sqrt(q)
    H = np.array([[-dx / r, -dy / r, 0], [dy / q, -dx / q, -1]])
    L = -H[:, :2]
    return np.array({rows})
"""

_A = """
def A_odometry(x, u):
    (d, turn), theta = u, x[2]
    s, c = np.sin(theta), np.cos(theta)
    A = np.array([[1, 0, -d * s], [0, 1, d * c], [0, 0, 1]])
    return {returns}
"""

_J = """
def {name}(x, z):
    (r, bearing), theta = z, x[2]
    c, s = np.cos(theta + bearing), np.sin(theta + bearing)
    return np.array({rows})
"""

_N = """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn, P_rn = Jr @ P @ Jr.T + Jz @ R @ Jz.T, P @ Jr.T
    {changed}
    return P_nn, P_rn
"""


def _h_robot(name, rows, loses, diagnosis=None, **problem):
    return Wrong(
        f"H robot: {name}", _H.format(name="H_robot", rows=rows), loses, diagnosis, **problem
    )


def _h_landmark(name, rows, loses, diagnosis=None, **problem):
    code = _H.format(name="H_landmark", rows=rows)
    return Wrong(f"H landmark: {name}", code, loses, diagnosis, **problem)


def _a(name, returns, loses, diagnosis=None, **problem):
    return Wrong(f"A: {name}", _A.format(returns=returns), loses, diagnosis, **problem)


def _a_heading(name, sx, sy, diagnosis):
    returns = f"np.array([[1, 0, {sx}], [0, 1, {sy}], [0, 0, 1]])"
    return _a(name, returns, {"heading-column"}, diagnosis)


def _j_xr(name, rows, diagnosis, loses=("J_xr",), **problem):
    code = _J.format(name="J_xr", rows=rows)
    return Wrong(f"J_xr: {name}", code, loses, diagnosis, **problem)


def _j_xr_heading(name, sx, sy, diagnosis):
    return _j_xr(name, f"[[1, 0, {sx}], [0, 1, {sy}]]", diagnosis)


def _j_z_at(name, angle, diagnosis, length="r"):
    c, s = f"np.cos({angle})", f"np.sin({angle})"
    return _j_z(name, f"[[{c}, -{length} * {s}], [{s}, {length} * {c}]]", diagnosis)


def _j_z(name, rows, diagnosis, loses=("J_z",), **problem):
    return Wrong(f"J_z: {name}", _J.format(name="J_z", rows=rows), loses, diagnosis, **problem)


def _new(name, changed, loses, diagnosis=None, **problem):
    return Wrong(f"new: {name}", _N.format(changed=changed), loses, diagnosis, **problem)


RANGE, BEARING = {"range-row"}, {"bearing-row"}
BOTH_ROWS = RANGE | BEARING
ALL_COLUMNS = {"position-columns", "heading-column"}
BOTH_BLOCKS = {"P_nn", "P_rn"}
SHAPE = {"problem": "malformed"}

AS_PRINTED = [
    _h_robot("printed (2)", "[H[0], [dy / q, dx / q, -1]]", BEARING, "printed-2"),
    _h_landmark("printed (3), from (2)", "[L[0], [-dy / q, -dx / q]]", BEARING, "printed-3"),
    _a_heading("from the printed (4)", "-s", "c", "step-missing"),
    _a_heading("printed (5)", "-d * s * s", "d * c * c", "printed-5"),
    _j_xr_heading("printed (10)", "-np.sin(theta)", "np.cos(theta)", "printed-10"),
    _j_z_at("printed (11)", "theta + bearing", "printed-11", length="1"),
    _j_z_at("printed (11), no turn", "theta", "printed-11", length="1"),
]

IN_H_ROBOT = [
    _h_robot("rows swapped", "H[::-1]", BOTH_ROWS, "rows-swapped"),
    _h_robot("by the landmark", "np.column_stack([L, [0, -1]])", BOTH_ROWS, "by-landmark"),
    _h_robot("all signs", "-H", BOTH_ROWS, "by-landmark"),
    _h_robot(
        "dx and dy exchanged",
        "[[-dy / r, -dx / r, 0], [dx / q, -dy / q, -1]]",
        BOTH_ROWS,
        "xy-exchanged",
    ),
    _h_robot("r for r²", "[H[0], [dy / r, -dx / r, -1]]", BEARING, "r-for-r2"),
    _h_robot("r² for r", "[[-dx / q, -dy / q, 0], H[1]]", RANGE, "r2-for-r"),
    _h_robot("bearing in degrees", "[H[0], np.degrees(H[1])]", BEARING, "degrees"),
    _h_robot("all but −1 in degrees", "[H[0], [*np.degrees(H[1, :2]), -1]]", BEARING, "degrees"),
    _h_robot("heading in degrees", "H * [1, 1, np.pi / 180]", BEARING, "heading-degrees"),
    _h_robot("bearing clockwise", "[H[0], -H[1]]", BEARING, "bearing-sign"),
    _h_robot("bearing negated but −1", "[H[0], [-dy / q, dx / q, -1]]", BEARING, "bearing-sign"),
    _h_robot("missing −1", "[H[0], [dy / q, -dx / q, 0]]", BEARING, "heading-missing"),
    _h_robot("plus one", "[H[0], [dy / q, -dx / q, 1]]", BEARING, "heading-sign"),
    _h_robot("one sign of the range", "[[-dx / r, dy / r, 0], H[1]]", RANGE, "sign"),
    _h_robot("made-up numbers", "[[1, 2, 3], [4, 5, 6]]", BOTH_ROWS, "idle"),
    _h_robot("transposed", "H.T", BOTH_ROWS, **SHAPE),
    _h_robot("both parts at once", "np.hstack([H, L])", BOTH_ROWS, **SHAPE),
    _h_robot("not a number", "H * np.nan", BOTH_ROWS, **SHAPE),
]

IN_H_LANDMARK = [
    _h_landmark("by the robot", "H[:, :2]", BOTH_ROWS, "by-robot"),
    _h_landmark("transposed", "L.T", BOTH_ROWS, "transposed"),
    _h_landmark("rows swapped", "L[::-1]", BOTH_ROWS, "rows-swapped"),
    _h_landmark(
        "dx and dy exchanged", "[[dy / r, dx / r], [-dx / q, dy / q]]", BOTH_ROWS, "xy-exchanged"
    ),
    _h_landmark("r for r²", "[L[0], [-dy / r, dx / r]]", BEARING, "r-for-r2"),
    _h_landmark("r² for r", "[[dx / q, dy / q], L[1]]", RANGE, "r2-for-r"),
    _h_landmark("bearing in degrees", "[L[0], np.degrees(L[1])]", BEARING, "degrees"),
    _h_landmark("bearing clockwise", "[L[0], -L[1]]", BEARING, "bearing-sign"),
    _h_landmark("one sign of the range", "[[dx / r, -dy / r], L[1]]", RANGE, "sign"),
    _h_landmark("with a heading", "np.column_stack([L, [0, -1]])", BOTH_ROWS, **SHAPE),
]

IN_A = [
    _a("transposed", "A.T", ALL_COLUMNS, "transposed"),
    _a("identity missing", "A - np.eye(3)", ALL_COLUMNS, "identity-missing"),
    _a_heading(
        "after the motion",
        "-d * np.sin(theta + turn)",
        "d * np.cos(theta + turn)",
        "after-motion",
    ),
    _a_heading(
        "at half the turn",
        "-d * np.sin(theta + turn / 2)",
        "d * np.cos(theta + turn / 2)",
        "after-motion",
    ),
    _a_heading(
        "heading taken for degrees",
        "-d * np.sin(np.radians(theta))",
        "d * np.cos(np.radians(theta))",
        "degrees",
    ),
    _a_heading(
        "heading made degrees",
        "-d * np.sin(np.degrees(theta))",
        "d * np.cos(np.degrees(theta))",
        "degrees",
    ),
    _a_heading("per degree", "-np.radians(d * s)", "np.radians(d * c)", "degrees"),
    _a_heading("sine and cosine swapped", "-d * c", "d * s", "sine-cosine"),
    _a_heading("all signs", "d * s", "-d * c", "column-sign"),
    _a_heading("one sign", "d * s", "d * c", "column-sign"),
    _a("identity", "np.eye(3)", ALL_COLUMNS, "no-heading"),
    _a("turn in the corner", "A + np.diag([0, 0, turn - 1])", {"heading-column"}, "turn-for-one"),
    _a("zero in the corner", "A - np.diag([0, 0, 1])", {"heading-column"}, "turn-for-one"),
    _a("two rows", "A[:2]", ALL_COLUMNS, **SHAPE),
    _a("no matrix but f", "np.array([x[0] + d * c, x[1] + d * s, turn])", ALL_COLUMNS, **SHAPE),
]

IN_J = [
    _j_xr_heading("range missing", "-s", "c", "jxr-range-missing"),
    _j_xr_heading(
        "bearing missing", "-r * np.sin(theta)", "r * np.cos(theta)", "jxr-bearing-missing"
    ),
    _j_xr_heading(
        "bearing clockwise",
        "-r * np.sin(theta - bearing)",
        "r * np.cos(theta - bearing)",
        "jxr-bearing-sign",
    ),
    _j_xr_heading(
        "angles taken for degrees",
        "-r * np.sin(np.radians(theta + bearing))",
        "r * np.cos(np.radians(theta + bearing))",
        "jxr-degrees",
    ),
    _j_xr_heading(
        "bearing taken for degrees",
        "-r * np.sin(theta + np.radians(bearing))",
        "r * np.cos(theta + np.radians(bearing))",
        "jxr-degrees",
    ),
    _j_xr_heading("per degree", "-np.radians(r * s)", "np.radians(r * c)", "jxr-degrees"),
    _j_xr_heading("sine and cosine swapped", "-r * c", "r * s", "jxr-sine-cosine"),
    _j_xr_heading("no heading", "0", "0", "jxr-no-heading"),
    _j_xr_heading("all signs", "r * s", "-r * c", "jxr-sign"),
    _j_xr("identity missing", "[[0, 0, -r * s], [0, 0, r * c]]", "jxr-identity-missing"),
    _j_xr("transposed", "[[1, 0], [0, 1], [-r * s, r * c]]", None, {"04-jxr-jz"}, **SHAPE),
    _j_xr("three rows", "[[1, 0, -r * s], [0, 1, r * c], [0, 0, 1]]", None, {"04-jxr-jz"}, **SHAPE),
    _j_z("transposed", "[[c, s], [-r * s, r * c]]", "jz-transposed"),
    _j_z("columns swapped", "[[-r * s, c], [r * c, s]]", "jz-columns-swapped"),
    _j_z("sine and cosine swapped", "[[s, -r * c], [c, r * s]]", "jz-sine-cosine"),
    _j_z("one sign", "[[c, r * s], [s, r * c]]", "jz-sign"),
    _j_z_at("bearing missing", "theta", "jz-bearing-missing"),
    _j_z_at("heading missing", "bearing", "jz-heading-missing"),
    _j_z_at("bearing clockwise", "theta - bearing", "jz-bearing-sign"),
    _j_z_at("angles taken for degrees", "np.radians(theta + bearing)", "jz-degrees"),
    _j_z_at("per degree", "theta + bearing", "jz-degrees", length="np.radians(r)"),
]

IN_NEW = [
    _new("noise only", "P_nn = Jz @ R @ Jz.T", {"P_nn"}, "pose-ignored"),
    _new("pose only", "P_nn = Jr @ P @ Jr.T", {"P_nn"}, "noise-ignored"),
    _new("R as it is", "P_nn = Jr @ P @ Jr.T + R", {"P_nn"}, "noise-not-carried"),
    _new("R alone", "P_nn = R", {"P_nn"}, "noise-not-carried"),
    _new("heading left out", "P_nn = P[:2, :2] + Jz @ R @ Jz.T", {"P_nn"}, "heading-ignored"),
    _new(
        "standard deviation for variance",
        "P_nn = Jr @ P @ Jr.T + Jz @ np.sqrt(R) @ Jz.T",
        {"P_nn"},
        "standard-deviation",
    ),
    _new(
        "variance squared",
        "P_nn = Jr @ P @ Jr.T + Jz @ R**2 @ Jz.T",
        {"P_nn"},
        "standard-deviation",
    ),
    _new(
        "sandwich the wrong way round",
        "P_nn = Jr @ P @ Jr.T + Jz.T @ R @ Jz",
        {"P_nn"},
        "sandwich-reversed",
    ),
    _new("transpose missing", "P_nn = Jr @ P @ Jr.T + Jz @ R @ Jz", {"P_nn"}, "transpose-missing"),
    _new("minus", "P_nn = Jr @ P @ Jr.T - Jz @ R @ Jz.T", {"P_nn"}, "noise-subtracted"),
    _new("identity", "P_nn = np.eye(2)", {"P_nn"}),
    _new("zero cross terms", "P_rn = np.zeros((3, 2))", {"P_rn"}, "cross-zero"),
    _new(
        "identity and zero cross terms",
        "P_nn, P_rn = np.eye(2), np.zeros((3, 2))",
        BOTH_BLOCKS,
        "cross-zero",
    ),
    _new("cross without heading", "P_rn = P[:, :2]", {"P_rn"}, "cross-without-heading"),
    _new("cross negated", "P_rn = -P_rn", {"P_rn"}, "cross-sign"),
    _new("bare Jacobian", "P_rn = Jr.T", {"P_rn"}, "cross-not-weighted"),
    _new("cross transposed", "P_rn = P_rn.T", BOTH_BLOCKS, **SHAPE),
    _new("one result", "return P_nn", BOTH_BLOCKS, **SHAPE),
    _new("not attempted", "raise NotImplementedError", BOTH_BLOCKS, problem="not attempted"),
    _new("does not multiply", "P_nn = P_nn @ P", BOTH_BLOCKS, problem="raised"),
    Wrong("J_z is missing", "del J_z", {"04-jxr-jz"}, problem="missing"),
]

WRONG = [*AS_PRINTED, *IN_H_ROBOT, *IN_H_LANDMARK, *IN_A, *IN_J, *IN_NEW]

_SYMPY = """
import functools
import sympy as sp

@functools.cache
def _derived():
    x, y, t, px, py, d, turn, r, b = sp.symbols("x y t px py d turn r b", real=True)
    pose = sp.Matrix([x, y, t])
    h = sp.Matrix([sp.sqrt((px - x)**2 + (py - y)**2), sp.atan2(py - y, px - x) - t])
    f = sp.Matrix([x + d * sp.cos(t), y + d * sp.sin(t), t + turn])
    g = sp.Matrix([x + r * sp.cos(t + b), y + r * sp.sin(t + b)])
    one, other, third = [(x, y, t), (px, py)], [(x, y, t), (d, turn)], [(x, y, t), (r, b)]
    return (
        sp.lambdify(one, h.jacobian(pose)),
        sp.lambdify(one, h.jacobian(sp.Matrix([px, py]))),
        sp.lambdify(other, f.jacobian(pose)),
        sp.lambdify(third, g.jacobian(pose)),
        sp.lambdify(third, g.jacobian(sp.Matrix([r, b]))),
    )

def H_robot(x, p): return _derived()[0](x, p)
def H_landmark(x, p): return _derived()[1](x, p)
def A_odometry(x, u): return _derived()[2](x, u)
def J_xr(x, z): return _derived()[3](x, z)
def J_z(x, z): return _derived()[4](x, z)
"""

_DIFFERENCES = """
def _slopes(f, x, e={step}):
    x = np.asarray(x, dtype=float)
    return np.column_stack([(f(x + s) - f(x - {back} * s)) / (e * (1 + {back}))
                            for s in e * np.eye(len(x))])

def H_robot(x, p): return _slopes(lambda v: h(v, p), x)
def H_landmark(x, p): return _slopes(lambda v: h(x, v), p)
def A_odometry(x, u): return _slopes(lambda v: f_odometry(v, u), x)
def J_xr(x, z): return _slopes(lambda v: g(v, z), x)
def J_z(x, z): return _slopes(lambda v: g(x, v), z)
"""

_COMPLEX_STEP = """
def _slopes(f, x, e=1e-30):
    steps = e * np.eye(len(x))
    return np.column_stack([np.imag(f(np.asarray(x) + 1j * s)) / e for s in steps])

def _see(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    return np.array([np.sqrt(dx**2 + dy**2), np.arctan(dy / dx) - x[2]])

def _drive(x, u):
    return np.array([x[0] + u[0] * np.cos(x[2]), x[1] + u[0] * np.sin(x[2]), x[2] + u[1]])

def _place(x, z):
    return np.array([x[0] + z[0] * np.cos(x[2] + z[1]), x[1] + z[0] * np.sin(x[2] + z[1])])

def H_robot(x, p): return _slopes(lambda v: _see(v, p), x)
def H_landmark(x, p): return _slopes(lambda v: _see(x, v), p)
def A_odometry(x, u): return _slopes(lambda v: _drive(v, u), x)
def J_xr(x, z): return _slopes(lambda v: _place(v, z), x)
def J_z(x, z): return _slopes(lambda v: _place(x, v), z)
"""

_GEOMETRIC = """
def _towards(x, p):
    offset = np.subtract(p, x[:2])
    r = np.linalg.norm(offset)
    return offset / r, r

def H_robot(x, p):
    (c, s), r = _towards(x, p)
    return [[-c, -s, 0], [s / r, -c / r, -1]]

def H_landmark(x, p):
    return -np.array(H_robot(x, p))[:, :2]

def A_odometry(x, u):
    A = np.identity(3)
    A[:2, 2] = u[0] * np.array([-np.sin(x[2]), np.cos(x[2])])
    return A.tolist()

def J_z(x, z):
    angle = x[2] + z[1]
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return turn @ np.diag([1, z[0]])

def J_xr(x, z):
    return np.hstack([np.eye(2), J_z(x, z)[:, 1:]])
"""

_BLOCKS = """
def new_landmark(x, P, z, R):
    G = np.block([[np.eye(3), np.zeros((3, 2))], [J_xr(x, z), J_z(x, z)]])
    joint = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    joint = G @ joint @ G.T
    return [joint[3:, 3:], joint[:3, 3:]]
"""

_FACTORS = """
def new_landmark(x, P, z, R):
    pose, noise = J_xr(x, z) @ np.linalg.cholesky(P), J_z(x, z) @ np.linalg.cholesky(R)
    return pose @ pose.T + noise @ noise.T, np.einsum("ij,kj->ik", P, J_xr(x, z))
"""

RIGHT = [
    Right("sympy inside", _SYMPY),
    Right("central differences", _DIFFERENCES.format(step="1e-6", back=1)),
    Right("one-sided differences", _DIFFERENCES.format(step="1e-6", back=0)),
    Right("complex step", _COMPLEX_STEP),
    Right("from unit vectors, as lists", _GEOMETRIC),
    Right("the joint covariance in one product", _BLOCKS),
    Right("through Cholesky factors", _FACTORS),
]
