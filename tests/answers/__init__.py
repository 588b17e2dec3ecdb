"""Independent answers: written from the lesson and the exercise's text alone, the checks unopened.

An exercise is a module ``exNN``, or a package of modules, one a task. Each holds ``RIGHT`` and
``WRONG``, lists of (task's id, what it is, source). Nothing in the checks may be tuned to a single
one of them; what they show is how well kinds of mistakes are found. ``python -m tests.answers 06``
prints what the checks say of each.
"""

import importlib
import pkgutil

IDS = [name[2:] for _, name, _ in pkgutil.iter_modules(__path__) if name.startswith("ex")]


def answers(id):
    """The right and the wrong answers to an exercise.

    Parameters
    ----------
    id : str such as "06"

    Returns
    -------
    two lists of (task's id, what it is, source)
    """
    whole = importlib.import_module(f"{__name__}.ex{id}")
    names = [found.name for found in pkgutil.iter_modules(getattr(whole, "__path__", []))]
    parts = [importlib.import_module(f"{whole.__name__}.{name}") for name in names] or [whole]
    return [a for part in parts for a in part.RIGHT], [a for part in parts for a in part.WRONG]
