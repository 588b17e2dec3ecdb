"""Exercise 02: what students write for rays, scans, readings, noise and its size."""

from tests.bank import Right, Wrong


def ray(
    u="np.cos(phi), np.sin(phi)",
    w="wall[2] - wall[0], wall[3] - wall[1]",
    d="wall[0] - p[0], wall[1] - p[1]",
    t="(dx * wy - dy * wx) / det",
    s="(dx * uy - dy * ux) / det",
    hit="t >= 0 and 0 <= s <= 1",
    result="t",
    parallel="if det == 0: return np.inf",
):
    """The source of a ray_wall with these lines."""
    return f"""
def ray_wall(p, phi, wall):
    ux, uy = {u}
    wx, wy = {w}
    dx, dy = {d}
    det = ux * wy - uy * wx
    {parallel}
    t = {t}
    s = {s}
    return {result} if {hit} else np.inf
"""


# whether parallel lines meet far away is a matter of the last bit
PARALLEL = ("02-ray-wall:parallel",)
ELSEWHERE = tuple(f"02-ray-wall:{law}" for law in ("behind", "beside", "parallel"))

RAY = [
    Wrong("behind accepted", ray(hit="0 <= s <= 1"), {"behind"}, "behind accepted"),
    Wrong(
        "behind accepted, without sign",
        ray(hit="0 <= s <= 1", result="abs(t)"),
        {"behind"},
        "behind accepted",
    ),
    Wrong("endless wall", ray(hit="t >= 0"), {"beside"}, "endless wall", may_lose=PARALLEL),
    Wrong(
        "no end tested", ray(hit="t >= 0 and s <= 1"), {"beside"}, "one end open", may_lose=PARALLEL
    ),
    Wrong(
        "no beginning tested",
        ray(hit="t >= 0 and s >= 0"),
        {"beside"},
        "one end open",
        may_lose=PARALLEL,
    ),
    Wrong(
        "lines only",
        ray(hit="True"),
        {"behind", "beside"},
        "behind accepted",
        may_lose=PARALLEL,
    ),
    Wrong(
        "way to the wall reversed",
        ray(d="p[0] - wall[0], p[1] - wall[1]"),
        {"02-ray-wall"},
        "never met",
    ),
    Wrong(
        "sign of t",
        ray(t="-(dx * wy - dy * wx) / det"),
        {"reached", "behind"},
        "looks backwards",
    ),
    Wrong("share of the wall returned", ray(result="s"), {"reached"}, "share returned"),
    Wrong(
        "phi converted to degrees",
        ray(u="np.cos(np.degrees(phi)), np.sin(np.degrees(phi))"),
        {"reached"},
        "degrees",
        may_lose=ELSEWHERE,
    ),
    Wrong(
        "phi taken for degrees",
        ray(u="np.cos(np.radians(phi)), np.sin(np.radians(phi))"),
        {"reached"},
        "degrees",
        may_lose=ELSEWHERE,
    ),
    Wrong(
        "sine for cosine",
        ray(u="np.sin(phi), np.cos(phi)"),
        {"reached"},
        "sine and cosine swapped",
        may_lose=ELSEWHERE,
    ),
    Wrong(
        "y downwards",
        ray(u="np.cos(phi), -np.sin(phi)"),
        {"reached"},
        "clockwise",
        may_lose=ELSEWHERE,
    ),
    Wrong(
        "both x first",
        ray(w="wall[1] - wall[0], wall[3] - wall[2]", d="wall[0] - p[0], wall[2] - p[1]"),
        {"reached"},
        "columns mistaken",
        may_lose=ELSEWHERE,
    ),
    Wrong(
        "p forgotten",
        ray(d="wall[0], wall[1]"),
        {"reached"},
        "from the origin",
        may_lose=ELSEWHERE,
    ),
    Wrong(
        "always 1",
        "def ray_wall(p, phi, wall):\n    return 1.0",
        {"02-ray-wall"},
        "idle",
    ),
    Wrong(
        "NaN for nothing",
        ray().replace("else np.inf", "else np.nan"),
        {"02-ray-wall"},
        problem="malformed",
    ),
    Wrong(
        "nothing returned",
        "def ray_wall(p, phi, wall):\n    t = 1",
        {"02-ray-wall"},
        problem="malformed",
    ),
    Wrong(
        "a pair",
        "def ray_wall(p, phi, wall):\n    return 1.0, 2.0",
        {"02-ray-wall"},
        problem="malformed",
    ),
    Wrong(
        "parallel walls not thought of",
        """
def ray_wall(p, phi, wall):
    u, a, b = np.array([np.cos(phi), np.sin(phi)]), wall[:2], wall[2:]
    t, s = np.linalg.solve(np.column_stack([u, a - b]), a - p)
    return t if t >= 0 and 0 <= s <= 1 else np.inf
""",
        {"02-ray-wall"},
        problem="raised",
    ),
]


