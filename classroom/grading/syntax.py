"""Parse Python syntax trees (AST) from several threads, one at a time. CPython 3.11 counts the
depth of a syntax tree with one counter for all threads. If a garbage collection during parsing
switches threads, parsing raises ``SystemError: AST constructor recursion depth mismatch``.
"""

import ast
import threading

_ONE_AT_A_TIME = threading.Lock()


def parse(source):
    """Call :func:`ast.parse` safely from any thread."""
    with _ONE_AT_A_TIME:
        return ast.parse(source)
