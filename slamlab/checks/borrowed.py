"""What a student's functions borrow from the package though it answers the exercise.

The worker that grades does not hold these modules, so a notebook that imports one earns nothing
there; here it could be imported, and a check would promise points that nobody gets.
"""

from types import CodeType, FunctionType, ModuleType


def borrowed(functions, namespace, answers):
    """Find a module that answers the exercise among what functions use, by import or by name.

    Parameters
    ----------
    functions : names of the functions in the namespace
    namespace : the student's names
    answers : names of modules of slamlab

    Returns
    -------
    str, what is borrowed and from where, as the beginning of a sentence; None where nothing is
    """
    waiting, seen = list(functions), set()
    while waiting:
        name = waiting.pop()
        if name in seen or name not in namespace:
            continue
        seen.add(name)
        value = namespace[name]
        home = value.__name__ if isinstance(value, ModuleType) else _home(value)
        if found := _answering([home], answers):
            return f"{name} comes from {found}"
        if home.startswith("slamlab"):  # handed out: its names are not the notebook's
            continue
        for code in _codes(value):
            if found := _answering(code.co_names, answers):
                return f"{name} imports {found}"
            waiting += code.co_names
    return None


def _home(value):
    return str(getattr(value, "__module__", None) or "")


def _answering(modules, answers):
    """The first of some modules that is one of the answers, or inside of one."""
    for module in modules:
        if any(module == answer or module.startswith(f"{answer}.") for answer in answers):
            return module
    return None


def _codes(value):
    """The code of a function, of a class's methods, and of all that they define inside."""
    if isinstance(value, type):
        return [code for each in vars(value).values() for code in _codes(each)]
    code = value.__code__ if isinstance(value, FunctionType) else value
    if not isinstance(code, CodeType):
        return []
    return [code, *(inner for each in code.co_consts for inner in _codes(each))]
