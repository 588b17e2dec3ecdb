"""Text of a failing case: the arguments, the returned values, the expected values."""

import re
import textwrap

import numpy as np

from classroom.exercises.case_presentation import PRESENTATIONS, CasePresentation
from classroom.exercises.failing_cases import FailingCase
from classroom.exercises.function_calls import StudentError
from classroom.exercises.function_calls.changed_arguments import ARGUMENT_NAMES, CHANGED

WIDTH = 92  # of the text without its margin [characters]
MOST = 60  # numbers of an array that are shown
MARGIN, INDENT = "    ", "      "
WRITTEN = {  # arrays of integers that encode text or bytes, by name
    "codes": lambda codes: repr("".join(chr(code) for code in codes if code > 0)),
    "data": lambda data: f"{bytes(data[data >= 0].tolist()).hex(' ')}   (bytes)",
}
UNNAMED = "result", "codes"  # a single returned value has no name that a student knows


def format_case(task, case: FailingCase) -> str | None:
    """Format a task's failing case in lines; return None if no single input can be shown."""
    if isinstance(case.outputs, StudentError) and not case.one:
        return None
    function = task.call.functions[0]
    begin = f"For instance, with {case.probe}:" if case.probe else "For instance:"
    failed = isinstance(case.outputs, StudentError)
    reading = PRESENTATIONS.get(task.id, CasePresentation())
    inputs, got = _read(reading, case.inputs, {} if failed else case.outputs, case.one)
    shown = _named(inputs, True)
    given = [reading.called or f"{function} is given", shown] if shown else []
    if failed:
        why = re.split(r", at `| \(line", case.outputs.message)[0]  # the verdict shows the rest
        fails = f"{'and' if given else function} fails: {why}"
        return _joined([begin, *given, fails])
    if case.law.name == "unchanged":
        names = ARGUMENT_NAMES.get(task.id) or list(case.inputs)
        changed = [names[int(k)] for k in case.outputs[CHANGED]]
        return _joined([f"{function} changes {' and '.join(changed)}."])
    want = case.law.want(case.inputs) if case.law.want else {}
    lines = _reason(case.law, case.inputs, _returned(case.outputs))
    if not case.one:  # a whole set is too long to show
        taken = f"Taken together, with {case.probe}:" if case.probe else "Taken together:"
        return _joined([taken, *lines]) if lines else None
    try:
        want = _read(reading, case.inputs, want, True)[1]
    except KeyError:  # a law may determine a part of the outputs only
        got = _returned(case.outputs)
    got = {name: got[name] for name in want if name in got} or got
    shown = [*given, reading.returned, _named(got, True)]
    if want:
        shown += ["and should return", _named(want, True), *_worst(got, want)]
    return _joined([begin, *shown, *lines])


def _returned(outputs):
    return {name: array for name, array in outputs.items() if name != CHANGED}


def _read(reading, inputs, outputs, one):
    inputs = {name: array for name, array in inputs.items() if not name.startswith("_")}
    outputs = _returned(outputs)
    if not one:
        return inputs, outputs
    rows = [
        {name: a[0] if np.ndim(a) and len(a) else a for name, a in arrays.items()}
        for arrays in (inputs, outputs)
    ]
    return [{n: np.asarray(a)[None] for n, a in shown.items()} for shown in reading.shown(*rows)]


def _worst(got, want):
    """Yield an array's largest error if the array is large or the printed numbers are equal."""
    shares = {
        name: _share_off(got[name], right)
        for name, right in want.items()
        if name in got and got[name].shape == right.shape and right.dtype.kind != "U"
    }
    name = max(shares, key=lambda name: shares[name].max(initial=0), default=None)
    if name is None or not shares[name].max(initial=0) > 0:
        return
    mine, right = got[name][0], want[name][0]
    equal = format_numbers(name, mine) == format_numbers(name, right)
    if equal or right.size > MOST:  # otherwise the difference is visible
        at = np.unravel_index(np.argmax(shares[name]), right.shape)
        index = f"[{', '.join(map(str, at))}]" if at else ""
        digits = 12 if equal else 4
        numbers = f"{mine[at]:.{digits}g} instead of {right[at]:.{digits}g}"
        yield f"the largest error is at {name}{index}: {numbers}"


def _share_off(got, right):
    """Compute the errors of the first row relative to its largest expected number."""
    with np.errstate(invalid="ignore", divide="ignore"):
        off = np.nan_to_num(np.abs(got - right)[0])
        return np.nan_to_num(off / np.abs(right[0]).max(initial=0))


def format_numbers(name, array) -> str:
    """Format an array's name and rounded numbers: "P = [[0.1, 0], [0, 0.2]]"."""
    array = np.asarray(array)
    label = "" if name in UNNAMED else f"{name} = "
    if array.dtype.kind == "U":  # no number was returned
        return f"{label}{array}".replace("\n", "\n" + " " * len(label))
    if name in WRITTEN and array.ndim == 1:
        written = f"{label}{WRITTEN[name](array.astype(int))}"
        return textwrap.fill(written, WIDTH, subsequent_indent=" " * len(label))
    if array.dtype.kind == "f":  # neither -0 nor rounding errors
        most = np.abs(array[np.isfinite(array)]).max(initial=0)
        array = np.where(np.abs(array) <= 1e-12 * most, 0.0, array)  # NaN stays NaN
    text = np.array2string(
        array,
        precision=4,
        suppress_small=bool(array.size and np.abs(array).max() > 1e-3),
        threshold=MOST,
        edgeitems=2,
        separator=", ",
        max_line_width=WIDTH - len(label),
        formatter={"float_kind": _short} if array.dtype.kind == "f" else None,
    )
    size = f"   {array.shape}" if array.size > MOST else ""
    return f"{label}{text}{size}".replace("\n", "\n" + " " * len(label))


def _short(x):
    """Format a number with four digits, but an integer (perhaps a seed) with all digits."""
    return f"{x:.0f}" if float(x).is_integer() and abs(x) < 1e12 else f"{x:.4g}"


def _reason(law, inputs, outputs):
    try:
        return [law.why(inputs, outputs)] if law.why else []
    except Exception:  # malformed outputs may have no explanation
        return []


def _named(arrays, one):
    return "\n".join(
        textwrap.indent(format_numbers(n, a[0] if one and np.ndim(a) and len(a) else a), INDENT)
        for n, a in arrays.items()
    )


def _joined(lines):
    return "\n".join(line if line.startswith(INDENT) else wrapped(line, MARGIN) for line in lines)


def wrapped(text, margin="") -> str:
    """Wrap each line, indented by a margin, because JupyterLab breaks long lines inside words."""
    width = len(MARGIN) + WIDTH
    first, later = margin, margin + INDENT[len(MARGIN) :]
    filled = (
        textwrap.fill(line.strip(), width, initial_indent=first, subsequent_indent=later)
        for line in text.splitlines()
    )
    return "\n".join(filled)
