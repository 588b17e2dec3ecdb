"""Solutions of exercise 07 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

# ---- templates: a right solution with one place to change -----------------------------------

RHO = """
def correlation(P):
    d = np.diag(P)
    s = np.sqrt(d)
    with np.errstate(all="ignore"):
        rho = {rho}
    {then}
    return {result}
"""
ZEROED = "rho = np.where(np.isfinite(rho), rho, 0)"
BY_SIGMAS = "P / np.outer(s, s)"

UPDATES = """
def two_updates(P, H_1, H_2, R):
    def update(P, H):
        S = {S}
        K = {K}
        return {P}

    def unlinked(P, robot):
        P = P.copy()
        P[3:5, 5:] = P[5:, 3:5] = 0
        if robot:
            P[:3, 3:] = P[3:, :3] = 0
        return P

    P_first = {first}
    P_both = {both}
    return {result}
"""

RELATIVE = """
def relative(x, P, i, j):
    a, b = slice({row} + 2 * i, {row} + 2 + 2 * i), slice({row} + 2 * j, {row} + 2 + 2 * j)
    P_ii, P_jj, P_ij = P[a, a], P[b, b], P[a, b]
    return {delta}, {P}
"""

FUSE = """
def fuse(a, P_a, b, P_b, P_ab):
    S = {S}
    K = {C} @ np.linalg.inv(S)
    x = {x}
    P = {P}
    return {result}
"""

STEP = """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    {drive}
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = {S}
    K = P @ H / S
    x, P = {x}, {P}
    {then}
    return {result}
"""

FIRST = """
def first_estimates(predicted, updated, landmarks):
    n = len(predicted)
    A = np.tile(np.eye(3), (n - 1, 1, 1))
    dx, dy = ({steps})[:, :2].T
    A[:, 0, 2], A[:, 1, 2] = {column}
    H = []
    for k in range(n):
        H_r = H_robot({pose}, {landmark})
        H.append(np.hstack([{blocks}]))
    return {result}
