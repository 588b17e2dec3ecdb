"""Noisy readings for task 02-noise: inputs, errors and dropouts."""

import numpy as np

from course.exercises.ex02_sensors_and_worlds.calls import FINITE, NOTHING

NOISY_CALLS = 3  # the second with the same seed as the first, the third with another


def sensors(rng, beams=4000, n=2, near=0.5, open_=0.025, error=(0.008, 0.03), lost=(0.08, 0.25)):
    """Sensors' inputs; ``near`` and ``open_`` are fractions of beams that meet a near wall, or no
    wall."""
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
    """Per sensor, for near and far beams: count, relative errors, their standard deviation,
    dropouts."""
    names = ("ranges", "error", "dropouts")
    for k, (true, error, p) in enumerate(zip(*(inputs[name] for name in names), strict=True)):
        back = outputs["state"][k, 0] == FINITE
        for far in (False, True):
            there = (true > 3) == far if far else true <= 3
            kept = there & back
            yield there.sum(), outputs["ranges"][k, 0][kept] / true[kept] - 1, error, p


def normalised(inputs, outputs, call):
    """Errors (n, beams) in σ; NaN where there is no reading, or no noise."""
    true, sigma = inputs["ranges"], inputs["error"][:, None]
    back = (outputs["state"][:, call] == FINITE) & (sigma > 0)
    return np.where(back, (outputs["ranges"][:, call] / true - 1) / sigma, np.nan)


def lost_beams(inputs, outputs):
    """Per sensor (NOISY_CALLS, beams) whether a possible reading was lost; and p."""
    for k, p in enumerate(inputs["dropouts"]):
        yield (outputs["state"][k] == NOTHING)[:, np.isfinite(inputs["ranges"][k])], p


def surprise(inputs, outputs):
    """Mean squared normalised number of dropouts, expected 1; and number of scans."""
    found = [
        (lost[0].sum() - lost.shape[1] * p) ** 2 / (lost.shape[1] * p * (1 - p))
        for lost, p in lost_beams(inputs, outputs)
    ]
    return np.mean(found), len(found)


def same(outputs, a, b):
    calls = [array for array in outputs.values() if array.ndim == 3]
    return all(np.array_equal(array[:, a], array[:, b]) for array in calls)
