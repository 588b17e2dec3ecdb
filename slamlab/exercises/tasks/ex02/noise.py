"""Task 02-noise: thousands of readings, judged by their statistics.

Every band is six standard deviations wide, so that chance fails nobody.
"""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES, NOTHING
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex02.noise_mistakes import MISTAKES, SHORT
from slamlab.exercises.tasks.ex02.readings import CALLS, each, lost_beams, same, sensors, surprise

BAND = 6.0  # standard deviations
NEVER = 1e-9  # less is no chance
ROUNDING = 1e-12


def _of(**how):
    return lambda rng: sensors(rng, **how)


def _bounded(inputs, outputs, off):
    """Whether a statistic (errors, error) is within its band for all, and something came back."""
    return all(
        off(z, error) <= BAND * error + ROUNDING if len(z) else p**count > NEVER
        for count, z, error, p in each(inputs, outputs)
    )


def _right_on_average(inputs, outputs):
    return _bounded(inputs, outputs, lambda z, error: abs(z.mean()) * np.sqrt(len(z)))


def _spread_right(inputs, outputs):
    def off(z, error):
        return abs(np.sqrt(np.mean(z**2)) - error) * np.sqrt(2 * len(z))

    return _bounded(inputs, outputs, off)


def _why_spread(inputs, outputs):
    told = [(z, error) for _, z, error, _ in each(inputs, outputs) if len(z)]
    z, error = max(told, key=lambda two: abs(np.log(np.sqrt(np.mean(two[0] ** 2)) / two[1])))
    return (
        f"{len(z)} readings of one sensor are {100 * z.mean():.3g} % too long on average, and "
        f"{100 * np.sqrt(np.mean(z**2)):.3g} % off (rms); error is {100 * error:.3g} %"
    )


def _likely(count, n, p):
    """Whether so many of n are no surprise where each has the probability p."""
    return abs(count - n * p) <= BAND * np.sqrt(n * p * (1 - p))


def _lost_by_chance(inputs, outputs):
    # two independent draws share p² of the beams, the same draw p
    return all(
        _likely(lost[0].sum(), lost.shape[1], p)
        and _likely((lost[0] & lost[2]).sum(), lost.shape[1], p**2)
        for lost, p in lost_beams(inputs, outputs)
    )


def _why_lost(inputs, outputs):
    lost, p = max(lost_beams(inputs, outputs), key=lambda two: abs(two[0][0].mean() - two[1]))
    return (
        f"of {lost.shape[1]} beams that meet something {lost[0].sum()} were lost, and "
        f"{(lost[0] & lost[2]).sum()} of these again with another seed; dropouts is {p:.3g}"
    )


def _one_by_one(inputs, outputs):
    mean, n = surprise(inputs, outputs)
    return abs(mean - 1) * n <= BAND * np.sqrt(2 * n + 4)  # 1 / (n p q) is 2 or 3: a little wider


def _why_one_by_one(inputs, outputs):
    mean, n = surprise(inputs, outputs)
    return (
        f"over {n} short scans, how many were lost varies with {mean:.2g} times the variance "
        "that it has where each beam is lost by itself"
    )


def _stayed(inputs, outputs):
    """Of each reading that was NaN, whether it still is."""
    return (outputs["state"][0] == NOTHING)[~np.isfinite(inputs["ranges"])]


def _why_nothing(inputs, outputs):
    stayed = _stayed(inputs, outputs)
    return f"of {stayed.size} readings that were NaN {np.sum(~stayed)} are NaN no more"


def _seeded(inputs, outputs):
    return same(outputs, 0, 1) and not same(outputs, 0, 2)


def _why_seeded(inputs, outputs):
    if same(outputs, 0, 1):
        return "with another seed the scan is the same"
    return "called again with the same seed it gives another scan"


EXACT = ("average", "spread", "dropouts", "nothing")

NOISE = Task(
    id="02-noise",
    title="Noise",
    drive=DRIVES["02-noise"],
    inputs=sensors,
    shapes=lambda inputs: dict.fromkeys(("state", "ranges"), (CALLS, *inputs["ranges"].shape)),
    laws=(
        Law(
            "average",
            1,
            "over thousands of readings the errors average out",
            _right_on_average,
            why=_why_spread,
            asks="Which random number has the mean 0 and is as often negative as positive?",
        ),
        Law(
            "spread",
            2,
            "their standard deviation is error · r, near and far",
            _spread_right,
            why=_why_spread,
            asks="A standard normal number has the standard deviation 1. By what do you multiply "
            "it for a reading at 10 m, and by what for one at 1 m?",
        ),
        Law(
            "dropouts",
            1,
            "the share of lost readings is dropouts, and every scan loses others",
            _lost_by_chance,
            why=_why_lost,
            asks="A number is drawn evenly from 0 to 1. With which probability is it below 0.2?",
        ),
        Law(
            "one by one",
            0.5,
            "each beam is lost whatever the others do, so their number varies",
            _one_by_one,
            why=_why_one_by_one,
            asks="Ten beams, dropouts = 0.2: in how many scans of a hundred are just two lost?",
            main=False,
        ),
        Law(
            "nothing",
            1,
            "what was NaN already stays NaN",
            lambda inputs, outputs: bool(_stayed(inputs, outputs).all()),
            why=_why_nothing,
            asks="What is NaN plus a number, and does any line of yours replace NaN?",
            alone=False,
        ),
        Law(
            "seed",
            0.5,
            "the same seed gives the same scan, another seed another one",
            _seeded,
            why=_why_seeded,
            asks="Whose random numbers do you use?",
        ),
    ),
    probes=(
        Probe(SHORT, _of(n=150, beams=15, open_=0, lost=(0.2, 0.4)), ("one by one",)),
        Probe("a sensor that loses nothing", _of(lost=(0, 0)), EXACT),
        Probe("a sensor that loses everything", _of(beams=50, lost=(1, 1)), EXACT),
        Probe("a sensor without error", _of(beams=300, error=(0, 0)), EXACT),
        Probe("nothing in sight", _of(beams=20, open_=1), EXACT),
        Probe("a scan of no beams", _of(beams=0), EXACT),
        Probe("a scan of one beam", _of(beams=1, lost=(0, 0), open_=0, near=0), EXACT),
    ),
    diagnoses=MISTAKES,
    rounds=False,
)
