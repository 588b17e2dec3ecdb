"""LaTeX of a line in which what is new is coloured and underlined; the robot's r is roman."""

import re
from collections import defaultdict

import sympy as sp
from sympy.printing.latex import LatexPrinter

# blue of Okabe and Ito, 5.2 : 1 on white; the style sheet has their lighter blue for a dark page
COLOUR = "#0072b2"
SUBSCRIPT = re.compile(r"_\{[a-z0-9]{1,2}\}")


def marked_latex(change):
    """Typeset a line.

    Parameters
    ----------
    change : slamlab.derivation.changes.Change

    Returns
    -------
    str, LaTeX for MathJax and KaTeX
    """
    return _Printer().line(change)


def latex(expression, **settings):
    """Typeset an expression as the course writes it: italic r is a range, roman r the robot.

    Parameters
    ----------
    expression : sympy expression
    settings : what sympy's printer takes, such as ``mat_str``

    Returns
    -------
    str, LaTeX
    """
    return _Roman(settings).doprint(expression)


def name_of_matrix(name):
    """Typeset the name of a matrix: ``P_rr`` becomes P with a roman subscript.

    Parameters
    ----------
    name : str

    Returns
    -------
    str, LaTeX
    """
    return _roman(sp.latex(sp.Symbol(name)))


def _roman(tex):
    return SUBSCRIPT.sub(lambda found: re.sub("r+", r"\\mathrm{\g<0>}", found[0]), tex)


def mark(tex, sign=""):
    """Mark LaTeX as new: by colour, and for who sees no colours by a line below."""
    before = f"{{}}{sign}" if sign else ""  # as between two terms
    return rf"{{\color{{{COLOUR}}}{{{before}\underline{{{tex}}}}}}}"


class _Roman(LatexPrinter):
    """Prints as sympy does; r in a matrix's subscript is the robot, in a number's the range."""

    def _print_MatrixSymbol(self, expr, **options):
        return _roman(super()._print_MatrixSymbol(expr, **options))


class _Printer(_Roman):
    """Asks of each part that it prints whether that is new."""

    def __init__(self):
        super().__init__({"mat_delim": "["})
        self._frame = {}  # changes of the parts of what is being printed, by expression

    def line(self, change):
        if change.is_new:
            return mark(self._plain(change.expression))
        outer, self._frame = self._frame, defaultdict(list)
        for part in change.parts:
            self._frame[part.expression].append(part)
        tex = super()._print(change.expression)
        # what sympy prints in another form, as a power -1, is marked with what it stands in
        lost = any(part for left in self._frame.values() for part in left)
        self._frame = outer
        return mark(self._plain(change.expression)) if lost else tex

    def _plain(self, expression):
        outer, self._frame = self._frame, {}
        tex = super()._print(expression)
        self._frame = outer
        return tex

    def _print(self, expr, **options):
        waiting = self._frame.get(expr) if not options else None
        return self.line(waiting.pop(0)) if waiting else super()._print(expr, **options)

    def _print_Add(self, expr, order=None):
        tex = ""
        for term in self._as_ordered_terms(expr, order=order):
            waiting = self._frame.get(term)
            change = waiting.pop(0) if waiting else None
            tex += self._term(term, change, first=not tex)
        return tex

    def _print_MatAdd(self, expr):
        return self._print_Add(expr)

    def _as_ordered_terms(self, expr, order=None):
        if expr.is_MatAdd:  # what is taken away comes last
            return sorted(expr.args, key=lambda term: term.could_extract_minus_sign())
        return super()._as_ordered_terms(expr, order=order)

    def _term(self, term, change, first):
        """A term with its sign, which is new where the term is."""
        is_new = change is not None and change.is_new
        tex = self.line(change) if change and not is_new else self._plain(term)
        sign = "" if first else "+ "
        if tex.startswith("- "):
            sign, tex = "- ", tex[2:]
        if self._needs_add_brackets(term):
            tex = rf"\left({tex}\right)"
        return " " + (mark(tex, sign) if is_new else sign + tex)
