"""Programs of task 11-draw."""

from course.tasks import Slip, Stumble

TASK = "11-draw"

WAYS = {
    "by a loop": """
def draw(weights, rng):
    n = len(weights)
    u, i, end, drawn = rng.random() / n, 0, weights[0], []
    for k in range(n):
        for _ in range(n):
            if u + k / n < end or i == n - 1:
                break
            i += 1
            end += weights[i]
        drawn.append(i)
    return drawn
""",
    "the last end set to one": """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1
    return np.searchsorted(ends, rng.uniform(0, 1 / n) + np.linspace(0, 1, n, endpoint=False))
""",
    "by counting copies, shuffled": """
def draw(weights, rng):
    n, u = len(weights), rng.random()
    ends = np.ceil(n * np.cumsum(weights) - u).astype(int)
    ends[-1] = n
    return rng.permutation(np.repeat(np.arange(n), np.diff(ends, prepend=0)))
""",
    "from the right": """
def draw(weights, rng):
    n = len(weights)
    teeth = 1 - (rng.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth), n - 1)
""",
    "a comb over n times the weights": """
def draw(weights, rng):
    ends = len(weights) * np.cumsum(weights) / np.sum(weights)
    teeth = np.arange(len(weights)) + rng.random()
    return np.clip(np.digitize(teeth, ends), 0, len(weights) - 1).tolist()
""",
    "each tooth by itself": """
def draw(weights, rng):
    n, ends = len(weights), np.cumsum(weights)
    ends /= ends[-1]
    u = rng.uniform()
    return np.array([int(np.argmax(ends > (u + k) / n)) for k in range(n)], dtype=int)
""",
}

TEETH = "(rng.random() + np.arange(n)) / n"
PICKED = 'np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right"), n - 1)'
OWN = "The random number comes from elsewhere: take the generator that is passed in, and no other."

