"""Solutions of exercise 11 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

MOVE = """
def move(rows, u, C, rng):
    n = len(rows)
    x, y, theta = rows.T
    d, turn = {noise}
    return {result}
"""


def move(**changes):
    parts = {
        "noise": "rng.multivariate_normal(u, C, n).T",
        "result": "np.column_stack([x + d * np.cos(theta), y + d * np.sin(theta), theta + turn])",
    }
    return MOVE.format(**(parts | changes))


def drive_by(heading):
    """The samples drive along another heading."""
    return (
        f"np.column_stack([x + d * np.cos({heading}), y + d * np.sin({heading}), "
        "wrap(theta + turn)])"
    )


WEIGH = """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    R_inv = {R_inv}
    for place, seen in zip(p, z):
        v = {v}
        {wrap}
        {add}
    return {result}
"""


def weigh(**changes):
    parts = {
        "R_inv": "np.linalg.inv(R)",
        "v": "seen - h(rows, place)",
        "wrap": "v[:, 1] = wrap(v[:, 1])",
        "add": "logs += -0.5 * np.sum(v @ R_inv * v, axis=1)",
        "result": "logs",
    }
    return WEIGH.format(**(parts | changes))


def normalise(weights):
    return f"""
def normalise(logs):
    return {weights}
"""


def size(formula):
    return f"""
def effective_size(weights):
    return {formula}
"""


DRAW = """
def draw(weights, rng):
    n = len(weights)
    teeth = {teeth}
    return {result}
"""


def draw(**changes):
    parts = {
        "teeth": "(rng.random() + np.arange(n)) / n",
        "result": "np.minimum(np.searchsorted(np.cumsum(weights), teeth), n - 1)",
    }
    return DRAW.format(**(parts | changes))


LOCALISE = """
def localise(rows, weights, u, C, p, z, R, rng):
    n, before = len(rows), rows
    {move}
    logs = {logs}
    weights = {weights}
    if {when}:
        {draw}
    return {result}
"""


def localise(**changes):
    parts = {
        "move": "rows = move(rows, u, C, rng)",
        "logs": "np.log(weights) + log_likelihoods(rows, p, z, R)",
        "weights": "normalise(logs)",
        "when": "effective_size(weights) < n / 2",
        "draw": "rows, weights = rows[draw(weights, rng)], np.full(n, 1 / n)",
        "result": "rows, weights",
    }
    return LOCALISE.format(**(parts | changes))


MOTION = (
    "np.log(weights) + log_likelihoods(rows, p, z, R) - 0.5 * np.einsum('na,ab,nb->n', "
    "*(lambda e: (e, np.linalg.inv(C), e))(np.column_stack(["
    "np.sum((rows - before)[:, :2] * np.column_stack([np.cos(before[:, 2]), "
    "np.sin(before[:, 2])]), axis=1), wrap(rows[:, 2] - before[:, 2])]) - u))"
)

STATISTICS = {"11-localise:mean", "11-localise:spread"}

WRONG = [
    # move
    Wrong("samples stay", move(result="rows"), {"average", "spread", "seed"}, "not-moved"),
    Wrong("noise forgotten", move(noise="u"), {"spread", "seed"}, "noise-forgotten"),
    Wrong(
        "the same noise for all",
        move(noise="rng.multivariate_normal(u, C)"),
        {"spread"},
        "one-draw-for-all",
        may_lose={"11-move:average"},
    ),
    Wrong(
        "a generator of its own",
        move(noise="np.random.default_rng().multivariate_normal(u, C, n).T"),
        {"seed"},
        "another-generator",
    ),
    Wrong(
        "the same seed always",
        move(noise="np.random.default_rng(0).multivariate_normal(u, C, n).T"),
        {"seed"},
        "always-the-same",
    ),
    Wrong(
        "one heading for all",
        move(result=drive_by("theta.mean()")),
        {"heading", "average", "spread"},
        "one-heading",
    ),
    Wrong(
        "the first sample's heading",
        move(result=drive_by("rows[0, 2]")),
        {"heading", "average", "spread"},
        "one-heading",
    ),
    Wrong(
        "turn, then drive",
        move(result=drive_by("(theta + turn)")),
        {"heading", "average", "spread"},
        "turned-first",
    ),
    Wrong(
        "an arc",
        move(result=drive_by("(theta + turn / 2)")),
        {"heading", "average"},
        "arc",
        may_lose={"11-move:spread"},
    ),
    Wrong(
        "noise on the pose",
        """
