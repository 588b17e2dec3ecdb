"""``derive``: lines of a derivation; each line is checked to equal the previous one.

f = sp.Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta), theta + turn])
(
    derive("A", partials(f, [x, y, theta]), "by definition")
    .step("by x and y", differentiate(x, y))
    .step("the step's name", given={dx: d * sp.cos(theta), dy: d * sp.sin(theta)})
)"""

from dataclasses import dataclass, replace

import sympy as sp

from classroom.derivation import derivation_page
from classroom.derivation.equality import Verdict, compare
from classroom.derivation.random_points import generator


@dataclass(frozen=True)
class Line:
    """A line of a derivation."""

    why: str  # the step and its reason
    expression: sp.Basic | None  # None if the line could not be computed
    verdict: Verdict | None = None  # None if nothing was checked
    given: tuple = ()  # definitions that the line uses


@dataclass(frozen=True)
class Derivation:
    """A derivation; ``step`` returns a longer derivation.

    Parameters
    ----------
    name : str, of the derived quantity
    lines : tuple of Line
    """

    name: str
    lines: tuple

    def step(self, why, to=None, given=None):
        """Derive the next line; raise TypeError if the arguments are invalid.

        Parameters
        ----------
        why : str, the step and its reason
        to : a rule (function of the last line), or the next line, or None to substitute ``given``:
            the meaning for a name that occurs in the last line, otherwise the name for its meaning
        given : dict or Eq, names (symbols) and their meanings
        """
        given = _names(given)
        if to is None and not given:
            raise TypeError(f"step {why!r}: give the next line, a rule, or definitions")
        if not (to is None or callable(to) or isinstance(to, sp.Basic | sp.MatrixBase)):
            raise TypeError(
                f"step {why!r}: the next line must be a SymPy formula or a rule, not {to!r}"
            )
        return replace(self, lines=(*self.lines, self._next(why, to, given)))

    def _next(self, why, to, given):
        last, known = self.lines[-1].expression, tuple(given.items())
        if self.broken:
            return Line(why, None, None, known)
        rule = (lambda _: to) if isinstance(to, sp.Basic | sp.MatrixBase) else to or _put_in(given)
        try:
            line = _fixed(rule(last))
            verdict = compare(last, line, given, generator())
        except Exception as error:  # a rule may raise anything on an unsuitable line
            return Line(why, None, Verdict(False, f"cannot be done here: {error}"), known)
        return Line(why, line, verdict, known)

    @property
    def broken(self):
        """Number of the first line, from 1, that does not follow from the previous one; 0 if all
        lines follow."""
        wrong = [
            k for k, line in enumerate(self.lines, 1) if line.verdict and not line.verdict.holds
        ]
        return wrong[0] if wrong else 0

    @property
    def result(self):
        """Expression of the last line before the first one that does not follow."""
        return self.lines[self.broken - 2 if self.broken else -1].expression

    def _repr_mimebundle_(self, include=None, exclude=None):
        return {"text/html": derivation_page.html(self), "text/plain": derivation_page.text(self)}

    def __repr__(self):
        return derivation_page.text(self)


def derive(name, start, why="by definition"):
    """Begin a derivation. Returns a Derivation. Raises TypeError.

    Parameters
    ----------
    name : str, of the derived quantity, such as ``"J_xr"``
    start : sympy scalar, matrix or matrix expression
    why : str, its origin
    """
    if not isinstance(start, sp.Basic | sp.MatrixBase):
        raise TypeError(f"a derivation must start from a SymPy formula, not from {start!r}")
    return Derivation(name, (Line(why, _fixed(start)),))


def _fixed(line):
    return line.as_immutable() if isinstance(line, sp.MatrixBase) else sp.sympify(line)


def _names(given):
    given = {given.lhs: given.rhs} if isinstance(given, sp.Eq) else dict(given or {})
    for name in given:
        if not isinstance(name, sp.Symbol | sp.MatrixSymbol):
            raise TypeError(f"given must map symbols to their meanings, but {name} is not a symbol")
    return {name: sp.sympify(meaning) for name, meaning in given.items()}


def _put_in(given):
    def insert(line):
        for name, meaning in given.items():
            line = line.subs(*((name, meaning) if name in line.free_symbols else (meaning, name)))
        return line

    return insert