SLIPS = (
    Slip(
        "largest-weight",
        "You take the sample with the largest weight, every time. That is the erratum of the thesis' "
        "algorithm 1: a weight is a probability.",
        (PICKED, "np.full(n, np.argmax(weights))"),
        (PICKED, "np.argsort(weights)[::-1] * 0 + weights.argmax()"),
    ),
    Slip(
        "all-once",
        "You draw every sample once: what weighs much is to be drawn several times, what weighs "
        "little not at all.",
        (PICKED, "np.argsort(weights)[::-1]"),
        (PICKED, "np.arange(n)"),
        (PICKED, "rng.permutation(n)"),
    ),
    Slip(
        "one-draw",
        "One sample is drawn and copied n times. Each of the n teeth picks for itself.",
        (PICKED, "np.full(n, rng.choice(n, p=weights))"),
        (TEETH, "np.full(n, rng.random())"),
    ),
    Slip(
        "without-weights",
        "All samples are drawn alike often, whatever their weight.",
        (PICKED, "rng.integers(n, size=n)"),
        (PICKED, "rng.choice(n, n)"),
    ),
    Slip(
        "tickets",
        "On average this is right, but these are n random numbers, one for each draw. A comb has one "
        "random number for all its teeth.",
        (TEETH, "rng.random(n)"),
        (PICKED, "rng.choice(n, n, p=weights)"),
    ),
    Slip(
        "stratified",
        "Each tooth has a random number of its own. That is calmer than tickets, but no comb.",
        (TEETH, "(rng.random(n) + np.arange(n)) / n"),
    ),
    Slip(
        "rest-by-tickets",
        "The whole copies are given for sure, but the rest is drawn by several random numbers.",
        """
def draw(weights, rng):
    n = len(weights)
    whole = np.floor(n * weights + 1e-9).astype(int)
    rest = np.maximum(n * weights - whole, 0)
    others = rng.choice(n, n - whole.sum(), p=rest / rest.sum()) if whole.sum() < n else []
    return np.concatenate([np.repeat(np.arange(n), whole), others])
""",
    ),
    Slip(
        "rounded",
        "n w is rounded, and no random number decides: what is due to have a third of a copy never "
        "gets one.",
        """
def draw(weights, rng):
    n = len(weights)
    copies = np.rint(n * weights).astype(int)
    return np.resize(np.repeat(np.arange(n), copies), n)
""",
        """
def draw(weights, rng):
    n = len(weights)
    whole = np.floor(n * weights + 1e-9).astype(int)
    extra = np.argsort(whole - n * weights)[: n - whole.sum()]
    return np.concatenate([np.repeat(np.arange(n), whole), extra])
""",
    ),
    Slip(
        "no-random-number",
        "Every seed draws the same: some samples would never get the copy that is due to them now and "
        "then.",
        (TEETH, "(0.5 + np.arange(n)) / n"),
        (TEETH, "np.arange(n) / n"),
        (TEETH, "np.linspace(0, 1, n)"),
        """
def draw(weights, rng):
    n = len(weights)
    return np.searchsorted(np.cumsum(weights), np.arange(n) / n)
""",
    ),
    Slip("a-seed-of-its-own", OWN, ("rng.random()", "np.random.default_rng(0).random()")),
    Slip(
        "shift-not-divided",
        "The random number shifts the comb by up to the whole rod. It stands on the rod if the first "
        "tooth is at u/n.",
        (TEETH, "rng.random() + np.arange(n) / n"),
    ),
    Slip(
        "shift-rolls-over",
        "The teeth that leave the rod at its end come in again at its beginning: each is a fair draw, "
        "but the sample on which the rod begins is served twice.",
        (TEETH, "(rng.random() + np.arange(n)) / n * (1 + 1 / n) % 1"),
    ),
    Slip(
        "off-by-a-tooth",
        "The teeth stand from 1 to n, not from 0 to n − 1: the first samples are left out.",
        (TEETH, "(rng.random() + np.arange(1, n + 1)) / n"),
    ),
    Slip(
        "n-minus-one",
        "The teeth stand 1/(n − 1) apart. There are n of them on a rod of length one.",
        (TEETH, "(rng.random() + np.arange(n)) / max(n - 1, 1)"),
    ),
    Slip(
        "linspace",
        "np.linspace takes its end in, so that n teeth leave n − 1 gaps: they stand too far apart, or the "
        "last one never moves.",
        (TEETH, "np.linspace(rng.random() / n, 1, n)"),
        (TEETH, "np.linspace(0, 1, n) + rng.random() / n"),
        (TEETH, "np.linspace(rng.random() / n, 1 - 1 / n, n)"),
        (TEETH, "np.linspace(1 / n, 1, n) - rng.random()"),
    ),
    Slip(
        "half-shift",
        "The comb is shifted by half of what it may be: samples at one end of each gap lose.",
        (TEETH, "(rng.random() / 2 + np.arange(n)) / n"),
        (TEETH, "(rng.random() - 0.5 + np.arange(n)) / n"),
    ),
    Slip(
        "normal-shift",
        "The shift comes from a bell: all places between 0 and 1/n are to be as likely.",
        (TEETH, "(np.clip(rng.normal(0.5, 0.2), 0, 1) + np.arange(n)) / n"),
    ),
    Slip(
        "not-end-to-end",
        "The teeth are compared with the weights themselves. Lay them end to end first.",
        ("np.cumsum(weights)", "weights"),
        ("np.cumsum(weights)", "np.sort(weights)"),
    ),
    Slip(
        "sorted-first",
        "The weights are sorted first, and then the indices point to other samples.",
        ("np.cumsum(weights)", "np.cumsum(np.sort(weights))"),
        ("np.cumsum(weights)", "np.cumsum(np.sort(weights)[::-1])"),
    ),
    Slip(
        "one-too-low",
        "Each tooth picks the neighbour of the piece that it falls on.",
        (PICKED, 'np.maximum(np.searchsorted(np.cumsum(weights), teeth, side="right") - 1, 0)'),
        (PICKED, 'np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right") + 1, n - 1)'),
    ),
    Slip(
        "each-once",
        "Samples that are due to have several copies get one only, and something else fills the rest.",
        (PICKED, f"np.resize(np.unique({PICKED}), n)"),
    ),
    Slip(
        "weights-squared",
        "The weights are used twice: they were squared.",
        ("np.cumsum(weights)", "np.cumsum(weights**2 / np.sum(weights**2))"),
    ),
    Slip(
        "first-tooth-moves-only",
        "Only the first tooth is shifted; the others stand still.",
        (TEETH, "np.append(rng.random() / n, np.arange(1, n) / n)"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (PICKED, "teeth"),
        (PICKED, f"np.unique({PICKED})[:2]"),
        (PICKED, f"weights[{PICKED}]"),
        (f"return {PICKED}", PICKED),
        (', side="right"), n - 1)', ") + 1, n)"),
    ),
    Stumble("raised", ("rng.random()", "rng()"), ("rng.random()", "rng.rand()")),
)

AGAIN = "a second random number is as good as the first"
EQUIVALENT = {
    " -> teeth = (rng.random() + np.arange(n)) / n": f"{AGAIN}; a comb may begin at either end",
    " -> teeth = 1 - (rng.random() + np.arange(n)) / n": AGAIN,
    " -> teeth = np.arange(len(weights)) + rng.random()": AGAIN,
    " -> u, i, end, drawn = (rng.random() / n, 0, weights[0], [])": AGAIN,
    " -> n, u = (len(weights), rng.random())": AGAIN,
    " -> u = rng.uniform()": AGAIN,
}
