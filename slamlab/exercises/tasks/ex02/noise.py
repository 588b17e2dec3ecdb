"""Task 02-noise: thousands of readings, judged by their statistics.

Every band is six standard deviations wide, so that chance fails nobody.
"""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES, FINITE, NOTHING
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Probe, Task

BAND = 6.0  # standard deviations
CALLS = 3  # the second with the same seed as the first, the third with another
NEVER = 1e-9  # less is no chance
ROUNDING = 1e-12


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


def _of(**how):
    return lambda rng: sensors(rng, **how)


def _each(inputs, outputs):
    """For each sensor and for near and far beams: how many there are, errors of the readings that
    came back, as shares of the range, and what they should spread by; and dropouts."""
    names = ("ranges", "error", "dropouts")
    for k, (true, error, p) in enumerate(zip(*(inputs[name] for name in names), strict=True)):
        back = outputs["state"][0, k] == FINITE
        for far in (False, True):
            there = (true > 3) == far if far else true <= 3
            kept = there & back
            yield there.sum(), outputs["ranges"][0, k][kept] / true[kept] - 1, error, p


def _bounded(inputs, outputs, off):
    """Whether a statistic (errors, error) is within its band for all, and something came back."""
    return all(
        off(z, error) <= BAND * error + ROUNDING if len(z) else p**count > NEVER
        for count, z, error, p in _each(inputs, outputs)
    )


def _right_on_average(inputs, outputs):
    return _bounded(inputs, outputs, lambda z, error: abs(z.mean()) * np.sqrt(len(z)))


def _spread_right(inputs, outputs):
    def off(z, error):
        return abs(np.sqrt(np.mean(z**2)) - error) * np.sqrt(2 * len(z))

    return _bounded(inputs, outputs, off)


def _why_spread(inputs, outputs):
    told = [(z, error) for _, z, error, _ in _each(inputs, outputs) if len(z)]
    z, error = max(told, key=lambda two: abs(np.log(np.sqrt(np.mean(two[0] ** 2)) / two[1])))
    return (
        f"{len(z)} readings of one sensor are {100 * z.mean():.3g} % too long on average, and "
        f"{100 * np.sqrt(np.mean(z**2)):.3g} % off (rms); error is {100 * error:.3g} %"
    )


def _lost(inputs, outputs):
    """For each sensor (CALLS, beams) whether readings were lost that could have come back; and p."""
    for k, p in enumerate(inputs["dropouts"]):
        yield (outputs["state"][:, k] == NOTHING)[:, np.isfinite(inputs["ranges"][k])], p


def _likely(count, n, p):
    """Whether so many of n are no surprise where each has the probability p."""
    return abs(count - n * p) <= BAND * np.sqrt(n * p * (1 - p))


def _lost_by_chance(inputs, outputs):
    # two independent draws share p² of the beams, the same draw p
    return all(
        _likely(lost[0].sum(), lost.shape[1], p)
        and _likely((lost[0] & lost[2]).sum(), lost.shape[1], p**2)
        for lost, p in _lost(inputs, outputs)
    )


def _why_lost(inputs, outputs):
    lost, p = max(_lost(inputs, outputs), key=lambda two: abs(two[0][0].mean() - two[1]))
    return (
        f"of {lost.shape[1]} beams that meet something {lost[0].sum()} were lost, and "
        f"{(lost[0] & lost[2]).sum()} of these again with another seed; dropouts is {p:.3g}"
    )


def _surprise(inputs, outputs):
    """Sum over scans of the squared surprise at how many were lost, and how many scans."""
    found = [
        (lost[0].sum() - lost.shape[1] * p) ** 2 / (lost.shape[1] * p * (1 - p))
        for lost, p in _lost(inputs, outputs)
    ]
    return np.sum(found), len(found)


def _one_by_one(inputs, outputs):
    chi2, n = _surprise(inputs, outputs)
    return abs(chi2 - n) <= BAND * np.sqrt(2 * n + 4)  # 1 / (n p q) is 2 or 3: a little wider


