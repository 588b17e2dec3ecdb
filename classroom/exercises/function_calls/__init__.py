"""Calls of a student's functions on the inputs of a task (test driver); the worker's side.

``changed_arguments`` (detects mutation), ``run_and_pack`` (all sets of inputs in one message),
``stand_ins`` (ask for the values of right functions that run elsewhere);
``several_values``, ``slam_step``, ``student_estimator`` (for more than one exercise). A worker
that runs student code contains no other part of the checks: no laws, no right answers."""

import linecache
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from traceback import walk_tb

import numpy as np

from classroom.exercises.function_calls.changed_arguments import CHANGED, WatchedFunction

Arrays = Mapping[str, np.ndarray]

MAX_NUMBERS = 500_000
"""Largest size of one output: no right answer is larger, and the pipe limits a message."""

_LINE_OF_SYNTAX_ERROR = re.compile(r" \((<cell \d+>), line (\d+)\)$")
_CELL = re.compile(r"<cell |<ipython-input|[/\\](ipykernel|xpython)_")


class StudentError(Exception):
    """A student's function is missing, fails, or returns nothing that can be judged.

    kind : "missing", "not attempted", "raised", "malformed", "time" or "died"."""

    def __init__(self, kind, message):
        super().__init__(message)
        self.kind, self.message = kind, message


