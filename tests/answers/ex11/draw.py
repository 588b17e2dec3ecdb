"""Independent answers to 11-draw: right ones, and students' mistakes."""

RIGHT = [
    (
        "11-draw",
        "pointer walking along the rod, as in the textbook",
        """
def draw(weights, rng):
    n = len(weights)
    u = rng.random()
    picked = np.zeros(n, dtype=int)
    i, end = 0, weights[0]
    for k in range(n):
        tooth = (u + k) / n
        while tooth >= end and i < n - 1:
            i += 1
            end += weights[i]
        picked[k] = i
    return picked
""",
    ),
    (
        "11-draw",
        "last end set to one, shuffled order",
        """
def draw(weights, rng):
    ends = np.cumsum(weights)
    ends = ends / ends[-1]
    n = weights.size
    teeth = np.arange(n) / n + rng.random() / n
    rows = np.searchsorted(ends, teeth, side="right")
    return np.clip(rows, 0, n - 1)[::-1]
""",
    ),
    (
        "11-draw",
        "np.digitize",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1.0 + 1e-9
    return np.digitize((np.arange(n) + rng.uniform()) / n, ends)
""",
    ),
]

WRONG = [
    (
        "11-draw",
        "a random number for every draw",
        """
def draw(weights, rng):
    n = len(weights)
    return np.minimum(np.searchsorted(np.cumsum(weights), rng.random(n)), n - 1)
""",
    ),
    (
        "11-draw",
        "rng.choice",
        """
def draw(weights, rng):
    return rng.choice(len(weights), size=len(weights), p=weights / np.sum(weights))
""",
    ),
    (
        "11-draw",
        "shifts the comb by u instead of u/n",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = rng.random() + np.arange(n) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right"), n - 1)
""",
    ),
    (
        "11-draw",
        "teeth where the rod has ended give n",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (rng.random() + np.arange(n)) / n
    return np.searchsorted(np.cumsum(weights), teeth, side="right")
""",
    ),
    (
        "11-draw",
        "argmax: a tooth past the last end picks sample 0",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    u = rng.random()
    return np.array([np.argmax(ends > (u + k) / n) for k in range(n)])
""",
    ),
    (
        "11-draw",
        "stratified: a new random number for each tooth",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    picked = []
    for k in range(n):
        tooth = (k + rng.random()) / n
        picked.append(min(np.searchsorted(ends, tooth, side="right"), n - 1))
    return np.array(picked)
""",
    ),
    (
        "11-draw",
        "np.random instead of rng",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (np.random.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right"), n - 1)
""",
    ),
    (
        "11-draw",
        "no randomness: comb in the middle",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1.0
    return np.searchsorted(ends, (np.arange(n) + 0.5) / n, side="right")
""",
    ),
    (
        "11-draw",
        "linspace up to 1: teeth are not 1/n apart",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = np.linspace(rng.random() / n, 1, n)
    return np.clip(np.searchsorted(np.cumsum(weights), teeth, side="right"), 0, n - 1)
""",
    ),
    (
        "11-draw",
        "sorts the weights; indices belong to the sorted ones",
        """
def draw(weights, rng):
    n = len(weights)
    big_first = np.sort(weights)[::-1]
    teeth = (rng.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(big_first), teeth, side="right"), n - 1)
""",
    ),
    (
        "11-draw",
        "cumsum written into the argument",
        """
def draw(weights, rng):
    n = len(weights)
    np.cumsum(weights, out=weights)
    weights[-1] = 1.0
    return np.searchsorted(weights, (rng.random() + np.arange(n)) / n, side="right")
""",
    ),
    (
        "11-draw",
        "returns how many copies, not the indices",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    copies = np.zeros(n, dtype=int)
    u, i = rng.random(), 0
    for k in range(n):
        while i < n - 1 and (u + k) / n >= ends[i]:
            i += 1
        copies[i] += 1
    return copies
""",
    ),
    (
        "11-draw",
        "rounds n w, fills up with the best: no chance",
        """
def draw(weights, rng):
    n = len(weights)
    copies = np.floor(n * weights).astype(int)
    rest = n - copies.sum()
    best = np.argsort(weights * n - copies)[::-1][:rest]
    copies[best] += 1
    return np.repeat(np.arange(n), copies)
""",
    ),
    (
        "11-draw",
        "off by one: the piece before",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (rng.random() + np.arange(n)) / n
    return np.maximum(np.searchsorted(np.cumsum(weights), teeth, side="right") - 1, 0)
""",
    ),
]
