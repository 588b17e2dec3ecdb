"""Visible text: letters that cannot be seen, or turn others round, are shown by their numbers.

Code can be written so that it reads in another way than it runs, by marks that change the direction
of writing; see N. Boucher, R. Anderson: Trojan Source, 2021.
"""

import unicodedata

_UNSEEN = {"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"}
_KEPT = "\n\t"


def visible(value):
    """Text, or all text in plain data, with unseen letters shown as ⟦202e⟧.

    Parameters
    ----------
    value : str, or dict, list or tuple of what may stand in JSON

    Returns
    -------
    the same with visible text
    """
    if isinstance(value, str):
        if value.isprintable():
            return value
        return "".join(_letter(c) for c in value.replace("\r\n", "\n"))
    if isinstance(value, dict):
        return {visible(key): visible(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [visible(item) for item in value]
    return value


def _letter(c):
    hidden = c not in _KEPT and unicodedata.category(c) in _UNSEEN
    return f"⟦{ord(c):04x}⟧" if hidden else c