"""


def template(text, **defaults):
    """A function that fills a template, its defaults changed where asked for."""
    return lambda **changes: text.format(**(defaults | changes))


rho = template(RHO, rho=BY_SIGMAS, then=ZEROED, result="rho")
updates = template(
    UPDATES,
    S="H @ P @ H.T + R",
    K="P @ H.T @ np.linalg.inv(S)",
    P="P - K @ S @ K.T",
    first="update(P, H_1)",
    both="update(P_first, H_2)",
    result="P_first, P_both",
)
relative = template(RELATIVE, row=3, delta="x[b] - x[a]", P="P_ii - P_ij - P_ij.T + P_jj")
fuse = template(
    FUSE,
    S="P_a + P_b - P_ab - P_ab.T",
    C="(P_a - P_ab)",
    x="a + K @ (b - a)",
    P="P_a - K @ S @ K.T",
    result="x, P",
)
step = template(
    STEP,
    drive="x[0] += d; P[0, 0] += q",
    S="H @ P @ H + r",
    x="x + K * (z - H @ x)",
    P="P - S * np.outer(K, K)",
    then="pass",
    result="x, P",
)
first = template(
    FIRST,
    steps="np.diff(predicted, axis=0)",
    column="-dy, dx",
    pose="predicted[k]",
    landmark="landmarks[0]",
    blocks="H_r, -H_r[:, :2]",
    result="A, H",
)

SHAPE = {"problem": "malformed"}
RAISED = {"problem": "raised"}

# ---- 07-correlation -------------------------------------------------------------------------

SAMPLES, UNITS, CERTAIN = "samples", "units", "certain"
RHO_ALL = (SAMPLES, UNITS, CERTAIN)


def _rho(name, loses, diagnosis=None, problem=None, **changes):
    return Wrong(f"rho: {name}", rho(**changes), loses, diagnosis, problem)


IN_RHO = [
    _rho("by variances", (SAMPLES, UNITS), "by-variances", rho="P / np.outer(d, d)"),
    _rho(
        "by variances, zeros too",
        RHO_ALL,
        "by-variances",
        rho="P / np.outer(d, d)",
        then="pass",
    ),
    _rho("by the row's sigma", (SAMPLES, UNITS), "one-sigma", rho="P / s[:, None]"),
    _rho("by the column's sigma", (SAMPLES, UNITS), "one-sigma", rho="P / s"),
    _rho("by the row's variance", (SAMPLES, UNITS), "one-variance", rho="P / d[:, None]"),
    _rho("by the column's variance", (SAMPLES, UNITS), "one-variance", rho="P / d"),
    _rho("the covariance", (SAMPLES, UNITS, "certain"), "one-number-for-all", rho="P"),
    _rho("by the largest variance", (SAMPLES, UNITS), "one-number-for-all", rho="P / d.max()"),
    _rho("by the trace", (SAMPLES, UNITS), "one-number-for-all", rho="P / np.trace(P)"),
    _rho("corrcoef of P", (SAMPLES, UNITS), "corrcoef-of-P", rho="np.corrcoef(P)"),
    _rho("sizes", (SAMPLES,), "sign-lost", result="np.abs(rho)"),
    _rho("squares", (SAMPLES,), "sign-lost", result="rho**2"),
    _rho("zero by zero", (CERTAIN,), "zero-over-zero", then="pass"),
    _rho(
        "one for zero by zero",
        (CERTAIN,),
        "certain-not-zero",
        then="rho = np.where(np.isfinite(rho), rho, 1)",
    ),
    _rho("zeros", RHO_ALL, "idle", rho="0 * P"),
    _rho("half", (SAMPLES,), rho="P / np.outer(s, s) / 2"),
    _rho("one row", RHO_ALL, result="rho[0]", **SHAPE),
    _rho("the robot's block", RHO_ALL, result="rho[:3, :3]", **SHAPE),
    _rho("nothing", RHO_ALL, result="None", **SHAPE),
    _rho("complex", RHO_ALL, result="rho + 0j", **SHAPE),
]

# ---- 07-two-updates -------------------------------------------------------------------------

FIRST_LAW, BOTH, GROWS = "first", "both", "never-grows"
UPDATES_ALL = (FIRST_LAW, BOTH, GROWS)


def _updates(name, loses, diagnosis=None, problem=None, **changes):
    return Wrong(f"updates: {name}", updates(**changes), loses, diagnosis, problem)


_UNTOUCHED = """
def two_updates(P, H_1, H_2, R):
    def update(P, H, unseen):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        new = P - K @ S @ K.T
        {kept}
        return new
    P_first = update(P, H_1, slice(5, 7))
    return P_first, update(P_first, H_2, slice(3, 5))
"""

_IN_PLACE = """
def two_updates(P, H_1, H_2, R):
    def update(P, H):
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        P -= K @ H @ P
        return P
    P_first = update(P, H_1)
    return P_first, update(P_first, H_2)
