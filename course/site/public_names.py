"""Public names (API) of the library: the exports of each component, each name once."""

import importlib
import pkgutil
import re
from functools import cache

import slamlab

INTERNAL = ("cli", "extras", "files", "parallel")  # components that only serve the others


@cache
def by_component():
    """Return the public names of each component that has any, in the order of the data flow.

    Returns
    -------
    dict, component to {dotted module: {name: object}}, of the component and its subpackages
    """
    found, listed = {}, []
    for component in re.findall(r"^(\w+) {2,}\S", slamlab.__doc__, re.MULTILINE):
        top = importlib.import_module(f"slamlab.{component}")
        inside = pkgutil.iter_modules(getattr(top, "__path__", ()))
        below = [importlib.import_module(f"{top.__name__}.{x.name}") for x in inside if x.ispkg]
        for module in [top, *below] if component not in INTERNAL else ():
            names = _exported(module)
            new = {n: o for n, o in names.items() if not any(o is x for x in listed)}
            listed += new.values()
            # a subpackage whose names the component itself exports is not listed again
            if new and (module is top or new == names):
                found.setdefault(component, {})[module.__name__] = new
    return found


def page_of(module, name):
    """Return the component whose page documents a function, method or class, or None."""
    for component, modules in by_component().items():
        for exported in modules.values():
            for each in exported.values():
                if getattr(each, "__module__", None) == module and (
                    getattr(each, "__name__", None) == name or name in vars(each)
                ):
                    return component
    return None


def _exported(module):
    """Map names to objects: those in ``__all__``, or else the definitions of a module."""
    names = getattr(module, "__all__", None)
    if names is None and not hasattr(module, "__path__"):
        public = {n: o for n, o in vars(module).items() if not n.startswith("_")}
        names = [n for n, o in public.items() if getattr(o, "__module__", "") == module.__name__]
    return {name: getattr(module, name) for name in names or ()}
