"""Hidden packages: installed libraries that a worker must not see, in whatever folder they stand.

The course itself is one for every exercise, for it holds the answers; an exercise names others,
such as a ready-made Kalman filter. They are left out of what may be imported, covered by mounts
(bubblewrap), and not among the files that may be read (Landlock).
"""

import os
import re
import sys
from pathlib import Path

LIBRARY_FOLDERS = ("site-packages", "dist-packages")
# where an interpreter's folder may hold further libraries, those of other environments included
FURTHER = (
    "lib/python*/*-packages",
    "lib64/python*/*-packages",
    "local/lib/python*/*-packages",
    "envs/*/lib/python*/site-packages",
    "pkgs/*/site-packages",
    "pkgs/*/lib/python*/site-packages",
)


def library_folders():
    """The folders of installed libraries (site-packages) of this interpreter."""
    places = (Path(place) for place in dict.fromkeys(sys.path))
    return [path for path in places if path.name in LIBRARY_FOLDERS and path.is_dir()]


def entries(folder, hides=()):
    """The entries of the course and of hidden packages in a folder of libraries.

    Parameters
    ----------
    folder : Path
    hides : names of packages, as they are imported

    Returns
    -------
    list of Path: a package's folder or module, and the notes of its installation
    """
    hidden = {name.lower() for name in hides} | ({"__pycache__"} if hides else set())
    named = [(entry.name.lower(), entry) for entry in folder.iterdir()]
    # filterpy, filterpy.py, filterpy-2.0.0.dist-info, filterpy-1.4.5-py3.11.egg
    return [e for name, e in named if "slamlab" in name or re.split("[.-]", name)[0] in hidden]


def places(folders, hides=()):
    """All places of the course and of hidden packages that some folders hold.

    Parameters
    ----------
    folders : list of Path, such as an interpreter's
    hides : names of packages

    Returns
    -------
    list of Path, links resolved
    """
    further = (found for folder in folders for pattern in FURTHER for found in folder.glob(pattern))
    libraries = {path.resolve() for path in (*library_folders(), *further)}
    open_ones = [path for path in libraries if path.is_dir() and os.access(path, os.R_OK)]
    return sorted({entry.resolve() for path in open_ones for entry in entries(path, hides)})


def readable_around(folder, hidden):
    """What may be read of a folder so that some places in it may not.

    Parameters
    ----------
    folder : Path
    hidden : list of Path, links resolved

    Returns
    -------
    (list of Path to read with all below, list of Path of which only names are listed)
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
            readable.append(entry)  # what it leads to; else that is gone through where it stands
    return readable, [folder]
