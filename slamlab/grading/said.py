"""What a worker says of a task, passed on only as far as it can tell nothing of the inputs.

The worker runs the student's code, so that any text of its may be the student's: only sentences of
the drives are passed on, and in their gaps only names and small numbers that are known anyway.
"""

import ast
import builtins
import functools
import importlib.util
import re

KINDS = {"missing", "not attempted", "raised", "malformed"}
TYPES = {name for name, value in vars(builtins).items() if isinstance(value, type)}
WORDS = TYPES | {"NoneType", "function", "generator", "module", "ndarray", "matrix", "DataFrame"}
WORDS |= {"Series", "MutableDenseMatrix", "transposed", "and", "is"}

_RAISED = re.compile(r"(\w+): .*?( \(line \d{1,6} of the cell(?:, in (\w{1,60}))?\))?", re.S)
_GAP = r"(.{0,80}?)"
_LONG_NUMBER = re.compile(r"\d*\.\d+|\d{5,}")
_WORD = re.compile(r"[^\W\d]\w*")
_ELSE = "check(…) in the notebook says more"


def told(kind, problem, task, exercise, cells):
    """A failure as a student may read it.

    Parameters
    ----------
    kind, problem : str, from the worker
    task : Task
    exercise : Exercise
    cells : list of (number, source), the student's

    Returns
    -------
    str
    """
    if kind == "raised":
        return _raised(problem, cells)
    known = WORDS | set(task.drive.functions)
    for template in sentences(exercise.drives):
        match = template.fullmatch(problem)
        if match and known.issuperset(_WORD.findall(" ".join(match.groups()))):
            return _LONG_NUMBER.sub("…", problem)
    return "not attempted yet" if kind == "not attempted" else f"cannot be judged; {_ELSE}"


@functools.cache
def sentences(drives):
    """The patterns of what the drives of an exercise may say.

    Parameters
    ----------
    drives : str, their module, which is read and not run

    Returns
    -------
    list of patterns, a group for each gap in them
    """
    found = [re.compile(r"((?:\w+ is )?)not attempted yet")]
    for name in (drives, "slamlab.checks.drives"):
        with open(importlib.util.find_spec(name).origin, encoding="utf-8") as file:
            tree = ast.parse(file.read())
        for call in ast.walk(tree):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "StudentError":
                found.append(_pattern(call.args[1]))
    return [pattern for pattern in found if pattern]


def _pattern(text):
    parts = text.values if isinstance(text, ast.JoinedStr) else [text]
    said = [re.escape(p.value) if isinstance(p, ast.Constant) else _GAP for p in parts]
    return re.compile("".join(said)) if any(isinstance(p, ast.Constant) for p in parts) else None


def _raised(problem, cells):
    match = _RAISED.fullmatch(problem)
    name, where, function = match.groups() if match else ("", "", None)
    if name not in TYPES:
        name = "an exception of its own"
    if function and not any(f"def {function}(" in source for _, source in cells):
        where = ""
    return f"raised {name}{where or ''}; check(…) in the notebook shows what it says"
