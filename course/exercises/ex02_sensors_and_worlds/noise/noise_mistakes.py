"""Mistakes of task 02-noise, diagnosed by the statistics of readings."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis
from course.exercises.ex02_sensors_and_worlds.calls import FINITE
from course.exercises.ex02_sensors_and_worlds.noise.readings import each, lost_beams, same, surprise

SHORT = "many short scans"
"""Name of the probe that shows whether beams are lost one by one."""


def _all(inputs, outputs, condition):
    told = [z / error for count, z, error, _ in each(inputs, outputs) if count]
    return all(len(z) and condition(z) for z in told)


def _scaled(name, hint, sigma, asks):
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

    return Diagnosis(name, hint, matches, asks=asks)


def _share(inputs, outputs, wrong):
    return all(abs(lost[0].mean() - wrong(p)) < 0.05 for lost, p in lost_beams(inputs, outputs))


def _as_many(inputs, outputs):
    lost = [(lost[0].sum(), p * lost.shape[1]) for lost, p in lost_beams(inputs, outputs)]
    found, due = np.sum(lost, axis=0)
    return abs(found / due - 1) < 0.5


MISTAKES = (
    Diagnosis(
        "another-generator",
        "Two calls with the same seed give different results. Draw all random numbers from the "
        "argument rng, not from np.random and not from your own generator.",
        lambda inputs, outputs: not same(outputs, 0, 1),
        asks="From which object do your random numbers come? Does the same seed give the "
        "same result twice?",
    ),
    Diagnosis(
        "always-the-same",
        "Every seed gives the same result. Draw from the argument rng, not from a generator with "
        "a fixed seed.",
        lambda inputs, outputs: same(outputs, 0, 2),
        asks="Which generator draws your random numbers, and which seed does it have?",
    ),
    Diagnosis(
        "zero-for-lost",
        "Your lost readings are 0, which would mean a wall at the sensor. Use NaN for no return.",
        lambda inputs, outputs: bool(
            ((outputs["ranges"][:, 0] == 0) & (outputs["state"][:, 0] == FINITE)).any()
        ),
        asks="Which value do your lost readings have, and what would this value mean on a map?",
    ),
    Diagnosis(
        "no-error",
        "Your readings have no noise. Where do you use error?",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: np.abs(z).max() < 1e-6),
        asks="On which lines of your code does `error` have an effect?",
    ),
    Diagnosis(
        "one-number-for-all",
        "All beams have the same error. How many random numbers does a scan of n beams need?",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: np.ptp(z) < 1e-6),
        asks="How many random numbers do you draw for a scan of 300 beams?",
    ),
    Diagnosis(
        "one-sided",
        "None of your readings is too short, but noise has both signs. Do you use an absolute "
        "value, or a uniform random number in place of a normal one?",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: (z > -1e-9).all()),
        asks="How many of your readings are shorter than the true range?",
    ),
    _scaled(
        "does-not-grow",
        "Near and far readings have the same noise. Its standard deviation is error times the "
        "range, so it grows with the range.",
        lambda true, error: error + 0 * true,
        asks="How large is the noise of your readings at 1 m, and how large is it at 10 m?",
    ),
    _scaled(
        "variance-taken",
        "You scale by the variance, (error · r)². Multiply a standard normal number by the "
        "standard deviation.",
        lambda true, error: (error * true) ** 2,
        asks="Which unit has the number by which you multiply a standard normal number?",
    ),
    _scaled(
        "root-taken",
        "You scale by the square root of error · r, but error · r is already the standard "
        "deviation.",
        lambda true, error: np.sqrt(error * true),
        asks="Which unit has the number by which you multiply a standard normal number?",
    ),
    _scaled(
        "per-cent",
        "Your noise is a hundred times too small. error is a fraction and not a percentage: 0.02 "
        "is 2 %.",
        lambda true, error: error * true / 100,
        asks="How large is the noise of your readings at 10 m if error is 0.02?",
    ),
    Diagnosis(
        "uniform",
        "Your noise never exceeds error · r, like a uniform random number. Normally distributed "
        "noise exceeds its standard deviation in one of three cases.",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: 0.3 < abs(z).max() < 1 + 1e-6),
        asks="How large is the largest error of your readings, compared with error · r?",
    ),
    Diagnosis(
        "kept-for-lost",
        "Your probability of a dropout is 1 − dropouts. Reverse the comparison.",
        lambda inputs, outputs: _share(inputs, outputs, lambda p: 1 - p),
        asks="How many of your beams are lost if dropouts is 0.1?",
    ),
    Diagnosis(
        "nothing-lost",
        "None of your beams is lost. Where do you use dropouts?",
        lambda inputs, outputs: not any(lost.any() for lost, _ in lost_beams(inputs, outputs)),
        asks="How many of your beams are lost if dropouts is 0.5?",
    ),
    Diagnosis(
        "the-same-beams-lost",
        "Mostly the same beams are lost in every scan. Draw a new random number for each beam of "
        "each scan.",
        lambda inputs, outputs: all(
            (lost[0] & lost[2]).sum() > 0.7 * lost[0].sum()
            for lost, _ in lost_beams(inputs, outputs)
        ),
        asks="Which beams are lost in two calls with different seeds?",
    ),
    Diagnosis(  # by chance the mean is 1 ± 0.12, and within a band of 0.7
        "a-fixed-number-lost",
        "The same number of beams is lost in every scan. Each beam is lost independently of the "
        "others, so this number varies.",
        lambda inputs, outputs: surprise(inputs, outputs)[0] < 0.3,
        on=SHORT,
        asks="Throw a coin for each of ten beams. Is the number of heads always five?",
    ),
    Diagnosis(
        "all-or-none",
        "You use one random number for all beams of a scan, or for several neighbouring beams. "
        "Each beam is lost independently.",
        lambda inputs, outputs: surprise(inputs, outputs)[0] > 3 and _as_many(inputs, outputs),
        on=SHORT,
        asks="How many random numbers do you draw to decide which of 300 beams are lost?",
    ),
)