"""

WHEN_FULL = (FIRST_LAW, BOTH)
IN_UPDATES = [
    _updates("K = P Hᵀ", WHEN_FULL, "gain-without-S", K="P @ H.T"),
    _updates(
        "K = P Hᵀ, short",
        WHEN_FULL,
        "gain-without-S",
        K="P @ H.T",
        P="P - K @ H @ P",
    ),
    _updates(
        "K S⁻¹ Kᵀ",
        UPDATES_ALL,
        "inverse-in-the-sandwich",
        P="P - K @ np.linalg.inv(S) @ K.T",
    ),
    _updates("K S⁻¹ K", UPDATES_ALL, P="P - K @ np.linalg.inv(S) @ K", **RAISED),
    _updates("S without R", WHEN_FULL, "noise-forgotten", S="H @ P @ H.T"),
    _updates(
        "S without shares",
        UPDATES_ALL,
        "shares-ignored-in-S",
        S=(
            "H[:, :3] @ P[:3, :3] @ H[:, :3].T + H[:, 3:5] @ P[3:5, 3:5] @ H[:, 3:5].T"
            " + H[:, 5:] @ P[5:, 5:] @ H[:, 5:].T + R"
        ),
        P="P - K @ H @ P",
    ),
    _updates("added", UPDATES_ALL, "added", P="P + K @ S @ K.T"),
    _updates(
        "half of Joseph's form",
        WHEN_FULL,
        "joseph-without-noise",
        P="(np.eye(7) - K @ H) @ P @ (np.eye(7) - K @ H).T",
    ),
    _updates(
        "landmarks unlinked each time",
        UPDATES_ALL,
        "unlinked",
        first="unlinked(update(P, H_1), False)",
        both="unlinked(update(P_first, H_2), False)",
    ),
    _updates(
        "all unlinked each time",
        UPDATES_ALL,
        "unlinked",
        first="unlinked(update(P, H_1), True)",
        both="unlinked(update(P_first, H_2), True)",
    ),
    _updates(
        "P_12 zero at the end",
        (BOTH, GROWS),
        "unlinked",
        both="unlinked(update(P_first, H_2), False)",
    ),
    _updates(
        "unlinked between the two",
        (BOTH, GROWS),
        "unlinked",
        both="update(unlinked(P_first, True), H_2)",
    ),
    Wrong(
        "updates: unseen rows untouched",
        _UNTOUCHED.format(kept="new[unseen], new[:, unseen] = P[unseen], P[:, unseen]"),
        UPDATES_ALL,
        "unseen-untouched",
    ),
    Wrong(
        "updates: unseen block untouched",
        _UNTOUCHED.format(kept="new[unseen, unseen] = P[unseen, unseen]"),
        UPDATES_ALL,
        "unseen-untouched",
    ),
    _updates(
        "second from before the first",
        (BOTH, GROWS),
        "covariance-before-the-first",
        both="update(P, H_2)",
    ),
    _updates(
        "second with the old gain and S",
        (BOTH, GROWS),
        "covariance-before-the-first",
        both="P_first - (P - update(P, H_2))",
    ),
    _updates(
        "second with the old gain",
        (BOTH, GROWS),
        "covariance-before-the-first",
        both="P_first - P @ H_2.T @ np.linalg.inv(H_2 @ P @ H_2.T + R) @ H_2 @ P_first",
    ),
    Wrong("updates: in place", _IN_PLACE, (FIRST_LAW,), "overwritten"),
    _updates("after both, twice", (FIRST_LAW,), "overwritten", result="P_both, P_both"),
    _updates("p1 twice", (BOTH,), "one-landmark-twice", both="update(P_first, H_1)"),
    _updates(
        "second first",
        (FIRST_LAW,),
        "second-first",
        first="update(P, H_2)",
        both="update(P_first, H_1)",
    ),
    _updates("noise twice", WHEN_FULL, S="H @ P @ H.T + 2 * R", P="P - K @ H @ P"),
    _updates("the prior", UPDATES_ALL, "idle", P="P"),
    _updates("one only", UPDATES_ALL, result="P_both", **SHAPE),
    _updates("blocks", UPDATES_ALL, result="P_first[:3, :3], P_both[:3, :3]", **SHAPE),
    _updates("NaN", UPDATES_ALL, result="P_first, P_both * np.nan", **SHAPE),
]

# ---- 07-relative ----------------------------------------------------------------------------

VECTOR, SPREAD, COMMON = "vector", "spread", "common"
RELATIVE_ALL = (VECTOR, SPREAD, COMMON)


def _relative(name, loses, diagnosis=None, problem=None, **changes):
    return Wrong(f"relative: {name}", relative(**changes), loses, diagnosis, problem)


IN_RELATIVE = [
    _relative("no robot before", (VECTOR, SPREAD, COMMON), "wrong-rows", row=0),
    _relative("counted from 1", (VECTOR, SPREAD, COMMON), "wrong-rows", row=1),
    _relative("robot of two rows", (VECTOR, SPREAD, COMMON), "wrong-rows", row=2),
    _relative("back", (VECTOR,), "vector-sign", delta="x[a] - x[b]"),
    _relative("sum", (VECTOR,), "vector-sum", delta="x[a] + x[b]"),
    _relative("the end only", (VECTOR,), "vector-sum", delta="x[b]"),
    _relative("P_ii + P_jj", (SPREAD, COMMON), "correlations-ignored", P="P_ii + P_jj"),
    _relative("plus", (SPREAD, COMMON), "cross-signs", P="P_ii + P_ij + P_ij.T + P_jj"),
    _relative("P_ij twice", (SPREAD,), "transpose-missing", P="P_ii - 2 * P_ij + P_jj"),
    _relative("P_ji twice", (SPREAD,), "transpose-missing", P="P_ii - 2 * P_ij.T + P_jj"),
    _relative("P_ij once", (SPREAD, COMMON), "cross-once", P="P_ii - P_ij + P_jj"),
    _relative("difference", (SPREAD,), "subtracted", P="P_jj - P_ii"),
    _relative("negative", (SPREAD,), "subtracted", P="P_ij + P_ij.T - P_ii - P_jj"),
    _relative(
        "diagonal", (SPREAD,), "diagonal-only", P="np.diag(np.diag(P_ii - P_ij - P_ij.T + P_jj))"
    ),
    _relative("one landmark's", (SPREAD, COMMON), P="P_jj"),
    _relative("variances only", RELATIVE_ALL, P="np.diag(P_ii + P_jj)", **SHAPE),
    _relative("a row", RELATIVE_ALL, delta="(x[b] - x[a])[None]", **SHAPE),
    _relative("text", RELATIVE_ALL, delta="'3'", **SHAPE),
    _relative("nothing", RELATIVE_ALL, delta="None", **SHAPE),
]

# ---- 07-fuse --------------------------------------------------------------------------------

UNBIASED, BEST, HONEST = "unbiased", "best", "honest"
FUSE_ALL = (UNBIASED, BEST, HONEST)


def _fuse(name, loses, diagnosis=None, problem=None, **changes):
    return Wrong(f"fuse: {name}", fuse(**changes), loses, diagnosis, problem)


_CI = """
def fuse(a, P_a, b, P_b, P_ab):
    I_a, I_b = np.linalg.inv(P_a), np.linalg.inv(P_b)
    shares = {shares}
    found = [np.linalg.inv(w * I_a + (1 - w) * I_b) for w in shares]
    k = int(np.argmin([np.trace(P) for P in found]))
    w, P = shares[k], found[k]
    return P @ (w * I_a @ a + (1 - w) * I_b @ b), P
