"""Independent answers to 02-noise: right ones, and students' mistakes."""

RIGHT = [
    (
        "02-noise",
        "factor and np.where",
        """
def noisy(ranges, error, dropouts, rng):
    lost = rng.uniform(size=ranges.shape) < dropouts
    factor = rng.normal(1.0, error, size=ranges.shape)
    return np.where(lost, np.nan, ranges * factor)
""",
    ),
    (
        "02-noise",
        "beam by beam",
        """
def noisy(ranges, error, dropouts, rng):
    out = np.full(len(ranges), np.nan)
    for i, r in enumerate(ranges):
        if np.isnan(r):
            continue
        if rng.random() < dropouts:
            continue
        out[i] = r + rng.normal(0, error * r)
    return out
""",
    ),
    (
        "02-noise",
        "binomial for the losses",
        """
def noisy(ranges, error, dropouts, rng):
    new = ranges * (1 + error * rng.standard_normal(ranges.size))
    new[rng.binomial(1, dropouts, ranges.size) == 1] = np.nan
    return new
""",
    ),
]

WRONG = [
    (
        "02-noise",
        "error in metres, the same at all ranges",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges + error * rng.standard_normal(len(ranges))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "one random number for the whole scan",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + error * rng.standard_normal())
    lost = rng.random(len(ranges)) < dropouts
    return np.where(lost, np.nan, measured)
""",
    ),
    (
        "02-noise",
        "uniform noise of +- error",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + rng.uniform(-error, error, len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "error is taken as the variance",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + np.sqrt(error) * rng.standard_normal(len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "gives normal() the variance (error r)^2",
        """
def noisy(ranges, error, dropouts, rng):
    out = np.array([rng.normal(r, (error * r) ** 2) for r in ranges])
    out[rng.random(len(ranges)) < dropouts] = np.nan
    return out
""",
    ),
    (
        "02-noise",
        "its own chance: np.random",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + error * np.random.standard_normal(len(ranges)))
    measured[np.random.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "a new generator with a fixed seed",
        """
def noisy(ranges, error, dropouts, rng):
    rng = np.random.default_rng(0)
    measured = ranges + error * ranges * rng.standard_normal(len(ranges))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "changes ranges in place",
        """
def noisy(ranges, error, dropouts, rng):
    ranges += error * ranges * rng.standard_normal(len(ranges))
    ranges[rng.random(len(ranges)) < dropouts] = np.nan
    return ranges
""",
    ),
    (
        "02-noise",
        "the losses are the complement",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * rng.normal(1, error, len(ranges))
    kept = rng.random(len(ranges)) < dropouts
    return np.where(kept, measured, np.nan)
""",
    ),
    (
        "02-noise",
        "an exact number of beams is lost",
        """
def noisy(ranges, error, dropouts, rng):
    n = len(ranges)
    measured = ranges + error * ranges * rng.standard_normal(n)
    lost = rng.choice(n, size=round(dropouts * n), replace=False)
    measured[lost] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "lost beams return 0",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + error * rng.standard_normal(len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = 0.0
    return measured
""",
    ),
    (
        "02-noise",
        "all or none is lost",
        """
def noisy(ranges, error, dropouts, rng):
    if rng.random() < dropouts:
        return np.full(len(ranges), np.nan)
    return ranges + error * ranges * rng.standard_normal(len(ranges))
""",
    ),
    (
        "02-noise",
        "lost beams are left out",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges + error * ranges * rng.standard_normal(len(ranges))
    return measured[rng.random(len(ranges)) >= dropouts]
""",
    ),
    (
        "02-noise",
        "losses depend on the noise: the same random numbers decide both",
        """
def noisy(ranges, error, dropouts, rng):
    chance = rng.standard_normal(len(ranges))
    measured = ranges * (1 + error * chance)
    edge = np.sort(chance)[int(dropouts * len(chance)) - 1] if len(chance) and dropouts > 0 else -np.inf
    measured[chance <= edge] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "always longer: abs",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges + np.abs(error * ranges * rng.standard_normal(len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "NaN becomes a number",
        """
def noisy(ranges, error, dropouts, rng):
    r = np.nan_to_num(ranges)
    measured = r * (1 + error * rng.standard_normal(len(r)))
    measured[rng.random(len(r)) < dropouts] = np.nan
    return measured
""",
    ),
]
