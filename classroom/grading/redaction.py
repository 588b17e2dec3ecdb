"""Redaction of error messages, so that they reveal nothing about the secret inputs. Student code
controls every text, name and number of a worker: it can encode a secret input in the failing line,
the exception or the returned shape. Only the fixed messages of the function calls are shown, and
the gaps in these messages are filled only with names of the task's functions and outputs.
"""

import ast
import functools
import importlib.util
import re

from classroom.grading import syntax

# kinds of problem that a worker may report
PROBLEM_KINDS = {"missing", "not attempted", "raised", "malformed"}
# messages of the judge's checks, without numbers that the student's function chose
MEASURED = (
    (re.compile(r"returned shape \([\d, ]*\)(?: \(one number\))?, expected"),
     "returned a wrong shape; expected"),
    (re.compile(r"answered \d+ of \d+ calls"), "did not answer every call"),
    (re.compile(r"returned \d+ entries"), "returned entries"),
)  # fmt: skip

_GAP = r"(.{0,80}?)"
_HIDDEN = "…"
_SEE_CHECK = "run check(…) in the notebook for details"


def redact(kind, problem, task, calls):
    """Redact a worker's message for the student; ``calls`` names the module of function calls."""
    if kind == "raised":
        return f"raised an exception; {_SEE_CHECK}"
    known = _known_words(task)
    for template in sentence_templates(calls):
        if match := template.fullmatch(problem):
            return _filled(match, known)
    return "not attempted yet" if kind == "not attempted" else f"cannot be judged; {_SEE_CHECK}"


def redact_measured(problem):
    """Redact the shape or count in a message of the judge's checks."""
    for pattern, replacement in MEASURED:
        problem = pattern.sub(replacement, problem)
    return problem


def _known_words(task):
    """Return the texts allowed in a gap: functions, outputs, a question about transposition."""
    functions = set(task.call.functions)
    outputs = () if callable(task.shapes) else task.shapes
    parts = {f"{function}'s {output}" for function in functions for output in outputs}
    return functions | parts | {"", " (transposed?)"}


def _filled(match, known):
    """Return the message with unknown texts in its gaps hidden."""
    text, hidden = match.string, False
    for group in range(len(match.groups()), 0, -1):
        if match[group] not in known:
            start, end = match.span(group)
            text, hidden = text[:start] + _HIDDEN + text[end:], True
    if hidden and "shape" in text:
        text = "returned an array of a wrong shape"
    return f"{text}; {_SEE_CHECK}" if hidden else text


@functools.cache
def sentence_templates(calls):
    """Return patterns of all messages in an exercise's function calls; each gap is a group."""
    found = [re.compile(r"not attempted yet"), re.compile(rf"{_GAP} is not attempted yet")]
    for name in (calls, "classroom.exercises.function_calls"):
        with open(importlib.util.find_spec(name).origin, encoding="utf-8") as file:
            tree = syntax.parse(file.read())
        for call in ast.walk(tree):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "StudentError":
                found.append(_template(call.args[1]))
    return [pattern for pattern in found if pattern]


def _template(text):
    parts = text.values if isinstance(text, ast.JoinedStr) else [text]
    pattern = [re.escape(p.value) if isinstance(p, ast.Constant) else _GAP for p in parts]
    return re.compile("".join(pattern)) if any(isinstance(p, ast.Constant) for p in parts) else None
