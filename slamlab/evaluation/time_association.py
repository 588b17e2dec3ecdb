"""Time association (time synchronisation) of two sets of timestamps: pairs the nearest timestamps
within a tolerance, and explains why timestamps do not match."""

import numpy as np

TOLERANCE = 0.01  # largest difference of associated timestamps, as in evo [s]
FACTORS = {
    1e-9: "nanoseconds", 1e-6: "microseconds", 1e-3: "milliseconds",
    1e3: "milliseconds", 1e6: "microseconds", 1e9: "nanoseconds",
}  # fmt: skip
FEW, MANY = 0.25, 0.75  # associated share below which a reason is sought; that confirms one [1]
CHANCE = np.inf, 2, 4  # pairs by chance if nothing, unit or offset, or both are free [1]
EPOCH = 1e8  # a larger offset of clocks is a different epoch [s]


def associate(first, second, tolerance=TOLERANCE):
    """Associate ascending timestamps (n,), (m,) [s]; return pairs of indices (k, 2). A timestamp of
    the shorter set gets the nearest one of the other within the tolerance; none is used twice."""
    if np.array_equal(first, second):
        return np.repeat(np.arange(len(first))[:, None], 2, axis=1)
    short, long = (second, first) if len(second) <= len(first) else (first, second)
    nearest, gap = nearest_timestamps(long, short)
    order = np.lexsort((gap, nearest))
    taken = np.r_[False, np.diff(nearest[order]) == 0]
    chosen = np.sort(order[(gap[order] <= tolerance) & ~taken])
    pairs = chosen, nearest[chosen]
    return np.column_stack(pairs if short is first else pairs[::-1])


def nearest_timestamps(times, stamps):
    """Return, for each timestamp, the index of the nearest of ``times``, and the difference [s]."""
    order = np.argsort(times, kind="stable")
    ordered = times[order]
    right = np.clip(np.searchsorted(ordered, stamps), 1, max(1, len(times) - 1))
    left = right - 1
    right = np.minimum(right, len(times) - 1)
    nearer = np.where(
        np.abs(ordered[left] - stamps) <= np.abs(ordered[right] - stamps), left, right
    )
    return order[nearer], np.abs(ordered[nearer] - stamps)


def associated(first, second, tolerance, names):
    """Associate like :func:`associate`, but raise ValueError with a reason if few timestamps of
    ``names`` match or if they are not ascending."""
    first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    if not len(first) or not len(second):
        raise ValueError(
            f"no pose pairs: {names[0]} has {len(first)} poses and {names[1]} {len(second)}"
        )
    if np.array_equal(first, second):
        return associate(first, second)
    for name, times in zip(names, (first, second), strict=True):
        _check_rising(name, times)
    pairs, fewest = associate(first, second, tolerance), min(len(first), len(second))
    few = len(pairs) < FEW * fewest
    why = _indices(first, second, names) if few or len(pairs) < len(first) == len(second) else ""
    if few and not why:
        why = explanation(first, second, tolerance, names)
    by_chance = 1  # as many pairs as after an arbitrary shift
    if few and not _are_regular((first, second), tolerance):
        by_chance = 2 + 2 * len(associate(first + 3 * tolerance, second, tolerance))
    if why or len(pairs) <= min(by_chance, fewest - 1):
        raise ValueError(
            f"{len(pairs)} of {len(first)} timestamps of {names[0]} and {len(second)} of "
            f"{names[1]} match within {tolerance:g} s: {why or _nearest(first, second, names)}"
        )
    return pairs


def explanation(first, second, tolerance, names):
    """Find a unit or an offset by which most timestamps of ``names`` would match. Return it and a
    remedy in words, or "" if there is none."""
    fewest = min(len(first), len(second))
    regular = _are_regular((first, second), tolerance)
    half = max(tolerance, np.median(np.diff(second)) / 2 if len(second) > 1 else 0.0)
    trials = [(a, b) for a in (1.0, *FACTORS) for b in (0.0, second[0] - a * first[0])]
    for bound in (tolerance, half):  # the offset of regular series is only known up to their period
        best, most = None, max(MANY * fewest, 2 * len(associate(first, second, bound)))
        for factor, offset in trials:
            count = len(associate(factor * first + offset, second, bound))
            shifted = factor != 1 or not regular or abs(offset) >= 2 * half  # or in between
            if shifted and count > max(most, CHANCE[int(factor != 1) + int(offset != 0)]):
                best, most = (factor, offset), count
        if best:
            return _in_words(*best, names)
    return ""


def _are_regular(series, tolerance):
    """Whether the timestamps of each series are equally spaced, apart from a few."""
    spread = [np.percentile(np.diff(times), (15, 85)) for times in series if len(times) > 1]
    return (np.ptp(spread, axis=1) <= tolerance).all() if spread else True


def _in_words(factor, offset, names):
    causes, offset = [], offset * min(1, 1 / factor)
    if factor != 1:
        causes.append(
            f"the timestamps of {names[factor > 1]} are in {FACTORS[factor]}, not seconds: "
            f"multiply its times by {min(factor, 1 / factor):g}"
        )
    if offset:
        epochs = ", probably because one counts from 1970 and the other from its start"
        causes.append(
            f"{names[0]} begins {abs(offset):.6g} s {'before' if offset > 0 else 'after'} "
            f"{names[1]}{epochs if abs(offset) > EPOCH else ''}: if only the clocks differ, add "
            f"{offset:.15g} s to its times, or the known difference"
        )
    return "; then ".join(causes)


def _indices(first, second, names):
    """Return the reason why times do not match if they are only indices of poses."""
    for name, other, times in zip(names, names[::-1], (first, second), strict=True):
        if np.array_equal(times, np.arange(len(times))):
            return f"the times of {name} are its indices: use its timestamps, or those of {other}"
    return ""


def _nearest(first, second, names):
    """Return a remedy for timestamps whose mismatch neither a unit nor an offset explains."""
    i, j = associate(first, second, np.inf).T
    return (
        f"the nearest differ by {np.abs(first[i] - second[j]).min():.3g} s ({names[0]} is from "
        f"{first[0]:.9g} to {first[-1]:.9g} s, {names[1]} from {second[0]:.9g} to "
        f"{second[-1]:.9g} s); if they belong to one run, use a larger tolerance, or if the "
        "clocks differ, add the difference to the times"
    )


def _check_rising(name, times):
    wrong = np.flatnonzero(~(np.diff(times) > 0))
    if len(wrong):
        i = wrong[0]
        raise ValueError(
            f"the timestamps of {name} are not ascending: {times[i + 1]:.9g} s of pose {i + 1} "
            f"comes after {times[i]:.9g} s; sort the poses by time and remove duplicates, or split "
            "off a second trajectory"
        )
