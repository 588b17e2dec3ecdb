"""Statistics of Monte Carlo runs: medians, shares and paired differences with confidence intervals.

A paired difference compares two estimators on the same runs, and thus with the same noise.
"""

import numpy as np
from scipy.stats import binomtest, bootstrap


def median_interval(values, statistic=np.median):
    """Return the median of values (n,), or another statistic, and its 95 % bootstrap confidence
    interval: median, low, high."""
    if min(values) == max(values):  # equal values have no bootstrap interval
        return [round(float(values[0]), 4)] * 3
    rng = np.random.default_rng(0)
    interval = bootstrap((values,), statistic, method="percentile", rng=rng).confidence_interval
    return [round(float(v), 4) for v in (statistic(values), *interval)]


def mean_interval(values):
    """Return the mean of values (n,) and its 95 % bootstrap confidence interval: mean, low, high.

    The mean of shares of runs of equal length is the share in all runs together.
    """
    return median_interval(values, np.mean)


def share_interval(count, total):
    """Return a share and its 95 % Wilson confidence interval: share, low, high. Equation (12.6)."""
    interval = binomtest(count, total).proportion_ci(method="wilson")
    return [round(float(v), 4) for v in (count / total, *interval)]


def paired_difference(first, second):
    """Return the median of first − second on the same runs and its 95 % interval. Equation (12.7).

    The difference is significant if the interval does not contain zero.
    """
    return median_interval(np.subtract(first, second))


def mcnemar_test(first, second):
    """Return McNemar's test of paired events (n,): how often only the first and only the second
    occurred, and the p-value."""
    first, second = np.asarray(first, dtype=bool), np.asarray(second, dtype=bool)
    mine, other = int(np.sum(first & ~second)), int(np.sum(second & ~first))
    p = binomtest(mine, mine + other).pvalue if mine + other else 1.0
    return [mine, other, round(float(p), 4)]


def percent(share):
    """Format (share, low, high) in per cent, and None as a dash."""
    return (
        "–" if share is None else "{:.0f} % ({:.0f} % to {:.0f} %)".format(*100 * np.array(share))
    )


def cm(interval, sign=""):
    """Format (median, low, high) [m] in centimetres."""
    value, low, high = (f"{100 * v:{sign}.1f}" for v in interval)
    return f"{value} ({low} to {high})"