"""
_AVERAGE = "(P_a + P_b + P_ab + P_ab.T) / 4"
NOT_BEST = (BEST, HONEST)

IN_FUSE = [
    _fuse("P_ab ignored", NOT_BEST, "correlations-ignored", S="P_a + P_b", C="P_a"),
    _fuse("a", (BEST,), "one-of-the-two", x="a", P="P_a"),
    _fuse("b", (BEST,), "one-of-the-two", x="b", P="P_b"),
    Wrong("fuse: intersection", _CI.format(shares="[0.5]"), NOT_BEST, "covariance-intersection"),
    Wrong(
        "fuse: best intersection",
        _CI.format(shares="np.linspace(0.01, 0.99, 25)"),
        NOT_BEST,
        "covariance-intersection",
    ),
    _fuse("mean, honest", (BEST,), "averaged", x="(a + b) / 2", P=_AVERAGE),
    _fuse("mean, too sure", NOT_BEST, "averaged", x="(a + b) / 2", P="(P_a + P_b) / 4"),
    _fuse("swapped", NOT_BEST, "weights-swapped", x="b + K @ (a - b)"),
    _fuse(
        "plus in both",
        NOT_BEST,
        "plus-for-minus",
        S="P_a + P_b + P_ab + P_ab.T",
        C="(P_a + P_ab)",
    ),
    _fuse("S_xv by v = a − b against b − a", NOT_BEST, "gain-sign", C="(P_ab - P_a)"),
    _fuse("plus in S", NOT_BEST, "plus-for-minus", S="P_a + P_b + P_ab + P_ab.T"),
    _fuse("plus in C", NOT_BEST, "plus-for-minus", C="(P_a + P_ab)"),
    _fuse("P_ab twice in S", NOT_BEST, "transpose-missing", S="P_a + P_b - 2 * P_ab"),
    _fuse("C turned", NOT_BEST, "transpose-missing", C="(P_a - P_ab.T)"),
    _fuse("not in S", NOT_BEST, "cross-in-one-place", S="P_a + P_b"),
    _fuse("not in C", NOT_BEST, "cross-in-one-place", C="P_a"),
    _fuse("once in S", NOT_BEST, "cross-in-one-place", S="P_a + P_b - P_ab"),
    _fuse("(I − K) P_a", (HONEST,), "standard-formula", P="P_a - K @ P_a"),
    _fuse(
        "both parts, no mixed terms",
        (HONEST,),
        "honest-but-for-the-share",
        P="(np.eye(2) - K) @ P_a @ (np.eye(2) - K).T + K @ P_b @ K.T",
    ),
    _fuse("weights do not sum to 1", FUSE_ALL, x="K @ (b - a)"),
    _fuse("twice the correction", NOT_BEST, x="a + 2 * K @ (b - a)"),
    _fuse("standard deviations", (HONEST,), P="np.sqrt(np.abs(P_a - K @ S @ K.T))"),
    _fuse("P only", FUSE_ALL, result="P", **SHAPE),
    _fuse("P turned to a vector", FUSE_ALL, result="x, np.diag(P)", **SHAPE),
    _fuse("NaN", FUSE_ALL, result="x * np.nan, P", **SHAPE),
]

# ---- 07-corridor ----------------------------------------------------------------------------

MEAN, COVARIANCE, NEES = "mean", "covariance", "nees"
STEP_ALL = (MEAN, COVARIANCE, NEES)


def _step(name, diagnosis=None, problem=None, loses=STEP_ALL, luck=(), **changes):
    luck = tuple(f"07-corridor:{law}" for law in luck)
    return Wrong(f"corridor: {name}", step(**changes), loses, diagnosis, problem, luck)


SEEN = "np.isin(np.arange(len(x)), [0, i])"
IN_STEP = [
    _step("all forgotten", "forgotten", then="P = np.diag(np.diag(P))"),
    _step("doors apart", "forgotten", then="P[1:, 1:] = np.diag(np.diag(P[1:, 1:]))"),
    _step("robot apart", "forgotten", then="P[0, 1:] = P[1:, 0] = 0"),
    _step(
        "others kept",
        "others-not-moved",
        x=f"x + {SEEN} * K * (z - H @ x)",
        P=f"P - S * np.outer(K, K) * np.outer({SEEN}, {SEEN})",
    ),
    _step(
        "others' means kept",
        "others-not-moved",
        x=f"x + {SEEN} * K * (z - H @ x)",
        loses=(MEAN,),
        luck=(NEES,),
    ),
    _step("away", "innovation-sign", x="x - K * (z - H @ x)", loses=(MEAN, NEES)),
    _step("not driven", "not-moved", drive="P[0, 0] += q", loses=(MEAN, NEES)),
    _step("doors driven", "not-moved", drive="x += d; P[0, 0] += q", loses=(MEAN, NEES)),
    _step("driven back", "not-moved", drive="x[0] -= d; P[0, 0] += q", loses=(MEAN, NEES)),
    _step("no q", "drive-noise-missing", drive="x[0] += d"),
    _step("q everywhere", "doors-made-noisy", drive="x[0] += d; P += q * np.eye(len(x))"),
    _step("q in every entry", "doors-made-noisy", drive="x[0] += d; P += q"),
    _step("no r", "sight-noise-missing", S="H @ P @ H"),
    _step("q²", "standard-deviation", drive="x[0] += d; P[0, 0] += q**2"),
    _step("√r", "standard-deviation", S="H @ P @ H + np.sqrt(r)", P="P - np.outer(K, H @ P)"),
    _step(
        "S without shares",
        "shares-ignored-in-S",
        S="P[0, 0] + P[i, i] + r",
        P="P - np.outer(K, H @ P)",
        loses=(MEAN, COVARIANCE),
        luck=(NEES,),
    ),
    _step("gain halved", x="x + K / 2 * (z - H @ x)", loses=(MEAN, NEES)),
    _step("much too sure", result="x, P / 4"),
    _step("x only", problem="malformed", result="x"),
    _step("column", problem="malformed", result="x[:, None], P"),
    _step("text", problem="malformed", result="'x', P"),
]

# ---- 07-first-estimates ---------------------------------------------------------------------

DERIVATIVE, DIRECTIONS = "derivative", "directions"
BOTH_LAWS = (DERIVATIVE, DIRECTIONS)


def _first(name, loses, diagnosis=None, problem=None, **changes):
    return Wrong(f"first: {name}", first(**changes), loses, diagnosis, problem)


FROM_UPDATED = "predicted[1:] - updated[:-1]"
IN_FIRST = [
    _first(
        "the usual Jacobians",
        BOTH_LAWS,
        "landmark-as-now",
        steps=FROM_UPDATED,
        landmark="landmarks[k]",
    ),
    _first("landmark as now", BOTH_LAWS, "landmark-as-now", landmark="landmarks[k]"),
    _first("the last landmark", BOTH_LAWS, "landmark-as-now", landmark="landmarks[-1]"),
    _first(
        "all at the latest",
        BOTH_LAWS,
        "landmark-as-now",
        steps=FROM_UPDATED,
        pose="updated[k]",
        landmark="landmarks[k]",
    ),
    _first("updated pose", BOTH_LAWS, "pose-as-updated", pose="updated[k]"),
    _first(
        "all updated",
        BOTH_LAWS,
        "pose-as-updated",
        pose="updated[k]",
        steps="np.diff(updated, axis=0)",
    ),
    _first("H's landmark sign", BOTH_LAWS, "signs-of-H", blocks="H_r, H_r[:, :2]"),
    _first("all of H's signs", (DERIVATIVE,), "signs-of-H", blocks="-H_r, H_r[:, :2]"),
    _first("A from updated", (DIRECTIONS,), "from-updated", steps=FROM_UPDATED),
    _first("A to updated", (DIRECTIONS,), "to-updated", steps="updated[1:] - predicted[:-1]"),
    _first("A by updated", (DIRECTIONS,), "to-updated", steps="np.diff(updated, axis=0)"),
    _first("A's sign", (DIRECTIONS,), "signs-of-A", column="dy, -dx"),
    _first("A exchanged", (DIRECTIONS,), "signs-of-A", column="dx, dy"),
    _first("A one sign", (DIRECTIONS,), "signs-of-A", column="dy, dx"),
    _first("A = I", (DIRECTIONS,), "identity", column="0, 0"),
    _first("landmark first in H", BOTH_LAWS, blocks="-H_r[:, :2], H_r"),
    _first("H of zeros", BOTH_LAWS, blocks="0 * H_r, 0 * H_r[:, :2]"),
    _first("one A too many", BOTH_LAWS, result="np.concatenate([A, A[:1]]), H", **SHAPE),
    _first("robot only", BOTH_LAWS, blocks="H_r", **SHAPE),
    _first("H missing", BOTH_LAWS, result="A", **SHAPE),
]

# ---- right, written otherwise ---------------------------------------------------------------

_RHO_LOOPS = """
def correlation(P):
    n = len(P)
    rho = [[0.0] * n for _ in range(n)]
    for i in range(n):
        for j in range(n):
            if P[i, i] > 0 and P[j, j] > 0:
                rho[i][j] = P[i, j] / (P[i, i] * P[j, j]) ** 0.5
    return rho
