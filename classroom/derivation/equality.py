"""Equality of two lines: refuted at a point, proved by algebra, or not refuted."""

from dataclasses import dataclass, field

import numpy as np
import sympy as sp

from classroom.derivation.random_points import random_point

PROVED = "by algebra"
POINTS = 4  # random points at which two lines must agree
TRIES = 40  # points tried to find POINTS at which both lines have a value
DIGITS = 30  # of a value; those of matrix expressions are floats
CLOSE = 1e-9  # relative tolerance of two values of the order of 1
TOO_LONG, SIMPLE = 600, 60  # operations, above which expanding and simplifying may take minutes


@dataclass(frozen=True)
class Verdict:
    """Result of the check of a line."""

    holds: bool
    words: str  # the method, or what differs
    point: dict = field(default_factory=dict)  # symbol to value at which they differ


def compare(old, new, given, rng):
    """Compare two SymPy lines, first at random points and then by algebra.

    given : maps symbols to their meanings. Two equations are equal if their sides are equal, or if
    the differences of their sides are equal up to a factor that is never zero."""
    if isinstance(old, sp.Eq) and isinstance(new, sp.Eq):
        return _compare_equations(old, new, given, rng)
    if isinstance(old, sp.Eq) or isinstance(new, sp.Eq):
        return Verdict(
            False, "an equation can only follow from an equation, and a formula from a formula"
        )
    old, new = (_inserted(line, given) for line in (old, new))
    if _shape(old) != _shape(new):
        return Verdict(False, f"{_described(_shape(old))} became {_described(_shape(new))}")
    if old == new:
        return Verdict(True, PROVED)
    agreed, symbols = 0, _symbols(old) | _symbols(new)
    evaluated = [_evaluated(line, symbols) for line in (old, new)]
    for _ in range(TRIES):
        point = random_point(symbols, rng)
        values = [_values(line, point) for line in evaluated]
        if None in values:
            continue
        for place, (before, now) in enumerate(zip(*values, strict=True)):
            if abs(before - now) > CLOSE * (1 + abs(before) + abs(now)):
                return _refuted(old, new, place, before, now, point)
        agreed += 1
        if agreed == POINTS or not symbols:
            break
    if not agreed:
        return Verdict(False, "no point was found at which both lines are defined")
    return Verdict(True, PROVED if _proved(old, new) else f"at {agreed} random points")


def _compare_equations(old, new, given, rng):
    sides = [compare(*pair, given, rng) for pair in zip(old.args, new.args, strict=True)]
    if all(side.holds for side in sides):
        return max(sides, key=lambda side: side.words != PROVED)
    if not any(getattr(side, "is_Matrix", False) for side in (*old.args, *new.args)):
        before, now = (_inserted(line.lhs - line.rhs, given) for line in (old, new))
        factor = sp.simplify(now / before)
        if factor.is_nonzero and factor.is_finite:
            return Verdict(True, PROVED)
    left, right = sides
    side = ("left", left) if not left.holds else ("right", right)
    return Verdict(False, f"{side[0]} side: {side[1].words}", side[1].point)


def _inserted(line, given):
    return line.doit().subs(given).doit()


def _shape(line):
    return tuple(line.shape) if getattr(line, "is_Matrix", False) else ()


def _described(shape):
    return f"a {shape[0]}×{shape[1]} matrix" if shape else "a number"


def _symbols(line):
    return {s for s in line.free_symbols if s.is_Matrix or isinstance(s, sp.Symbol)}


def _evaluated(line, symbols):
    """Return a function of a point that computes a line's entries."""
    if not getattr(line, "is_MatrixExpr", False):
        return lambda point: [
            sp.sympify(e).xreplace(point).doit().evalf(DIGITS) for e in _entries(line)
        ]
    symbols = list(symbols)
    # the docstring would be slow to make
    program = sp.lambdify(symbols, line, docstring_limit=0)
    return lambda point: [
        sp.Float(float(entry)) for entry in program(*(_array(point[s]) for s in symbols)).ravel()
    ]


def _values(evaluated, point):
    try:
        values = evaluated(point)
    except (ValueError, ZeroDivisionError, np.linalg.LinAlgError):  # such as a singular inverse
        return None
    return values if all(value.is_number and value.is_finite for value in values) else None


def _array(value):
    return np.array(value, dtype=float) if value.is_Matrix else float(value)


def _entries(line):
    return list(line) if isinstance(line, sp.MatrixBase) else [line]


def _refuted(old, new, place, before, now, point):
    words = f"{_short(before)} became {_short(now)}"
    held = _symbols(old) | _symbols(new)
    if _shape(old):
        row, column = divmod(place, int(_shape(old)[1]))
        words = f"in row {row + 1}, column {column + 1} {words}"
        if isinstance(old, sp.MatrixBase) and isinstance(new, sp.MatrixBase):
            held = _entries(old)[place].free_symbols | _entries(new)[place].free_symbols
    return Verdict(False, words, {s: value for s, value in point.items() if s in held})


def _short(value):
    real, imaginary = (sp.Float(part, 4) for part in value.as_real_imag())
    return f"{real:.4g}" + (f" + {imaginary:.4g}i" if imaginary else "")


def _proved(old, new):
    if getattr(old, "is_MatrixExpr", False):
        return _zero_blocks(old - new)
    pairs = zip(_entries(old), _entries(new), strict=True)
    return all(_is_zero(before - now) for before, now in pairs)


def _is_zero(difference):
    """Return whether algebra simplifies an expression to zero; long expressions are not tried."""
    if sp.count_ops(difference) > TOO_LONG:
        return False
    if sp.expand(difference) == 0:
        return True
    return sp.count_ops(difference) <= SIMPLE and sp.simplify(difference) == 0


def _zero_blocks(difference):
    collapsed = sp.block_collapse(difference)
    blocks = collapsed.blocks if isinstance(collapsed, sp.BlockMatrix) else [collapsed]
    return all(sp.expand(block).doit().is_ZeroMatrix is True for block in blocks)
