"""Redaction: what is said of a task that fails, redacted so that it reveals nothing of the inputs.

The worker runs the student's code, so that any text of its may be the student's, and so may any
name and number in it: the line at which it fails, the exception that it raises, the shape that it
returns can be chosen by an input. Only sentences of the drives are passed on, and in their gaps
only the names of the functions that are asked for.
"""

import ast
import functools
import importlib.util
import re

from slamlab.grading import syntax

# kinds of problem that a worker may report
PROBLEM_KINDS = {"missing", "not attempted", "raised", "malformed"}
# what the judge itself measured, without the numbers that the student's function chose
MEASURED = (
    (re.compile(r"returned shape \([\d, ]*\)(?: \(one number\))?, expected"),
     "returned another shape than"),
    (re.compile(r"answered \d+ of \d+ calls"), "did not answer every call"),
    (re.compile(r"returned \d+ entries"), "returned entries"),
)  # fmt: skip

_GAP = r"(.{0,80}?)"
_HIDDEN = "…"
_SEE_CHECK = "check(…) in the notebook says more"


def redact(kind, problem, task, drives):
    """Redact the message of a failure so that a student may read it.

    Parameters
    ----------
    kind, problem : str, from the worker
    task : Task
    drives : str, the module of the exercise's drives

    Returns
    -------
    str
    """
    if kind == "raised":
        return "raised an exception; check(…) in the notebook shows which, and where"
    known = _known_words(task)
    for template in sentence_templates(drives):
        if match := template.fullmatch(problem):
            return _filled(match, known)
    return "not attempted yet" if kind == "not attempted" else f"cannot be judged; {_SEE_CHECK}"


def redact_measured(problem):
    """Redact what the judge measured of outputs: a shape, a count.

    Parameters
    ----------
    problem : str, of a verdict

    Returns
    -------
    str
    """
    for pattern, said in MEASURED:
        problem = pattern.sub(said, problem)
    return problem


def _known_words(task):
    """What may stand in a gap: a function, one of its outputs, a question."""
    functions = set(task.drive.functions)
    outputs = () if callable(task.shapes) else task.shapes
    parts = {f"{function}'s {output}" for function in functions for output in outputs}
    return functions | parts | {"", " (transposed?)"}


def _filled(match, known):
    """A sentence with each gap as it was, or hidden where it holds what is not known."""
    text, hidden = match.string, False
    for group in range(len(match.groups()), 0, -1):
        if match[group] not in known:
            start, end = match.span(group)
            text, hidden = text[:start] + _HIDDEN + text[end:], True
    return f"{text}; {_SEE_CHECK}" if hidden else text


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
    found = [re.compile(r"not attempted yet"), re.compile(rf"{_GAP} is not attempted yet")]
    for name in (drives, "slamlab.exercises.drives"):
        with open(importlib.util.find_spec(name).origin, encoding="utf-8") as file:
            tree = syntax.parse(file.read())
        for call in ast.walk(tree):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "StudentError":
                found.append(_template(call.args[1]))
    return [pattern for pattern in found if pattern]


def _template(text):
    parts = text.values if isinstance(text, ast.JoinedStr) else [text]
    said = [re.escape(p.value) if isinstance(p, ast.Constant) else _GAP for p in parts]
    return re.compile("".join(said)) if any(isinstance(p, ast.Constant) for p in parts) else None
