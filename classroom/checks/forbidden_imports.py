"""Forbidden imports: detect functions that use a library module which solves the exercise.

The worker does not contain these modules, so a check must not award points for using them."""

from types import CodeType, FunctionType, ModuleType

from classroom import installed_course


def find_forbidden_import(functions, namespace, answers):
    """Find a module that functions use and that solves the exercise.

    Return the beginning of a sentence, such as "X comes from MODULE", or None."""
    waiting, seen = list(functions), set()
    while waiting:
        name = waiting.pop()
        if name in seen or name not in namespace:
            continue
        seen.add(name)
        value = namespace[name]
        module = value.__name__ if isinstance(value, ModuleType) else _module_of(value)
        if found := _answering([module], answers):
            return f"{name} comes from {found}"
        if (
            module.partition(".")[0] in installed_course.own_packages()
        ):  # handed out: its names are not the notebook's
            continue
        for code in _codes(value):
            if found := _answering(code.co_names, answers):
                return f"{name} imports {found}"
            waiting += code.co_names
    return None


def _module_of(value):
    return str(getattr(value, "__module__", None) or "")


def _answering(modules, answers):
    for module in modules:
        if any(module == answer or module.startswith(f"{answer}.") for answer in answers):
            return module
    return None


def _codes(value):
    """Return all code objects, also nested ones, of a function or of a class's methods."""
    if isinstance(value, type):
        return [code for each in vars(value).values() for code in _codes(each)]
    code = value.__code__ if isinstance(value, FunctionType) else value
    if not isinstance(code, CodeType):
        return []
    return [code, *(inner for each in code.co_consts for inner in _codes(each))]
