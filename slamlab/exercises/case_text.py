"""Put a failing case into words: what was called, what came back, what the law wants."""

import textwrap

import numpy as np

from slamlab.exercises.cases import Case
from slamlab.exercises.drives import StudentError
from slamlab.exercises.drives.arguments import CHANGED

WIDTH = 92  # of what is said [letters]
MOST = 60  # numbers of an array that are shown
INDENT = "      "
WRITTEN = {  # whole numbers that stand for something else, by their arrays' names
    "codes": lambda codes: repr("".join(chr(code) for code in codes if code > 0)),
    "data": lambda data: f"{bytes(data[data >= 0].tolist()).hex(' ')}   (bytes)",
}


def format_case(task, case: Case) -> str | None:
    """Format a case for a student.

    Parameters
    ----------
    task : Task
    case : Case

    Returns
    -------
    str, some lines; None where no single input is known that could be shown
    """
    if isinstance(case.outputs, StudentError) and not case.one:
        return None
    function = task.drive.functions[0]
    begin = f"For instance, with {case.probe}:" if case.probe else "For instance:"
    given = {n: a for n, a in case.inputs.items() if not n.startswith("_")}  # the judge's own
    lines = [begin]
    if given:
        lines += [f"{function} is given" if case.one else "given are", _named(given, case.one)]
    if isinstance(case.outputs, StudentError):
        return _joined([*lines, f"{'and' if given else 'it'} fails: {case.outputs.message}"])
    if case.law.name == "unchanged":
        names = list(case.inputs)
        which = [int(k) for k in case.outputs[CHANGED]]
        changed = " and ".join(names[k] if k < len(names) else f"argument {k}" for k in which)
        return _joined([f"{function} changes {changed}: work on a copy, such as {changed}.copy()"])
    want = case.law.want(case.inputs) if case.law.want else None
    shown = {n: a for n, a in case.outputs.items() if n != CHANGED and (not want or n in want)}
    lines += ["it returns", _named(shown, case.one)]
    if want:
        lines += ["and should return", _named(want, case.one)]
    elif case.law.why:
        lines += [case.law.why(case.inputs, case.outputs)]
    return _joined(lines)


def format_numbers(name, array) -> str:
    """Format a name and its numbers, short and rounded: "P = [[0.1, 0], [0, 0.2]]"."""
    array = np.asarray(array)
    if name in WRITTEN and array.ndim == 1:
        return f"{name} = {WRITTEN[name](array.astype(int))}"
    text = np.array2string(
        array,
        precision=4,
        suppress_small=bool(array.size and np.abs(array).max() > 1e-3),
        threshold=MOST,
        edgeitems=2,
        separator=", ",
        max_line_width=WIDTH,
        formatter={"float_kind": lambda x: f"{x:.4g}"} if array.dtype.kind == "f" else None,
    )
    label = "" if name == "result" else f"{name} = "
    size = f"   {array.shape}" if array.size > MOST else ""
    return f"{label}{text}{size}".replace("\n", "\n" + " " * len(label))


def _named(arrays, one):
    return "\n".join(
        textwrap.indent(format_numbers(n, a[0] if one and np.ndim(a) and len(a) else a), INDENT)
        for n, a in arrays.items()
    )


def _joined(lines):
    return "\n".join(line if line.startswith(INDENT) else f"    {line}" for line in lines)
