"""Drives (test drivers): call a student's functions on given inputs, the worker's side of a task.

No truth and no answer stands here or in the modules beside this one: a worker that runs student
code holds nothing else of the checks.
"""

import linecache
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from traceback import walk_tb

import numpy as np

from slamlab.exercises.drives.arguments import CHANGED, Watched

Arrays = Mapping[str, np.ndarray]

MAX_NUMBERS = 500_000
"""Most numbers of one output: more are no honest answer, and would not fit the pipe."""

_CELL = re.compile(r"<cell |<ipython-input|[/\\](ipykernel|xpython)_")


class StudentError(Exception):
    """A student's function is missing, fails, or returns nothing that can be judged.

    Parameters
    ----------
    kind : str, one of "missing", "not attempted", "raised", "malformed", "time", "died", "needs"
    message : str, what happened, in words for the student
    """

    def __init__(self, kind, message):
        super().__init__(message)
        self.kind, self.message = kind, message


def numbers(value, function):
    """Convert what a student's function returned to a float array.

    Parameters
    ----------
    value : anything
    function : str, the function's name, for the message

    Returns
    -------
    float array

    Raises
    ------
    StudentError : "malformed" when it is not made of real numbers
    """
    if value is None:
        raise StudentError(
            "malformed",
            f"{function} returned None, where numbers are wanted: does every way through it end "
            "with a return?",
        )
    try:
        if isinstance(value, str | bytes):  # which astype would read as numbers
            raise TypeError
        if _contains_itself(value):
            raise StudentError(
                "malformed",
                f"{function} returned a list that contains itself: was it appended to itself?",
            )
        array = np.asarray(value)
        if array.dtype.kind == "c":  # of which astype would take the half
            raise StudentError(
                "malformed", f"{function} returned complex numbers: a root of something negative?"
            )
        if array.dtype.kind not in "biufO":
            raise TypeError
        if array.size > MAX_NUMBERS:
            raise StudentError(
                "malformed",
                f"{function} returned {array.size} numbers: at most {MAX_NUMBERS} are allowed",
            )
        return array.astype(float)
    except StudentError:
        raise
    except Exception:  # an object may raise anything while it is being converted
        raise StudentError(
            "malformed",
            f"{function} returned {type(value).__name__}, which is no array of real numbers",
        ) from None


def _contains_itself(value, above=()):
    """Whether a list is one of its own elements, at any depth: NumPy would not end on one."""
    if not isinstance(value, list | tuple):
        return False
    above = (*above, id(value))
    return any(id(each) in above or _contains_itself(each, above) for each in value)


def shaped(value, what, shape):
    """Convert what a student's function returned to a float array of one shape.

    Parameters
    ----------
    value : anything
    what : str, what it is, for the message
    shape : tuple of int

    Raises
    ------
    StudentError : "malformed" when it is no such array
    """
    array = numbers(value, what)
    if array.shape != shape:
        raise StudentError("malformed", wrong_shape(what, array.shape, shape))
    return array


def wrong_shape(what, got, want) -> str:
    """Say that a function returned an array of a wrong shape, or that a value of it has one.

    Parameters
    ----------
    what : str, the function, or words for the value
    got : tuple of int
    want : tuple of int, None for any length
    """
    sizes = ", ".join("n" if n is None else str(n) for n in want)
    expected = f"({sizes},)" if len(want) == 1 else f"({sizes})"
    number = "" if want else " (one number)"
    turned = " (transposed?)" if got == want[::-1] and got != want else ""
    verb = "returned" if what.isidentifier() else "has"
    return f"{what} {verb} shape {got}, expected {expected}{number}{turned}"


def rows(inputs: Arrays):
    """Yield the arguments of each call: row i of each array, scalars as float, arrays as copies."""
    count = min(len(a) for a in inputs.values())
    for i in range(count):
        yield [float(a[i]) if a.ndim == 1 else np.array(a[i]) for a in inputs.values()]


def call_each(functions: Mapping[str, Callable], inputs: Arrays) -> dict[str, np.ndarray]:
    """Call the first function once per row of the inputs and stack what it returns as "result".

    Parameters
    ----------
    functions : name to function, in the task's order
    inputs : name to (n, ...) array, in the order of the function's arguments

    Returns
    -------
    {"result": (n, ...)}

    Raises
    ------
    StudentError : "malformed" when the results are no numbers or differ in shape
    """
    name, function = next(iter(functions.items()))
    results = [numbers(function(*row), name) for row in rows(inputs)]
    shapes = sorted({r.shape for r in results})
    if len(shapes) > 1:
        raise StudentError(
            "malformed", f"{name} returned arrays of different shapes: {shapes[0]}, {shapes[1]}"
        )
    return {"result": np.array(results)}


