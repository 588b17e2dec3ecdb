"""Statistics of many runs: medians and shares with intervals, and differences on the same run.

Two estimators on the same drives meet the same luck. Whether one is better is asked of their
difference on each drive, not of two intervals that overlap or do not.
"""

import numpy as np
from scipy.stats import binomtest, bootstrap


def median_interval(values):
    """Median and its 95 % confidence interval by bootstrap.

    Parameters
    ----------
    values : (n,)

    Returns
    -------
    list of 3: median, low, high
    """
    if min(values) == max(values):  # which has no bootstrap
        return [round(float(values[0]), 4)] * 3
    rng = np.random.default_rng(0)
    interval = bootstrap((values,), np.median, method="percentile", rng=rng).confidence_interval
    return [round(float(v), 4) for v in (np.median(values), *interval)]


def share_interval(count, total):
    """Share and its 95 % confidence interval by Wilson. Equation (12.6).

    Parameters
    ----------
    count, total : int

    Returns
    -------
    list of 3: share, low, high
    """
    interval = binomtest(count, total).proportion_ci(method="wilson")
    return [round(float(v), 4) for v in (count / total, *interval)]


def paired_difference(first, second):
    """Median of the differences on the same runs, with its 95 % confidence interval.

    What is common to both drops out. Equation (12.7).

    Parameters
    ----------
    first, second : (n,) of the same n runs

    Returns
    -------
    list of 3: median of first − second, low, high; one that leaves out zero tells them apart
    """
    return median_interval(np.subtract(first, second))


def only_one(first, second):
    """Count the runs in which something happened to one of two only; those in which it happened
    to both, or to none, say nothing about which is better (McNemar).

    Parameters
    ----------
    first, second : (n,) bool, of the same n runs

    Returns
    -------
    list of 3: to the first only, to the second only, and the p-value of equal chances
    """
    first, second = np.asarray(first, dtype=bool), np.asarray(second, dtype=bool)
    mine, other = int(np.sum(first & ~second)), int(np.sum(second & ~first))
    p = binomtest(mine, mine + other).pvalue if mine + other else 1.0
    return [mine, other, round(float(p), 4)]


def percent(share):
    """Share with its confidence interval as text, in per cent.

    Parameters
    ----------
    share : (share, low, high), or None where there were no runs

    Returns
    -------
    str
    """
    return (
        "–" if share is None else "{:.0f} % ({:.0f} % to {:.0f} %)".format(*100 * np.array(share))
    )


def cm(interval, sign=""):
    """Median with its confidence interval as text, in centimetres.

    Parameters
    ----------
    interval : (median, low, high) [m]
    sign : str, "+" for one that is always written

    Returns
    -------
    str
    """
    value, low, high = (f"{100 * v:{sign}.1f}" for v in interval)
    return f"{value} ({low} to {high})"
