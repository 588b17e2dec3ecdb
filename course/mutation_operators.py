"""Mutation operators: every small change of a program that a student could make, by family.

The families are those of :mod:`classroom.exercises.mistake_families`, whose texts are shown to
students.
"""

import ast
import copy
import itertools
import pickle
from collections.abc import Iterator
from dataclasses import dataclass

SWAPS = {  # function for function
    "sin": ("cos", "trigonometry"),
    "cos": ("sin", "trigonometry"),
    "arctan2": ("hypot", "trigonometry"),
    "tan": ("arctan", "trigonometry"),
    "argmin": ("argmax", "order"),
    "argmax": ("argmin", "order"),
    "min": ("max", "order"),
    "max": ("min", "order"),
    "minimum": ("maximum", "order"),
    "maximum": ("minimum", "order"),
    "any": ("all", "guard"),
    "all": ("any", "guard"),
    "floor": ("ceil", "index"),
    "ceil": ("floor", "index"),
    "mean": ("sum", "factor"),
    "sum": ("mean", "factor"),
    "var": ("std", "square"),
    "std": ("var", "square"),
    "log": ("exp", "inverse"),
    "exp": ("log", "inverse"),
}
DROPPED = {  # functions left out, with their families
    "wrap": "wrap",
    "inv": "inverse",
    "sqrt": "square",
    "abs": "sign",
    "cumsum": "missing",
    "radians": "degrees",
    "deg2rad": "degrees",
    "degrees": "degrees",
    "copy": "missing",
    "clip": "guard",
    "sort": "order",
    "sorted": "order",
    "round": "index",
    "log": "inverse",
    "exp": "inverse",
}
COMPARED = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.GtE),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.LtE),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
}


@dataclass(frozen=True)
class Mutant:
    """A changed program.

    Parameters
    ----------
    family : str
    text : str, what was changed to what
    source : str
    """

    family: str
    text: str
    source: str


def mutants(source) -> list[Mutant]:
    """Create all mutants of a program; each mutant has one change and a different text.

    Parameters
    ----------
    source : str

    Returns
    -------
    list of Mutant
    """
    tree, found = ast.parse(source), {}
    before, stored = ast.unparse(tree), pickle.dumps(tree)  # loads is a faster copy than deepcopy
    names = _names(tree)
    for k, node in enumerate(ast.walk(tree)):
        for family, change in _changes(node, names.get(node, frozenset())):
            changed = pickle.loads(stored)
            change(next(itertools.islice(ast.walk(changed), k, None)), changed)
            try:
                text = ast.unparse(ast.fix_missing_locations(changed))
                compile(text, "<mutant>", "exec")
            except (SyntaxError, ValueError, TypeError, AttributeError, RecursionError):
                continue
            if text != before and text not in found:
                found[text] = Mutant(family, _difference(before, text), text)
    return list(found.values())


def _changes(node, names) -> Iterator:
    """Yield (family, change(node, tree)) for all changes of one node."""
    if isinstance(node, ast.BinOp):
        yield from _operations(node)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not | ast.Invert):
        family = "sign" if isinstance(node.op, ast.USub) else "guard"
        yield family, lambda n, t: _put(n, t, n.operand)
    elif isinstance(node, ast.Call):
        yield from _calls(node)
    elif isinstance(node, ast.Attribute) and node.attr == "T":
        yield "transpose", lambda n, t: _put(n, t, n.value)
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        for other in COMPARED.get(type(node.ops[0]), ()):
            yield "guard", lambda n, t, other=other: n.ops.__setitem__(0, other())
    elif isinstance(node, ast.BoolOp):
        other = ast.Or if isinstance(node.op, ast.And) else ast.And
        yield "guard", lambda n, t: setattr(n, "op", other())
        for k in range(len(node.values)):
            yield "guard", lambda n, t, k=k: n.values.pop(k)
    elif isinstance(node, ast.If | ast.IfExp | ast.While):
        yield "guard", lambda n, t: setattr(n, "test", ast.Constant(True))
        if not isinstance(node, ast.While):
            yield "guard", lambda n, t: setattr(n, "test", ast.Constant(False))
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield from _constants(node)
    elif isinstance(node, ast.Tuple) and len(node.elts) > 1 and isinstance(node.ctx, ast.Load):
        for k in range(len(node.elts) - 1):
            yield "order", lambda n, t, k=k: _swap(n.elts, k)
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id in names:
        for other in sorted(names - {node.id}):
            yield "name", lambda n, t, other=other: setattr(n, "id", other)
    elif isinstance(node, ast.AugAssign):
        turned = ast.Sub if isinstance(node.op, ast.Add) else ast.Add
        yield "sign", lambda n, t: setattr(n, "op", turned())
    if isinstance(getattr(node, "body", None), list):
        yield from _statements(node)


def _operations(node):
    op = type(node.op)
    yield "missing", lambda n, t: _put(n, t, n.left)
    yield "missing", lambda n, t: _put(n, t, n.right)
    if op in (ast.Add, ast.Sub):
        yield "sign", lambda n, t: setattr(n, "op", ast.Sub() if op is ast.Add else ast.Add())
    if op in (ast.Sub, ast.Div, ast.MatMult, ast.FloorDiv, ast.Mod, ast.Pow):
        yield "order", _turn
    if op in (ast.Mult, ast.Div):
        yield "inverse", lambda n, t: setattr(n, "op", ast.Div() if op is ast.Mult else ast.Mult())
    if op is ast.MatMult:
        yield "transpose", lambda n, t: setattr(n, "left", _transposed(n.left))
        yield "transpose", lambda n, t: setattr(n, "right", _transposed(n.right))
        yield "order", lambda n, t: setattr(n, "op", ast.Mult())
    if op in (ast.Mult, ast.MatMult, ast.Add, ast.Sub):
        yield "factor", lambda n, t: _put(n, t, ast.BinOp(ast.Constant(2), ast.Mult(), _kept(n)))
        yield "factor", lambda n, t: _put(n, t, ast.BinOp(ast.Constant(0.5), ast.Mult(), _kept(n)))
        yield "square", lambda n, t: setattr(n, "right", _squared(n.right))
        yield "square", lambda n, t: setattr(n, "left", _squared(n.left))