def move(rows, u, C, rng):
    moved = np.array([f_odometry(x, u) for x in rows])
    return moved + rng.normal(0, [0.05, 0.05, 0.03], moved.shape)
""",
        {"heading", "spread"},
        "noise-on-the-pose",
    ),
    Wrong(
        "correlation forgotten",
        move(noise="rng.normal(u, np.sqrt(np.diag(C)), (n, 2)).T"),
        {"spread"},
        "correlation-forgotten",
    ),
    Wrong(
        "variances as deviations",
        move(noise="rng.normal(u, np.diag(C), (n, 2)).T"),
        {"spread"},
        "standard-deviation",
    ),
    Wrong(
        "deviations as variances",
        move(noise="rng.multivariate_normal(u, np.diag(np.sqrt(np.diag(C))), n).T"),
        {"spread"},
        "root-taken-twice",
        may_lose={"11-move:average"},
    ),
    Wrong(
        "C for its root",
        move(noise="u[:, None] + C @ rng.standard_normal((2, n))"),
        {"spread"},
        "C-as-root",
    ),
    Wrong(
        "uniform noise of that deviation's width",
        move(noise="rng.uniform(u - np.sqrt(np.diag(C)), u + np.sqrt(np.diag(C)), (n, 2)).T"),
        {"spread"},
    ),
    Wrong("samples in columns", move(result="rows.T"), {"11-move"}, problem="malformed"),
    Wrong(
        "turn forgotten",
        move(result="np.column_stack([x + d * np.cos(theta), y + d * np.sin(theta), theta])"),
        {"average", "spread"},
        "turn-forgotten",
    ),
    Wrong(
        "sine and cosine",
        move(result=drive_by("(np.pi / 2 - theta)")),
        {"heading", "average", "spread"},
        "sine-and-cosine",
    ),
    Wrong(
        "backwards", move(result=drive_by("(theta + np.pi)")), {"average", "spread"}, "backwards"
    ),
    Wrong(
        "noise alone",
        move(noise="rng.multivariate_normal([0, 0], C, n).T"),
        {"average"},
        "noise-alone",
    ),
    # weigh
    Wrong("not wrapped", weigh(wrap="pass"), {"behind"}, "unwrapped"),
    Wrong(
        "z and h wrapped one by one",
        weigh(v="np.array([seen[0], wrap(seen[1])]) - h(rows, place)", wrap="pass"),
        {"behind"},
        "unwrapped",
    ),
    Wrong(
        "bearing from 0 to 2π",
        weigh(wrap="v[:, 1] %= 2 * np.pi"),
        {"near", "behind"},
        "from-zero",
    ),
    Wrong("sign", weigh(add="logs += 0.5 * np.sum(v @ R_inv * v, 1)"), {"near", "behind"}, "sign"),
    Wrong(
        "half forgotten",
        weigh(add="logs -= np.sum(v @ R_inv * v, axis=1)"),
        {"near", "behind"},
        "half-forgotten",
    ),
    Wrong(
        "R for its inverse",
        weigh(R_inv="R"),
        {"near", "behind", "far"},
        "R-not-inverted",
        may_lose={"11-weigh:far"},
    ),
    Wrong(
        "R squared",
        weigh(R_inv="np.diag(1 / np.diag(R) ** 2)"),
        {"near", "behind"},
        "standard-deviation",
    ),
    Wrong(
        "root of R",
        weigh(R_inv="np.diag(1 / np.sqrt(np.diag(R)))"),
        {"near", "behind"},
        "standard-deviation",
    ),
    Wrong(
        "R's diagonal only",
        weigh(R_inv="np.diag(1 / np.diag(R))"),
        {"near", "behind"},
        "correlation-forgotten",
    ),
    Wrong(
        "degrees",
        weigh(wrap="v[:, 1] = np.degrees(wrap(v[:, 1]))"),
        {"near", "behind"},
        "degrees",
    ),
    Wrong(
        "mean over landmarks",
        weigh(result="logs / len(p)"),
        {"near", "behind"},
        "mean-over-landmarks",
    ),
    Wrong(
        "return inside the loop",
        weigh(add="return -0.5 * np.sum(v @ R_inv * v, axis=1)"),
        {"near", "behind"},
        "one-landmark",
    ),
    Wrong(
        "started anew inside the loop",
        weigh(add="logs = -0.5 * np.sum(v @ R_inv * v, axis=1)"),
        {"near", "behind"},
        "one-landmark",
    ),
    Wrong(
        "likelihood, then logarithm",
        weigh(
            R_inv="np.linalg.inv(R); logs = np.ones(len(rows))",
            add="logs *= np.exp(-0.5 * np.sum(v @ R_inv * v, axis=1))",
            result="np.log(logs)",
        ),
        {"far"},
        "underflow",
    ),
    Wrong(
        "likelihoods",
        weigh(result="np.exp(logs)"),
        {"near", "behind", "far"},
        "no-logarithm",
    ),
    Wrong(
        "likelihoods summed",
        weigh(
            add="logs += np.exp(-0.5 * np.sum(v @ R_inv * v, axis=1))",
            result="np.log(logs)",
        ),
        {"near", "behind"},
        "likelihoods-summed",
        may_lose={"11-weigh:far"},
    ),
    Wrong(
        "worst sighting only",
        weigh(add="logs = np.minimum(logs, -0.5 * np.sum(v @ R_inv * v, axis=1))"),
        {"near", "behind"},
        "largest-only",
    ),
    Wrong(
        "range only",
        weigh(add="logs -= 0.5 * v[:, 0] ** 2 / R[0, 0]"),
        {"near", "behind"},
        "one-of-two",
    ),
    Wrong(
        "one pose for all",
        weigh(v="(seen - h(rows[0], place)) * np.ones((len(rows), 2))"),
        {"near", "behind", "far"},
        "all-alike",
    ),
    Wrong("one number", weigh(result="logs.sum()"), {"11-weigh"}, problem="malformed"),
    # normalise
    Wrong("NaN", normalise("np.log(-np.exp(logs))"), {"sum", "ratios", "any-size"}, "no-numbers"),
    Wrong(
        "as it stands", normalise("np.exp(logs) / np.sum(np.exp(logs))"), {"any-size"}, "underflow"
    ),
    Wrong(
        "patched by a small number",
        normalise("np.exp(logs) / (np.sum(np.exp(logs)) + 1e-300)"),
        {"any-size"},
        "underflow",
    ),
    Wrong(
        "patched by equal weights",
        """
