"""Programs of task 11-proposal."""

from course.tasks import Slip, Stumble

TASK = "11-proposal"

WAYS = {
    "all at once": """
def reweigh(before, after, weights, u, C, m, D):
    step = after - before
    heading = np.stack([np.cos(before[:, 2]), np.sin(before[:, 2])], axis=1)
    e = np.stack([np.sum(step[:, :2] * heading, axis=1), wrap(step[:, 2])], axis=1)
    p = -0.5 * np.einsum("na,ab,nb->n", e - u, np.linalg.inv(C), e - u)
    q = -0.5 * np.einsum("na,nab,nb->n", e - m, np.linalg.inv(D), e - m)
    logs = p - q + np.linalg.slogdet(D)[1] / 2 + np.log(weights)
    w = np.exp(logs - logs.max())
    return w / w.sum()
""",
    "two densities written out": """
def reweigh(before, after, weights, u, C, m, D):
    def log_density(e, mean, P):
        v = e - mean
        v[1] = wrap(v[1])
        return -v @ np.linalg.solve(P, v) / 2 - np.log(2 * np.pi * np.sqrt(np.linalg.det(P)))

    logs = []
    for a, b, w, mean, P in zip(before, after, weights, m, D):
        c, s = np.cos(a[2]), np.sin(a[2])
        x, y = np.array([[c, s], [-s, c]]) @ (b - a)[:2]
        e = np.array([x, wrap(b[2] - a[2])])
        logs.append(np.log(w) + log_density(e, u, C) - log_density(e, mean, P))
    return list(normalise(np.array(logs)))
""",
    "whitened by roots": """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    length = np.hypot(step[:, 0], step[:, 1])
    d = length * np.cos(np.arctan2(step[:, 1], step[:, 0]) - theta)
    e = np.column_stack([d, (step[:, 2] + np.pi) % (2 * np.pi) - np.pi])
    L, K = np.linalg.cholesky(C), np.linalg.cholesky(D)
    p = np.linalg.solve(L, (e - u).T)
    q = np.linalg.solve(K, (e - m)[:, :, None])[:, :, 0]
    logs = (q**2).sum(axis=1) / 2 - (p**2).sum(axis=0) / 2
    logs += np.log(weights * K[:, 0, 0] * K[:, 1, 1])
    return np.exp(logs - np.logaddexp.reduce(logs))
""",
    "by the odometry's inverse, sample by sample": """
def reweigh(before, after, weights, u, C, m, D):
    n = len(weights)
    logs = np.zeros(n)
    for k in range(n):
        (x0, y0, t0), (x1, y1, t1) = before[k], after[k]
        turn = np.arctan2(np.sin(t1 - t0), np.cos(t1 - t0))
        e = np.array([(x1 - x0) * np.cos(t0) + (y1 - y0) * np.sin(t0), turn])
        for sign, mean, P in ((1, u, C), (-1, m[k], D[k])):
            (a, b), (_, c) = P
            det = a * c - b * b
            v, w = e - mean
            logs[k] -= sign * ((c * v * v - 2 * b * v * w + a * w * w) / det + np.log(det)) / 2
    shifted = logs - np.max(logs)
    return weights * np.exp(shifted) / np.dot(weights, np.exp(shifted))
""",
}

ALONG = "step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)"
TURN = "wrap(step[:, 2])"
LOGS = "np.log(weights)"
DIFFERENCE = "w @ np.linalg.inv(D[k]) @ w - v @ np.linalg.inv(C) @ v"
DET = "        logs[k] += 0.5 * np.log(np.linalg.det(D[k]))\n"
PAIR = "e[k] - u, e[k] - m[k]"