def _calls(node):
    name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
    if name in SWAPS:
        other, family = SWAPS[name]
        field = "attr" if isinstance(node.func, ast.Attribute) else "id"
        yield family, lambda n, t: setattr(n.func, field, other)
    if name in DROPPED and node.args:
        yield DROPPED[name], lambda n, t: _put(n, t, n.args[0])
    elif name in DROPPED and isinstance(node.func, ast.Attribute):
        yield DROPPED[name], lambda n, t: _put(n, t, n.func.value)
    if name == "solve" and len(node.args) == 2:
        yield "inverse", lambda n, t: _put(n, t, ast.BinOp(n.args[0], ast.MatMult(), n.args[1]))
    if name in ("sin", "cos", "tan") and node.args:
        yield "degrees", lambda n, t: n.args.__setitem__(0, _call("degrees", n.args[0]))
        yield "degrees", lambda n, t: n.args.__setitem__(0, _call("radians", n.args[0]))
        yield "sign", lambda n, t: _put(n, t, ast.UnaryOp(ast.USub(), _kept(n)))
    if name in ("arctan2", "wrap", "arcsin", "arccos"):
        yield "degrees", lambda n, t: _put(n, t, _call("degrees", _kept(n)))
        yield "sign", lambda n, t: _put(n, t, ast.UnaryOp(ast.USub(), _kept(n)))
    for k in range(len(node.args) - 1):
        yield "order", lambda n, t, k=k: _swap(n.args, k)
    for k, keyword in enumerate(node.keywords):
        if keyword.arg == "axis":
            yield "axis", lambda n, t, k=k: n.keywords.pop(k)
            for axis in (0, 1, -1):
                value = ast.Constant(axis)
                yield "axis", lambda n, t, k=k, v=value: setattr(n.keywords[k], "value", v)
        elif keyword.arg in ("strict", "dtype"):
            continue
        else:
            yield "missing", lambda n, t, k=k: n.keywords.pop(k)


def _constants(node):
    value = node.value
    family = "index" if isinstance(value, int) else "factor"
    others = [value + 1, value - 1] if isinstance(value, int) else [2 * value, value / 2, -value]
    for other in others:
        yield family, lambda n, t, other=other: setattr(n, "value", other)
    if isinstance(value, int) and value > 1:
        yield "factor", lambda n, t: setattr(n, "value", 2 * value)


def _statements(node):
    body = node.body
    for k, statement in enumerate(body):
        if isinstance(statement, ast.Assign | ast.AugAssign | ast.Expr | ast.For) and len(body) > 1:
            yield "missing", lambda n, t, k=k: n.body.pop(k)
        if isinstance(statement, ast.AugAssign | ast.Assign):
            yield "twice", lambda n, t, k=k: n.body.insert(k, copy.deepcopy(n.body[k]))
        if k + 1 < len(body) and not isinstance(body[k + 1], ast.FunctionDef):
            yield "stale", lambda n, t, k=k: _swap(n.body, k)
        if isinstance(node, ast.For) and isinstance(statement, ast.If):
            yield "guard", lambda n, t, k=k: n.body.insert(k + 1, ast.Break())
    if isinstance(node, ast.For):
        for cut in (ast.Slice(ast.Constant(1)), ast.Slice(None, ast.Constant(-1))):
            yield "index", lambda n, t, cut=cut: setattr(n, "iter", _cut(n.iter, cut))


def _names(tree):
    """Map each node to the local names of the function that contains it."""
    found = {}
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            inside = list(ast.walk(function))
            stored = {
                n.id for n in inside if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
            }
            found |= dict.fromkeys(inside, stored | {a.arg for a in function.args.args})
    return found


def _put(node, tree, value):
    """Replace an expression with another."""
    for parent in ast.walk(tree):
        for field, child in ast.iter_fields(parent):
            if child is node:
                setattr(parent, field, value)
                return
            if isinstance(child, list) and any(item is node for item in child):
                child[next(k for k, item in enumerate(child) if item is node)] = value
                return


def _kept(node):
    return copy.copy(node)


def _turn(node, tree):
    node.left, node.right = node.right, node.left


def _swap(items, k):
    items[k], items[k + 1] = items[k + 1], items[k]


def _transposed(value):
    if isinstance(value, ast.Attribute) and value.attr == "T":
        return value.value
    return ast.Attribute(value, "T", ast.Load())


def _squared(value):
    return ast.BinOp(value, ast.Pow(), ast.Constant(2))


def _cut(iterable, part):
    return ast.Subscript(_call("list", iterable, of=None), part, ast.Load())


def _call(name, argument, of="np"):
    function = ast.Name(name, ast.Load())
    if of:
        function = ast.Attribute(ast.Name(of, ast.Load()), name, ast.Load())
    return ast.Call(function, [argument], [])


def _difference(before, after):
    """Return the lines in which two programs differ: "old line -> new line"."""
    old, new = before.splitlines(), after.splitlines()
    while old and new and old[0] == new[0]:
        old, new = old[1:], new[1:]
    while old and new and old[-1] == new[-1]:
        old, new = old[:-1], new[:-1]
    return f"{' / '.join(map(str.strip, old))} -> {' / '.join(map(str.strip, new))}"
