"""Programs of task 11-kidnapped: some methods that find the robot, and some that do not."""

from course.tasks import Slip, Stumble

TASK = "11-kidnapped"
MUTANTS = 60  # of the solution: a run takes long

HEAD = "def find_again(rows, weights, u, C, p, z, R, rng):\n"
RING = """
    def ring(count):
        '''Poses that could have made the sighting, and their ranges.'''
        r, beta = rng.multivariate_normal(z[0], R, count).T
        angle = rng.uniform(-np.pi, np.pi, count)
        x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
        return np.column_stack([x, y, wrap(angle + np.pi - beta)]), r
"""
ANYWHERE = "rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))"

WAYS = {
    "by logarithms and tickets, half as many strangers": HEAD
    + RING
    + """
    n, k = len(rows), len(rows) // 2
    moved = move(rows, u, C, rng)
    strangers, r = ring(k)
    top = np.log(1 - GHOSTS) - np.log(2 * np.pi) - np.linalg.slogdet(R)[1] / 2
    floor = np.log(GHOSTS / (2 * np.pi * REACH))
    known = np.log(weights) + np.logaddexp(top + log_likelihoods(moved, p, z, R), floor)
    new = np.log(0.01 * np.abs(r) / (80 * k) + 1e-300)
    new[(np.abs(strangers[:, :2]) > ROOM / 2).any(axis=1)] = -1e3
    w = normalise(np.append(known, new))
    return np.concatenate([moved, strangers])[rng.choice(n + k, n, p=w)], np.full(n, 1 / n)
""",
    "strangers of one weight, evenly on the ring": HEAD
    + """
    n = len(rows)
    moved = move(rows, u, C, rng)
    noise = rng.multivariate_normal([0, 0], R, n)
    angle = 2 * np.pi * (np.arange(n) + rng.random()) / n
    r = np.abs(z[0, 0] + noise[:, 0])
    x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
    new = np.column_stack([x, y, wrap(angle + np.pi - z[0, 1] - noise[:, 1])])
    real = np.exp(log_likelihoods(moved, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    w = np.append(weights * (0.9 * real + 0.1 / 63), np.full(n, 0.0005 / n))
    w[n:][(np.abs(x) > 5) | (np.abs(y) > 4)] = 0
    w = w / w.sum()
    picked = np.searchsorted(np.cumsum(w)[:-1], (rng.random() + np.arange(n)) / n)
    return np.vstack([moved, new])[picked], np.ones(n) / n
""",
    "twice as many strangers": HEAD
    + RING
    + """
    n, moved = len(rows), move(rows, u, C, rng)
    strangers, r = ring(2 * n)
    real = np.exp(log_likelihoods(moved, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    known = 0.99 * weights * (0.9 * real + 0.1 / (2 * np.pi * 10))
    new = 0.9 * 0.01 * np.abs(r) / 80 / (2 * n)
    new[(np.abs(strangers[:, 0]) > 5) | (np.abs(strangers[:, 1]) > 4)] = 0
    w = np.append(known, new)
    picked = draw(w / w.sum(), rng)[rng.integers(3) :: 3]
    return list(np.vstack([moved, strangers])[picked]), [1 / n] * n
""",
    "p l / q of each stranger by its densities": HEAD
    + RING
    + """
    n = len(rows)
    moved = move(rows, u, C, rng)
    strangers, r = ring(n)
    peak = 1 / (2 * np.pi * np.sqrt(np.linalg.det(R)))

    def likelihood(x):
        return (1 - GHOSTS) * peak * np.exp(log_likelihoods(x, p, z, R)) + GHOSTS / (2 * np.pi * REACH)

    prior = np.where((np.abs(strangers[:, :2]) < ROOM / 2).all(axis=1), 1 / (80 * 2 * np.pi), 0)
    # drawn round z, as densities of range, bearing and angle: in x, y and θ they are 1/r of that
    q = peak * np.exp(log_likelihoods(strangers, p, z, R)) / (2 * np.pi * np.maximum(np.abs(r), 1e-6))
    q = np.maximum(q, 1e-2 * q.max())
    w = np.append(0.99 * weights * likelihood(moved), 0.01 * prior * likelihood(strangers) / q / n)
    together = np.vstack([moved, strangers])
    w = w / np.sum(w)
    best = rng.permutation(draw(w, rng))[:n]
    return together[best], np.full(n, 1 / n)
""",
}


def gated(share, limit=10, strangers="ring(k)[0]"):
    """A step that throws strangers when no sample explains the sighting, and goes on else."""
    return (
        HEAD
        + RING
        + f"""
    n, k = len(rows), int({share} * len(rows))
    rows = move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    if np.max(logs) < -{limit}:
        rows[:k] = {strangers}
        return rows, np.full(n, 1 / n)
    weights = normalise(np.log(weights) + logs)
    if effective_size(weights) < n / 2:
        rows, weights = rows[draw(weights, rng)], np.full(n, 1 / n)
    return rows, weights
"""
    )


def always(share, strangers=ANYWHERE, with_ring=""):
    """The lesson's step, and strangers in each of them."""
    return (
        HEAD
        + with_ring
        + f"""
    n, k = len(rows), int({share} * len(rows))
    rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    rows = rows[draw(weights, rng)]
    rows[rng.permutation(n)[:k]] = {strangers}
    return rows, np.full(n, 1 / n)
"""
    )


def task_3(C="C", R="R"):
    return HEAD + f"    return localise(rows, weights, u, {C}, p, z, {R}, rng)\n"


STEP = task_3()
FLOOR = "seen = (1 - GHOSTS) * real + GHOSTS / (REACH * 2 * np.pi)"
PICKED = "picked = draw(together / np.sum(together), rng)[rng.integers(2) :: 2]"
BOTH = "[(1 - carried) * weights * seen, carried * odd]"

