"""Visible text: invisible and bidirectional control characters are shown as code points.

Invisible characters can make code appear to do something else (Boucher, Anderson: Trojan Source,
2021)."""

import unicodedata

_INVISIBLE = {"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"}
_KEPT = "\n\t"


def visible(value):
    """Return plain data in which invisible characters of texts are shown as, for example,
    ⟦202e⟧."""
    if isinstance(value, str):
        if value.isprintable():
            return value
        return "".join(_visible_character(c) for c in value.replace("\r\n", "\n"))
    if isinstance(value, dict):
        return {visible(key): visible(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [visible(item) for item in value]
    return value


def _visible_character(c):
    hidden = c not in _KEPT and unicodedata.category(c) in _INVISIBLE
    return f"⟦{ord(c):04x}⟧" if hidden else c
