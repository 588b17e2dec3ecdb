"""Extension of Sphinx: the search finds a symbol by its plain form, ψ or P_ri, not by LaTeX alone."""

import re
import unicodedata

from docutils import nodes

_FONT = re.compile(r"\\(?:mathrm|mathbf|mathcal|boldsymbol|text|operatorname)\s*\{?(\w+)\}?")
_COMMAND = re.compile(r"\\([a-zA-Z]+)")
_SUBSCRIPT = re.compile(r"_\{([\w,]+)\}")
_WORD = re.compile(r"[^\W\d_](?:_\w+)?")


def setup(app):
    """Register with Sphinx."""
    app.connect("doctree-read", _add_keywords)
    return {"parallel_read_safe": True, "version": "1"}


def plain_forms(latex):
    r"""The symbols of a formula in plain characters.

    Parameters
    ----------
    latex : str, such as ``P_{\mathrm{ri}} = \psi``

    Returns
    -------
    set of str, such as {"P_ri", "ψ"}
    """
    text = _COMMAND.sub(_greek, _FONT.sub(r"\1", latex))
    return set(_WORD.findall(_SUBSCRIPT.sub(lambda found: f"_{found[1].replace(',', '')}", text)))


def _greek(found):
    name = found[1].removeprefix("var")
    kind = "CAPITAL" if name[0].isupper() else "SMALL"
    try:
        return unicodedata.lookup(f"GREEK {kind} LETTER {name.upper().replace('LAMBDA', 'LAMDA')}")
    except KeyError:
        return " "


def _add_keywords(app, doctree):
    formulas = doctree.findall(lambda node: isinstance(node, nodes.math | nodes.math_block))
    found = set().union(*(plain_forms(node.astext()) for node in formulas))
    if found:
        doctree += nodes.meta("", name="keywords", content=", ".join(sorted(found)))