@dataclass(frozen=True)
class Drive:
    """A drive (test driver): how a task calls a student's functions.

    Parameters
    ----------
    functions : names the student must define, in order
    run : (functions by name, inputs) -> arrays
    seconds : float, timeout (wall clock) of one run [s]
    """

    functions: tuple[str, ...]
    run: Callable[[Mapping[str, Callable], Arrays], dict[str, np.ndarray]] = call_each
    seconds: float = 10.0

    def __call__(self, namespace: Mapping, inputs: Arrays) -> dict[str, np.ndarray]:
        """Find the functions in a namespace and run them.

        Parameters
        ----------
        namespace : the student's names
        inputs : name to array

        Returns
        -------
        name to array, and which arguments were changed as :data:`CHANGED`

        Raises
        ------
        StudentError : when a function is missing, not attempted, fails, or returns no numbers
        KeyboardInterrupt : when the person at the keyboard, or a time limit, stopped it
        """
        functions = {}
        for name in self.functions:
            if name not in namespace:
                raise StudentError("missing", f"{name} is not defined")
            if not callable(namespace[name]):
                what = type(namespace[name]).__name__
                raise StudentError("malformed", f"{name} is of type {what}, not a function")
            functions[name] = Watched(namespace[name])
        try:
            outputs = dict(self.run(functions, inputs))
        except (StudentError, KeyboardInterrupt):
            raise
        except BaseException as error:  # SystemExit too: sys.exit() in a function is a mistake
            if type(error) is NotImplementedError:  # input() raises one of its own kind
                raise StudentError("not attempted", self._unsolved(error)) from None
            raise StudentError("raised", describe(error)) from None
        changed = set().union(*(function.changed for function in functions.values()))
        return outputs | {CHANGED: np.array(sorted(changed), dtype=float)}

    def _unsolved(self, error):
        """That something is not attempted yet: which, unless it is the only function there is."""
        codes = [frame.f_code for frame, _ in walk_tb(error.__traceback__)]
        theirs = [code for code in codes if _CELL.search(code.co_filename)]
        which = [code.co_name for code in codes if code in theirs or code.co_name in self.functions]
        named = f"{which[-1]} is " if which and which[-1:] != [*self.functions] else ""
        return f"{named}not attempted yet"


def describe(error: BaseException) -> str:
    """Describe an exception in one line, with the last line of student code in its traceback.

    Parameters
    ----------
    error : BaseException

    Returns
    -------
    str
    """
    where, traceback = "", error.__traceback__
    while traceback is not None:
        frame, number = traceback.tb_frame, traceback.tb_lineno
        # cells have no file of their own: "<cell 3>" in the worker, "/tmp/ipykernel_…" in a kernel
        if _CELL.search(frame.f_code.co_filename):
            name = frame.f_code.co_name
            inside = "" if name == "<module>" else f", in {name}"
            where = f"{_line(frame, number)} (line {number} of the cell{inside})"
        traceback = traceback.tb_next
    try:
        text = str(error)[:1000].strip().splitlines()
    except Exception:  # an exception class of the student's own may fail at this, too
        text = []
    return f"{type(error).__name__}: {text[0][:300] if text else 'no message'}{where}"


def place(file, number) -> str:
    """Say which line of a cell it is: " (line 2 of the cell)"; "" where a file is no cell."""
    return f" (line {number} of the cell)" if _CELL.search(file) else ""


def _line(frame, number):
    """The line of code at which a frame stands, and the shapes of the arrays in it."""
    line = linecache.getline(frame.f_code.co_filename, number).strip()
    arrays = {w: frame.f_locals.get(w) for w in dict.fromkeys(re.findall(r"[^\W\d]\w*", line))}
    shapes = [f"{w} is {a.shape}" for w, a in arrays.items() if type(a) is np.ndarray]
    cut = f"{line[:99]}…" if len(line) > 100 else line
    said = "; ".join([f"`{cut}`"] * bool(line) + [", ".join(shapes[:6])] * bool(shapes))
    return f", at {said}" if said else ""
