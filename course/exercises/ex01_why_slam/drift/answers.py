# %% way: in closed form, as an array of one
def drift(n, d, sigma):
    return np.array([sigma * d * np.sqrt(n * (n - 1) * (2 * n - 1) / 6)])

# %% way: the sine of each error
def drift(n, d, sigma):
    return d * np.sin(sigma) * np.linalg.norm(np.arange(n))

# %% way: as the root of a covariance
def drift(n, d, sigma):
    P = np.zeros((2, 2))
    A = np.array([[1, d], [0, 1]])
    for _ in range(n):
        P = A @ P @ A.T + np.diag([0, sigma**2])
    return np.sqrt(P[0, 0])

# %% way: a loop
def drift(n, d, sigma):
    import math

    total = 0.0
    for k in range(1, n + 1):
        total += ((n - k) * d * sigma) ** 2
    return math.sqrt(total)

# %% way: a matrix of all errors on all steps
def drift(n, d, sigma):
    bent = np.tril(np.ones((n, n)), -1)
    aside = d * sigma * bent.sum(axis=0)
    return float(np.sqrt(aside @ aside))

# %% way: variances step by step
def drift(n, d, sigma):
    variance = sum((d * sigma * k) ** 2 for k in range(n))
    return variance**0.5

# %% right: closed form
def drift(n, d, sigma):
    if n == 0:
        return 0.0
    return sigma * d * ((n - 1) * n * (2 * n - 1) / 6) ** 0.5

# %% right: the norm of a vector
def drift(n, d, sigma):
    return float(np.linalg.norm(sigma * d * np.arange(n - 1, -1, -1)))

# %% wrong: one constant error: n-1 steps of sigma
def drift(n, d, sigma):
    return (n - 1) * d * np.sin(sigma)

# %% wrong: closed form with a slip: (2n+1)
def drift(n, d, sigma):
    return sigma * d * np.sqrt(n * (n - 1) * (2 * n + 1) / 6)

# %% wrong: closed form divides by n, fails for no step
def drift(n, d, sigma):
    mean_of_squares = (n - 1) * n * (2 * n - 1) / 6 / n
    return sigma * d * np.sqrt(n * mean_of_squares)

# %% wrong: simulated with 2000 robots
def drift(n, d, sigma):
    rng = np.random.default_rng(0)
    e = np.cumsum(sigma * rng.standard_normal((2000, n)), axis=1)
    return np.std(d * np.sum(np.sin(e[:, :-1]), axis=1))

# %% wrong: divides by n for a mean
def drift(n, d, sigma):
    k = np.arange(n)
    return sigma * d * np.sqrt(np.mean(k ** 2))
