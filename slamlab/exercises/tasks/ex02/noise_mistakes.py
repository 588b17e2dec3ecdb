"""Mistakes of task 02-noise, told by the statistics of readings: chance leaves no fingerprints."""

import numpy as np

from slamlab.exercises.drives.ex02 import FINITE
from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex02.readings import each, lost_beams, same, surprise

SHORT = "many short scans"
"""Name of the probe that shows whether beams are lost one by one."""


def _all(inputs, outputs, condition):
    """Whether errors in units of what is asked, of each sensor, near and far, are such."""
    told = [z / error for count, z, error, _ in each(inputs, outputs) if count]
    return all(len(z) and condition(z) for z in told)


def _scaled(name, hint, sigma):
    """Diagnosis: the errors have another standard deviation, near and far alike."""

    def matches(inputs, outputs):
        for true, error, state, got in zip(
            inputs["ranges"],
            inputs["error"],
            outputs["state"][:, 0],
            outputs["ranges"][:, 0],
            strict=True,
        ):
            for part in (true > 3, true <= 3):
                kept = part & (state == FINITE)
                z = (got - true)[kept] / sigma(true[kept], error)
                if not abs(np.sqrt(np.mean(z**2)) - 1) < 0.15:
                    return False
        return True

    return Diagnosis(name, hint, matches)


def _share(inputs, outputs, wrong):
    """Whether each sensor loses a wrong share of its readings, of p."""
    return all(abs(lost[0].mean() - wrong(p)) < 0.05 for lost, p in lost_beams(inputs, outputs))


def _as_many(inputs, outputs):
    """Whether over all scans nearly as many are lost as should be: all or none, five times less."""
    lost = [(lost[0].sum(), p * lost.shape[1]) for lost, p in lost_beams(inputs, outputs)]
    found, due = np.sum(lost, axis=0)
    return abs(found / due - 1) < 0.5


MISTAKES = (
    Diagnosis(
        "another-generator",
        "The same seed gives another result: draw every random number from the rng that is passed "
        "in, none from np.random or a generator of your own.",
        lambda inputs, outputs: not same(outputs, 0, 1),
    ),
    Diagnosis(
        "always-the-same",
        "Whatever the seed, the result is the same: draw from the rng that is passed in, do not "
        "make one with a fixed seed.",
        lambda inputs, outputs: same(outputs, 0, 2),
    ),
    Diagnosis(
        "zero-for-lost",
        "Lost readings are 0: whoever averages takes them for a wall at the sensor. NaN says that "
        "nothing came back.",
        lambda inputs, outputs: bool(
            ((outputs["ranges"][:, 0] == 0) & (outputs["state"][:, 0] == FINITE)).any()
        ),
    ),
    Diagnosis(
        "no-error",
        "No reading errs at all: where does error come in?",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: np.abs(z).max() < 1e-6),
    ),
    Diagnosis(
        "one-number-for-all",
        "All beams err alike. How many random numbers does a scan of n beams need?",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: np.ptp(z) < 1e-6),
    ),
    Diagnosis(
        "one-sided",
        "No reading is too short: noise goes both ways. Look for an absolute value, or a random "
        "number from 0 to 1 where a normal one belongs.",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: (z > -1e-9).all()),
    ),
    _scaled(
        "does-not-grow",
        "Near and far readings err alike: error is a share of the range, so the standard deviation "
        "grows with it.",
        lambda true, error: error + 0 * true,
    ),
    _scaled(
        "variance-taken",
        "You scale by the variance, (error · r)²: a standard normal number times the standard "
        "deviation has the right spread.",
        lambda true, error: (error * true) ** 2,
    ),
    _scaled(
        "root-taken",
        "You scale by the root of error · r: that is a standard deviation already.",
        lambda true, error: np.sqrt(error * true),
    ),
    Diagnosis(
        "uniform",
        "Your noise never exceeds error · r: that is the width of a uniform draw, not a standard "
        "deviation. A normal draw goes beyond it in one of three cases.",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: abs(z).max() < 1 + 1e-6),
    ),
    Diagnosis(
        "kept-for-lost",
        "The share dropouts is kept, the rest is lost: look at the direction of the comparison.",
        lambda inputs, outputs: _share(inputs, outputs, lambda p: 1 - p),
    ),
    Diagnosis(
        "nothing-lost",
        "No beam is ever lost: where do dropouts come in?",
        lambda inputs, outputs: not any(lost.any() for lost, _ in lost_beams(inputs, outputs)),
    ),
    Diagnosis(
        "the-same-beams-lost",
        "The same beams are lost in every scan: each is lost by chance, drawn anew.",
        lambda inputs, outputs: all(
            np.array_equal(lost[0], lost[2]) for lost, _ in lost_beams(inputs, outputs)
        ),
    ),
    Diagnosis(  # by chance the mean is 1 ± 0.12, and within a band of 0.7
        "a-fixed-number-lost",
        "In every scan just as many are lost. Each beam is lost by itself, whatever the others do, "
        "so the number varies from scan to scan.",
        lambda inputs, outputs: surprise(inputs, outputs)[0] < 0.3,
        on=SHORT,
    ),
    Diagnosis(
        "all-or-none",
        "One number decides about all beams of a scan, or about a whole run of them. Each is lost "
        "by itself.",
        lambda inputs, outputs: surprise(inputs, outputs)[0] > 3 and _as_many(inputs, outputs),
        on=SHORT,
    ),
)
