"""How a derivation is shown: as HTML with LaTeX, a ``slamlab-step`` a line, and as plain text."""

import html as markup

import sympy as sp

from slamlab.derivation.changes import change
from slamlab.derivation.marked_latex import latex, marked_latex, name_of_matrix

STYLE = "padding-left: 1.2em; font-size: 95%"  # Jacobians are wide
NOT_REACHED = "not reached: line {} does not hold"


def html(derivation):
    """The derivation as a list; every line after the first can be revealed by itself.

    Parameters
    ----------
    derivation : slamlab.derivation.steps.Derivation

    Returns
    -------
    str
    """
    items = [
        f'<li class="{"slamlab-step" if k else "slamlab-start"}">{_item(derivation, k)}</li>'
        for k in range(len(derivation.lines))
    ]
    label = markup.escape(f"Derivation of {derivation.name}")
    start = f'<ol class="slamlab-derivation" aria-label="{label}" style="{STYLE}">'
    return "\n".join([start, *items, "</ol>"])


def text(derivation):
    """The derivation as plain text; what is new in a line stands behind it.

    Parameters
    ----------
    derivation : slamlab.derivation.steps.Derivation

    Returns
    -------
    str
    """
    paragraphs = []
    for k, line in enumerate(derivation.lines):
        told = [f"{k + 1}. {line.why}"]
        if line.expression is not None:
            name = sp.Symbol(derivation.name if not k else " ")
            equation = line.expression
            if not isinstance(equation, sp.Eq):
                equation = sp.Eq(name, equation, evaluate=False)
            told.append(_indented(sp.pretty(equation, use_unicode=True, wrap_line=False)))
        if k and line.expression is not None:
            new = list(dict.fromkeys(map(str, _change(derivation, k).marked())))
            told += [f"   new: {', '.join(new)}"] if new else []
        told += [f"   {words}" for words in _words(derivation, k, _in_text)]
        paragraphs.append("\n".join(told))
    return "\n\n".join(paragraphs)


def _item(derivation, k):
    line = derivation.lines[k]
    told = [markup.escape(line.why)]
    if line.expression is not None:
        name = name_of_matrix(derivation.name)
        left = rf"\phantom{{{name}}} =" if k else f"{name} ="
        if isinstance(line.expression, sp.Eq):  # which has a left side of its own
            left = ""
        tex = markup.escape(f"{left} {marked_latex(_change(derivation, k))}", quote=False)
        told.append(rf"$\displaystyle {tex}$")
    told += [f"<small>{words}</small>" for words in _words(derivation, k, _in_latex)]
    return "<br>".join(told)


def _change(derivation, k):
    """What line k has that the one before has not; in the first line nothing is new."""
    now = derivation.lines[k].expression
    return change(now, derivation.lines[k - 1].expression if k else now)


def _words(derivation, k, written):
    """What the machine says of line k: a list of str; formulas are ``written`` by a function."""
    line = derivation.lines[k]
    known = ", ".join(written(*pair) for pair in line.given)
    where = f", where {known}" if known else ""
    if line.verdict is None:
        return [f"– {NOT_REACHED.format(derivation.broken)}"] if line.expression is None else []
    if line.verdict.holds:
        return [f"✓ equal {line.verdict.words}{where}"]
    at = [written(symbol, value) for symbol, value in line.verdict.point.items()]
    point = f" at {', '.join(at)}" if at else ""
    words = markup.escape(line.verdict.words) if written is _in_latex else line.verdict.words
    return [f"✗ line {k + 1} does not follow: {words}{point}{where}"]


def _in_text(name, meaning):
    if isinstance(meaning, sp.BlockMatrix):
        return f"{name} is in blocks"
    if isinstance(meaning, sp.MatrixBase):
        return f"{name} = {meaning.tolist()}"
    return f"{name} = {float(meaning):g}" if meaning.is_Rational else f"{name} = {meaning}"


def _in_latex(name, meaning):
    tex = latex(name)
    if isinstance(meaning, sp.BlockMatrix):
        return f"${tex}$ is in blocks"
    small = latex(meaning, mat_str="smallmatrix")
    value = f"{float(meaning):g}" if meaning.is_Rational else small
    return markup.escape(f"${tex} = {value}$", quote=False)


def _indented(shown):
    return "\n".join(f"   {row}".rstrip() for row in shown.splitlines())