SLIPS = (
    Slip(
        "localise",
        "This is task 3's step: no sample is left where the robot now is, and copies never get there.",
        STEP,
    ),
    Slip(
        "blunter-sensor",
        "A larger R trusts all sightings less, the good ones, too. No sample gets to the robot by that.",
        task_3(R="10 * R"),
        task_3(R="100 * R"),
    ),
    Slip(
        "wilder-wheels",
        "With more noise of the wheels the cloud creeps about for the robot; it is coarse all the time "
        "and comes late.",
        task_3(C="100 * C"),
        task_3(C="400 * C", R="4 * R"),
    ),
    Slip(
        "strangers-anywhere",
        "Strangers that are thrown anywhere hardly ever hit three numbers at once. Which poses could "
        "have made the sighting?",
        always(0.1),
        always(0.3),
        gated(1.0, strangers=ANYWHERE),
        gated(0.3, strangers=ANYWHERE),
    ),
    Slip(
        "strangers-only",
        "The cloud is thrown anew in each step: all that was known before is lost.",
        HEAD + RING + "    return ring(len(rows))[0], weights\n",
        (BOTH, "[0 * weights * seen, carried * odd]"),
    ),
    Slip(
        "not-weighed",
        "Strangers are as much believed as samples that have proved themselves: their weight has to "
        "say how unlikely a kidnapping is.",
        always(0.1, "ring(k)[0]", RING),
        always(0.3, "ring(k)[0]", RING),
    ),
    Slip(
        "all-at-once",
        "One odd sighting, and the whole cloud is thrown away, or most of it. One sighting in ten is "
        "false.",
        gated(1.0),
        gated(0.5),
        gated(1.0, 30),
    ),
    Slip(
        "ghosts-forgotten",
        "A false sighting leaves none of the samples alive: how likely is it that a sighting is false, "
        "whatever the pose?",
        (FLOOR, "seen = real"),
        (FLOOR, "seen = (1 - GHOSTS) * real + 1e-9"),
    ),
    Slip(
        "ghosts-only-refused",
        "Odd sightings are refused, and so the robot is never found: after the kidnapping all of them "
        "are odd.",
        HEAD
        + """
    rows = move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    if np.max(logs) > -10:
        weights = normalise(np.log(weights) + logs)
        if effective_size(weights) < len(rows) / 2:
            rows, weights = rows[draw(weights, rng)], np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    Slip(
        "heading-forgotten",
        "The strangers stand on the ring, but look anywhere: the bearing tells how they look.",
        ("wrap(angle + np.pi - beta)", "rng.uniform(-np.pi, np.pi, n)"),
        ("wrap(angle + np.pi - beta)", "wrap(angle - beta)"),
        ("wrap(angle + np.pi - beta)", "wrap(angle + np.pi + beta)"),
    ),
    Slip(
        "ring-round-the-origin",
        "The ring of poses that could have made the sighting is round the post, not round something "
        "else.",
        ("p[0, 0] + r * np.cos(angle), p[0, 1] + r", "r * np.cos(angle), r"),
        (
            "p[0, 0] + r * np.cos(angle), p[0, 1] + r",
            "rows[:, 0] + r * np.cos(angle), rows[:, 1] + r",
        ),
    ),
    Slip(
        "likelihood-without-height",
        "The factor before the exponential is missing: beside a false sighting's density, a true one "
        "is not as likely as you take it for.",
        (" / (2 * np.pi * np.sqrt(np.linalg.det(R)))", " / 1000"),
    ),
    Slip(
        "kidnapped-all-the-time",
        "You take a kidnapping for likelier than a false sighting: the cloud follows each of them.",
        ("carried = len(rows), 0.01", "carried = len(rows), 0.5"),
        ("* np.abs(r) / np.prod(ROOM) / n", "* np.abs(r)"),
    ),
    Slip(
        "kidnapped-hardly-ever",
        "You take a kidnapping for so unlikely that the robot is found too late, or never.",
        ("carried = len(rows), 0.01", "carried = len(rows), 1e-5"),
        (BOTH, "[weights * seen, 0 * odd]"),
        ("/ np.prod(ROOM) / n", "/ np.prod(ROOM) / n**3"),
    ),
    Slip(
        "few-strangers",
        "A handful of strangers is too few: on a ring of twenty metres one of them hardly ever stands "
        "where the robot is.",
        ("    odd = ", "    inside[5:] = False\n    odd = "),
    ),
    Slip(
        "not-moved",
        "The robot drives in each step, and the samples do not.",
        ("rows = move(rows, u, C, rng)", "rows = rows"),
    ),
    Slip(
        "half-the-rod",
        "Only the beginning of the rod is drawn from: the strangers, who lie at its end, never are.",
        (PICKED, "picked = draw(together / np.sum(together), rng)[:n]"),
        (PICKED, "picked = draw(normalise(np.log(weights * seen)), rng)"),
    ),
)

STUMBLES = (
    Stumble("malformed", (", np.full(n, 1 / n)", "")),
    Stumble("malformed", ("[rng.integers(2) :: 2]", "")),
    Stumble(
        "malformed",
        (", np.full(n, 1 / n)", ", np.full(n, -1 / n)"),
        (", np.full(n, 1 / n)", ", np.zeros(n)"),
    ),
    Stumble("raised", ("[picked]", "[picked + 10**6]")),
)

PASTED = {
    "task 3's step": STEP,
    "the lesson's strangers": always(0.1),
    "the lesson's step with more strangers": always(0.25),
}

EQUIVALENT = {
    " -> ": "any method goes: what finds as many robots as soon is a right way of its own",
}