def normalise(logs):
    weights = np.exp(np.minimum(logs, 700))
    if weights.sum() == 0:
        return np.full(len(logs), 1 / len(logs))
    return weights / weights.sum()
""",
        {"any-size"},
        "underflow-patched",
    ),
    Wrong(
        "the smallest taken off",
        normalise("(lambda w: w / w.sum())(np.exp(logs - logs.min()))"),
        {"any-size"},
        "overflow",
    ),
    Wrong(
        "by the largest weight",
        normalise("np.exp(logs - logs.max())"),
        {"sum", "any-size"},
        "over-the-largest",
    ),
    Wrong("not divided", normalise("np.exp(logs)"), {"sum", "any-size"}, "not-normalised"),
    Wrong(
        "length one",
        normalise("(lambda w: w / np.linalg.norm(w))(np.exp(logs - logs.max()))"),
        {"sum", "any-size"},
        "length-one",
    ),
    Wrong(
        "logarithms divided", normalise("logs / logs.sum()"), {"ratios", "any-size"}, "logs-divided"
    ),
    Wrong("n_eff inverted", size("np.sum(weights**2)"), {"effective"}, "inverted"),
    Wrong("sum squared", size("1 / np.sum(weights) ** 2"), {"effective"}, "squared-sum"),
    Wrong("weights counted", size("np.count_nonzero(weights)"), {"effective"}, "counted"),
    Wrong("number of samples", size("len(weights)"), {"effective"}, "counted"),
    Wrong(
        "1 over the largest", size("1 / np.max(weights)"), {"effective"}, "over-the-largest-weight"
    ),
    Wrong("as a share", size("1 / np.sum(weights**2) / len(weights)"), {"effective"}, "share"),
    Wrong("length inverted", size("1 / np.linalg.norm(weights)"), {"effective"}, "root"),
    Wrong("n_eff as an array", size("1 / weights**2"), {"11-normalise"}, problem="malformed"),
    # draw
    Wrong(
        "largest weight",
        draw(result="np.full(n, np.argmax(weights))"),
        {"share", "fair", "seed"},
        "largest-weight",
    ),
    Wrong(
        "one draw for all",
        draw(result="np.full(n, rng.choice(n, p=weights))"),
        {"share"},
        "one-draw",
        may_lose={"11-draw:fair"},
    ),
    Wrong(
        "weights forgotten",
        draw(result="rng.integers(n, size=n)"),
        {"share", "fair"},
        "without-weights",
    ),
    Wrong("all once", draw(result="np.arange(n)"), {"share", "fair", "seed"}, "without-weights"),
    Wrong(
        "independent draws",
        draw(teeth="np.sort(rng.random(n))"),
        {"share"},
        "independent",
        may_lose={"11-draw:fair"},
    ),
    Wrong(
        "choice",
        draw(result="rng.choice(n, n, p=weights)"),
        {"share"},
        "independent",
        may_lose={"11-draw:fair"},
    ),
    Wrong(
        "stratified",
        draw(teeth="(rng.random(n) + np.arange(n)) / n"),
        {"share"},
        "stratified",
        may_lose={"11-draw:fair"},
    ),
    Wrong(
        "no random number",
        draw(teeth="(0.5 + np.arange(n)) / n"),
        {"fair", "seed"},
        "no-random-number",
    ),
    Wrong(
        "a generator of its own for the draw",
        draw(teeth="(np.random.default_rng().random() + np.arange(n)) / n"),
        {"seed"},
        "another-generator",
    ),
    Wrong(
        "shift not divided by n",
        draw(teeth="rng.random() + np.arange(n) / n"),
        {"share", "fair"},
        "shifted",
    ),
    Wrong(
        "teeth from 1 to n",
        draw(teeth="(rng.random() + np.arange(1, n + 1)) / n"),
        {"share", "fair"},
        "shifted",
    ),
    Wrong(
        "logarithms of the comb's places", draw(result="teeth"), {"11-draw"}, problem="malformed"
    ),
    Wrong(
        "too few drawn",
        draw(result="np.unique(np.searchsorted(np.cumsum(weights), teeth))[:2]"),
        {"11-draw"},
        problem="malformed",
    ),
    Wrong(
        "the rest drawn independently",
        """
