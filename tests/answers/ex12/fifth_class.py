"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "12-interval",
        "bisection of the inequality",
        """
def interval(k, n):
    p0 = k / n
    def inside(p):
        return (p0 - p) ** 2 <= 1.96 ** 2 * p * (1 - p) / n
    def edge(a, b):
        for _ in range(200):
            m = (a + b) / 2
            a, b = (m, b) if inside(m) == inside(p0) and inside(p0) else (a, m)
        return a
    low = 0.0 if k == 0 else edge(p0, 0.0)
    high = 1.0 if k == n else edge(p0, 1.0)
    if k == 0:
        high = 1.96 ** 2 / (n + 1.96 ** 2)
    if k == n:
        low = n / (n + 1.96 ** 2)
    return low, high
""",
    ),
]

WRONG = [
    (
        "12-paired",
        "mean of absolute errors",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.mean(a[:end]) - np.mean(b[:end]))
    d, n = np.sort(d), len(d)
    total, k = 0.0, 0
    while total + comb(n, k) / 2 ** n <= 0.025:
        total += comb(n, k) / 2 ** n
        k += 1
    return d[k - 1], d[n - k]
""",
    ),
    (
        "12-interval",
        "n − 1 for n",
        """
def interval(k, n):
    p, q = k / n, 1.96 ** 2 / (n - 1)
    a, b, c = 1 + q, -(2 * p + q), p ** 2
    d = np.sqrt(b ** 2 - 4 * a * c)
    return (-b - d) / 2 / a, (-b + d) / 2 / a
""",
    ),
    (
        "12-odometry",
        "turns below a thousandth count as straight on",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    if abs(turn) < 1e-3:
        return np.array([d, 0.0, turn])
    R = d / turn
    return np.array([R * np.sin(turn), R * (1 - np.cos(turn)), turn])
""",
    ),
]
