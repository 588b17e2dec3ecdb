"""Forbidden imports: detect functions that use a module of the course that the worker lacks, such
as one that solves the exercise. A check must not award points that grading would not award."""

import re
import sys
from types import CodeType, FunctionType, ModuleType

from classroom import installed_course
from classroom.grading.import_closure import STUBBED
from classroom.grading.staging import worker_modules

_DOTTED = re.compile(r"\w+(\.\w+)+")


def find_forbidden_import(functions, namespace, exercise):
    """Find a module that functions use and that is unavailable during grading.

    Return the beginning of a sentence, such as "X comes from MODULE, which …", or None."""
    waiting, seen = list(functions), set()
    while waiting:
        name = waiting.pop()
        if name in seen or name not in namespace:
            continue
        seen.add(name)
        value = namespace[name]
        if _is_own(_module_of(value)):
            if _lacks(exercise, _module_of(value)):
                return f"{name} comes from {_reason(exercise, _module_of(value))}"
            continue  # handed out: its names are not the notebook's
        for code in _codes(value):
            for module in _modules(code, namespace):
                if _lacks(exercise, module):
                    return f"{name} imports {_reason(exercise, module)}"
            waiting += code.co_names
    return None


def _reason(exercise, module):
    solves = any(f"{module}.".startswith(f"{answer}.") for answer in exercise.answers)
    return f"{module}, which {'solves this exercise and ' * solves}is unavailable during grading"


def _is_own(module):
    return module.partition(".")[0] in installed_course.own_packages()


def _lacks(exercise, module):
    """Whether the worker lacks a module of the course."""
    stubbed = f"{module}.".startswith(f"{STUBBED}.")
    return _is_own(module) and not stubbed and module not in worker_modules(exercise)


def _module_of(value):
    name = "__name__" if isinstance(value, ModuleType) else "__module__"
    return str(getattr(value, name, None) or "")


def _modules(code, namespace):
    """Return the modules that code imports, by a statement or by name, and those that it reaches
    as attributes of a package."""
    named = [c for c in code.co_consts if isinstance(c, str) and _DOTTED.fullmatch(c)]  # importlib
    waiting = [namespace.get(name, sys.modules.get(name)) for name in code.co_names]
    reached = []
    while waiting:
        value = waiting.pop()
        if isinstance(value, ModuleType) and _is_own(value.__name__):
            within = [getattr(value, name, None) for name in code.co_names]
            found = [v for v in within if v is not None and _module_of(v) not in reached]
            reached += map(_module_of, found)
            waiting += found
    return [*code.co_names, *named, *reached]


def _codes(value):
    """Return all code objects, also nested ones, of a function or of a class's methods."""
    if isinstance(value, type):
        return [code for each in vars(value).values() for code in _codes(each)]
    code = value.__code__ if isinstance(value, FunctionType) else value
    if not isinstance(code, CodeType):
        return []
    return [code, *(inner for each in code.co_consts for inner in _codes(each))]
