"""Exercise 02, the task of finding the noise again, over many sets of repeated scans.

The judge looks at the same scans with an estimator of its own, so that chance is common to both:
an honest estimate is as large on average, and does not scatter far from it.
"""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

SETS, SCANS, BEAMS, OPEN, AGAIN = 40, 25, 36, 5, 5
BIAS = 0.08  # a divisor of k instead of k - 1 makes 2 %, a median some more
SCATTER = 0.09  # a median makes 4 %, a single beam 17 %
SHARE = 0.02


def inputs(rng):
    """Repeated scans of sensors at rest; the truth is in no array.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"scans": (n, k, beams), "again": (m,)}
    """
    truth = rng.uniform(0.5, 9, (SETS, 1, BEAMS))
    error, dropouts = rng.uniform(0.004, 0.03, (SETS, 1, 1)), rng.uniform(0.05, 0.25, (SETS, 1, 1))
    scans = truth * (1 + error * rng.standard_normal((SETS, SCANS, BEAMS)))
    scans[rng.random(scans.shape) < dropouts] = np.nan
    for scan in scans:
        scan[:, rng.choice(BEAMS, OPEN, replace=False)] = np.nan
    return {"scans": scans, "again": np.ones(AGAIN)}


def _seen(i):
    """(n, k, beams - OPEN) the beams that ever returned anything."""
    scans = i["scans"]
    some = ~np.isnan(scans).all(axis=1)
    return np.array([scan[:, those] for scan, those in zip(scans, some, strict=True)])


def _error(i):
    """(n,) pooled standard deviation as a share of the range."""
    seen = _seen(i)
    share = seen / np.nanmean(seen, axis=1, keepdims=True) - 1
    freedom = (~np.isnan(seen)).sum(axis=(1, 2)) - seen.shape[2]
    return np.sqrt(np.nansum(share**2, axis=(1, 2)) / freedom)


def _dropouts(i):
    return np.isnan(_seen(i)).mean(axis=(1, 2))


def _ratio(i, o):
    return o["fit"][:, 0] / _error(i)


def _on_average(i, o):
    return abs(_ratio(i, o).mean() - 1) < BIAS


def _all_used(i, o):
    ratio = _ratio(i, o)
    return ratio.std() < SCATTER * abs(ratio.mean())


def _any_unit(i, o):
    return abs(o["in_mm"][:, 0] - o["fit"][:AGAIN, 0]) <= 1e-6 * abs(o["fit"][:AGAIN, 0])


def _share_right(i, o):
    return abs(o["fit"][:, 1] / _dropouts(i) - 1) < SHARE


def _error_is(formula, tolerance):
    """Whether the error of every set follows a wrong formula of (n, k, beams) readings."""
    return lambda i, o: (abs(o["fit"][:, 0] / formula(_seen(i)) - 1) < tolerance).all()


def _share_is(formula):
    return lambda i, o: bool((abs(o["fit"][:, 1] - formula(i)) < 1e-3 * formula(i)).all())


def _filled(seen):
    """The error where every NaN is taken for 0."""
    zeros = np.nan_to_num(seen)
    return (zeros.std(axis=1) / zeros.mean(axis=1)).mean(axis=1)


def _by_mean_range(seen):
    variances = np.nanvar(seen, axis=1, ddof=1).mean(axis=1)
    return np.sqrt(variances) / np.nanmean(seen, axis=(1, 2))


FIT = Task(
    id="02-fit",
    title="How noisy was it?",
    drive=DRIVES["02-fit"],
    inputs=inputs,
    shapes={"fit": (SETS, 2), "in_mm": (AGAIN, 2)},
    laws=(
        Law("error", 2, "over many sensors the error found is right on average", _on_average),
        Law("all beams", 1, "no estimate is far off: all beams are used", _all_used),
        Law("any unit", 1, "the same scans in millimetres have the same error", _any_unit),
        Law(
            "dropouts",
            2,
            "dropouts is the share lost among the beams that ever return anything",
            _share_right,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "order swapped",
            "The two numbers have changed places: return error, dropouts.",
            lambda i, o: (abs(o["fit"][:, 0] / _dropouts(i) - 1) < 0.2).all(),
        ),
        Diagnosis(
            "in metres",
            "Your error is a standard deviation in metres: in millimetres it would be a thousand "
            "times as large. Divide by the range, beam by beam.",
            lambda i, o: (abs(o["in_mm"][:, 0] / o["fit"][:AGAIN, 0] / 1000 - 1) < 1e-3).all(),
        ),
        Diagnosis(
            "variance",
            "Your error is the square of what is asked: a variance, where a standard deviation "
            "belongs.",
            lambda i, o: abs(np.median(o["fit"][:, 0] / _error(i) ** 2) - 1) < 0.15,
        ),
        Diagnosis(
            "zeros for NaN",
            "Lost readings take part as zeros: they make the spread huge. Leave them out "
            "(np.nanmean, np.nanstd).",
            _error_is(_filled, 0.15),
        ),
        Diagnosis(
            "beams mixed",
            "Different beams measure different distances: their spread is the room's, not the "
            "sensor's. Compare readings of the same beam only, down a column.",
            lambda i, o: np.median(_ratio(i, o)) > 5,
        ),
        Diagnosis(
            "one range for all",
            "You divide by the mean range of all beams, but the far ones are noisier: they weigh "
            "too much. Make shares first, beam by beam.",
            _error_is(_by_mean_range, 0.05),
        ),
        Diagnosis(
            "one beam",
            "Right on average, but each estimate scatters widely: it rests on too few readings. "
            "Use all the beams.",
            lambda i, o: _on_average(i, o) and not _all_used(i, o),
        ),
        Diagnosis(
            "open beams counted",
            "Beams that look into the open are counted as dropouts: a column without a single "
            "return is no dropout.",
            _share_is(lambda i: np.isnan(i["scans"]).mean(axis=(1, 2))),
        ),
        Diagnosis(
            "share kept",
            "dropouts is the share that was lost; you return the share that came back.",
            _share_is(lambda i: 1 - _dropouts(i)),
        ),
        Diagnosis(
            "number lost",
            "You return how many were lost; asked is the share, a number from 0 to 1.",
            _share_is(lambda i: np.isnan(_seen(i)).sum(axis=(1, 2))),
        ),
        Diagnosis(
            "beams ever lost",
            "You count beams that were lost at least once. A dropout is a single reading.",
            _share_is(lambda i: np.isnan(_seen(i)).any(axis=1).mean(axis=1)),
        ),
    ),
)
