"""Task 02-noise: thousands of readings, judged by their statistics."""
# Every band is six standard deviations wide, so that chance fails nobody.

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex02_sensors_and_worlds.calls import CALLS, NOTHING
from course.exercises.ex02_sensors_and_worlds.noise.noise_mistakes import MISTAKES, SHORT
from course.exercises.ex02_sensors_and_worlds.noise.readings import (
    NOISY_CALLS,
    each,
    lost_beams,
    normalised,
    same,
    sensors,
    surprise,
)

BAND = 6.0  # standard deviations
NEVER = 1e-9  # less is no chance
BEYOND = (1, 0.3173), (2, 0.0455), (2.6, 0.00932)  # σ, and how many normal errors are larger
ROUNDING = 1e-12


def _of(**how):
    return lambda rng: sensors(rng, **how)


def _bounded(inputs, outputs, off):
    return all(
        off(z, error) <= BAND * error + ROUNDING if len(z) else p**count > NEVER
        for count, z, error, p in each(inputs, outputs)
    )


def _rms(z):
    return np.sqrt(np.mean(z**2))


def _right_on_average(inputs, outputs):
    # errors that spread too far have a mean that does: so it is judged by what they do spread
    def off(z, error):
        return abs(z.mean()) * np.sqrt(len(z)) * min(1, error / max(_rms(z), ROUNDING))

    return _bounded(inputs, outputs, off)


def _spread_right(inputs, outputs):
    def off(z, error):
        return abs(_rms(z) - error) * np.sqrt(2 * len(z))

    z = normalised(inputs, outputs, 0)
    count = np.isfinite(z).sum()
    sides = [(side * z, t, p) for side in (1, -1) for t, p in BEYOND]
    normal = all(_likely((z > t).sum(), count, p / 2, 4) for z, t, p in sides)
    return _bounded(inputs, outputs, off) and normal and _unrelated(z[:, 1:], z[:, :-1])


def _unrelated(a, b):
    # by what the errors do spread, and about their mean: other laws judge both
    a, b = (z[np.isfinite(a * b)] for z in (a, b))
    if not a.size:
        return True
    a, b = a - a.mean(), b - b.mean()
    return abs(a @ b) <= (BAND * np.sqrt(a.size) + 20) * max(_rms(a) * _rms(b), ROUNDING)


def _told(inputs, outputs, off):
    told = [(z, error) for _, z, error, _ in each(inputs, outputs) if len(z)]
    if not told:
        return "there is no valid reading"
    z, error = max(told, key=lambda two: off(*two))
    return (
        f"{len(z)} reading{'' if len(z) == 1 else 's'} of one sensor: {100 * z.mean():.3g} % too "
        f"long on average, rms error {100 * _rms(z):.3g} %; error is {100 * error:.3g} %"
    )


def _why_average(inputs, outputs):
    return _told(inputs, outputs, lambda z, _: abs(z.mean()) * np.sqrt(len(z)) / _rms(z))


def _why_spread(inputs, outputs):
    told = _told(
        inputs, outputs, lambda z, error: abs(_rms(z) / error - 1) if error else _rms(z) > 0
    )
    z = normalised(inputs, outputs, 0)
    related = np.nanmean(z[:, 1:] * z[:, :-1]) / np.nanmean(z**2)
    z = z[np.isfinite(z)]
    beyond = ", ".join(
        f"{np.mean(z < -t):.3f} and {np.mean(z > t):.3f} ({p / 2:.3f})" for t, p in BEYOND
    )
    return (
        f"{told}; fractions below −1 and above 1 σ, 2 σ, 2.6 σ, in brackets those of the normal "
        f"distribution: {beyond}; correlation of neighbouring beams {related:.2g}"
    )


def _likely(count, n, p, more=0):
    return abs(count - n * p) <= BAND * np.sqrt(n * p * (1 - p)) + more


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
        f"of {lost.shape[1]} beams that meet a wall {lost[0].sum()} were lost, and "
        f"{(lost[0] & lost[2]).sum()} of these again with another seed; dropouts is {p:.3g}"
    )


def _one_by_one(inputs, outputs):
    mean, n = surprise(inputs, outputs)
    return abs(mean - 1) * n <= BAND * np.sqrt(2 * n + 4)  # 1 / (n p q) is 2 or 3: a little wider


def _why_one_by_one(inputs, outputs):
    mean, n = surprise(inputs, outputs)
    return (
        f"over {n} short scans, the number of lost beams has {mean:.2g} times the variance "
        "of independent dropouts"
    )


def _filled(inputs, outputs):
    return (outputs["state"][:, 0] != NOTHING)[np.isnan(inputs["ranges"])]