def scan(result, nearest="min(ray_wall(p, phi, wall) for wall in walls)"):
    """The source of a scan with that result, of nearest (n,) and range_max."""
    return f"""
def scan(p, directions, walls, range_max):
    nearest = np.array([{nearest} for phi in directions])
    return {result}
"""


LIMITED = "np.where(nearest <= range_max, nearest, np.nan)"
MET = "[t for t in (ray_wall(p, phi, wall) for wall in walls) if np.isfinite(t)]"

SCAN = [
    Wrong(
        "farthest wall",
        scan(LIMITED, f"max({MET}, default=np.inf)"),
        {"free sight"},
        "farthest wall",
    ),
    Wrong(
        "first wall met",
        scan(LIMITED, f"next(iter({MET}), np.inf)"),
        {"free sight"},
        "first in the list",
    ),
    Wrong(
        "last wall met",
        scan(LIMITED, f"next(reversed({MET}), np.inf)"),
        {"free sight"},
        "last in the list",
    ),
    Wrong(
        "infinity beyond the range",
        scan("np.where(nearest <= range_max, nearest, np.inf)"),
        {"nothing"},
        "infinity left",
    ),
    Wrong(
        "cut off at range_max",
        scan("np.minimum(nearest, range_max)"),
        {"nothing"},
        "range_max reported",
    ),
    Wrong(
        "zero for nothing",
        scan("np.where(nearest <= range_max, nearest, 0)"),
        {"nothing"},
        "zero reported",
    ),
    Wrong("no range_max", scan("nearest"), {"nothing"}, "seen beyond the range"),
    Wrong(
        "NaN only where no wall is",
        scan("np.where(np.isfinite(nearest), nearest, np.nan)"),
        {"nothing"},
        "seen beyond the range",
    ),
    Wrong(
        "comparison reversed",
        scan("np.where(nearest > range_max, np.nan, np.nan)"),
        {"02-scan"},
        "nothing seen",
    ),
    Wrong(
        "directions in degrees",
        scan(LIMITED).replace("(p, phi, wall)", "(p, np.radians(phi), wall)"),
        {"on a wall", "free sight"},
        "degrees",
        may_lose=("02-scan:nothing",),
    ),
    Wrong(
        "average of the walls met",
        scan(LIMITED, f"np.mean({MET} or [np.inf])"),
        {"on a wall", "free sight"},
    ),
    Wrong(
        "a range for each wall",
        scan(LIMITED, "[ray_wall(p, phi, wall) for wall in walls]"),
        {"02-scan"},
        problem="malformed",
    ),
]


def points(
    back="millimetres > 0",
    beta="-np.radians(degrees[back])",
    r="millimetres[back] / 1000",
    q="r * np.cos(beta), r * np.sin(beta)",
    result="carry(pose, carry(mount, q))",
    matrix="[[c, s], [-s, c]]",
):
    """The source of a to_points with these lines."""
    return f"""
def to_points(degrees, millimetres, mount, pose):
    def carry(frame, q):
        c, s = np.cos(frame[2]), np.sin(frame[2])
        return q @ np.array({matrix}) + frame[:2]
    back = {back}
    beta, r = {beta}, {r}
    q = np.column_stack([{q}])
    return {result}
"""


