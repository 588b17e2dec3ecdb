"""Laws: properties of every correct solution (property-based tests); diagnoses of mistakes."""

import contextlib
import functools
from collections.abc import Callable, Mapping
from contextvars import ContextVar
from dataclasses import dataclass, field

import numpy as np

from classroom.exercises.function_calls import Arrays
from classroom.exercises.function_calls.run_and_pack import MAIN

TOLERANCE = 1e-5
"""Relative tolerance: finite differences of a model are off by 1e-6, wrong formulas by far more."""
ROUNDING = 1e-9
"""Absolute tolerance: the rounding error of numbers of order 1."""

_KNOWN = ContextVar("known", default=None)


@contextlib.contextmanager
def cache_within_judging():
    """Cache results of :func:`once` within this context."""
    token = _KNOWN.set({})
    try:
        yield
    finally:
        _KNOWN.reset(token)


def once(compute):
    """Cache a function of inputs (and outputs) that several laws call."""

    @functools.wraps(compute)
    def known(*arrays):
        found = _KNOWN.get()
        if found is None:
            return compute(*arrays)
        key = compute, *map(id, arrays)
        if key not in found:
            found[key] = compute(*arrays), arrays  # keeps the arrays alive, so their ids stay valid
        return found[key][0]

    return known


@dataclass(frozen=True)
class Law:
    """A law: a property that every correct solution has (property-based test).

    main : whether the law is judged on the random inputs, and not only on the probes that list this
    law. after : laws that this law requires; while one of them is broken, this law is not reported
    as broken. alone : False for a law that a trivial answer obeys; it earns points only together
    with other laws."""

    name: str  # short; stored in the gradebook
    points: float
    says: str  # as a sentence for the student
    holds: Callable[[Arrays, Arrays], np.ndarray | bool]  # or (n,) bool, one entry per input
    want: Callable[[Arrays], Arrays] | None = None  # the right outputs, if the law determines them
    why: Callable[[Arrays, Arrays], str] | None = None  # otherwise: why the outputs are wrong
    asks: str = ""  # a guiding question, for hint
    step: Callable[[Arrays], Mapping] | str = ""  # for hint: intermediate results, or a sentence
    main: bool = True
    alone: bool = True
    after: tuple[str, ...] = ()


@dataclass(frozen=True)
class Mistake:
    """A named mistake, with its hint for the student, and the question that precedes the hint."""

    name: str
    hint: str
    asks: str | None = field(default="", kw_only=True)  # None for what is not a known mistake


@dataclass(frozen=True)
class Diagnosis(Mistake):
    """A mistake that is recognised by a property of the outputs."""

    matches: Callable[[Arrays, Arrays], bool]  # (inputs, outputs) -> bool
    on: str = MAIN  # the set whose outputs are tested: the random inputs, or a probe


def equals(name, points, says, want, parts=None, angles=None, tolerance=TOLERANCE, **more) -> Law:
    """Create the law that outputs equal expected outputs, row by row, within a tolerance.

    want : inputs -> dict of expected outputs (n, ...) by name. parts : by output, the index or the
    list of indices to compare in a row. angles : by output, the index on the last axis that is
    compared modulo 2π. tolerance : relative to the largest expected number of a row."""

    want = once(want)

    def holds(inputs, outputs):
        right = want(inputs)
        same = [
            _rows_close(outputs[o], right[o], at, (angles or {}).get(o), tolerance)
            for o, indices in (parts or dict.fromkeys(right, np.s_[...])).items()
            for at in (indices if isinstance(indices, list) else [indices])
        ]
        return np.logical_and.reduce(same)

    def wanted(inputs):
        right = want(inputs)
        return {o: right[o] for o in parts or right}

    return Law(name, points, says, holds, want=wanted, **more)


def _rows_close(got, want, at, angle, tolerance):
    """Return (n,) bool: whether each row agrees at an index, angles modulo 2π."""
    want = np.asarray(want, dtype=float)
    off = got - want
    if angle is not None:
        off[..., angle] = np.remainder(off[..., angle] + np.pi, 2 * np.pi) - np.pi
    at = (slice(None), *at) if isinstance(at, tuple) else (slice(None), at)
    off, scale = np.abs(off[at]), np.abs(want[at])
    flat = len(off), -1
    if off.size == 0:
        return np.ones(len(got), dtype=bool)
    allowed = ROUNDING + tolerance * scale.reshape(flat).max(axis=1)
    return off.reshape(flat).max(axis=1) <= allowed
