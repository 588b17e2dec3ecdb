"""Names that a room offers at its door, imported only when they are asked for (PEP 562).

A worker of the grader holds some modules of a room and not those that answer its exercise, so no
``__init__`` may import more than is asked for.
"""

import importlib
import sys
from types import ModuleType


def exports(room, modules):
    """The ``__getattr__``, ``__dir__`` and ``__all__`` of a package.

    Parameters
    ----------
    room : str, the package's ``__name__``
    modules : dict, module (relative to the room, or in full) to the names that it gives

    Returns
    -------
    (callable, callable, list of str)
    """
    home = {name: module for module, names in modules.items() for name in names}

    class Room(ModuleType):
        def __setattr__(self, name, value):
            # importing a module sets it on its package: never over a name that the door offers
            if not (name in home and isinstance(value, ModuleType)):
                super().__setattr__(name, value)

    sys.modules[room].__class__ = Room

    def get(name):
        if name not in home:
            raise AttributeError(f"module {room!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(home[name], room), name)
        setattr(sys.modules[room], name, value)  # the next time it is found without asking
        return value

    return get, lambda: sorted(home), sorted(home)