POINTS = [
    Wrong(
        "minus forgotten",
        points(beta="np.radians(degrees[back])"),
        {"bearing"},
        "counter-clockwise",
    ),
    Wrong(
        "millimetres kept",
        points(r="millimetres[back]"),
        {"rigid", "range"},
        "millimetres",
    ),
    Wrong("degrees kept", points(beta="-degrees[back]"), {"rigid", "bearing"}, "degrees"),
    Wrong(
        "degrees and the minus",
        points(beta="degrees[back]"),
        {"rigid", "bearing"},
        "degrees",
    ),
    Wrong(
        "front along +y",
        points(q="-r * np.sin(beta), r * np.cos(beta)"),
        {"bearing"},
        "front along +y",
    ),
    Wrong(
        "front along +y, mirrored",
        points(q="r * np.sin(beta), r * np.cos(beta)"),
        {"bearing"},
        "front along +y",
    ),
    Wrong("no mount", points(result="carry(pose, q)"), {"range", "bearing"}, "mount forgotten"),
    Wrong("no pose", points(result="carry(mount, q)"), {"range", "bearing"}, "pose forgotten"),
    Wrong(
        "pose first",
        points(result="carry(mount, carry(pose, q))"),
        {"range", "bearing"},
        "wrong order",
    ),
    Wrong(
        "poses added",
        points(result="carry(pose + mount, q)"),
        {"range", "bearing"},
        "mount added as it is",
    ),
    Wrong(
        "mount's angle forgotten",
        points(result="carry(pose, q + mount[:2])"),
        {"bearing"},
        "mount not turned",
    ),
    Wrong(
        "matrix transposed",
        points(matrix="[[c, -s], [s, c]]"),
        {"range", "bearing"},
        "turned the wrong way",
    ),
    Wrong(
        "readings of 0 kept",
        points(back="millimetres >= 0"),
        {"nothing left out"},
        "empties kept",
    ),
    Wrong(
        "a fifth as far",
        points(r="millimetres[back] / 5000"),
        {"rigid", "range"},
    ),
    Wrong(
        "the last left out",
        points(result="carry(pose, carry(mount, q))[:-1]"),
        {"02-to-points"},
    ),
    Wrong(
        "NaN in the map",
        points(back="degrees >= 0", r="np.where(millimetres > 0, millimetres, np.nan) / 1000"),
        {"02-to-points"},
        problem="malformed",
    ),
    Wrong(
        "points in columns",
        points(result="carry(pose, carry(mount, q)).T"),
        {"02-to-points"},
        problem="malformed",
    ),
]


def noisy(
    draw="rng.standard_normal(len(ranges))",
    sigma="error * ranges",
    lost="rng.random(len(ranges)) < dropouts",
    nothing="np.nan",
    before="",
    after="",
):
    """The source of a noisy with these lines."""
    return f"""
def noisy(ranges, error, dropouts, rng):
    {before}
    measured = ranges + {sigma} * {draw}
    measured[{lost}] = {nothing}
    {after}
    return measured
"""


AVERAGE = ("02-noise:average",)

