"""Perturbed rounding: numpy gets other last bits, as on another processor, in every fourth number.

Put this folder first on PYTHONPATH. Processors differ in the last bit of sines, angles and
products; results that depend on that bit differ from machine to machine. OTHER_PROCESSOR=2 and so
on emulate further processors.
"""

import os

import numpy as np

ODD = np.uint64(0x9E3779B97F4A7C15 + 2 * int(os.environ.get("OTHER_PROCESSOR", "1")))

NAMES = ["sin", "cos", "tan", "exp", "log", "arctan2", "arctan", "arcsin", "arccos", "hypot"]


def nudged(found: np.ndarray) -> np.ndarray:
    """Return numbers (...), a quarter of them one bit nearer to zero; 0 and ±1 stay exact."""
    bits = found.view(np.uint64) * ODD
    chosen = (bits >> np.uint64(62) == 0) & (found != 0) & (np.abs(found) != 1)
    return np.where(chosen & np.isfinite(found), np.nextafter(found, 0), found)


class Nudged:
    """A ufunc whose results are nudged; its methods, such as ``outer``, do not change."""

    def __init__(self, exact):
        self.exact = exact
        self.__name__, self.__doc__ = exact.__name__, exact.__doc__

    def __call__(self, *values, **named):
        found = self.exact(*values, **named)
        if isinstance(found, np.float64):
            return nudged(np.atleast_1d(found))[0]
        if type(found) is not np.ndarray or found.dtype != np.float64:
            return found
        if "out" in named or "where" in named:
            found[...] = nudged(found)
            return found
        return nudged(found)

    def __getattr__(self, name):
        return getattr(self.exact, name)


for name in NAMES:
    setattr(np, name, Nudged(getattr(np, name)))
