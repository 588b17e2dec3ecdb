"""Independent answers to 12-interval: right ones, and students' mistakes."""

RIGHT = [
    (
        "12-interval",
        "abc formula",
        """
def interval(k, n):
    z2 = 1.96**2
    share = k / n
    a = 1 + z2 / n
    b = -(2 * share + z2 / n)
    c = share**2
    root = np.sqrt(max(b * b - 4 * a * c, 0.0))
    return max(0.0, (-b - root) / (2 * a)), min(1.0, (-b + root) / (2 * a))
""",
    ),
    (
        "12-interval",
        "Clopper-Pearson from scipy",
        """
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.025, k, n - k + 1) if k > 0 else 0.0
    high = beta.ppf(0.975, k + 1, n - k) if k < n else 1.0
    return float(low), float(high)
""",
    ),
]

WRONG = [
    (
        "12-interval",
        "Wald: k/n plus and minus",
        """
def interval(k, n):
    p = k / n
    s = np.sqrt(p * (1 - p) / n)
    return p - 1.96 * s, p + 1.96 * s
""",
    ),
    (
        "12-interval",
        "Wald, clipped to 0..1",
        """
def interval(k, n):
    p = k / n
    half = 1.96 * (p * (1 - p) / n) ** 0.5
    return max(0.0, p - half), min(1.0, p + half)
""",
    ),
    (
        "12-interval",
        "upper end first",
        """
def interval(k, n):
    z = 1.96
    middle = (k / n + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return min(middle + half, 1.0), max(middle - half, 0.0)
""",
    ),
    (
        "12-interval",
        "z of a one-sided 95 %",
        """
def interval(k, n):
    z, p = 1.645, k / n
    a, b, c = 1 + z**2 / n, 2 * p + z**2 / n, p**2
    root = np.sqrt(b**2 - 4 * a * c)
    return max((b - root) / (2 * a), 0.0), min((b + root) / (2 * a), 1.0)
""",
    ),
    (
        "12-interval",
        "half width not divided by 1 + z²/n",
        """
def interval(k, n):
    z, p = 1.96, k / n
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    return max(middle - half, 0), min(middle + half, 1)
""",
    ),
    (
        "12-interval",
        "no shift of the middle",
        """
def interval(k, n):
    z, p = 1.96, k / n
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(p - half, 0.0), min(p + half, 1.0)
""",
    ),
    (
        "12-interval",
        "z instead of z² in the inequality",
        """
def interval(k, n):
    z, p = 1.96, k / n
    a, b, c = 1 + z / n, -(2 * p + z / n), p * p
    root = np.sqrt(b * b - 4 * a * c)
    return (-b - root) / (2 * a), (-b + root) / (2 * a)
""",
    ),
    (
        "12-interval",
        "nothing lost: says 0 to 0; all lost: 1 to 1",
        """
def interval(k, n):
    if k == 0:
        return 0.0, 0.0
    if k == n:
        return 1.0, 1.0
    z = 1.96
    middle = (k + z**2 / 2) / (n + z**2)
    half = z / (n + z**2) * np.sqrt(k * (n - k) / n + z**2 / 4)
    return middle - half, middle + half
""",
    ),
    (
        "12-interval",
        "Clopper-Pearson with 5 % on each side",
        """
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.05, k, n - k + 1) if k else 0.0
    high = beta.ppf(0.95, k + 1, n - k) if k < n else 1.0
    return low, high
""",
    ),
    (
        "12-interval",
        "Clopper-Pearson, nan at k = 0 and k = n",
        """
def interval(k, n):
    from scipy.stats import beta
    return beta.ppf(0.025, k, n - k + 1), beta.ppf(0.975, k + 1, n - k)
""",
    ),
    (
        "12-interval",
        "tries a grid of whole per cents: too coarse for many runs",
        """
def interval(k, n):
    possible = [p / 100 for p in range(101) if (k / n - p / 100) ** 2 <= 1.96**2 * p / 100 * (1 - p / 100) / n]
    return min(possible), max(possible)
""",
    ),
    (
        "12-interval",
        "whole-number division",
        """
def interval(k, n):
    z = 1.96
    p = k // n
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(middle - half, 0.0), min(middle + half, 1.0)
""",
    ),
    (
        "12-interval",
        "bootstrap: of none lost it draws none lost",
        """
def interval(k, n):
    rng = np.random.default_rng(0)
    shares = rng.binomial(n, k / n, 2000) / n
    low, high = np.quantile(shares, [0.025, 0.975])
    return low, high
""",
    ),
    (
        "12-interval",
        "binomial sums with powers: overflows for many runs",
        """
def interval(k, n):
    def at_most(j, p):
        return sum(comb(n, i) * p**i * (1 - p) ** (n - i) for i in range(j + 1))

    def solve(f):
        a, b = 0.0, 1.0
        for _ in range(50):
            m = (a + b) / 2
            a, b = (m, b) if f(m) else (a, m)
        return a

    low = 0.0 if k == 0 else solve(lambda p: 1 - at_most(k - 1, p) < 0.025)
    high = 1.0 if k == n else solve(lambda p: at_most(k, p) > 0.025)
    return low, high
""",
    ),
    (
        "12-interval",
        "per cents",
        """
def interval(k, n):
    z = 1.96
    middle = (k / n + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return 100 * max(middle - half, 0.0), 100 * min(middle + half, 1.0)
""",
    ),
]