NOISE = [
    Wrong("the same for all ranges", noisy(sigma="error"), {"spread"}, "does not grow"),
    Wrong("variance", noisy(sigma="(error * ranges) ** 2"), {"spread"}, "variance taken"),
    Wrong(
        "root", noisy(sigma="np.sqrt(error * ranges)"), {"spread"}, "root taken", may_lose=AVERAGE
    ),
    Wrong("uniform", noisy(draw="rng.uniform(-1, 1, len(ranges))"), {"spread"}, "uniform"),
    Wrong(
        "only longer",
        noisy(draw="abs(rng.standard_normal(len(ranges)))"),
        {"average", "spread"},
        "one-sided",
    ),
    Wrong(
        "rng.random",
        noisy(draw="rng.random(len(ranges))"),
        {"average", "spread"},
        "one-sided",
    ),
    Wrong(
        "one draw",
        noisy(draw="rng.standard_normal()"),
        {"spread"},
        "one number for all",
        may_lose=AVERAGE,
    ),
    Wrong("no noise", noisy(sigma="0 * ranges"), {"spread"}, "one number for all"),
    Wrong(
        "dropouts kept",
        noisy(lost="rng.random(len(ranges)) > dropouts"),
        {"dropouts"},
        "kept for lost",
    ),
    Wrong("no dropouts", noisy(lost="ranges < 0"), {"dropouts"}, "nothing lost"),
    Wrong(
        "zeros where lost",
        noisy(nothing="0.0"),
        {"average", "spread", "dropouts", "nothing"},
        "zero for lost",
    ),
    Wrong(
        "the first beams lost",
        noisy(lost=": int(dropouts * len(ranges))"),
        {"dropouts"},
        "always the same beams",
    ),
    Wrong(
        "np.random",
        noisy(draw="np.random.standard_normal(len(ranges))"),
        {"seed"},
        "another generator",
    ),
    Wrong(
        "a fresh generator",
        noisy(before="rng = np.random.default_rng()"),
        {"seed"},
        "another generator",
    ),
    Wrong(
        "a seed of its own",
        noisy(before="rng = np.random.default_rng(0)"),
        {"02-noise"},
        "always the same",
    ),
    Wrong(
        "nothing filled with the mean",
        noisy(before="ranges = np.where(np.isnan(ranges), np.nanmean(ranges), ranges)"),
        {"nothing"},
    ),
    Wrong("twice the noise", noisy(sigma="2 * error * ranges"), {"spread"}),
    Wrong(
        "1 cm too long", noisy(after="measured += 0.01"), {"average"}, may_lose=("02-noise:spread",)
    ),
    Wrong(
        "too few",
        noisy(after="measured = measured[~np.isnan(measured)]"),
        {"02-noise"},
        problem="malformed",
    ),
]


def fit(error=None, dropouts="lost.mean()", seen="scans[:, ~np.isnan(scans).all(axis=0)]"):
    """The source of a fit with these formulas of scans, seen and lost."""
    error = (
        error or "np.sqrt(np.nanmean((np.nanstd(seen, axis=0) / np.nanmean(seen, axis=0)) ** 2))"
    )
    return f"""
def fit(scans):
    seen = {seen}
    lost = np.isnan(seen)
    return {error}, {dropouts}
"""


