"""Law and diagnosis: a property that every correct solution has, and a classic mistake with its
hint."""

import contextlib
import functools
from collections.abc import Callable, Mapping
from contextvars import ContextVar
from dataclasses import dataclass

import numpy as np

from slamlab.exercises.drives import Arrays
from slamlab.exercises.drives.input_sets import MAIN

TOLERANCE = 1e-5
"""Share of the largest number wanted: differences of a model err by 1e-6, wrong forms by far
more."""
ROUNDING = 1e-9
"""What numbers of order 1 may be off by rounding alone."""

_KNOWN = ContextVar("known", default=None)


@contextlib.contextmanager
def one_judging():
    """Within it, what is computed :func:`once` is kept: nothing changes the arrays meanwhile."""
    token = _KNOWN.set({})
    try:
        yield
    finally:
        _KNOWN.reset(token)


def once(compute):
    """A function of inputs, or of inputs and outputs, that several laws ask for: computed once.

    Parameters
    ----------
    compute : callable; what it gives is changed by nobody

    Returns
    -------
    callable, the same but for time
    """

    @functools.wraps(compute)
    def known(*arrays):
        found = _KNOWN.get()
        if found is None:
            return compute(*arrays)
        key = compute, *map(id, arrays)
        if key not in found:
            found[key] = compute(*arrays), arrays  # held, so that no other gets their ids
        return found[key][0]

    return known


@dataclass(frozen=True)
class Law:
    """A law: a property that every correct solution has (property-based test).

    Parameters
    ----------
    name : str, short; stands in the record
    points : float, what it is worth
    says : str, the law as a sentence for the student
    holds : (inputs, outputs) -> bool, or (n,) bool with one entry per input
    want : inputs -> name to array, the outputs that obey it, where the law knows them
    why : (inputs, outputs) -> str, why these outputs cannot be, where it does not
    asks : str, a question that leads on, for ``hint``
    step : inputs -> name to number or array, quantities on the way to the answer, for ``hint``
    main : bool, whether it is judged on the random inputs; else on the probes that name it only
    after : names of laws without which it cannot hold: while one of them is broken it is not told
        as broken, too
    alone : bool, whether it earns by itself; else, as many an answer that was computed of nothing
        obeys it, such as a sign, only beside a law that does
    """

    name: str
    points: float
    says: str
    holds: Callable[[Arrays, Arrays], np.ndarray | bool]
    want: Callable[[Arrays], Arrays] | None = None
    why: Callable[[Arrays, Arrays], str] | None = None
    asks: str = ""
    step: Callable[[Arrays], Mapping] | None = None
    main: bool = True
    alone: bool = True
    after: tuple[str, ...] = ()


@dataclass(frozen=True)
class Mistake:
    """A mistake that has a name.

    Parameters
    ----------
    name : str, short; stands in the record
    hint : str, for the student
    """

    name: str
    hint: str


@dataclass(frozen=True)
class Diagnosis(Mistake):
    """A diagnosis: a mistake that is told by a property of random or tolerated outputs.

    Parameters
    ----------
    name, hint : as of :class:`Mistake`
    matches : (inputs, outputs) -> bool
    on : str, the set that it looks at: the random inputs, or a probe by its name
    """

    matches: Callable[[Arrays, Arrays], bool]
    on: str = MAIN


def equals(name, points, says, want, parts=None, angles=None, tolerance=TOLERANCE, **more) -> Law:
    """The law that outputs equal what is wanted, row by row, but for rounding.

    Parameters
    ----------
    name, points, says : as of :class:`Law`
    want : inputs -> output's name to (n, ...) array; others of its outputs are not looked at
    parts : output's name to an index within one row, such as ``np.s_[:3, 3:]``, or to a list of
        them; None: all of ``want``
    angles : output's name to the index, on the last axis, of what counts modulo 2π
    tolerance : float, share of the largest number wanted in a row
    more : ``asks``, ``step``, ``main``, ``alone``, ``after`` of :class:`Law`

    Returns
    -------
    Law
    """

    want = once(want)

    def holds(inputs, outputs):
        right = want(inputs)
        same = [
            _rows_close(outputs[o], right[o], at, (angles or {}).get(o), tolerance)
            for o, places in (parts or dict.fromkeys(right, np.s_[...])).items()
            for at in (places if isinstance(places, list) else [places])
        ]
        return np.logical_and.reduce(same)

    def wanted(inputs):
        right = want(inputs)
        return {o: right[o] for o in parts or right}

    return Law(name, points, says, holds, want=wanted, **more)


def _rows_close(got, want, at, angle, tolerance):
    """(n,) whether rows agree at an index, angles modulo 2π."""
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