def draw(weights, rng):
    n = len(weights)
    whole = np.floor(n * weights).astype(int)
    rest = n * weights - whole
    others = rng.choice(n, n - whole.sum(), p=rest / rest.sum())
    return np.concatenate([np.repeat(np.arange(n), whole), others])
""",
        {"share"},
        "stratified",
        may_lose={"11-draw:fair"},
    ),
    # localise
    Wrong(
        "weighed before moving",
        localise(
            move="logs = np.log(weights) + log_likelihoods(rows, p, z, R)",
            logs="logs; rows = move(rows, u, C, rng)",
        ),
        {"mean", "weights"},
        "weighed-before-moving",
        may_lose={"11-localise:spread"},
    ),
    Wrong(
        "motion in the weight",
        localise(logs=MOTION),
        {"weights"},
        "motion-in-the-weight",
        may_lose=STATISTICS,
    ),
    Wrong(
        "motion in the weight, drawn every time",
        localise(logs=MOTION, when="True"),
        {"spread"},
        "motion-in-the-weight",
        may_lose={"11-localise:mean"},
    ),
    Wrong(
        "weights of before forgotten",
        localise(logs="log_likelihoods(rows, p, z, R)"),
        {"weights"},
        "weights-forgotten",
        may_lose=STATISTICS,
    ),
    Wrong(
        "the scan twice",
        localise(logs="np.log(weights) + 2 * log_likelihoods(rows, p, z, R)"),
        {"weights"},
        "twice",
        may_lose=STATISTICS,
    ),
    Wrong(
        "weights kept after drawing",
        localise(draw="rows = rows[draw(weights, rng)]"),
        {"weights", "worth"},
        "weights-kept",
        may_lose=STATISTICS,
    ),
    Wrong("never drawn", localise(when="False"), {"worth"}, "never-drawn", may_lose=STATISTICS),
    Wrong(
        "drawn too late",
        localise(when="effective_size(weights) < n / 10"),
        {"worth"},
        "never-drawn",
        may_lose=STATISTICS,
    ),
    Wrong(
        "drawn when worth much",
        localise(when="effective_size(weights) > n / 2"),
        {"worth"},
        "never-drawn",
        may_lose=STATISTICS,
    ),
    Wrong(
        "equal weights without drawing",
        localise(draw="weights = np.full(n, 1 / n)", when="True"),
        {"mean", "spread"},
        "blind",
    ),
    Wrong("not moved", localise(move="pass"), {"mean", "spread"}, "not-moved"),
    Wrong(
        "localised by the largest weight",
        localise(draw="rows, weights = rows[[weights.argmax()] * n], np.full(n, 1 / n)"),
        {"mean", "spread"},
        "one-place",
        may_lose={"11-localise:mean"},
    ),
    Wrong(
        "weights not normalised",
        localise(
            weights="np.exp(logs - logs.max())", when="effective_size(normalise(logs)) < n / 2"
        ),
        {"weights"},
        "not-normalised",
        may_lose=STATISTICS,
    ),
    Wrong("rows only", localise(result="rows"), {"11-localise"}, problem="malformed"),
]

RIGHT = [
    Right(
        "move by a loop",
        """
