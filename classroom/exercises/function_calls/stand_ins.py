"""Stand-ins: right functions in place of a student's wrong ones of earlier tasks.

A stand-in contains no right function: it sends its arguments to one that runs elsewhere."""

import contextlib

import numpy as np


class StandIn:
    """A callable that asks for the values of a right function while a task is judged.

    ask : (name of the function, arguments by position or name) -> the value; raises ValueError"""

    def __init__(self, name, ask):
        self._name, self._ask = name, ask

    def __call__(self, *arguments, **named):
        if self._ask is None:
            raise RuntimeError(f"this {self._name} can be called only while a task is judged")
        given = {str(k): argument for k, argument in enumerate(arguments)} | named
        return self._ask(self._name, {name: _numbers(self._name, a) for name, a in given.items()})


def _numbers(function, argument):
    """Convert an argument to an array; a Generator is replaced by a number that it draws."""
    if isinstance(argument, np.random.Generator):
        argument = argument.random()
    if isinstance(argument, int | np.integer):
        return np.array(argument)
    try:
        return _array(argument)
    except (TypeError, ValueError, RecursionError):
        what = type(argument).__name__
        raise TypeError(f"{function} got {what}, which is not an array of numbers") from None


def _array(argument):
    """Convert to an array; arrays of unlike shapes, as in an edge (i, j, z, Λ), become one row."""
    try:
        return np.array(argument, dtype=float)
    except ValueError:
        if not isinstance(argument, list | tuple):
            raise
    parts = [_array(part) for part in argument]
    alike = len({part.shape for part in parts}) == 1
    return np.array(parts) if alike else np.concatenate([part.ravel() for part in parts])


def as_returned(values):
    """Return one value itself, or several as a tuple; a value without dimensions is a number."""
    found = tuple(array if array.ndim else array[()] for array in map(np.asarray, values))
    return found if len(found) > 1 else found[0]


@contextlib.contextmanager
def replaced(namespace, names, ask):
    """Put stand-ins for some functions into a namespace, and remove them afterwards."""
    before = {name: namespace[name] for name in names if name in namespace}
    made = {name: StandIn(name, ask) for name in names}
    namespace.update(made)
    try:
        yield
    finally:
        for name, one in made.items():
            one._ask = None
            namespace.pop(name, None)
        namespace.update(before)
