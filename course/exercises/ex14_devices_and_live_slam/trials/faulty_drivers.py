"""Faulty drivers of a one-byte counter, each with one fault.

A driver takes several sequences of readings (ways) and returns the counts of each, or None for an
exception.
"""

from itertools import product

import numpy as np

ROUND = 256


def ring(number):
    """Wrap a number into the range of a signed byte."""
    return (number + 128) % ROUND - 128


def counted(steps):
    """Return the counts since the first reading."""
    return np.concatenate([[0], np.cumsum(steps)])


def right(values):
    """Return the counts that a correct driver returns."""
    return counted(ring(np.diff(values))) if len(values) else np.zeros(0)


def _each(driver):
    def answers(ways, *parameter):
        return [driver(values, *parameter) if len(values) else np.zeros(0) for values in ways]

    return answers


def _steps(change):
    """Return a driver with changed steps: (raw, steps, values, parameter) -> steps."""

    def driver(values, *parameter):
        raw = np.diff(values)
        return counted(change(raw, ring(raw), values, *parameter))

    return _each(driver)


def _counts(change):
    """Return a driver with changed counts: (counts, values, parameter) -> counts."""
    return _each(lambda values, *parameter: change(right(values), values, *parameter))


def _mended_beyond(raw, steps, values, limit, side):
    mended = raw - ROUND * np.sign(raw) * (np.abs(raw) > limit)
    return np.where(np.sign(raw) == side, mended, steps)


def _mended_once(raw, steps, values):
    return np.where(np.cumsum(raw != steps) > 1, raw, steps)


def _refused(raw, steps, values, most):
    return np.where(np.abs(steps) > most, 0, steps)


def _backlash(raw, steps, values):
    turned = np.concatenate([[False], steps[1:] * steps[:-1] < 0])[: len(steps)]
    return steps - np.sign(steps) * turned


def _byte_skipped(values, byte):
    """Ignore readings of one byte: repeat the previous count, and complete the next step."""
    seen = values.copy()
    for k in np.flatnonzero(values == byte):
        seen[k] = seen[k - 1] if k else byte
    return right(seen)


def _without_repeats(values):
    return right(values)[np.concatenate([[True], np.diff(values) != 0])]


def _total_of(counts, values, bits):
    half = 2 ** (bits - 1)
    return (counts + half) % (2 * half) - half


def _needs(least):
    return lambda ways: [right(values) if len(values) >= least else None for values in ways]


def _goes_on(ways):
    found, total = [], 0
    for values in ways:
        found.append(total + right(values))
        total = found[-1][-1] if len(values) else total
    return found


def _last_kept(ways):
    found, last = [], None
    for values in ways:
        first = values[0] if len(values) and last is None else last
        found.append(ring(values[:1] - first).sum() + right(values) if len(values) else values)
        last = values[-1] if len(values) else last
    return found


def _first_lost(ways):
    return [right(values[1:] if k else values) for k, values in enumerate(ways)]


def _flag_kept(ways):
    return [right(values) if not k else values - values[:1] for k, values in enumerate(ways)]


_BYTES, _SPEEDS = range(-128, 128), [*range(-127, 0), *range(1, 128)]
_LIMITS = [*range(100, 127), *range(129, 151)]
_ONCE = [()]
FAULTS = {  # name: driver, its parameters, how many of them are drawn
    "not mended": (_steps(lambda raw, *_: raw), _ONCE, 1),
    "one side": (
        _steps(lambda raw, s, v, side: np.where(raw * side > 0, raw, s)),
        [(1,), (-1,)],
        2,
    ),
    "wrong limit": (_steps(_mended_beyond), [*product(_LIMITS, (1, -1))], 12),
    "limit at the edge": (_steps(_mended_beyond), [*product((126, 129), (1, -1))], 3),
    "255": (_steps(lambda raw, s, v, n: s + n * np.sign(s - raw)), [(-1,), (1,)], 1),
    "mended once": (_steps(_mended_once), _ONCE, 2),
    "too fast": (_steps(_refused), [(most,) for most in range(90, 127)], 7),
    "dead band": (_steps(lambda raw, s, v, b: s * (np.abs(s) > b)), [(1,), (2,), (3,)], 2),
    "one step": (_steps(lambda raw, s, v, k: s * (s != k)), [(k,) for k in _SPEEDS], 14),
    "backlash": (_steps(_backlash), _ONCE, 1),
    "never back": (_steps(lambda raw, s, v: np.maximum(s, 0)), _ONCE, 1),
    "size": (_steps(lambda raw, s, v: np.abs(s)), _ONCE, 1),
    "sign": (_steps(lambda raw, s, v: -s), _ONCE, 1),
    "one byte": (_each(_byte_skipped), [(byte,) for byte in _BYTES], 12),
    "edge byte": (_each(_byte_skipped), [(-128,), (-1,), (0,), (127,)], 2),
    "no repeats": (_each(_without_repeats), _ONCE, 3),
    "first kept": (_counts(lambda c, v: c + v[0]), _ONCE, 3),
    "few bits": (_counts(_total_of), [(bits,) for bits in range(9, 17)], 6),
    "16 bits": (_counts(_total_of), [(16,)], 2),
    "no sign": (_counts(lambda c, v, bits: c % 2**bits), [(8,), (12,), (16,)], 2),
    "short memory": (_counts(lambda c, v, most: c[-most:]), [(n,) for n in range(50, 251)], 6),
    "needs one": (_needs(1), _ONCE, 3),
    "needs two": (lambda ways: [right(v) if len(v) != 1 else None for v in ways], _ONCE, 3),
    "total kept": (_goes_on, _ONCE, 3),
    "last kept": (_last_kept, _ONCE, 3),
    "reading lost": (_first_lost, _ONCE, 2),
    "mended in the first": (_flag_kept, _ONCE, 2),
}


def drawn(rng):
    """Draw the faulty drivers, as (name of the fault, parameter)."""
    found = []
    for name, (_, parameters, count) in FAULTS.items():
        replace = count > len(parameters)
        chosen = rng.choice(len(parameters), count, replace=replace)
        found += [(name, parameters[k]) for k in chosen]
    return found


def answers(fault, ways):
    """Return the counts of a faulty driver for each sequence, None for an exception."""
    name, parameter = fault
    return FAULTS[name][0](ways, *parameter)


def is_detected(fault, ways):
    """Return whether a faulty driver differs from a correct one on at least one sequence."""
    for values, found in zip(ways, answers(fault, ways), strict=True):
        if found is None or not np.array_equal(found, right(values)):
            return True
    return False
