"""Hidden packages: installed libraries that a worker must not see. The hidden packages are the
course, which contains the answers, and the packages that an exercise hides. Hidden packages cannot
be imported, are covered by mounts (bubblewrap), and cannot be read (Landlock).
"""

import os
import re
import sys
from pathlib import Path

from classroom import installed_course

DISTRIBUTIONS = ("slam_course", "slam_course_lab")  # names of their metadata folders
LIBRARY_FOLDERS = ("site-packages", "dist-packages")
# further folders of libraries below an interpreter's folder, also those of other environments
FURTHER = (
    "lib/python*/*-packages",
    "lib64/python*/*-packages",
    "local/lib/python*/*-packages",
    "envs/*/lib/python*/site-packages",
    "pkgs/*/site-packages",
    "pkgs/*/lib/python*/site-packages",
)


def library_folders():
    paths = map(Path, dict.fromkeys(sys.path))
    return [path for path in paths if path.name in LIBRARY_FOLDERS and path.is_dir()]


def entries(folder, hides=()):
    """Return the entries of hidden packages in a folder of libraries, with their metadata."""
    hidden = {name.lower() for name in hides} | ({"__pycache__"} if hides else set())
    hidden |= {*installed_course.own_packages(), *DISTRIBUTIONS}
    # filterpy, filterpy.py, filterpy-2.0.0.dist-info, filterpy-1.4.5-py3.11.egg, _slam_course.pth
    named = [(re.split("[.-]", entry.name.lower())[0], entry) for entry in folder.iterdir()]
    return [entry for name, entry in named if not hidden.isdisjoint((name, name.lstrip("_")))]


def hidden_paths(folders, hides=()):
    """Return the resolved paths of hidden packages below some folders, such as an interpreter's."""
    further = (found for folder in folders for pattern in FURTHER for found in folder.glob(pattern))
    libraries = {path.resolve() for path in (*library_folders(), *further)}
    open_ones = [path for path in libraries if path.is_dir() and os.access(path, os.R_OK)]
    return sorted({entry.resolve() for path in open_ones for entry in entries(path, hides)})


def readable_around(folder, hidden):
    """Return the paths in a folder, excluding ``hidden``, that may be read recursively, and the
    folders whose entries may only be listed.
    """
    folder = folder.resolve()
    if folder in hidden:
        return [], []
    if not any(path.is_relative_to(folder) for path in hidden):
        return [folder], []
    readable = []
    for entry in folder.iterdir():
        if not entry.is_symlink():
            readable += readable_around(entry, hidden)[0]
        elif not any(path.is_relative_to(entry.resolve()) for path in hidden):
            readable.append(entry)  # a link to a folder with hidden packages is left out
    return readable, [folder]