FIT = [
    Wrong(
        "spread of everything",
        fit("np.nanstd(scans) / np.nanmean(scans)"),
        {"error", "all beams"},
        "beams mixed",
    ),
    Wrong(
        "along the rows",
        fit("np.mean(np.nanstd(seen, axis=1) / np.nanmean(seen, axis=1))"),
        {"error", "all beams"},
        "beams mixed",
    ),
    Wrong(
        "in metres",
        fit("np.sqrt(np.nanmean(np.nanstd(seen, axis=0) ** 2))"),
        {"error", "any unit"},
        "in metres",
        may_lose=("02-fit:all beams",),
    ),
    Wrong(
        "variance of the shares",
        fit("np.mean(np.nanvar(seen, axis=0) / np.nanmean(seen, axis=0) ** 2)"),
        {"error", "all beams"},
        "variance",
    ),
    Wrong(
        "zeros for NaN",
        fit("np.mean(np.nan_to_num(seen).std(axis=0) / np.nan_to_num(seen).mean(axis=0))"),
        {"error", "all beams"},
        "zeros for NaN",
    ),
    Wrong(
        "one mean range",
        fit("np.sqrt(np.nanmean(np.nanvar(seen, axis=0))) / np.nanmean(seen)"),
        {"error"},
        "one range for all",
    ),
    Wrong(
        "first beam only",
        fit("np.nanstd(seen[:, 0], ddof=1) / np.nanmean(seen[:, 0])"),
        {"all beams"},
        "one beam",
        may_lose=("02-fit:error",),
    ),
    Wrong(
        "swapped",
        """
def fit(scans):
    seen = scans[:, ~np.isnan(scans).all(axis=0)]
    error = np.sqrt(np.mean((np.nanstd(seen, axis=0) / np.nanmean(seen, axis=0)) ** 2))
    return np.isnan(seen).mean(), error
""",
        {"error", "dropouts", "all beams"},
        "order swapped",
    ),
    Wrong(
        "open beams counted",
        fit(dropouts="np.isnan(scans).mean()"),
        {"dropouts"},
        "open beams counted",
    ),
    Wrong("share kept", fit(dropouts="1 - lost.mean()"), {"dropouts"}, "share kept"),
    Wrong("number lost", fit(dropouts="lost.sum()"), {"dropouts"}, "number lost"),
    Wrong(
        "beams lost at least once",
        fit(dropouts="lost.any(axis=0).mean()"),
        {"dropouts"},
        "beams ever lost",
    ),
    Wrong(
        "two standard deviations",
        fit("2 * np.mean(np.nanstd(seen, axis=0) / np.nanmean(seen, axis=0))"),
        {"error"},
    ),
    Wrong(
        "plain mean",
        fit("np.mean(seen.std(axis=0) / seen.mean(axis=0))"),
        {"02-fit"},
        problem="malformed",
    ),
    Wrong("one number", "def fit(scans):\n    return 0.01", {"02-fit"}, problem="malformed"),
    Wrong(
        "an error for each beam",
        fit("np.nanstd(seen, axis=0) / np.nanmean(seen, axis=0)"),
        {"02-fit"},
        problem="malformed",
    ),
]

WRONG = [*RAY, *SCAN, *POINTS, *NOISE, *FIT]

