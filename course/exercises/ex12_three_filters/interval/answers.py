# %% way: the roots of the quadratic
def interval(k, n):
    p, c = k / n, 1.96**2 / n
    low, high = sorted(np.roots([1 + c, -2 * p - c, p**2]).real)
    return max(low, 0.0), min(high, 1.0)

# %% way: Clopper and Pearson
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.025, k, n - k + 1) if k else 0.0
    return low, beta.ppf(0.975, k + 1, n - k) if k < n else 1.0

# %% way: Agresti and Coull
def interval(k, n):
    more = n + 1.96**2
    p = (k + 1.96**2 / 2) / more
    half = 1.96 * np.sqrt(p * (1 - p) / more)
    return max(p - half, 0), min(p + half, 1)

# %% way: two and two more
def interval(k, n):
    p = (k + 2) / (n + 4)
    half = 1.96 * np.sqrt(p * (1 - p) / (n + 4))
    return np.clip([p - half, p + half], 0, 1)

# %% way: by SciPy
def interval(k, n):
    from scipy.stats import binomtest
    found = binomtest(k, n).proportion_ci(method="wilson")
    return [found.low, found.high]

# %% way: by halving
def interval(k, n):
    def end(inside, outside):
        for _ in range(60):
            p = (inside + outside) / 2
            if abs(k / n - p) <= 1.96 * np.sqrt(p * (1 - p) / n):
                inside = p
            else:
                outside = p
        return inside

    return end(k / n, 0.0), end(k / n, 1.0)

# %% way: Jeffreys
def interval(k, n):
    from scipy.stats import beta
    low, high = beta.ppf([0.025, 0.975], k + 0.5, n - k + 0.5)
    return (0.0 if k == 0 else low), (1.0 if k == n else high)

# %% right: roots of the quadratic a p^2 + b p + c, the far one first and the other by Vieta
def interval(k, n):
    k, n = float(k), float(n)
    z2 = 1.96**2
    a, b, c = 1 + z2 / n, -(2 * k / n + z2 / n), (k / n) ** 2
    root = max(b * b - 4 * a * c, 0.0) ** 0.5
    high = (-b + root) / (2 * a)
    low = c / (a * high)
    return max(0.0, low), min(1.0, high)

# %% wrong: sign of the middle term
def interval(k, n):
    q = 1.96 ** 2 / n
    p = k / n
    a, b, c = 1 + q, -(2 * p - q), p ** 2
    d = np.sqrt(max(b ** 2 - 4 * a * c, 0))
    return (-b - d) / 2 / a, (-b + d) / 2 / a

# %% wrong: half width not divided by 1 + z²/n
def interval(k, n):
    z, p = 1.96, k / n
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    return max(middle - half, 0), min(middle + half, 1)

# %% wrong: Clopper-Pearson with 5 % on each side
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.05, k, n - k + 1) if k else 0.0
    high = beta.ppf(0.95, k + 1, n - k) if k < n else 1.0
    return low, high

# %% wrong: Clopper-Pearson, nan at k = 0 and k = n
def interval(k, n):
    from scipy.stats import beta
    return beta.ppf(0.025, k, n - k + 1), beta.ppf(0.975, k + 1, n - k)

# %% wrong: tries a grid of whole per cents: too coarse for many runs
def interval(k, n):
    possible = [p / 100 for p in range(101) if (k / n - p / 100) ** 2 <= 1.96**2 * p / 100 * (1 - p / 100) / n]
    return min(possible), max(possible)

# %% wrong: whole-number division
def interval(k, n):
    z = 1.96
    p = k // n
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(middle - half, 0.0), min(middle + half, 1.0)

# %% wrong: every p of a thousandth that is possible
def interval(k, n):
    p = np.linspace(0, 1, 1001)
    possible = p[(k / n - p) ** 2 <= 1.96**2 * p * (1 - p) / n]
    return possible[0], possible[-1]

# %% wrong: bootstrap: studies drawn from the share that was found
def interval(k, n):
    shares = np.random.default_rng(0).binomial(n, k / n, 20000) / n
    return float(np.quantile(shares, 0.025)), float(np.quantile(shares, 0.975))