"""
_RHO_DIAGONAL = """
def correlation(P):
    s = np.sqrt(np.diag(P))
    s[s == 0] = 1
    P /= s
    P /= s[:, None]
    np.fill_diagonal(P, 1)
    return P
"""
_INFORMATION = """
def two_updates(P, H_1, H_2, R):
    I = np.linalg.inv(P)
    W = np.linalg.inv(R)
    first = I + H_1.T @ W @ H_1
    return np.linalg.inv(first), np.linalg.inv(first + H_2.T @ W @ H_2)
"""
_SEQUENTIAL = """
def two_updates(P, H_1, H_2, R):
    L = np.linalg.cholesky(R)
    out = []
    for H in (H_1, H_2):
        for row in np.linalg.solve(L, H):
            PH = P @ row
            P -= np.outer(PH, PH) / (row @ PH + 1)
        out.append(P.copy())
    return out
"""
_BLOCKWISE = """
def two_updates(P, H_1, H_2, R):
    P = [[P[a, b] for b in SLICES] for a in SLICES]
    first = seen(P, H_1[:, :3], H_1[:, 3:5], 1, R)
    both = seen(first, H_2[:, :3], H_2[:, 5:], 2, R)
    return np.block(first), np.block(both)

SLICES = slice(0, 3), slice(3, 5), slice(5, 7)

