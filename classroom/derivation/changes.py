"""Changes between two lines of a derivation (difference of expression trees).

Sums are compared term by term, products factor by factor, matrices entry by entry; the smallest
new parts are marked."""

from dataclasses import dataclass
from difflib import SequenceMatcher

import sympy as sp

SUMS, ORDERED = (sp.Add, sp.MatAdd), (sp.MatMul,)


@dataclass(frozen=True)
class Change:
    """Difference between an expression and an older one."""

    expression: sp.Basic
    is_new: bool = False  # all of it
    parts: tuple = ()  # Changes of its parts, in the order of printing

    def marked(self):
        """Return the expressions that are completely new, in the order of printing."""
        if self.is_new:
            return [self.expression]
        return [found for part in self.parts for found in part.marked()]

    def __bool__(self):
        return bool(self.marked())


def change(new, old):
    """Find the new parts of a line; the returned Change is falsy if both lines are equal."""
    if new == old and type(new) is type(old):
        return Change(new, parts=tuple(Change(part) for part in parts(new)))
    found = _inside(new, old)
    if not found or (all(part.is_new for part in found.parts) and not _keeps_its_head(new)):
        return _whole(new)
    return found


def parts(expression):
    """Return the printed parts of an expression, for example those of a product's fraction."""
    if _is_explicit(expression):
        return list(expression.blocks if isinstance(expression, sp.BlockMatrix) else expression)
    if expression.is_Mul and not isinstance(expression, sp.MatMul):
        _, above, below = _fraction(expression)
        return above + below
    return list(getattr(expression, "args", ()))


def _inside(new, old):
    """Return the Change if both expressions have the same kind, otherwise None."""
    if _is_explicit(new):
        same = _is_explicit(old) and _grid(new) == _grid(old)
        return _one_by_one(new, parts(new), parts(old)) if same else None
    if isinstance(new, SUMS):
        return Change(new, parts=_matched(list(new.args), list(type(new).make_args(old))))
    if isinstance(new, ORDERED):
        return Change(new, parts=_in_order(list(new.args), _flat(old)))
    if new.is_Mul:
        (sign, above, below), (was, above_then, below_then) = _fraction(new), _fraction(old)
        if sign != was:
            return None
        return Change(new, parts=_matched(above, above_then) + _matched(below, below_then))
    if new.func == old.func and len(new.args) == len(old.args) and new.args:
        return _one_by_one(new, new.args, old.args)
    return None


def _whole(new):
    if _is_explicit(new):
        return Change(new, parts=tuple(Change(entry, True) for entry in parts(new)))
    return Change(new, True)


def _one_by_one(new, parts_now, parts_then):
    pairs = zip(parts_now, parts_then, strict=True)
    return Change(new, parts=tuple(change(now, then) for now, then in pairs))


def _matched(now, then):
    """Return the changes of terms in any order; each term is compared with the most similar one."""
    left, found = list(then), {}
    for k, part in enumerate(now):
        if part in left:
            left.remove(part)
            found[k] = change(part, part)
    for k, part in enumerate(now):
        if k not in found:
            tried = [change(part, other) for other in left]
            best = min(tried, key=_leaves, default=None)
            if best is None or best.is_new:
                found[k] = _whole(part)
            else:
                left.pop(tried.index(best))
                found[k] = best
    return tuple(found[k] for k in range(len(now)))


def _in_order(now, then):
    """Return the changes of a matrix product's factors, whose order matters."""
    found = []
    for what, i, j, k, m in SequenceMatcher(None, then, now, autojunk=False).get_opcodes():
        if what == "replace" and j - i == m - k:
            found += [change(*pair) for pair in zip(now[k:m], then[i:j], strict=True)]
        else:
            found += [change(p, p) if what == "equal" else _whole(p) for p in now[k:m]]
    return tuple(found)


def _flat(product):
    factors = sp.MatMul.make_args(product)
    return [inner for f in factors for inner in (_flat(f) if f != product else [f])]


def _fraction(expression):
    sign = -1 if expression.could_extract_minus_sign() else 1
    above, below = sp.fraction(sign * expression, exact=True)
    factors = [list(e.as_ordered_factors()) for e in (above, below)]
    return sign, factors[0], [factor for factor in factors[1] if factor != 1]


def _is_explicit(expression):
    return isinstance(expression, sp.MatrixBase | sp.BlockMatrix)


def _keeps_its_head(new):
    """Return whether an expression is more than a list of its parts, unlike a sum or product."""
    return not (new.is_Add or new.is_Mul or isinstance(new, (*SUMS, *ORDERED)))


def _grid(matrix):
    return (matrix.blocks if isinstance(matrix, sp.BlockMatrix) else matrix).shape


def _leaves(found):
    return sum(_all_leaves(expression) for expression in found.marked())


def _all_leaves(expression):
    inner = parts(expression)
    return sum(map(_all_leaves, inner)) if inner else 1