def to_array(value, function):
    """Convert a value that a student's function returned to a float array.

    Raises StudentError "malformed"."""
    if value is None:
        raise StudentError(
            "malformed",
            f"{function} returned None, but must return numbers. Does every branch end with a "
            "return statement?",
        )
    try:
        if isinstance(value, str | bytes):  # astype would convert them to numbers
            raise TypeError
        if _contains_itself(value):
            raise StudentError(
                "malformed",
                f"{function} returned a list that contains itself. Is a list appended to itself?",
            )
        array = np.asarray(value)
        if array.dtype.kind == "c":  # astype would drop the imaginary part
            raise StudentError(
                "malformed",
                f"{function} returned complex numbers. Is there a root of a negative number?",
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
    except Exception:  # the conversion of an object may raise any exception
        raise StudentError(
            "malformed",
            f"{function} returned {type(value).__name__}, which is not an array of real numbers",
        ) from None


def _contains_itself(value, above=()):
    """Whether a list contains itself at any depth, so that NumPy would not terminate."""
    if not isinstance(value, list | tuple):
        return False
    above = (*above, id(value))
    return any(id(each) in above or _contains_itself(each, above) for each in value)


def to_shaped_array(value, what, shape):
    """Convert like :func:`to_array`, and check the shape; ``what`` names the value in messages."""
    array = to_array(value, what)
    if array.shape != shape:
        raise StudentError("malformed", wrong_shape_message(what, array.shape, shape))
    return array


def wrong_shape_message(what, got, want) -> str:
    """Return the message for a value of a wrong shape; None in ``want`` stands for any length."""
    sizes = ", ".join("n" if n is None else str(n) for n in want)
    expected = f"({sizes},)" if len(want) == 1 else f"({sizes})"
    number = "" if want else " (one number)"
    turned = " (transposed?)" if got == want[::-1] and got != want else ""
    verb = "returned" if what.isidentifier() else "has"
    return f"{what} {verb} shape {got}, expected {expected}{number}{turned}"


def argument_rows(inputs: Arrays):
    """Yield the arguments of each call: row i of each array, scalars as float."""
    count = min(len(a) for a in inputs.values())
    for i in range(count):
        yield [float(a[i]) if a.ndim == 1 else np.array(a[i]) for a in inputs.values()]


def call_each(functions: Mapping[str, Callable], inputs: Arrays) -> dict[str, np.ndarray]:
    """Call the first function once per row and stack the returned values as "result"."""
    name, function = next(iter(functions.items()))
    results = [to_array(function(*row), name) for row in argument_rows(inputs)]
    shapes = sorted({r.shape for r in results})
    if len(shapes) > 1:
        raise StudentError(
            "malformed", f"{name} returned arrays of different shapes: {shapes[0]}, {shapes[1]}"
        )
    return {"result": np.array(results)}


@dataclass(frozen=True)
class FunctionCall:
    """A task's call of a student's functions (test driver)."""

    functions: tuple[str, ...]  # names the student must define, in order
    run: Callable[[Mapping[str, Callable], Arrays], dict[str, np.ndarray]] = call_each
    seconds: float = 10.0  # timeout (wall clock) of one run [s]

    def __call__(self, namespace: Mapping, inputs: Arrays) -> dict[str, np.ndarray]:
        """Find the functions in a namespace, call them, and return their outputs by name.

        The output :data:`CHANGED` lists the changed arguments. Raises StudentError."""
        functions = {}
        for name in self.functions:
            if name not in namespace:
                raise StudentError("missing", f"{name} is not defined")
            if not callable(namespace[name]):
                what = type(namespace[name]).__name__
                raise StudentError("malformed", f"{name} is of type {what}, not a function")
            functions[name] = WatchedFunction(namespace[name])
        try:
            outputs = dict(self.run(functions, inputs))
        except (StudentError, KeyboardInterrupt):
            raise
        except BaseException as error:  # SystemExit, too: sys.exit() in a function is a mistake
            if type(error) is NotImplementedError:  # input() raises a subclass
                raise StudentError("not attempted", self._unsolved(error)) from None
            raise StudentError("raised", describe_exception(error)) from None
        changed = set().union(*(function.changed for function in functions.values()))
        return outputs | {CHANGED: np.array(sorted(changed), dtype=float)}

    def _unsolved(self, error):
        """Return the message for an unattempted function, with its name if there are several."""
        codes = [frame.f_code for frame, _ in walk_tb(error.__traceback__)]
        theirs = [code for code in codes if _CELL.search(code.co_filename)]
        which = [code.co_name for code in codes if code in theirs or code.co_name in self.functions]
        named = f"{which[-1]} is " if which and which[-1:] != [*self.functions] else ""
        return f"{named}not attempted yet"


def describe_exception(error: BaseException) -> str:
    """Describe an exception in one line, with the last line of student code in its traceback."""
    where, traceback = "", error.__traceback__
    while traceback is not None:
        frame, number = traceback.tb_frame, traceback.tb_lineno
        # cells have no file: "<cell 3>" in the worker, "/tmp/ipykernel_…" in a kernel
        if _CELL.search(frame.f_code.co_filename):
            name = frame.f_code.co_name
            inside = "" if name == "<module>" else f", in {name}"
            where = f"{_line(frame, number)} (line {number} of the cell{inside})"
        traceback = traceback.tb_next
    try:
        text = str(error)[:1000].strip().splitlines()
    except Exception:  # str() of a student's exception class may fail, too
        text = []
    text = text[0][:300] if text else "no message"
    text = _LINE_OF_SYNTAX_ERROR.sub(lambda found: line_in_cell(*found.groups()), text)
    return f"{type(error).__name__}: {text}{where}"


def line_in_cell(file, number) -> str:
    """Format the line of a cell, " (line 2 of the cell)"; return "" for other files."""
    return f" (line {number} of the cell)" if _CELL.search(file) else ""


def _line(frame, number):
    """Format the current line of a frame, and the shapes of the arrays in this line."""
    line = linecache.getline(frame.f_code.co_filename, number).strip()
    arrays = {w: frame.f_locals.get(w) for w in dict.fromkeys(re.findall(r"[^\W\d]\w*", line))}
    shapes = [f"{w} is {a.shape}" for w, a in arrays.items() if type(a) is np.ndarray]
    cut = f"{line[:99]}…" if len(line) > 100 else line
    text = "; ".join([f"`{cut}`"] * bool(line) + [", ".join(shapes[:6])] * bool(shapes))
    return f", at {text}" if text else ""