def seen(P, H_r, H_p, k, R):
    S = H_r @ P[0][0] @ H_r.T + H_r @ P[0][k] @ H_p.T + H_p @ P[k][0] @ H_r.T
    S = S + H_p @ P[k][k] @ H_p.T + R
    W = [(P[i][0] @ H_r.T + P[i][k] @ H_p.T) @ np.linalg.inv(S) for i in range(3)]
    return [[P[i][j] - W[i] @ S @ W[j].T for j in range(3)] for i in range(3)]
"""
_RELATIVE_D = """
def relative(x, P, i, j):
    D = np.zeros((2, len(x)))
    for k in range(2):
        D[k, 3 + 2 * i + k], D[k, 3 + 2 * j + k] = -1, 1
    return (D @ x).tolist(), D @ P @ D.T
"""
_RELATIVE_RESHAPED = """
def relative(x, P, i, j):
    p = x[3:].reshape(-1, 2)
    M = P[3:, 3:].reshape(len(p), 2, len(p), 2).transpose(0, 2, 1, 3)
    return [p[j] - p[i], M[i, i] + M[j, j] - M[i, j] - M[j, i]]
"""
_RELATIVE_IN_PLACE = """
def relative(x, P, i, j):
    P[3 + 2 * j : 5 + 2 * j] -= P[3 + 2 * i : 5 + 2 * i]
    P[:, 3 + 2 * j : 5 + 2 * j] -= P[:, 3 + 2 * i : 5 + 2 * i]
    x[3 + 2 * j : 5 + 2 * j] -= x[3 + 2 * i : 5 + 2 * i]
    return x[3 + 2 * j : 5 + 2 * j], P[3 + 2 * j : 5 + 2 * j, 3 + 2 * j : 5 + 2 * j]