def move(rows, u, C, rng):
    noise = rng.multivariate_normal([0, 0], C, size=len(rows))
    return np.array([f_odometry(x, u + e) for x, e in zip(rows, noise)])
""",
    ),
    Right(
        "move by a root of C, arguments overwritten",
        """
def move(rows, u, C, rng):
    L = np.linalg.cholesky(C)
    d, turn = u[:, None] + L @ rng.standard_normal((2, len(rows)))
    rows[:, 0] += d * np.cos(rows[:, 2])
    rows[:, 1] += d * np.sin(rows[:, 2])
    rows[:, 2] += turn
    return rows
""",
    ),
    Right(
        "one draw after the other",
        """
def move(rows, u, C, rng):
    return np.array([f_odometry(x, rng.multivariate_normal(u, C)) for x in rows])
""",
    ),
    Right(
        "weigh sample by sample",
        """
def log_likelihoods(rows, p, z, R):
    logs = []
    for x in rows:
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs.append(sum(-0.5 * e @ np.linalg.solve(R, e) for e in v))
    return logs
""",
    ),
    Right(
        "weigh all at once, with the constant",
        """
def log_likelihoods(rows, p, z, R):
    v = z - h(rows[:, None], p)
    v[..., 1] = np.arctan2(np.sin(v[..., 1]), np.cos(v[..., 1]))
    logs = -0.5 * np.einsum("nma,ab,nmb->n", v, np.linalg.inv(R), v)
    return logs - len(p) * np.log(2 * np.pi * np.sqrt(np.linalg.det(R)))
""",
    ),
    Right("weigh, h − z", weigh(v="h(rows, place) - seen")),
    Right("weigh, the largest taken off", weigh(result="logs - logs.max()")),
    Right(
        "log-sum-exp",
        """
def normalise(logs):
    top = max(logs)
    return np.exp(logs - (top + np.log(np.sum(np.exp(logs - top)))))
""",
    ),
    Right(
        "by logaddexp",
        normalise("np.exp(logs - np.logaddexp.reduce(logs))"),
    ),
    Right(
        "weights one by one",
        """
def normalise(logs):
    weights = [float(np.exp(l - max(logs))) for l in logs]
    return np.array([w / sum(weights) for w in weights])
""",
    ),
    Right("n_eff by a product", size("1.0 / (weights @ weights)")),
    Right("n_eff, not trusting the sum", size("weights.sum() ** 2 / np.sum(weights**2)")),
    Right(
        "comb by a loop",
        """
def draw(weights, rng):
    n = len(weights)
    u, i, end, drawn = rng.random() / n, 0, weights[0], []
    for k in range(n):
        while u + k / n > end and i < n - 1:
            i += 1
            end += weights[i]
        drawn.append(i)
    return drawn
""",
    ),
    Right(
        "comb, the last end set to one",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1
    return np.searchsorted(ends, rng.uniform(0, 1 / n) + np.linspace(0, 1, n, endpoint=False))
""",
    ),
    Right(
        "comb by counting copies, shuffled",
        """
def draw(weights, rng):
    n, u = len(weights), rng.random()
    ends = np.ceil(n * np.cumsum(weights) - u).astype(int)
    ends[-1] = n
    return rng.permutation(np.repeat(np.arange(n), np.diff(ends, prepend=0)))
""",
    ),
    Right(
        "comb from the right",
        draw(teeth="1 - (rng.random() + np.arange(n)) / n"),
    ),
    Right("always drawn", localise(when="True")),
    Right("drawn at half", localise(when="effective_size(weights) <= 0.5 * n")),
    Right(
        "weights multiplied",
        localise(
            logs="log_likelihoods(rows, p, z, R)",
            weights="(lambda w: w / w.sum())(weights * np.exp(logs - logs.max()))",
        ),
    ),
    Right("a list of two", localise(result="[rows, list(weights)]")),
    Right(
        "all in one, by tickets",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    logs = np.log(weights) + log_likelihoods(rows, p, z, R)
    weights = np.exp(logs - logs.max())
    weights /= weights.sum()
    if 1 / (weights @ weights) < len(rows) / 2:
        rows = rows[rng.choice(len(rows), len(rows), p=weights)]
        weights = np.ones(len(rows)) / len(rows)
    return rows, weights
""",
    ),
]
