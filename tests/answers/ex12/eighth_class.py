"""An eighth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "12-odometry",
        "turning about the standing wheel if one stands, else the usual",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    turn = (sr - sl) / base
    if left == right:
        return np.array([sl, 0, 0])
    if left == 0 or right == 0:
        R = base
    else:
        R = (sl + sr) / 2 / turn
    return np.array([R * np.sin(turn), R * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-lost",
        "longest run of readings beyond the limit",
        """
def lost_since(errors, limit):
    best, start, length = -1, None, 0
    for k, e in enumerate(list(errors) + [0]):
        if e > limit:
            start = k if start is None else start
        elif start is not None:
            if k - start > length:
                best, length = start, k - start
            start = None
    return best if errors[-1] > limit else -1
""",
    ),
    (
        "12-interval",
        "one Newton step for each end from the counted share",
        """
def interval(k, n):
    share = k / n
    half = 1.96 * (share * (1 - share) / n) ** 0.5
    ends = []
    for p in (share - half, share + half):
        p = min(max(p, 1e-3), 1 - 1e-3)
        f = (share - p) ** 2 - 1.96**2 * p * (1 - p) / n
        slope = -2 * (share - p) - 1.96**2 * (1 - 2 * p) / n
        ends.append(min(max(p - f / slope, 0), 1))
    return min(ends), max(ends)
""",
    ),
    (
        "12-paired",
        "the readings of all drives in one, and the median over these",
        """
def compare(errors_a, errors_b, limit):
    diffs = []
    for a, b in zip(errors_a, errors_b):
        for ea, eb in zip(a, b):
            if ea > limit or eb > limit:
                break
            diffs.append(ea - eb)
    diffs.sort()
    n = len(diffs)
    half = 0.98 * n**0.5
    return diffs[max(0, int(n / 2 - half))], diffs[min(n - 1, int(n / 2 + half))]
""",
    ),
]
