"""Lazy imports: each public name of a package is imported at its first use (PEP 562)."""

import importlib
import sys
from types import ModuleType


class LazyPackage(ModuleType):
    """Package with lazy imports; ``_modules`` maps each public name to its module."""

    def __getattr__(self, name):
        if name not in self._modules:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(self._modules[name], self.__name__), name)
        vars(self)[name] = value  # cached: __getattr__ is not called again
        return value

    def __dir__(self):
        return vars(self).keys() | self._modules.keys()

    def __setattr__(self, name, value):
        # the import of a submodule must not replace a public name
        if not (name in self._modules and isinstance(value, ModuleType)):
            super().__setattr__(name, value)

    def __reduce__(self):  # pickled by name, as other modules are by cloudpickle
        return importlib.import_module, (self.__name__,)


def exports(package_name, modules):
    """Set the lazy imports {module: names} of a package and return its ``__all__``."""
    package = sys.modules[package_name]
    package._modules = {name: module for module, names in modules.items() for name in names}
    package.__class__ = LazyPackage
    return sorted(package._modules)
