"""Sphinx extension with which the search finds symbols in plain form, such as ψ or P_ri."""

import re
import unicodedata

from docutils import nodes

_DRESS = re.compile(
    r"\\(?:math(?:rm|bf|cal|sf|bb)|boldsymbol|text|operatorname"
    r"|(?:wide)?(?:hat|tilde)|bar|check|dot|vec)(?![a-zA-Z])"
)
_COMMAND = re.compile(r"\\([a-zA-Z]+)")
_GROUP = re.compile(r"(?<![_^])\{\s*(\w)\s*\}")  # of one letter: \hat{x}
_SUBSCRIPT = re.compile(r"_\s*(?:\{((?:[^{}]|\{[^{}]*\})*)\}|(\w))")
_NAME = re.compile(r"[\w\s,{}]*")  # of a subscript, up to a sign: of k-1 it is k
_WORD = re.compile(r"(?:Δ\s*)?[^\W\d_](?:_\w+)?")
_OTHERS = {"ell": "ℓ", "min": "min", "max": "max"}


def setup(app):
    """Register with Sphinx."""
    app.connect("doctree-read", _add_keywords)
    return {"parallel_read_safe": True, "env_version": 2}


def plain_forms(latex):
    r"""Return the symbols of a formula in plain characters.

    Parameters
    ----------
    latex : str, such as ``P_{\mathrm ri} = \hat\psi + \Delta x``

    Returns
    -------
    set of str, such as {"P_ri", "ψ", "Δx"}
    """
    text = _GROUP.sub(r"\1", _COMMAND.sub(_letter, _DRESS.sub(" ", latex)))
    return {re.sub(r"\s", "", word) for word in _WORD.findall(_SUBSCRIPT.sub(_subscript, text))}


def spelled(symbols):
    """Return the names of Greek letters, for readers without a Greek keyboard.

    Parameters
    ----------
    symbols : collection of str, such as {"σ_x", "Δθ"}

    Returns
    -------
    set of str, such as {"sigma", "delta", "theta"}
    """
    named = (unicodedata.name(letter) for letter in "".join(symbols))
    greek = {name.split()[-1].lower() for name in named if name.startswith("GREEK")}
    return {name.replace("lamda", "lambda") for name in greek}


def _letter(found):
    name = found[1].removeprefix("var")
    kind = "CAPITAL" if name[0].isupper() else "SMALL"
    try:
        return unicodedata.lookup(f"GREEK {kind} LETTER {name.upper().replace('LAMBDA', 'LAMDA')}")
    except KeyError:
        return _OTHERS.get(name, " ")


def _subscript(found):
    name = re.sub(r"\W", "", _NAME.match(found[1] or found[2])[0])
    return f"_{name} " if name else " "


def _add_keywords(app, doctree):
    formulas = doctree.findall(lambda node: isinstance(node, nodes.math | nodes.math_block))
    found = set().union(*(plain_forms(node.astext()) for node in formulas))
    if found:
        words = ", ".join(sorted(found | spelled(found)))
        doctree += nodes.meta("", name="keywords", content=words)
