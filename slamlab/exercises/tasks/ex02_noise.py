"""Exercise 02, the task of noise: thousands of readings, judged by their statistics.

Every band is six standard deviations wide, so that chance fails nobody.
"""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES, FINITE, NOTHING
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

SENSORS, BEAMS, OPEN = 2, 4000, 100
BAND = 6.0  # standard deviations
CALLS = 3  # the third with another seed


def inputs(rng):
    """Sensors with near and far ranges and some directions in which there is nothing.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"ranges": (n, k), "error": (n,), "dropouts": (n,), "seed": (n,)}
    """
    half = (SENSORS, BEAMS // 2)
    ranges = np.hstack([rng.uniform(0.4, 1.2, half), rng.uniform(6, 10, half)])
    ranges = rng.permuted(ranges, axis=1)
    for row in ranges:
        row[rng.choice(BEAMS, OPEN, replace=False)] = np.nan
    return {
        "ranges": ranges,
        "error": rng.uniform(0.008, 0.03, SENSORS),
        "dropouts": rng.uniform(0.08, 0.25, SENSORS),
        "seed": rng.integers(1, 2**31, SENSORS).astype(float),
    }


def _samples(i, o):
    """For each sensor: true ranges and errors of the readings that came back [m]."""
    for k, true in enumerate(i["ranges"]):
        kept = np.isfinite(true) & (o["state"][0, k] == FINITE)
        yield true[kept], o["ranges"][0, k][kept] - true[kept]


def _each(i, o, value):
    """(n,) value(true, errors, error) of each sensor."""
    return np.array([value(*two, e) for two, e in zip(_samples(i, o), i["error"], strict=True)])


def _far(true):
    return true > 3


def _right_on_average(i, o):
    def off(true, errors, error):
        z = errors / (error * true)
        return abs(z.mean()) * np.sqrt(len(z)) if len(z) else np.inf

    return _each(i, o, off) < BAND


def _spread(i, o, expected):
    """(n, 2) near and far: root mean square of errors over what is expected of (true, error)."""

    def both(true, errors, error):
        z = errors / expected(true, error)
        return [np.sqrt(np.mean(z[part] ** 2)) for part in (~_far(true), _far(true))]

    return _each(i, o, both)


def _spread_right(i, o):
    def off(true, errors, error):
        z = errors / (error * true)
        parts = (z[~_far(true)], z[_far(true)])
        return [abs(p.std() - 1) * np.sqrt(2 * len(p)) if len(p) else np.inf for p in parts]

    return (_each(i, o, off) < BAND).all(axis=1)


def _lost(i, o):
    """(CALLS, n, k - OPEN) whether a reading that could have come back was lost."""
    there = np.isfinite(i["ranges"])
    return np.array([(s[there] == NOTHING).reshape(SENSORS, -1) for s in o["state"]])


def _lost_by_chance(i, o):
    lost, p = _lost(i, o), i["dropouts"]
    n = lost.shape[2]
    share_right = abs(lost[0].mean(axis=1) - p) < BAND * np.sqrt(p * (1 - p) / n)
    # two independent draws share p² of the beams, the same draw p
    not_the_same = (lost[0] & lost[2]).mean(axis=1) < (p**2 + p) / 2
    return share_right & not_the_same


def _nothing_stays(i, o):
    return (o["state"][0] == NOTHING)[~np.isfinite(i["ranges"])]


def _same(o, a, b):
    return bool((o["state"][a] == o["state"][b]).all() and (o["ranges"][a] == o["ranges"][b]).all())


def _seeded(i, o):
    return _same(o, 0, 1) and not _same(o, 0, 2)


def _scaled(name, hint, expected):
    """Diagnosis: the errors have another standard deviation, near and far alike."""
    return Diagnosis(name, hint, lambda i, o: (abs(_spread(i, o, expected) - 1) < 0.15).all())


def _all_z(i, o, condition):
    return all(
        len(true) and condition(errors / (error * true))
        for (true, errors), error in zip(_samples(i, o), i["error"], strict=True)
    )


NOISE = Task(
    id="02-noise",
    title="Noise",
    drive=DRIVES["02-noise"],
    inputs=inputs,
    shapes={"state": (CALLS, SENSORS, BEAMS), "ranges": (CALLS, SENSORS, BEAMS)},
    laws=(
        Law("average", 1, "over thousands of readings the errors average out", _right_on_average),
        Law("spread", 2, "their standard deviation is error * r, near and far", _spread_right),
        Law(
            "dropouts",
            1,
            "the share of lost readings is dropouts, others in every scan",
            _lost_by_chance,
        ),
        Law("nothing", 1, "where there is nothing nothing comes back", _nothing_stays),
        Law("seed", 1, "the same seed gives the same scan, another seed another one", _seeded),
    ),
    diagnoses=(
        Diagnosis(
            "another generator",
            "The same seed gives another result: draw every random number from the rng that is "
            "passed in, none from np.random or a generator of your own.",
            lambda i, o: not _same(o, 0, 1),
        ),
        Diagnosis(
            "always the same",
            "Whatever the seed, the result is the same: draw from the rng that is passed in; do "
            "not make one with a fixed seed.",
            lambda i, o: _same(o, 0, 2),
        ),
        Diagnosis(
            "zero for lost",
            "Lost readings are 0: whoever averages takes them for a wall at the sensor. Use NaN.",
            lambda i, o: ((o["ranges"][0] == 0) & (o["state"][0] == FINITE)).any(),
        ),
        Diagnosis(
            "one number for all",
            "All beams err alike: draw one number for each beam (the size of ranges).",
            lambda i, o: _all_z(i, o, lambda z: np.ptp(z) < 1e-6),
        ),
        Diagnosis(
            "one-sided",
            "No reading is too short: noise goes both ways. Look for an abs or a rng.random where "
            "a standard normal belongs.",
            lambda i, o: _all_z(i, o, lambda z: (z > -1e-9).all()),
        ),
        _scaled(
            "does not grow",
            "Near and far readings err alike: error is a share of the range, so the deviation "
            "grows with it.",
            lambda true, error: error + 0 * true,
        ),
        _scaled(
            "variance taken",
            "You scale by the variance, (error * r)²: a standard normal times the standard "
            "deviation has the right spread.",
            lambda true, error: (error * true) ** 2,
        ),
        _scaled(
            "root taken",
            "You scale by the root of error * r: that is a standard deviation already.",
            lambda true, error: np.sqrt(error * true),
        ),
        Diagnosis(
            "uniform",
            "Your noise never exceeds error * r: that is the width of a uniform draw, not a "
            "standard deviation. A normal draw goes beyond it in one of three cases.",
            lambda i, o: _all_z(i, o, lambda z: abs(z).max() < 1 + 1e-6),
        ),
        Diagnosis(
            "kept for lost",
            "The share dropouts is kept, the rest lost: look at the direction of the comparison.",
            lambda i, o: (abs(_lost(i, o)[0].mean(axis=1) - (1 - i["dropouts"])) < 0.05).all(),
        ),
        Diagnosis(
            "nothing lost",
            "No beam is ever lost: where do dropouts come in?",
            lambda i, o: not _lost(i, o)[0].any(),
        ),
        Diagnosis(
            "always the same beams",
            "The same beams are lost in every scan: each is lost by chance, drawn anew.",
            lambda i, o: (_lost(i, o)[0] == _lost(i, o)[2]).all() and _lost(i, o)[0].any(),
        ),
    ),
)
