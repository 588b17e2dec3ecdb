"""``derive``: a derivation as lines with names, each checked by machine to equal the one before.

    f = sp.Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta), theta + turn])
    (
        derive("A", partials(f, [x, y, theta]), "by definition")
        .step("by x and y", differentiate(x, y))
        .step("by θ", differentiate(theta))
        .step("the step's name", given={dx: d * sp.cos(theta), dy: d * sp.sin(theta)})
    )

A step by rule follows when the model's line is another; one that is written out is held against it.
"""

from dataclasses import dataclass, replace

import sympy as sp

from slamlab.derivation import derivation_page
from slamlab.derivation.equality import Verdict, compare
from slamlab.derivation.random_points import generator


@dataclass(frozen=True)
class Line:
    """A line of a derivation.

    Parameters
    ----------
    why : str, what is done and why
    expression : sympy, or None where the line could not be made
    verdict : Verdict, or None where nothing was checked: in the first line, and after a broken one
    given : dict, what the line takes for known
    """

    why: str
    expression: sp.Basic | None
    verdict: Verdict | None = None
    given: tuple = ()


@dataclass(frozen=True)
class Derivation:
    """A derivation; ``step`` gives a longer one.

    Parameters
    ----------
    name : str, of what is derived
    lines : tuple of Line
    """

    name: str
    lines: tuple

    def step(self, why, to=None, given=None):
        """Derive the next line.

        Parameters
        ----------
        why : str, what is done and why, in a sentence
        to : function of the last line (a rule), or the next line written out, or None: then what is
            given is put in, its meaning for a name that the last line holds, else the name for it
        given : dict or Eq, names (symbols) and what they stand for

        Returns
        -------
        Derivation

        Raises
        ------
        TypeError : a step without a rule, a line or something given; names that are no symbols
        """
        given = _names(given)
        if to is None and not given:
            raise TypeError(f"step {why!r}: say what comes next, or what is given")
        if not (to is None or callable(to) or isinstance(to, sp.Basic | sp.MatrixBase)):
            raise TypeError(f"step {why!r}: a line is a formula of sympy or a rule, not {to!r}")
        return replace(self, lines=(*self.lines, self._next(why, to, given)))

    def _next(self, why, to, given):
        last, known = self.lines[-1].expression, tuple(given.items())
        if self.broken:
            return Line(why, None, None, known)
        rule = (lambda _: to) if isinstance(to, sp.Basic | sp.MatrixBase) else to or _put_in(given)
        try:
            line = _fixed(rule(last))
            verdict = compare(last, line, given, generator())
        except Exception as error:  # whatever a rule may raise on a line it was not made for
            return Line(why, None, Verdict(False, f"cannot be done here: {error}"), known)
        return Line(why, line, verdict, known)

    @property
    def broken(self):
        """int, the first line that does not hold, counted from 1; 0 where all hold."""
        wrong = [
            k for k, line in enumerate(self.lines, 1) if line.verdict and not line.verdict.holds
        ]
        return wrong[0] if wrong else 0

    @property
    def result(self):
        """sympy expression of the last line that is proved."""
        return self.lines[self.broken - 2 if self.broken else -1].expression

    def _repr_mimebundle_(self, include=None, exclude=None):
        return {"text/html": derivation_page.html(self), "text/plain": derivation_page.text(self)}

    def __repr__(self):
        return derivation_page.text(self)


def derive(name, start, why="by definition"):
    """Begin a derivation.

    Parameters
    ----------
    name : str, of what is derived, such as ``"J_xr"``
    start : sympy scalar, matrix or matrix expression, the first line
    why : str, where that comes from

    Returns
    -------
    Derivation

    Raises
    ------
    TypeError : a start that is no formula of sympy
    """
    if not isinstance(start, sp.Basic | sp.MatrixBase):
        raise TypeError(f"a derivation starts from a formula of sympy, not from {start!r}")
    return Derivation(name, (Line(why, _fixed(start)),))


def _fixed(line):
    return line.as_immutable() if isinstance(line, sp.MatrixBase) else sp.sympify(line)


def _names(given):
    given = {given.lhs: given.rhs} if isinstance(given, sp.Eq) else dict(given or {})
    for name in given:
        if not isinstance(name, sp.Symbol | sp.MatrixSymbol):
            raise TypeError(f"given says what a symbol stands for; {name} is not one")
    return {name: sp.sympify(meaning) for name, meaning in given.items()}


def _put_in(given):
    """Rule that puts in what is given."""

    def insert(line):
        for name, meaning in given.items():
            line = line.subs(*((name, meaning) if name in line.free_symbols else (meaning, name)))
        return line

    return insert