def _why_one_by_one(inputs, outputs):
    chi2, n = _surprise(inputs, outputs)
    return (
        f"over {n} short scans, how many were lost varies with {chi2 / n:.2g} times the variance "
        "that it has where each beam is lost by itself"
    )


def _nothing_stays(inputs, outputs):
    return bool((outputs["state"][0] == NOTHING)[~np.isfinite(inputs["ranges"])].all())


def _same(outputs, a, b):
    return all(np.array_equal(array[a], array[b]) for array in outputs.values() if array.ndim == 3)


def _seeded(inputs, outputs):
    return _same(outputs, 0, 1) and not _same(outputs, 0, 2)


def _all(inputs, outputs, condition):
    """Whether errors in units of what is asked, of each sensor, near and far, are such."""
    told = [z / error for count, z, error, _ in _each(inputs, outputs) if count]
    return all(len(z) and condition(z) for z in told)


def _scaled(name, hint, sigma):
    """Diagnosis: the errors have another standard deviation, near and far alike."""

    def matches(inputs, outputs):
        for true, error, state, got in zip(
            inputs["ranges"], inputs["error"], outputs["state"][0], outputs["ranges"][0], strict=True
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
    return all(abs(lost[0].mean() - wrong(p)) < 0.05 for lost, p in _lost(inputs, outputs))


MISTAKES = (
    Diagnosis(
        "another-generator",
        "The same seed gives another result: draw every random number from the rng that is passed "
        "in, none from np.random or a generator of your own.",
        lambda inputs, outputs: not _same(outputs, 0, 1),
    ),
    Diagnosis(
        "always-the-same",
        "Whatever the seed, the result is the same: draw from the rng that is passed in, and do not "
        "make one with a fixed seed.",
        lambda inputs, outputs: _same(outputs, 0, 2),
    ),
    Diagnosis(
        "zero-for-lost",
        "Lost readings are 0: whoever averages takes them for a wall at the sensor. NaN says that "
        "nothing came back.",
        lambda inputs, outputs: bool(
            ((outputs["ranges"][0] == 0) & (outputs["state"][0] == FINITE)).any()
        ),
    ),
    Diagnosis(
        "one-number-for-all",
        "All beams err alike. How many random numbers does a scan of n beams need?",
        lambda inputs, outputs: _all(inputs, outputs, lambda z: np.ptp(z) < 1e-6),
    ),
    Diagnosis(
        "one-sided",
        "No reading is too short: noise goes both ways. Look for an absolute value, or for a random "
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
        "The share dropouts is kept, and the rest is lost: look at the direction of the comparison.",
        lambda inputs, outputs: _share(inputs, outputs, lambda p: 1 - p),
    ),
    Diagnosis(
        "nothing-lost",
        "No beam is ever lost: where do dropouts come in?",
        lambda inputs, outputs: not any(lost.any() for lost, _ in _lost(inputs, outputs)),
    ),
    Diagnosis(
        "the-same-beams-lost",
        "The same beams are lost in every scan: each is lost by chance, drawn anew.",
        lambda inputs, outputs: all(
            np.array_equal(lost[0], lost[2]) for lost, _ in _lost(inputs, outputs)
        ),
    ),
)
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
            "the share of lost readings is dropouts, others in every scan",
            _lost_by_chance,
            why=_why_lost,
            asks="A number is drawn evenly from 0 to 1. With which probability is it below 0.2?",
        ),
        Law(
            "one by one",
            0.5,
            "each beam is lost whatever the others do: so how many are lost varies",
            _one_by_one,
            why=_why_one_by_one,
            asks="Ten beams, dropouts = 0.2: in how many scans of a hundred are just two lost?",
            main=False,
        ),
        Law(
            "nothing",
            1,
            "where there is nothing nothing comes back",
            _nothing_stays,
            asks="What is NaN plus a number, and does any line of yours replace NaN?",
        ),
        Law(
            "seed",
            0.5,
            "the same seed gives the same scan, another seed another one",
            _seeded,
            asks="Whose random numbers do you use?",
        ),
    ),
    probes=(
        Probe("many short scans", _of(n=150, beams=15, open_=0, lost=(0.2, 0.4)), ("one by one",)),
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