"""
_GLS = """
def fuse(a, P_a, b, P_b, P_ab):
    J = np.vstack([np.eye(2), np.eye(2)])
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    P = np.linalg.inv(J.T @ W @ J)
    return P @ J.T @ W @ np.concatenate([a, b]), P
"""
_FROM_B = """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = np.linalg.solve(S.T, (P_b - P_ab.T).T).T
    b += K @ (a - b)
    return [b.tolist(), (P_b - K @ (P_b - P_ab)).tolist()]
"""
_FUSE_MIXED = """
def fuse(a, P_a, b, P_b, P_ab):
    K = np.linalg.lstsq(P_a + P_b - P_ab - P_ab.T, P_a - P_ab.T, rcond=None)[0].T
    L = np.eye(2) - K
    P = L @ P_a @ L.T + K @ P_b @ K.T + L @ P_ab @ K.T + K @ P_ab.T @ L.T
    return L @ a + K @ b, P
"""
_STEP_JOSEPH = """
def step(x, P, d, q, i, z, r):
    P[0, 0] += q
    x[0] += d
    H = np.zeros((1, len(x)))
    H[0, 0], H[0, i] = -1, 1
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + r)
    L = np.eye(len(x)) - K @ H
    return x + (K * (z - x[i] + x[0])).ravel(), L @ P @ L.T + K * r @ K.T
"""
_STEP_ENTRIES = """
def step(x, P, d, q, i, z, r):
    n = len(x)
    x, P = list(x), [list(row) for row in P]
    x[0], P[0][0] = x[0] + d, P[0][0] + q
    c = [P[k][i] - P[k][0] for k in range(n)]
    S = c[i] - c[0] + r
    v = z - (x[i] - x[0])
    x = [x[k] + c[k] * v / S for k in range(n)]
    return x, [[P[k][l] - c[k] * c[l] / S for l in range(n)] for k in range(n)]
