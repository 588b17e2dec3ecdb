"""Quantities of a program: which ones a change of the program hits.

A quantity is the name that a changed line assigns, such as ``S`` or ``v[1]``; ``result`` or
``result 2``, a value that a function returns; ``if``, the condition of an if or while; ``for``.
"""

import ast
import difflib
import re

SEPARATOR = "|"  # between the quantities of one change


def changed(before, after) -> tuple[str, ...]:
    """Return the quantities in which two programs differ, in order: "function.quantity".

    Parameters
    ----------
    before, after : str, source
    """
    old, new = (list(_units(ast.parse(source))) for source in (before, after))
    matcher = difflib.SequenceMatcher(None, old, new, autojunk=False)
    hit = []
    for kind, i, j, k, m in matcher.get_opcodes():
        if kind != "equal":
            hit += old[i:j] or new[k:m]
    return tuple(dict.fromkeys(f"{function}.{quantity}" for function, quantity, _ in hit))


def _units(tree, function=""):
    """Yield (function, quantity, text) of each statement, in order."""
    for node in tree.body if isinstance(tree.body, list) else []:
        if isinstance(node, ast.FunctionDef):
            yield from _units(node, node.name)
            continue
        if isinstance(node, ast.If | ast.While):
            yield function, "if", ast.unparse(node.test)
        elif isinstance(node, ast.For):
            yield function, "for", f"{ast.unparse(node.target)} in {ast.unparse(node.iter)}"
        elif isinstance(node, ast.Return):
            yield from _values(function, node.value)
        elif not hasattr(node, "body"):
            yield from _assigned(function, node)
        if isinstance(getattr(node, "body", None), list):
            yield from _units(node, function)
        if getattr(node, "orelse", None):
            yield from _units(ast.Module(node.orelse, []), function)


def _values(function, value):
    if isinstance(value, ast.Tuple):
        for k, each in enumerate(value.elts, 1):
            yield function, f"result {k}", ast.unparse(each)
    else:
        yield function, "result", ast.unparse(value) if value else ""


def _assigned(function, node):
    text = ast.unparse(node)
    if isinstance(node, ast.Assign):
        target, value = node.targets[0], node.value
        pair = isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple)
        if pair and len(target.elts) == len(value.elts):
            for name, each in zip(target.elts, value.elts, strict=True):
                yield function, ast.unparse(name), ast.unparse(each)
            return
        names = ast.unparse(target).strip("()")
    elif isinstance(node, ast.AugAssign | ast.AnnAssign):
        names = ast.unparse(node.target)
    else:  # a call that changes an object, such as found.append(…)
        names = re.match(r"\w*", text)[0]
    yield function, names, text
