"""LaTeX of a line, with new parts coloured and underlined, or boxed if they contain a fraction."""

import re
from collections import defaultdict

import sympy as sp
from sympy.printing.latex import LatexPrinter

# blue of Okabe and Ito, contrast 5.2 : 1 on white; style sheets use a lighter blue on dark pages
COLOUR = "#0072b2"
SUBSCRIPT = re.compile(r"_\{[a-z0-9]{1,2}\}")


def marked_latex(change):
    """Typeset a line, given as a Change, for MathJax and KaTeX."""
    return _Printer().line(change)


def latex(expression, **settings):
    """Typeset an expression; an italic r is a range, a roman r is the robot.

    settings : settings of SymPy's printer, such as ``mat_str``."""
    return _Roman(settings).doprint(expression)


def name_of_matrix(name):
    """Typeset a matrix's name: ``P_rr`` becomes P with a roman subscript."""
    return _roman(sp.latex(sp.Symbol(name)))


def _roman(tex):
    return SUBSCRIPT.sub(lambda found: re.sub("r+", r"\\mathrm{\g<0>}", found[0]), tex)


def mark(tex, sign=""):
    """Mark LaTeX as new by a colour, and by an underline, or by a box if it contains a fraction.

    An underline of a fraction would look like a second fraction bar.
    """
    before = f"{{}}{sign}" if sign else ""  # spaced as between two terms
    shape = "boxed" if r"\frac" in tex else "underline"
    return rf"{{\color{{{COLOUR}}}{{{before}\{shape}{{{tex}}}}}}}"


class _Roman(LatexPrinter):
    """Printer; r in a subscript means the robot for a matrix, but the range for a number."""

    def _print_MatrixSymbol(self, expr, **options):
        return _roman(super()._print_MatrixSymbol(expr, **options))


class _Printer(_Roman):
    def __init__(self):
        super().__init__({"mat_delim": "["})
        self._frame = {}  # changes of the parts of the current expression, by expression

    def line(self, change):
        if change.is_new:
            return mark(self._plain(change.expression))
        outer, self._frame = self._frame, defaultdict(list)
        for part in change.parts:
            self._frame[part.expression].append(part)
        tex = super()._print(change.expression)
        # parts that sympy prints in another form, such as a power -1, are marked with their parent
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
        if expr.is_MatAdd:  # subtracted terms come last
            return sorted(expr.args, key=lambda term: term.could_extract_minus_sign())
        return super()._as_ordered_terms(expr, order=order)

    def _term(self, term, change, first):
        """Typeset a term with its sign, which is marked if the term is new."""
        is_new = change is not None and change.is_new
        tex = self.line(change) if change and not is_new else self._plain(term)
        sign = "" if first else "+ "
        if tex.startswith("- "):
            sign, tex = "- ", tex[2:]
        if self._needs_add_brackets(term):
            tex = rf"\left({tex}\right)"
        return " " + (mark(tex, sign) if is_new else sign + tex)
