"""Redaction: what a worker says of a task, redacted so that it reveals nothing of the inputs.

The worker runs the student's code, so that any text of its may be the student's: only sentences of
the drives are passed on, and in their gaps only names and small numbers that are known anyway.
"""

import ast
import builtins
import functools
import importlib.util
import re

# kinds of problem that a worker may report
PROBLEM_KINDS = {"missing", "not attempted", "raised", "malformed"}
BUILTIN_TYPES = {name for name, value in vars(builtins).items() if isinstance(value, type)}
# words that may fill a gap of a message
ALLOWED_WORDS = BUILTIN_TYPES | {
    "NoneType",
    "function",
    "generator",
    "module",
    "ndarray",
    "matrix",
    "DataFrame",
}
ALLOWED_WORDS |= {"Series", "MutableDenseMatrix", "transposed", "and", "is"}

_RAISED = re.compile(r"(\w+): .*?( \(line \d{1,6} of the cell(?:, in (\w{1,60}))?\))?", re.S)
_GAP = r"(.{0,80}?)"
_LONG_NUMBER = re.compile(r"\d*\.\d+|\d{5,}")
_WORD = re.compile(r"[^\W\d]\w*")
_SEE_CHECK = "check(…) in the notebook says more"


def redact(kind, problem, task, exercise, cells):
    """Redact the message of a failure so that a student may read it.

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
        return _redact_exception(problem, cells)
    known = ALLOWED_WORDS | set(task.drive.functions)
    for template in sentence_templates(exercise.drives):
        match = template.fullmatch(problem)
        if match and known.issuperset(_WORD.findall(" ".join(match.groups()))):
            return _LONG_NUMBER.sub("…", problem)
    return "not attempted yet" if kind == "not attempted" else f"cannot be judged; {_SEE_CHECK}"


@functools.cache
def sentence_templates(drives):
    """The templates of all messages that the drives of an exercise may give, as patterns.

    Parameters
    ----------
    drives : str, their module, which is read and not run

    Returns
    -------
    list of patterns, a group for each gap in them
    """
    found = [re.compile(r"((?:\w+ is )?)not attempted yet")]
    for name in (drives, "slamlab.exercises.drives"):
        with open(importlib.util.find_spec(name).origin, encoding="utf-8") as file:
            tree = ast.parse(file.read())
        for call in ast.walk(tree):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "StudentError":
                found.append(_template(call.args[1]))
    return [pattern for pattern in found if pattern]


def _template(text):
    parts = text.values if isinstance(text, ast.JoinedStr) else [text]
    said = [re.escape(p.value) if isinstance(p, ast.Constant) else _GAP for p in parts]
    return re.compile("".join(said)) if any(isinstance(p, ast.Constant) for p in parts) else None


def _redact_exception(problem, cells):
    match = _RAISED.fullmatch(problem)
    name, where, function = match.groups() if match else ("", "", None)
    if name not in BUILTIN_TYPES:
        name = "an exception of its own"
    if function and not any(f"def {function}(" in source for _, source in cells):
        where = ""
    return f"raised {name}{where or ''}; check(…) in the notebook shows what it says"
