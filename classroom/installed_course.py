"""The installed course, found by its entry point (plug-in discovery).

The classroom does not import a course by name. The distribution of a course declares its package
in the entry-point group ``classroom.course``. The package contains ``exercises``, with a subpackage
``exNN_topic`` for each exercise, ``questions`` of the lessons, and ``recordings.json``: the names
of the recordings that each lesson uses.
"""

import functools
import importlib
from importlib import metadata, resources

GROUP = "classroom.course"


class CourseMissing(ImportError):
    """No course, or more than one course, is installed."""


@functools.cache
def package():
    """Return the name of the course's package. Raises CourseMissing."""
    found = {point.value for point in metadata.entry_points(group=GROUP)}
    if len(found) != 1:
        named = ", ".join(sorted(found)) or "none"
        raise CourseMissing(
            f"exactly one course (entry point {GROUP}) must be installed; installed: {named}"
        )
    return found.pop()


def module(name):
    """Import a module of the course, such as ``exercises``."""
    return importlib.import_module(f"{package()}.{name}")


def file(*path):
    """Locate a data file of the course; the file may not exist.

    path : str, folders and the name of the file, such as "questions", "04.json". Returns a
    Traversable.
    """
    return resources.files(package()).joinpath(*path)


def own_packages():
    """Return the names of the top-level packages: library, classroom and course."""
    return ("slamlab", "classroom", package())
