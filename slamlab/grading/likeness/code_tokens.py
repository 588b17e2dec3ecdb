"""Code as tokens that renaming, comments and layout do not change, and its k-grams.

S. Schleimer, D. S. Wilkerson, A. Aiken: Winnowing, SIGMOD 2003. They keep some of a text's k-grams;
a notebook is short enough to keep all. Tokens are read by an expression that never goes back:
Pygments takes most of a minute for 40 kB made to be slow, and Python's own ``tokenize`` refuses
what is not Python to its end.
"""

import builtins
import functools
import keyword
import re

GRAM = 12  # tokens of a k-gram; what is shorter is alike by chance
_KEPT = frozenset((*keyword.kwlist, *dir(builtins)))
_TOKEN = re.compile(
    r"""
      (?P<space>(?:[\s\\]|\#[^\n]*+)++)
    | (?P<string>[rbfuRBFU]{0,2}+(?:
          \"{3}(?:[^"\\]|\\.|"(?!""))*+(?:\"{3}|\Z)
        | '{3}(?:[^'\\]|\\.|'(?!''))*+(?:'{3}|\Z)
        | "(?:[^"\\\n]|\\.)*+"?+
        | '(?:[^'\\\n]|\\.)*+'?+))
    | (?P<name>[^\W\d]\w*+)
    | (?P<number>\.?+\d[\w.]*+)
    | (?P<sign>\*\*|//|->|:=|[-+*/%@&|^=!<>]=|.)
    """,
    re.X | re.S,
)
_END_OF_LINE = re.compile(r"[ \t]*+(?:\n|\#|\Z)")


def tokens(source):
    """Tokens of a cell; what need not be Python is read as far as it goes.

    A name is "v" unless it is Python's or stands behind a dot, a string is "s", and a string alone
    on its lines, such as a docstring, is left out.

    Parameters
    ----------
    source : str

    Returns
    -------
    list of (str, int, int), with the first and the last line it stands on, from 0
    """
    found, line, fresh = [], 0, True
    for match in _TOKEN.finditer(source):
        kind, text = match.lastgroup, match[0]
        first, line = line, line + text.count("\n")
        if kind == "space":
            fresh = fresh or line > first
            continue
        if kind == "string":
            if fresh and _END_OF_LINE.match(source, match.end()):
                continue
            text = "s"
        elif kind == "name" and text not in _KEPT and not (found and found[-1][0] == "."):
            text = "v"
        found.append((text, first, line))
        fresh = False
    return found


@functools.lru_cache(maxsize=2_000)  # most cells of a class are those that were handed out
def grams(source):
    """The k-grams of a cell.

    Parameters
    ----------
    source : str

    Returns
    -------
    tuple of (hash, first line, last line)
    """
    read = tokens(source)
    return tuple(
        (hash(tuple(text for text, _, _ in part)), part[0][1], part[-1][2])
        for part in (read[i : i + GRAM] for i in range(len(read) - GRAM + 1))
    )