"""
_STEP_AFQ = """
def step(x, P, d, q, i, z, r):
    A, Q, u = np.eye(len(x)), np.zeros_like(P), np.zeros_like(x)
    Q[0, 0], u[0] = q, d
    x, P = A @ x + u, A @ P @ A.T + Q
    H = np.eye(len(x))[i] - np.eye(len(x))[0]
    S = float(H @ P @ H) + r
    return [x + P @ H * (z - H @ x) / S, P - np.outer(P @ H, H @ P) / S]
"""
_FIRST_LOOPS = """
def first_estimates(predicted, updated, landmarks):
    A, H = [], []
    for k, (x, y, theta) in enumerate(predicted):
        px, py = landmarks[0]
        dx, dy = px - x, py - y
        q = dx**2 + dy**2
        r = q**0.5
        H.append([[-dx / r, -dy / r, 0, dx / r, dy / r], [dy / q, -dx / q, -1, -dy / q, dx / q]])
        if k:
            A.append([[1, 0, predicted[k - 1][1] - y], [0, 1, x - predicted[k - 1][0]], [0, 0, 1]])
    return A, H
"""
_FIRST_IMPORTED = """
def first_estimates(predicted, updated, landmarks):
    from slamlab.models.jacobians import H_landmark
    updated[:] = predicted
    landmarks[:] = landmarks[0].copy()
    H = np.zeros((len(predicted), 2, 5))
    for k, (x, p) in enumerate(zip(predicted, landmarks)):
        H[k, :, :3], H[k, :, 3:] = H_robot(x, p), H_landmark(x, p)
    A = np.zeros((len(predicted) - 1, 3, 3)) + np.eye(3)
    A[:, 0, 2] = updated[:-1, 1] - updated[1:, 1]
    A[:, 1, 2] = updated[1:, 0] - updated[:-1, 0]
    return A, H
"""
_FIRST_DIFFERENCES = """
def first_estimates(predicted, updated, landmarks):
    from slamlab.models import h
    def f(s):
        return h(s[:3], s[3:])
    H = []
    for x in predicted:
        s = np.concatenate([x, landmarks[0]])
        H.append(np.transpose([(f(s + e) - f(s - e)) / 2e-6 for e in 1e-6 * np.eye(5)]))
    A = [np.eye(3) for _ in predicted[1:]]
    for k, one in enumerate(A):
        dx, dy, _ = predicted[k + 1] - predicted[k]
        one[:2, 2] = -dy, dx
    return [np.array(A), np.array(H)]
"""

WRONG = IN_RHO + IN_UPDATES + IN_RELATIVE + IN_FUSE + IN_STEP + IN_FIRST
RIGHT = [
    Right("rho by loops, as lists", _RHO_LOOPS),
    Right("rho in place, 1 on all of the diagonal", _RHO_DIAGONAL),
    Right("rho divided, then zeroed", rho()),
    Right("rho with a small number below", rho(rho="P / (np.outer(s, s) + 1e-7)", then="pass")),
    Right("rho by diagonal matrices", rho(rho="np.diag(1 / s) @ P @ np.diag(1 / s)")),
    Right("updates in information form", _INFORMATION),
    Right("updates one number after the other, in place", _SEQUENTIAL),
    Right("updates block by block", _BLOCKWISE),
    Right(
        "updates in Joseph's form",
        updates(
            K="np.linalg.solve(S.T, H @ P).T",
            P="(np.eye(7) - K @ H) @ P @ (np.eye(7) - K @ H).T + K @ R @ K.T",
        ),
    ),
    Right("updates, short", updates(P="(np.eye(7) - K @ H) @ P")),
    Right("relative by a matrix", _RELATIVE_D),
    Right("relative by blocks of blocks", _RELATIVE_RESHAPED),
    Right("relative in place", _RELATIVE_IN_PLACE),
    Right("fuse by least squares", _GLS),
    Right("fuse from b", _FROM_B),
    Right("fuse with mixed terms", _FUSE_MIXED),
    Right("corridor in Joseph's form, in place", _STEP_JOSEPH),
    Right("corridor entry by entry", _STEP_ENTRIES),
    Right("corridor with A and Q", _STEP_AFQ),
    Right("first estimates by loops", _FIRST_LOOPS),
    Right("first estimates, history overwritten", _FIRST_IMPORTED),
    Right("first estimates by differences of h", _FIRST_DIFFERENCES),
]
