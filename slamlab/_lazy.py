"""Lazy doors: the names that a room offers, each imported only when it is asked for.

A worker of the grader holds some modules of a room and not those that answer its exercise, so the
``__init__`` of such a room may import no more than is asked for.
"""

import importlib
import sys
from types import ModuleType


class Room(ModuleType):
    """A package with a lazy door: ``_homes`` leads from a name that it offers to its module."""

    def __getattr__(self, name):
        if name not in self._homes:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(self._homes[name], self.__name__), name)
        vars(self)[name] = value  # the next time it is found without asking
        return value

    def __dir__(self):
        return vars(self).keys() | self._homes.keys()

    def __setattr__(self, name, value):
        # importing a module sets it on its package: never over a name that the door offers
        if not (name in self._homes and isinstance(value, ModuleType)):
            super().__setattr__(name, value)

    def __reduce__(self):  # pickled by name, as other modules are by cloudpickle
        return importlib.import_module, (self.__name__,)


def exports(room, modules):
    """Give a package its lazy door.

    Parameters
    ----------
    room : str, the package's ``__name__``
    modules : dict, module (relative to the room, or in full) to the names that it gives

    Returns
    -------
    list of str, its ``__all__``
    """
    package = sys.modules[room]
    package._homes = {name: module for module, names in modules.items() for name in names}
    package.__class__ = Room
    return sorted(package._homes)
