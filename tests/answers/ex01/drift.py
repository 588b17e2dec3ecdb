"""Independent answers to 01-drift: right ones, and students' mistakes."""

RIGHT = [
    (
        "01-drift",
        "closed form",
        """
def drift(n, d, sigma):
    if n == 0:
        return 0.0
    return sigma * d * ((n - 1) * n * (2 * n - 1) / 6) ** 0.5
""",
    ),
    (
        "01-drift",
        "a loop over the errors",
        """
def drift(n, d, sigma):
    var = 0.0
    for i in range(1, n + 1):
        sideways = (n - i) * d * sigma
        var += sideways ** 2
    return np.sqrt(var)
""",
    ),
    (
        "01-drift",
        "the norm of a vector",
        """
def drift(n, d, sigma):
    return float(np.linalg.norm(sigma * d * np.arange(n - 1, -1, -1)))
""",
    ),
    (
        "01-drift",
        "propagates variance of sideways and heading",
        """
def drift(n, d, sigma):
    P = np.zeros((2, 2))
    A = np.array([[1, d], [0, 1]])
    for _ in range(n):
        P = A @ P @ A.T
        P[1, 1] += sigma ** 2
    return np.sqrt(P[0, 0])
""",
    ),
]

WRONG = [
    (
        "01-drift",
        "the first error bends n steps",
        """
def drift(n, d, sigma):
    var = 0
    for k in range(1, n + 1):
        var += (k * d * sigma) ** 2
    return np.sqrt(var)
""",
    ),
    (
        "01-drift",
        "adds the standard deviations",
        """
def drift(n, d, sigma):
    return sigma * d * n * (n - 1) / 2
""",
    ),
    (
        "01-drift",
        "returns the variance",
        """
def drift(n, d, sigma):
    k = np.arange(n)
    return sigma ** 2 * d ** 2 * np.sum(k ** 2)
""",
    ),
    (
        "01-drift",
        "like the length: sqrt(n)",
        """
def drift(n, d, sigma):
    return d * sigma * np.sqrt(n)
""",
    ),
    (
        "01-drift",
        "the approximation n^1.5/sqrt(3)",
        """
def drift(n, d, sigma):
    return sigma * d * np.sqrt(n ** 3 / 3)
""",
    ),
    (
        "01-drift",
        "one constant error: n-1 steps of sigma",
        """
def drift(n, d, sigma):
    return (n - 1) * d * np.sin(sigma)
""",
    ),
    (
        "01-drift",
        "one random heading per step, not picked up",
        """
def drift(n, d, sigma):
    # each step goes sideways by d * e
    var = sum((d * sigma) ** 2 for i in range(1, n))
    return np.sqrt(var)
""",
    ),
    (
        "01-drift",
        "sigma counted as degrees",
        """
def drift(n, d, sigma):
    k = np.arange(n)
    return np.radians(sigma) * d * np.sqrt(np.sum(k ** 2))
""",
    ),
    (
        "01-drift",
        "sum of k, not k squared",
        """
def drift(n, d, sigma):
    total = 0
    for k in range(n):
        total += k
    return sigma * d * np.sqrt(total)
""",
    ),
    (
        "01-drift",
        "sums to n - 2",
        """
def drift(n, d, sigma):
    return d * sigma * np.sqrt(sum(k ** 2 for k in range(n - 1)))
""",
    ),
    (
        "01-drift",
        "forgets the step length under the root",
        """
def drift(n, d, sigma):
    return sigma * np.sqrt(d * np.sum(np.arange(n) ** 2))
""",
    ),
    (
        "01-drift",
        "simulates it",
        """
def drift(n, d, sigma):
    rng = np.random.default_rng(0)
    ends = []
    for _ in range(300):
        headings = np.cumsum(sigma * rng.standard_normal(n))
        ends.append(d * np.sum(np.sin(headings[:-1])))
    return float(np.std(ends))
""",
    ),
    (
        "01-drift",
        "closed form with a slip: (2n+1)",
        """
def drift(n, d, sigma):
    return sigma * d * np.sqrt(n * (n - 1) * (2 * n + 1) / 6)
""",
    ),
    (
        "01-drift",
        "closed form divides by n, fails for no step",
        """
def drift(n, d, sigma):
    mean_of_squares = (n - 1) * n * (2 * n - 1) / 6 / n
    return sigma * d * np.sqrt(n * mean_of_squares)
""",
    ),
]
