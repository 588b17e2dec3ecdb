"""Tokens of code that renaming, comments and layout do not change, and their k-grams (Schleimer,
Wilkerson, Aiken: Winnowing, SIGMOD 2003; MOSS). The regular expression never backtracks. Pygments
needs almost a minute for 40 kB of hostile text.
"""

import builtins
import functools
import keyword
import re

GRAM = 12  # tokens of a k-gram; shorter sequences agree by chance
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
    """Return tokens (text, first line, last line), with lines counted from 0. Names become "v",
    except Python's names and attributes, and strings become "s". Strings on separate lines, such as
    docstrings, are omitted. Text that is not Python is tokenised as far as possible.
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


@functools.lru_cache(maxsize=2_000)  # most cells are the same in every submission
def grams(source):
    """Return k-grams as (hash, first line, last line)."""
    read = tokens(source)
    return tuple(
        (hash(tuple(text for text, _, _ in part)), part[0][1], part[-1][2])
        for part in (read[i : i + GRAM] for i in range(len(read) - GRAM + 1))
    )
