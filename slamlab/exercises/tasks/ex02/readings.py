"""Noisy readings: what they are made of, and what was lost or erred; for the task of noise."""

import numpy as np

from slamlab.exercises.drives.ex02 import FINITE, NOTHING

CALLS = 3  # the second with the same seed as the first, the third with another


def sensors(rng, beams=4000, n=2, near=0.5, open_=0.025, error=(0.008, 0.03), lost=(0.08, 0.25)):
    """Sensors with near and far ranges and some directions in which there is nothing.

    Parameters
    ----------
    rng : numpy.random.Generator
    beams, n : int, how many beams a sensor has, and how many sensors
    near, open_ : float, share of the beams that meet something near, or nothing
    error, lost : (low, high)
    """
    ranges = np.where(
        rng.random((n, beams)) < near, rng.uniform(0.4, 1.2, (n, beams)), rng.uniform(6, 10, (n, 1))
    )
    ranges[rng.random(ranges.shape) < open_] = np.nan
    return {
        "ranges": ranges,
        "error": rng.uniform(*error, n),
        "dropouts": rng.uniform(*lost, n),
        "seed": rng.integers(1, 2**31, n).astype(float),
    }


def each(inputs, outputs):
    """For each sensor and for near and far beams: how many there are, errors of the readings that
    came back, as shares of the range, and what they should spread by; and dropouts."""
    names = ("ranges", "error", "dropouts")
    for k, (true, error, p) in enumerate(zip(*(inputs[name] for name in names), strict=True)):
        back = outputs["state"][k, 0] == FINITE
        for far in (False, True):
            there = (true > 3) == far if far else true <= 3
            kept = there & back
            yield there.sum(), outputs["ranges"][k, 0][kept] / true[kept] - 1, error, p


def lost_beams(inputs, outputs):
    """For each sensor (CALLS, beams) whether a reading was lost that could have come; and p."""
    for k, p in enumerate(inputs["dropouts"]):
        yield (outputs["state"][k] == NOTHING)[:, np.isfinite(inputs["ranges"][k])], p


def surprise(inputs, outputs):
    """Mean over scans of the squared surprise at how many were lost, 1 by chance; and how many."""
    found = [
        (lost[0].sum() - lost.shape[1] * p) ** 2 / (lost.shape[1] * p * (1 - p))
        for lost, p in lost_beams(inputs, outputs)
    ]
    return np.mean(found), len(found)


def same(outputs, a, b):
    """Whether two calls had the same result for every sensor."""
    calls = [array for array in outputs.values() if array.ndim == 3]
    return all(np.array_equal(array[:, a], array[:, b]) for array in calls)
