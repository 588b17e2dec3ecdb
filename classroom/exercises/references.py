"""Right functions (references) that replace wrong or missing functions of earlier tasks.

With them a mistake costs points only in its own task (error carried forward). They run in the
judge, never in a worker, and their calls are bounded and counted."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from classroom.exercises.function_calls import Arrays
from classroom.exercises.function_calls.stand_ins import as_returned, replaced

MAX_CALLS = 20_000  # in one run of a task
MAX_NUMBERS = 20_000  # in the arguments of one call
MAX_ALL_NUMBERS = 100_000_000  # in the arguments of all calls of a run


@dataclass(frozen=True)
class Reference:
    """A right function of a task, computed as the laws compute the right outputs.

    want : inputs of one call, arrays with one row by argument -> outputs with one row by name"""

    function: str
    arguments: str  # names, separated by spaces, as in the notebook
    want: Callable[[Arrays], Arrays]
    returns: str = "result"  # names of the outputs, separated by spaces, in the order of `return`

    def __call__(self, given: Arrays) -> list[np.ndarray]:
        """Return the values for the arguments of one call, named or numbered by position."""
        names = self.arguments.split()
        by_name = {names[int(k)] if k.isdecimal() else k: a for k, a in given.items()}
        if by_name.keys() != set(names) or len(by_name) != len(given):
            raise TypeError
        outputs = self.want({name: by_name[name][None] for name in names})
        return [np.asarray(outputs[name])[0] for name in self.returns.split()]


class ReferenceCalls:
    """Answers the calls of right functions during one run of a task; ``count`` counts them."""

    def __init__(self, references: Sequence[Reference]):
        self._references = {reference.function: reference for reference in references}
        self.count = self._numbers = 0

    @property
    def names(self):
        return tuple(self._references)

    def values(self, name, given: Arrays) -> list[np.ndarray]:
        """Return the values of a right function. Raises ValueError."""
        self.count += 1
        size = sum(array.size for array in given.values())
        self._numbers += size
        within = self.count <= MAX_CALLS and self._numbers <= MAX_ALL_NUMBERS
        if not within or size > MAX_NUMBERS:
            raise ValueError(f"{name} was called too often, or with too many numbers")
        try:
            with np.errstate(all="ignore"):
                values = self._references[name](given)
            if not all(array.dtype.kind in "fiub" for array in values):
                raise TypeError
            return values
        except Exception:  # a student's arguments may be anything
            shapes = ", ".join(str(array.shape) for array in given.values())
            problem = f"{name} has no result for these arguments, of shapes {shapes}: are their"
            raise ValueError(f"{problem} shapes right, and each P positive definite?") from None


NO_REFERENCES = ReferenceCalls(())


def in_place(namespace, references):
    """Replace functions of a namespace by references that run in this process, without bounds:
    context manager for a notebook, where students can read the library anyway."""

    def ask(name, given):
        return as_returned(ReferenceCalls(references).values(name, given))

    return replaced(namespace, [reference.function for reference in references], ask)
