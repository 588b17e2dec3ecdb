"""Syntax trees in several threads: one at a time, for CPython counts their depth for all at once.

A collector of garbage that runs in the middle of one tree lets another thread begin its own: with
Python 3.11 ``SystemError: AST constructor recursion depth mismatch``, now and then.
"""

import ast
import threading

_ONE_AT_A_TIME = threading.Lock()


def parse(source):
    """Parse a source text as :func:`ast.parse` does, from any thread.

    Parameters
    ----------
    source : str

    Returns
    -------
    ast.Module

    Raises
    ------
    SyntaxError, ValueError, RecursionError, MemoryError : as of :func:`ast.parse`
    """
    with _ONE_AT_A_TIME:
        return ast.parse(source)
