"""What several commands share."""

import numpy as np


def generator(seed):
    """A random generator from what a user typed; ValueError where that is negative."""
    if seed < 0:
        raise ValueError(f"--seed must not be negative, got {seed}")
    return np.random.default_rng(seed)


def damage_line(source):
    """What of a source could not be used, as the end of a line; empty where all was well."""
    kinds = ", ".join(f"{kind}: {count}" for kind, count in source.damage.items())
    return f"; damage: {kinds}" if kinds else ""