RIGHT = [
    Right(
        "by a 2×2 system",
        """
def ray_wall(p, phi, wall):
    M = np.array([[np.cos(phi), wall[0] - wall[2]], [np.sin(phi), wall[1] - wall[3]]])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if t > 0 and 0 < s < 1 else np.inf
""",
    ),
    Right(
        "turned into the beam's frame",
        """
def ray_wall(p, phi, wall):
    a = (complex(*wall[:2]) - complex(*p)) * np.exp(-1j * phi)
    b = (complex(*wall[2:]) - complex(*p)) * np.exp(-1j * phi)
    if a.imag * b.imag > 0 or abs(a.imag - b.imag) < 1e-9:
        return float("inf")
    t = a.real + (b.real - a.real) * a.imag / (a.imag - b.imag)
    return t if t >= 0 else float("inf")
""",
    ),
    Right(
        "with the math module, division left to fail softly",
        """
import math

def ray_wall(p, phi, wall):
    x1, y1, x2, y2 = map(float, wall)
    c, s = math.cos(phi), math.sin(phi)
    normal = (y1 - y2, x2 - x1)
    towards = normal[0] * c + normal[1] * s
    if abs(towards) < 1e-12:
        return math.inf
    t = (normal[0] * (x1 - p[0]) + normal[1] * (y1 - p[1])) / towards
    x, y = p[0] + t * c, p[1] + t * s
    inside = (x - x1) * (x - x2) + (y - y1) * (y - y2) <= 0
    return t if t >= 0 and inside else math.inf
""",
    ),
    Right(
        "parallel left to NumPy's infinities",
        ray(parallel=""),
    ),
    Right(
        "loops and lists",
        """
def scan(p, directions, walls, range_max):
    found = []
    for phi in directions:
        best = None
        for wall in walls:
            t = ray_wall(p, phi, wall)
            if t <= range_max and (best is None or t < best):
                best = t
        found.append(float("nan") if best is None else best)
    return found
""",
    ),
    Right(
        "all pairs at once",
        """
def scan(p, directions, walls, range_max):
    u = np.stack([np.cos(directions), np.sin(directions)], axis=1)[:, None]
    w, d = walls[:, 2:] - walls[:, :2], walls[:, :2] - p
    det = u[..., 0] * w[:, 1] - u[..., 1] * w[:, 0]
    t = (d[:, 0] * w[:, 1] - d[:, 1] * w[:, 0]) / det
    s = (d[:, 0] * u[..., 1] - d[:, 1] * u[..., 0]) / det
    t[(t < 0) | (s < 0) | (s > 1)] = np.inf
    nearest = t.min(axis=1)
    nearest[nearest > range_max] = np.nan
    return nearest
""",
    ),
    Right(
        "complex numbers",
        """
def to_points(degrees, millimetres, mount, pose):
    z = millimetres * 1e-3 * np.exp(-1j * np.deg2rad(degrees))
    z = z[millimetres != 0]
    for frame in (mount, pose):
        z = z * np.exp(1j * frame[2]) + complex(frame[0], frame[1])
    return np.column_stack([z.real, z.imag])
""",
    ),
    Right(
        "compose and transform of the package",
        """
from slamlab.geometry import compose, transform

def to_points(degrees, millimetres, mount, pose):
    r, b = millimetres / 1000, np.radians(360 - degrees)
    xy = np.column_stack([r * np.cos(b), r * np.sin(b)])[r > 0]
    return transform(compose(pose, mount), xy)
""",
    ),
    Right(
        "a loop that appends lists",
        """
def to_points(degrees, millimetres, mount, pose):
    def T(f):
        return np.array([[np.cos(f[2]), -np.sin(f[2]), f[0]], [np.sin(f[2]), np.cos(f[2]), f[1]],
                         [0, 0, 1]])
    out = []
    for a, mm in zip(degrees, millimetres):
        if mm == 0:
            continue
        q = [mm / 1000 * np.cos(np.radians(a)), -mm / 1000 * np.sin(np.radians(a)), 1]
        x, y, _ = T(pose) @ T(mount) @ q
        out.append([x, y])
    return out
""",
    ),
    Right(
        "rng.normal, dropouts drawn first",
        """
def noisy(ranges, error, dropouts, rng):
    lost = rng.random(ranges.shape) < dropouts
    return np.where(lost, np.nan, rng.normal(1, error, ranges.shape) * ranges)
""",
    ),
    Right(
        "beam by beam, changing its argument",
        """
def noisy(ranges, error, dropouts, rng):
    for k, r in enumerate(ranges):
        if not np.isnan(r):
            ranges[k] = np.nan if rng.uniform() < dropouts else r + rng.normal(0, error * r)
    return ranges
""",
    ),
    Right(
        "a fixed number lost, chosen by chance",
        """
def noisy(ranges, error, dropouts, rng):
    measured = list(ranges * (1 + error * rng.standard_normal(ranges.size)))
    for k in rng.choice(ranges.size, round(dropouts * ranges.size), replace=False):
        measured[k] = float("nan")
    return measured
""",
    ),
    Right(
        "mean of the beams' shares",
        fit("np.mean(np.nanstd(seen, axis=0) / np.nanmean(seen, axis=0))"),
    ),
    Right(
        "mean deviation over mean range",
        fit("np.nanmean(np.nanstd(seen, axis=0, ddof=1)) / np.nanmean(np.nanmean(seen, axis=0))"),
    ),
    Right(
        "by the median",
        """
def fit(scans):
    ever = np.isfinite(scans).any(axis=0)
    scans = scans[:, ever]
    share = scans / np.nanmedian(scans, axis=0) - 1
    error = 1.4826 * np.nanmedian(abs(share))
    return np.array([error, np.mean(np.isnan(scans))])
""",
    ),
    Right(
        "loops, changing its argument",
        """
def fit(scans):
    shares, lost, all_ = [], 0, 0
    for column in scans.T:
        good = column[~np.isnan(column)]
        if len(good) == 0:
            continue
        lost, all_ = lost + len(column) - len(good), all_ + len(column)
        column /= good.mean()
        shares += [(len(good), np.nanvar(column, ddof=1))]
    n, variance = np.array(shares).T
    return [float(np.sqrt(np.average(variance, weights=n - 1))), lost / all_]
""",
    ),
]
