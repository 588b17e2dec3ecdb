"""Solutions of exercise 08 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

FIT = """
def fit_line(points):
    centre = points.mean(axis=0)
    {centred}
    values, vectors = np.linalg.eigh(off.T @ off)
    normal = {normal}
    rho, alpha = normal @ centre, np.arctan2(normal[1], normal[0])
    {sign}
    return {result}
"""


def fit(**changes):
    parts = {
        "centred": "off = points - centre",
        "normal": "vectors[:, 0]",
        "sign": "if rho < 0:\n        rho, alpha = -rho, wrap(alpha + np.pi)",
        "result": "rho, alpha",
    }
    return FIT.format(**(parts | changes))


ANGLE = """
def fit_line(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = {alpha}
    rho = centre @ [np.cos(alpha), np.sin(alpha)]
    if rho < 0:
        rho, alpha = -rho, wrap(alpha + np.pi)
    return rho, alpha
"""


def angle(alpha):
    return ANGLE.format(alpha=alpha)


SLOPE = """
def fit_line(points):
    x, y = points.T
    {fit}
    if rho < 0:
        rho, alpha = -rho, wrap(alpha + np.pi)
    return rho, alpha
"""
OF_X = "a, b = np.polyfit(x, y, 1); rho, alpha = b / np.hypot(1, a), np.arctan2(1, -a)"
OF_Y = "a, b = np.polyfit(y, x, 1); rho, alpha = b / np.hypot(1, a), np.arctan2(-a, 1)"

WALL = """
def find_wall(points, band, needed, tries, rng):
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        pair = rng.choice(len(points), 2, replace=False)
        rho, alpha = fit_line(points[pair])
        off = points @ [np.cos(alpha), np.sin(alpha)] - rho
        inside = {inside}
        if {better}:
            best, guess = inside, (rho, alpha)
            {then}
    {none}
    rho, alpha = {line}
    return {result}
"""


def wall(**changes):
    parts = {
        "inside": "np.abs(off) <= band",
        "better": "inside.sum() > best.sum()",
        "then": "pass",
        "none": "if best.sum() < needed:\n        return None",
        "line": "fit_line(points[best])",
        "result": "rho, alpha, best",
    }
    return WALL.format(**(parts | changes))


CORNER = """
def corner(z1, R1, z2, R2):
    N = {N}
    p = {p}
    back, P = {back}, np.zeros((2, 2))
    for k, R in enumerate((R1, R2)):
        across = np.array([-N[k, 1], N[k, 0]])
        J = np.outer(back[:, k], {inner})
        P = {P}
    return {result}
"""


def corner(**changes):
    parts = {
        "N": "np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])",
        "p": "np.linalg.solve(N, [z1[0], z2[0]])",
        "back": "np.linalg.inv(N)",
        "inner": "[1, -(across @ p)]",
        "P": "P + J @ R @ J.T",
        "result": "p, P",
    }
    return CORNER.format(**(parts | changes))


SEEN = """
def h_line(x, line):
    rho, alpha = line
    c, s = np.cos(alpha), np.sin(alpha)
    distance, direction = {distance}, {direction}
    {then}
    return np.array([distance, direction])
"""


def seen(**changes):
    parts = {
        "distance": "rho - x[0] * c - x[1] * s",
        "direction": "wrap(alpha - x[2])",
        "then": "pass",
    }
    return SEEN.format(**(parts | changes))


SLOPES = """
def H_lines(x, line):
    c, s = np.cos(line[1]), np.sin(line[1])
    {before}
    H_r = np.array({H_r})
    H_p = np.array({H_p})
    return {result}
"""


def slopes(**changes):
    parts = {
        "before": "pass",
        "H_r": "[[-c, -s, 0], [0, 0, -1]]",
        "H_p": "[[1, x[0] * s - x[1] * c], [0, 1]]",
        "result": "H_r, H_p",
    }
    return SLOPES.format(**(parts | changes))


PAIRING = """
def associate(z, expected, S, gate):
    d2 = np.empty((len(z), len(expected)))
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            {wrap}
            d2[i, j] = {d2}
    pairs = [None] * len(z)
    {pair}
    return {result}
"""
NEAREST_FIRST = """for k in np.argsort(d2, axis=None):
        i, j = divmod(int(k), len(expected))
        if d2[i, j] <= gate and pairs[i] is None and j not in pairs:
            pairs[i] = j"""
IN_TURN = """for i in range(len(z)):
        free = [j for j in range(len(expected)) if d2[i, j] <= gate and j not in pairs]
        pairs[i] = {choice}"""


def pairing(**changes):
    parts = {
        "wrap": "v[1] = wrap(v[1])",
        "d2": "v @ np.linalg.inv(S[j]) @ v",
        "pair": NEAREST_FIRST,
        "result": "pairs",
    }
    return PAIRING.format(**(parts | changes))


LEAST, VERTICAL, OUTWARD = (f"08-fit-line:{law}" for law in ("least", "vertical", "outward"))
TURNED = "08-fit-line:turned"
MOST, NEAR, REFITTED, NOTHING = (
    f"08-ransac:{law}" for law in ("most", "near", "refitted", "nothing")
)
PLACE, COVARIANCE, CONSISTENT = (
    f"08-corner:{law}" for law in ("place", "covariance", "consistent")
)
ON_WALL, SIDE, WRAPPED, H_R, H_P = (
    f"08-h-line:{law}" for law in ("on-wall", "keeps-side", "wrapped", "H_r", "H_p")
)
ONCE, GATE, NEAREST = (f"08-associate:{law}" for law in ("once", "gate", "nearest"))
BOTH = {LEAST, VERTICAL}

WRONG = [
    # ---- fit
    Wrong("y = a x + b", SLOPE.format(fit=OF_X), BOTH | {TURNED}, "school"),
    Wrong(
        "x = a y + b", SLOPE.format(fit=OF_Y), {LEAST, TURNED}, "school-of-x", may_lose={VERTICAL}
    ),
    Wrong(
        "the better of both slopes",
        "def fit_line(points):\n"
        "    x, y = points.T\n"
        "    if np.var(x) > np.var(y):\n"
        f"        {OF_X}\n"
        "    else:\n"
        f"        {OF_Y}\n"
        "    return (rho, alpha) if rho >= 0 else (-rho, wrap(alpha + np.pi))\n",
        {LEAST},
        "school-of-x",
        may_lose={VERTICAL, TURNED},
    ),
    Wrong("not centred", fit(centred="off = points"), BOTH, "not-centred"),
    Wrong("largest eigenvalue", fit(normal="vectors[:, 1]"), BOTH, "along"),
    Wrong("svd's first row", fit(normal="np.linalg.svd(off)[2][0]"), BOTH, "along"),
    Wrong(
        "half forgotten",
        angle("np.arctan2(-2 * (x @ y), y @ y - x @ x)"),
        {LEAST, TURNED},
        "half-forgotten",
        may_lose={VERTICAL},
    ),
    Wrong(
        "arctan of the quotient",
        angle("0.5 * np.arctan(2 * (x @ y) / (x @ x - y @ y))"),
        {LEAST, TURNED},
        "arctan",
        may_lose={VERTICAL},
    ),
    Wrong(
        "the other sign in atan2",
        angle("0.5 * np.arctan2(2 * (x @ y), x @ x - y @ y)"),
        BOTH,
        "along",
    ),
    Wrong("alpha, rho", fit(result="alpha, rho"), BOTH | {TURNED}, "swapped", may_lose={OUTWARD}),
    Wrong(
        "degrees",
        fit(result="rho, np.degrees(alpha)"),
        {LEAST, TURNED},
        "degrees",
        may_lose={VERTICAL},
    ),
    Wrong("sign left to chance", fit(sign="pass"), {OUTWARD}, "negative"),
    Wrong(
        "absolute value of rho only",
        fit(sign="rho = abs(rho)"),
        {LEAST},
        "half-turn",
        may_lose={VERTICAL, TURNED},
    ),
    Wrong(
        "turned without rho",
        fit(sign="if rho < 0:\n        alpha += np.pi"),
        {LEAST, OUTWARD},
        "half-turn",
        may_lose={VERTICAL, TURNED},
    ),
    Wrong(
        "nothing returned", "def fit_line(points):\n    pass\n", {"08-fit-line"}, None, "malformed"
    ),
    Wrong("one number", fit(result="rho"), {"08-fit-line"}, None, "malformed"),
    Wrong("NaN", fit(result="np.nan, alpha"), {"08-fit-line"}, None, "malformed"),
    # ---- ransac
    Wrong("no abs", wall(inside="off <= band"), {NEAR, NOTHING}, "no-abs", may_lose={MOST}),
    Wrong(
        "squared distance", wall(inside="off**2 <= band"), {NEAR}, "wide", may_lose={MOST, NOTHING}
    ),
    Wrong("guess not refitted", wall(line="guess"), {REFITTED}, "not-refitted"),
    Wrong("refitted on all", wall(line="fit_line(points)"), {NEAR, REFITTED}, "refitted-on-all"),
    Wrong("always a wall", wall(none="pass"), {NOTHING}, "never-none"),
    Wrong("never a wall", wall(better="False"), {MOST, NEAR, REFITTED, NOTHING}, "always-none"),
    Wrong(
        "mask inverted",
        wall(result="rho, alpha, ~best"),
        {NEAR, REFITTED},
        "inverted",
        may_lose={MOST},
    ),
    Wrong(
        "last guess",
        wall(better="True", none="pass"),
        {MOST, NOTHING},
        "not-the-most",
        may_lose={NEAR},
    ),
    Wrong(
        "first guess",
        wall(then="break", none="pass"),
        {MOST, NOTHING},
        "not-the-most",
        may_lose={NEAR},
    ),
    Wrong("no mask", wall(result="rho, alpha"), {"08-ransac"}, None, "malformed"),
    Wrong(
        "rows for a mask",
        wall(result="rho, alpha, np.flatnonzero(best)"),
        {"08-ransac"},
        None,
        "malformed",
    ),
    # ---- corner
    Wrong(
        "range and bearing",
        corner(result="[np.hypot(*p), np.arctan2(p[1], p[0])], P"),
        {PLACE},
        "polar",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "N transposed",
        corner(p="np.linalg.solve(N.T, [z1[0], z2[0]])"),
        {PLACE, COVARIANCE},
        "N-transposed",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "direction for normal",
        corner(N="np.array([[-np.sin(z[1]), np.cos(z[1])] for z in (z1, z2)])"),
        {PLACE, COVARIANCE},
        "direction-for-normal",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "sum of the feet",
        corner(p="N.T @ [z1[0], z2[0]]"),
        {PLACE, COVARIANCE},
        "sum-of-feet",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "alpha ignored",
        corner(inner="[1, 0]"),
        {COVARIANCE},
        "alpha-ignored",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "lever missing",
        corner(inner="[1, -1]"),
        {COVARIANCE},
        "no-lever",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "lever's sign",
        corner(inner="[1, across @ p]"),
        {COVARIANCE},
        "lever-sign",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "R's diagonal",
        corner(P="P + J @ np.diag(np.diag(R)) @ J.T"),
        {COVARIANCE},
        "tie-ignored",
        may_lose={CONSISTENT},
    ),
    Wrong("last line only", corner(P="J @ R @ J.T"), {COVARIANCE, CONSISTENT}, "one-line"),
    Wrong("difference", corner(P="J @ R @ J.T - P"), {COVARIANCE, CONSISTENT}, "difference"),
    Wrong(
        "R squared",
        corner(P="P + J @ (R @ R) @ J.T"),
        {COVARIANCE, CONSISTENT},
        "standard-deviation",
    ),
    Wrong(
        "root of R",
        corner(P="P + J @ np.sqrt(np.abs(R)) @ J.T"),
        {COVARIANCE, CONSISTENT},
        "standard-deviation",
    ),
    Wrong(
        "N for its inverse",
        corner(back="N"),
        {COVARIANCE},
        "N-for-its-inverse",
        may_lose={CONSISTENT},
    ),
    Wrong(
        "rows of the inverse",
        corner(back="np.linalg.inv(N).T"),
        {COVARIANCE},
        "N-for-its-inverse",
        may_lose={CONSISTENT},
    ),
    Wrong("P only", corner(result="P"), {"08-corner"}, None, "malformed"),
    Wrong(
        "P as deviations", corner(result="p, np.sqrt(np.diag(P))"), {"08-corner"}, None, "malformed"
    ),
    # ---- observation
    Wrong("not wrapped", seen(direction="alpha - x[2]"), {WRAPPED}, "unwrapped"),
    Wrong(
        "always outward",
        seen(
            then="if distance < 0:\n"
            "        distance, direction = -distance, wrap(direction + np.pi)"
        ),
        {SIDE},
        "outward",
    ),
    Wrong(
        "distance without sign",
        seen(distance="abs(rho - x[0] * c - x[1] * s)"),
        {ON_WALL},
        "distance-only",
    ),
    Wrong("heading added", seen(direction="wrap(alpha + x[2])"), {ON_WALL, SIDE}, "heading-added"),
    Wrong(
        "heading less alpha", seen(direction="wrap(x[2] - alpha)"), {ON_WALL, SIDE}, "heading-added"
    ),
    Wrong("heading forgotten", seen(direction="alpha"), {ON_WALL, SIDE}, "heading-forgotten"),
    Wrong("moved away", seen(distance="rho + x[0] * c + x[1] * s"), {ON_WALL}, "moved-away"),
    Wrong("not moved", seen(distance="rho"), {ON_WALL}, "not-moved"),
    Wrong(
        "normal of the robot's frame",
        seen(distance="rho - x[:2] @ [np.cos(alpha - x[2]), np.sin(alpha - x[2])]"),
        {ON_WALL},
        "mixed-frames",
    ),
    Wrong(
        "sine for cosine", seen(distance="rho - x[0] * s - x[1] * c"), {ON_WALL}, "sine-for-cosine"
    ),
    Wrong(
        "H of the robot's frame",
        slopes(H_r="[[-np.cos(line[1] - x[2]), -np.sin(line[1] - x[2]), 0], [0, 0, -1]]"),
        {H_R},
        "mixed-frames-H",
    ),
    Wrong("heading missing in H", slopes(H_r="[[-c, -s, 0], [0, 0, 0]]"), {H_R}, "heading-missing"),
    Wrong("sign of H_r", slopes(H_r="[[c, s, 0], [0, 0, 1]]"), {H_R}, "H_r-sign"),
    Wrong("sign of the normal", slopes(H_r="[[c, s, 0], [0, 0, -1]]"), {H_R}, "H_r-sign"),
    Wrong("columns exchanged", slopes(H_r="[[-s, -c, 0], [0, 0, -1]]"), {H_R}, "xy-exchanged"),
    Wrong("identity", slopes(H_p="[[1, 0], [0, 1]]"), {H_P}, "lever-missing"),
    Wrong(
        "not differentiated",
        slopes(H_p="[[1, -x[0] * c - x[1] * s], [0, 1]]"),
        {H_P},
        "lever-is-normal",
    ),
    Wrong("sign of the lever", slopes(H_p="[[1, x[1] * c - x[0] * s], [0, 1]]"), {H_P}, "H_p-sign"),
    Wrong("H_p transposed", slopes(H_p="[[1, 0], [x[0] * s - x[1] * c, 1]]"), {H_P}, "transposed"),
    Wrong("H_r only", slopes(result="H_r"), {"08-h-line"}, None, "malformed"),
    Wrong("H_p, H_r", slopes(result="H_p, H_r"), {"08-h-line"}, None, "malformed"),
    # ---- association
    Wrong("Pythagoras", pairing(d2="v @ v"), {NEAREST}, "euclid", may_lose={GATE}),
    Wrong(
        "S not inverted", pairing(d2="v @ S[j] @ v"), {NEAREST}, "S-not-inverted", may_lose={GATE}
    ),
    Wrong(
        "entries inverted", pairing(d2="v @ (1 / S[j]) @ v"), {NEAREST}, "entries", may_lose={GATE}
    ),
    Wrong("angle of v not wrapped", pairing(wrap="pass"), {NEAREST}, "unwrapped"),
    Wrong(
        "variances only",
        pairing(d2="np.sum(v**2 / np.diag(S[j]))"),
        {NEAREST},
        "diagonal",
        may_lose={GATE},
    ),
    Wrong(
        "gate on the root",
        pairing(d2="np.sqrt(v @ np.linalg.inv(S[j]) @ v)"),
        {GATE},
        "not-squared",
    ),
    Wrong(
        "no gate",
        pairing(pair=NEAREST_FIRST.replace("d2[i, j] <= gate and ", "")),
        {GATE},
        "gate-forgotten",
    ),
    Wrong(
        "the nearest, always",
        pairing(pair="pairs = d2.argmin(axis=1)"),
        {ONCE, GATE},
        "gate-forgotten",
    ),
    Wrong(
        "first found",
        pairing(pair=IN_TURN.format(choice="free[0] if free else None")),
        {NEAREST},
        "first-found",
    ),
    Wrong(
        "each for itself",
        pairing(pair="pairs = [int(r.argmin()) if r.min() <= gate else None for r in d2]"),
        {ONCE},
        "each-alone",
    ),
    Wrong(
        "in turn",
        pairing(pair=IN_TURN.format(choice="min(free, key=lambda j: d2[i, j]) if free else None")),
        {NEAREST},
        "in-turn",
    ),
    Wrong(
        "counted from one",
        pairing(result="[None if j is None else j + 1 for j in pairs]"),
        {"08-associate"},
        None,
        "malformed",
    ),
    Wrong(
        "pairs (i, j)",
        pairing(result="[(i, j) for i, j in enumerate(pairs) if j is not None]"),
        {"08-associate"},
        None,
        "malformed",
    ),
    Wrong(
        "NotImplemented left",
        "def associate(z, expected, S, gate):\n    raise NotImplementedError\n",
        {"08-associate"},
        None,
        "not attempted",
    ),
]

RIGHT = [
    Right("angle in closed form", angle("0.5 * np.arctan2(-2 * (x @ y), y @ y - x @ x)")),
    Right("svd", fit(normal="np.linalg.svd(off)[2][1]")),
    Right(
        "general eig",
        fit(normal="np.linalg.eig(off.T @ off)[1][:, np.argmin(np.linalg.eig(off.T @ off)[0])]"),
    ),
    Right("a list, wrapped to 0 to 2π", fit(result="[float(rho), float(alpha % (2 * np.pi))]")),
    Right(
        "searched",
        "def fit_line(points):\n"
        "    from scipy.optimize import minimize\n"
        "    start, end = points[points[:, 0].argmin()], points[points[:, 0].argmax()]\n"
        "    off = points - points.mean(axis=0)\n"
        "    cost = lambda a: np.sum((off @ [np.cos(a), np.sin(a)]) ** 2)\n"
        "    grid = np.linspace(0, np.pi, 60)\n"
        "    a0 = grid[np.argmin([cost(a) for a in grid])]\n"
        "    a = minimize(lambda v: cost(v[0]), [a0], method='Nelder-Mead').x[0]\n"
        "    rho = points.mean(axis=0) @ [np.cos(a), np.sin(a)]\n"
        "    return (rho, a) if rho >= 0 else (-rho, a + np.pi)\n",
    ),
    Right(
        "mutates its points",
        "def fit_line(points):\n    centre = points.mean(axis=0)\n"
        "    points -= centre\n    n = np.linalg.svd(points)[2][1]\n    points += centre\n"
        "    rho = n @ centre\n    n, rho = (n, rho) if rho >= 0 else (-n, -rho)\n"
        "    return np.array([rho, np.arctan2(n[1], n[0])])\n",
    ),
    Right(
        "integers drawn",
        wall().replace(
            "rng.choice(len(points), 2, replace=False)", "rng.permutation(len(points))[:2]"
        ),
    ),
    Right(
        "refitted once more",
        wall(
            line="fit_line(points[best])",
            none="if best.sum() < needed:\n        return None\n"
            "    rho, alpha = fit_line(points[best])\n"
            "    best = np.abs(points @ [np.cos(alpha), np.sin(alpha)] - rho) <= band",
        ),
    ),
    Right(
        "every pair",
        """
def find_wall(points, band, needed, tries, rng):
    best = None
    for i in range(0, len(points)):
        for j in range(i + 1, len(points), 3):
            a, b = points[i], points[j]
            n = np.array([a[1] - b[1], b[0] - a[0]]) / np.hypot(*(a - b))
            inside = abs((points - a) @ n) <= band
            if best is None or inside.sum() > best.sum():
                best = inside
    return None if best.sum() < needed else (*fit_line(points[best]), best.tolist())
""",
    ),
    Right("mask as numbers", wall(result="[rho, alpha, best.astype(int)]")),
    Right(
        "feet solved by hand",
        """
def corner(z1, R1, z2, R2):
    (r1, a1), (r2, a2) = z1, z2
    det = np.sin(a2 - a1)
    x = (r1 * np.sin(a2) - r2 * np.sin(a1)) / det
    y = (r2 * np.cos(a1) - r1 * np.cos(a2)) / det
    R = np.zeros((4, 4))
    R[:2, :2], R[2:, 2:] = R1, R2
    def place(v):
        d = np.sin(v[3] - v[1])
        return np.array([
            (v[0] * np.sin(v[3]) - v[2] * np.sin(v[1])) / d,
            (v[2] * np.cos(v[1]) - v[0] * np.cos(v[3])) / d,
        ])
    v = np.array([r1, a1, r2, a2])
    J = np.column_stack([(place(v + e) - place(v - e)) / 2e-6 for e in 1e-6 * np.eye(4)])
    return [x, y], J @ R @ J.T
""",
    ),
    Right(
        "solve instead of inv",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    T = np.array([[-N[0, 1], N[0, 0]], [-N[1, 1], N[1, 0]]])
    lever = T @ p
    D = np.diag([
        np.array([1, -lever[0]]) @ R1 @ np.array([1, -lever[0]]),
        np.array([1, -lever[1]]) @ R2 @ np.array([1, -lever[1]]),
    ])
    half = np.linalg.solve(N, D)
    return p, np.linalg.solve(N, half.T).T
""",
    ),
    Right(
        "wrapped by atan2", seen(direction="np.arctan2(np.sin(alpha - x[2]), np.cos(alpha - x[2]))")
    ),
    Right(
        "slopes by differences",
        """
def H_lines(x, line):
    def f(v):
        return np.array([v[3] - v[0] * np.cos(v[4]) - v[1] * np.sin(v[4]), v[4] - v[2]])
    v = np.concatenate([x, line])
    H = np.column_stack([(f(v + e) - f(v - e)) / 2e-6 for e in 1e-6 * np.eye(5)])
    return H[:, :3], H[:, 3:]
""",
    ),
    Right("lists", slopes(result="H_r.tolist(), H_p.tolist()")),
    Right("wraps in place", pairing(wrap="z[i, 1] = wrap(z[i, 1]); v[1] = wrap(v[1])")),
    Right("solve for d²", pairing(d2="v @ np.linalg.solve(S[j], v)")),
    Right(
        "−1 never, numpy numbers",
        pairing(result="[None if j is None else np.int64(j) for j in pairs]"),
    ),
    Right(
        "all at once",
        """
def associate(z, expected, S, gate):
    v = z[:, None] - expected
    v[..., 1] = wrap(v[..., 1])
    d2 = np.einsum("mni,nij,mnj->mn", v, np.linalg.inv(S), v)
    pairs = [None] * len(z)
    while d2.min() <= gate:
        i, j = np.unravel_index(d2.argmin(), d2.shape)
        pairs[i] = j
        d2[i], d2[:, j] = np.inf, np.inf
    return tuple(pairs)
""",
    ),
]
