"""Display of a derivation as HTML with LaTeX (a ``slamlab-step`` for each line) and as text."""

import html as markup

import sympy as sp

from classroom.derivation.changes import change
from classroom.derivation.marked_latex import latex, marked_latex, name_of_matrix

STYLE = "padding-left: 1.2em; font-size: 95%"  # Jacobians are wide
NOT_REACHED = "not checked: line {} does not follow"


def html(derivation):
    """Return a derivation as an HTML list; each line after the first can be revealed separately."""
    items = [
        f'<li class="{"slamlab-step" if k else "slamlab-start"}">{_item(derivation, k)}</li>'
        for k in range(len(derivation.lines))
    ]
    label = markup.escape(f"Derivation of {derivation.name}")
    start = f'<ol class="slamlab-derivation" aria-label="{label}" style="{STYLE}">'
    return "\n".join([start, *items, "</ol>"])


def text(derivation):
    """Return a derivation as plain text with a list of the new parts of each line."""
    paragraphs = []
    for k, line in enumerate(derivation.lines):
        parts = [f"{k + 1}. {line.why}"]
        if line.expression is not None:
            name = sp.Symbol(derivation.name if not k else " ")
            equation = line.expression
            if not isinstance(equation, sp.Eq):
                equation = sp.Eq(name, equation, evaluate=False)
            parts.append(_indented(sp.pretty(equation, use_unicode=True, wrap_line=False)))
        if k and line.expression is not None:
            new = list(dict.fromkeys(map(str, _change(derivation, k).marked())))
            parts += [f"   new: {', '.join(new)}"] if new else []
        parts += [f"   {words}" for words in _words(derivation, k, _in_text)]
        paragraphs.append("\n".join(parts))
    return "\n\n".join(paragraphs)


def _item(derivation, k):
    line = derivation.lines[k]
    parts = [markup.escape(line.why)]
    if line.expression is not None:
        name = name_of_matrix(derivation.name)
        left = rf"\phantom{{{name}}} =" if k else f"{name} ="
        if isinstance(line.expression, sp.Eq):  # which has a left side of its own
            left = ""
        tex = markup.escape(f"{left} {marked_latex(_change(derivation, k))}", quote=False)
        parts.append(rf"$\displaystyle {tex}$")
    parts += [f"<small>{words}</small>" for words in _words(derivation, k, _in_latex)]
    return "<br>".join(parts)


def _change(derivation, k):
    now = derivation.lines[k].expression
    return change(now, derivation.lines[k - 1].expression if k else now)


def _words(derivation, k, written):
    """Return the result of the check of line k; ``written`` formats formulas."""
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