def _why_filled(inputs, outputs):
    filled = _filled(inputs, outputs)
    return f"of {filled.size} ranges that are NaN, {filled.sum()} are numbers in the result"


def _seeded(inputs, outputs):
    two = (normalised(inputs, outputs, call) for call in (0, 2))
    return same(outputs, 0, 1) and not same(outputs, 0, 2) and _unrelated(*two)


def _why_seeded(inputs, outputs):
    if not same(outputs, 0, 1):
        return "a second call with the same seed returns another scan"
    if not same(outputs, 0, 2):
        return "a call with another seed gives noise that is correlated with the first"
    return "a call with another seed returns the same scan"


def _thrice(ranges):
    return len(ranges), NOISY_CALLS, ranges.shape[1]


def _noise(inputs):
    return {
        "standard deviation of the noise at 1 m and at 10 m [m]": inputs["error"][0]
        * np.array([1, 10])
    }


def _lost(inputs):
    n, p = np.isfinite(inputs["ranges"][0]).sum(), inputs["dropouts"][0]
    return {
        "lost beams of this sensor: mean and standard deviation": np.array(
            [n * p, np.sqrt(n * p * (1 - p))]
        )
    }


def _drawn(inputs):
    rng = np.random.default_rng(int(inputs["seed"][0]))
    return {"first standard normal numbers of this seed": rng.standard_normal(3)}


EXACT = ("average", "spread", "dropouts", "nothing")

NOISE = Task(
    id="02-noise",
    title="Measurement noise and dropouts",
    call=CALLS["02-noise"],
    inputs=sensors,
    shapes=lambda inputs: dict.fromkeys(("state", "ranges"), _thrice(inputs["ranges"])),
    laws=(
        Law(
            "average",
            1,
            "over thousands of readings the mean error is 0",
            _right_on_average,
            why=_why_average,
            asks="Which random numbers with mean 0 do you need, to which numbers do you add them, "
            "and does their size decide anything else?",
            step=_noise,
        ),
        Law(
            "spread",
            2,
            "the noise is normally distributed with the standard deviation error · r, for near and "
            "for far walls, and independent for each beam",
            _spread_right,
            why=_why_spread,
            asks="Which distribution have the random numbers of your noise, and has each beam its "
            "own? By which number do you multiply them for a range of 10 m, and for one of 1 m?",
            step=_noise,
        ),
        Law(
            "dropouts",
            1,
            "the fraction of lost readings is dropouts, and other beams are lost in each scan",
            _lost_by_chance,
            why=_why_lost,
            asks="With which probability is a random number below 0.2 that is uniform between 0 "
            "and 1? Which beams does your code lose with another seed?",
            step=_lost,
        ),
        Law(
            "one by one",
            0.5,
            "beams are lost independently, so the number of lost beams varies",
            _one_by_one,
            why=_why_one_by_one,
            after=("dropouts",),
            asks="A sensor has ten beams, and dropouts is 0.2. In how many of a hundred scans are "
            "exactly two beams lost?",
            main=False,
            step=_lost,
        ),
        Law(
            "nothing",
            1,
            "if a range is NaN, the reading is NaN",
            lambda inputs, outputs: not _filled(inputs, outputs).any(),
            why=_why_filled,
            asks="What is NaN plus a number? Does one of your lines replace NaN?",
            alone=False,
            step=_lost,
        ),
        Law(
            "seed",
            0.5,
            "the same seed gives the same scan, and another seed gives another scan",
            _seeded,
            why=_why_seeded,
            asks="Which generator gives your random numbers?",
            step=_drawn,
        ),
    ),
    probes=(
        Probe(SHORT, _of(n=150, beams=15, open_=0, lost=(0.2, 0.4)), ("one by one",)),
        Probe("no dropouts", _of(lost=(0, 0)), EXACT),
        Probe("every beam lost", _of(beams=50, lost=(1, 1)), EXACT),
        Probe("a sensor with much noise", _of(beams=8000, error=(0.2, 0.25)), EXACT),
        Probe("a sensor without noise", _of(beams=300, error=(0, 0)), EXACT),
        Probe("no wall within range", _of(beams=20, open_=1), EXACT),
        Probe("a scan of no beams", _of(beams=0), EXACT),
        Probe("a scan of one beam", _of(beams=1, lost=(0, 0), open_=0, near=0), EXACT),
    ),
    diagnoses=MISTAKES,
    may_round=False,
    begins=(
        "What is the mean and what is the standard deviation of 3 · rng.standard_normal(1000)?",
        "How do you decide with a uniform random number whether a beam is lost?",
    ),
)