SLIPS = (
    Slip(
        "p-alone",
        "You multiply by the density of the wheels alone. Where the drawing wanted a sample there are "
        "many already; that is what the density of the drawing takes out.",
        [("w @ np.linalg.inv(D[k]) @ w - ", "-"), (DET, "")],
    ),
    Slip(
        "q-alone",
        "You divide by the density of the drawing alone: what the wheels find likely is missing.",
        (" - v @ np.linalg.inv(C) @ v", ""),
    ),
    Slip(
        "turned-over",
        "The two densities have changed places: what was drawn too often gains, and should lose.",
        [
            (DIFFERENCE, "v @ np.linalg.inv(C) @ v - w @ np.linalg.inv(D[k]) @ w"),
            ("] += 0.5 * np.log", "] -= 0.5 * np.log"),
        ],
        (PAIR, "e[k] - m[k], e[k] - u"),
    ),
    Slip(
        "multiplied",
        "You multiply by the density of the drawing. A sample that was drawn too often should count for less: divide.",
        [
            ("w @ np.linalg.inv(D[k]) @ w - ", "-w @ np.linalg.inv(D[k]) @ w - "),
            ("] += 0.5 * np.log", "] -= 0.5 * np.log"),
        ],
    ),
    Slip(
        "height-forgotten",
        "The factor before the exponential is missing. It is the same for all samples only where all "
        "have one covariance: a narrow hill is higher.",
        (DET, ""),
    ),
    Slip(
        "height-turned",
        "The factor before the exponential stands on the wrong side: a narrow hill is higher, and so "
        "its samples count for less.",
        ("] += 0.5 * np.log", "] -= 0.5 * np.log"),
    ),
    Slip(
        "height-squared",
        "The factor before the exponential has the root of the determinant.",
        ("0.5 * np.log(np.linalg.det(D[k]))", "np.log(np.linalg.det(D[k]))"),
    ),
    Slip(
        "height-of-a-number",
        "The factor before the exponential is that of a single number. e has two entries that err "
        "together: the determinant holds both, and what they share.",
        ("np.log(np.linalg.det(D[k]))", "np.log(np.prod(np.diag(D[k])))"),
        ("np.log(np.linalg.det(D[k]))", "np.log(D[k][0, 0])"),
        ("np.log(np.linalg.det(D[k]))", "np.log(np.trace(D[k]))"),
    ),
    Slip(
        "half-forgotten",
        "The factor ½ in the exponents is missing.",
        (f"0.5 * ({DIFFERENCE})", DIFFERENCE),
    ),
    Slip(
        "one-covariance",
        "Both densities have the same covariance in yours: the wheels have C, each drawing its own.",
        ("inv(C)", "inv(D[k])"),
        [("inv(D[k])", "inv(C)"), (DET, "")],
        [("inv(D[k])", "inv(D[0])"), (DET, "")],
    ),
    Slip(
        "one-mean",
        "The drawing has means of its own: you took both densities round the same drive.",
        (PAIR, "e[k] - u, e[k] - u"),
        (PAIR, "e[k] - m[k], e[k] - m[k]"),
        (PAIR, "e[k] - u, e[k] - m[0]"),
        (PAIR, "e[k] - u, e[k] - m.mean(axis=0)"),
    ),
    Slip(
        "density-at-the-mean",
        "You ask how likely the mean of the drawing is. What counts is the drive that the sample made.",
        (PAIR, "m[k] - u, e[k] - m[k]"),
        (PAIR, "m[k] - u, 0 * m[k]"),
        [
            (PAIR, "m[k] - u, 0 * m[k]"),
            ("inv(C)", "inv(C + D[k])"),
            (DET, DET.replace("+=", "-=").replace("D[k]", "C + D[k]")),
        ],
    ),
    Slip(
        "not-inverted",
        "A covariance stands where its inverse belongs.",
        [("inv(D[k])", "inv(np.linalg.inv(D[k]))"), ("inv(C)", "inv(np.linalg.inv(C))")],
        ("np.linalg.inv(D[k])", "D[k]"),
        ("np.linalg.inv(C)", "C"),
    ),
    Slip(
        "correlation-forgotten",
        "Distance and turn may err together: the covariances count as whole matrices.",
        [("inv(D[k])", "inv(np.diag(np.diag(D[k])))"), ("inv(C)", "inv(np.diag(np.diag(C)))")],
        ("inv(C)", "inv(np.diag(np.diag(C)))"),
        ("inv(D[k])", "inv(np.diag(np.diag(D[k])))"),
    ),
    Slip(
        "unwrapped",
        "The difference of two headings leaves (−π, π]: from 179° to −179° it is a turn of 2°.",
        (TURN, "step[:, 2]"),
        (TURN, "wrap(after[:, 2]) - wrap(before[:, 2])"),
    ),
    Slip(
        "from-zero",
        "The difference of two headings lies in [0, 2π): a small turn to the right becomes almost a "
        "full one.",
        (TURN, "step[:, 2] % (2 * np.pi)"),
    ),
    Slip(
        "length-for-distance",
        "The length of the way has no sign, and a robot may drive backwards: how far did it go along "
        "its heading?",
        (ALONG, "np.hypot(step[:, 0], step[:, 1])"),
    ),
    Slip(
        "new-heading",
        "The distance is taken along the heading after the turn. It drove along the old one.",
        ("before[:, 2]", "after[:, 2]"),
        ("before[:, 2]", "(before[:, 2] + after[:, 2]) / 2"),
    ),
    Slip(
        "x-alone",
        "The distance is the way in x only. A robot that looks to the north drives in y.",
        (ALONG, "step[:, 0]"),
    ),
    Slip(
        "sine-and-cosine",
        "Sine and cosine are swapped: along the heading θ the way is (cos θ, sin θ).",
        (ALONG, "step[:, 0] * np.sin(theta) + step[:, 1] * np.cos(theta)"),
        (ALONG, "step[:, 0] * np.cos(theta) - step[:, 1] * np.sin(theta)"),
    ),
    Slip(
        "backwards",
        "Before and after have changed places.",
        ("after - before", "before - after"),
    ),
    Slip(
        "old-weights-forgotten",
        "The weights that were given are lost: they hold what was seen.",
        (LOGS, "np.zeros(len(weights))"),
    ),
    Slip(
        "old-weights-not-logarithms",
        "Weights and logarithms are added up: logarithms of all of them add up.",
        (LOGS, "weights.copy()"),
    ),
    Slip(
        "not-normalised",
        "The weights do not sum to one.",
        ("normalise(logs)", "np.exp(logs)"),
        ("normalise(logs)", "np.exp(logs - np.max(logs))"),
    ),
    Slip(
        "logarithms",
        "These are logarithms. What is wanted are weights that sum to one.",
        ("normalise(logs)", "logs"),
        ("normalise(logs)", "logs / np.sum(logs)"),
    ),
    Slip(
        "underflow",
        "Densities are computed, and all of them are zero where samples lie many σ off. Only their "
        "logarithms can be held.",
        ("normalise(logs)", "np.exp(logs) / (np.sum(np.exp(logs)) + 1e-300)"),
        (
            "normalise(logs)",
            "np.exp(np.maximum(logs, -700)) / np.sum(np.exp(np.maximum(logs, -700)))",
        ),
    ),
    Slip(
        "degrees",
        "The turn is in degrees, while the covariances count in radians.",
        (TURN, "np.degrees(wrap(step[:, 2]))"),
    ),
    Slip(
        "poses-compared",
        "You compare poses in x, y and θ. It is the drive that was drawn: d and Δθ.",
        """
def reweigh(before, after, weights, u, C, m, D):
    wheels = np.array([f_odometry(x, u) for x in before])
    wanted = np.array([f_odometry(x, e) for x, e in zip(before, m)])
    v, w = after - wheels, after - wanted
    v[:, 2], w[:, 2] = wrap(v[:, 2]), wrap(w[:, 2])
    v, w = v[:, [0, 2]], w[:, [0, 2]]
    logs = np.log(weights) - 0.5 * np.einsum("na,ab,nb->n", v, np.linalg.inv(C), v)
    logs += 0.5 * np.einsum("na,nab,nb->n", w, np.linalg.inv(D), w)
    return normalise(logs + 0.5 * np.log(np.linalg.det(D)))
""",
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("normalise(logs)", "normalise(logs).sum()"),
        ("normalise(logs)", "logs[:, None]"),
    ),
    Stumble("malformed", ("    return normalise", "    normalise")),
    Stumble("malformed", (LOGS, "np.log(-weights)")),
    Stumble("raised", (DIFFERENCE, "w @ np.linalg.inv(D) @ w - v @ C @ v")),
)

HEAD = "def reweigh(before, after, weights, u, C, m, D):\n"
PASTED = {
    "task 1 with drives for sightings": HEAD
    + """
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    v = np.column_stack([d, wrap(step[:, 2])]) - u
    return normalise(np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1))
""",
    "the lesson's normalise": HEAD + "    return normalise(np.log(weights))\n",
    "the thesis' weight": HEAD
    + """
    off = after - np.array([f_odometry(x, u) for x in before])
    off[:, 2] = wrap(off[:, 2])
    logs = np.log(weights) - 0.5 * np.sum(off[:, [0, 2]] @ np.linalg.inv(C) * off[:, [0, 2]], axis=1)
    return normalise(logs)
""",
}
