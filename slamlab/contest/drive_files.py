"""What was driven, a file for each world and submission: a contest goes on where it was left."""

import json
import os
import zipfile

import numpy as np

from slamlab.grading.records import private_folder
from slamlab.project.driving import Drive

ARRAYS = ("online", "covariances", "trajectory", "points")


def write_drive(file, drive):
    """Write a drive; the file is there whole or not at all.

    Parameters
    ----------
    file : Path
    drive : Drive
    """
    private_folder(file.parent)
    told = json.dumps({"mistakes": drive.mistakes, "seconds": drive.seconds, "late": drive.late})
    partial = file.with_name(f".{file.name}.part")
    with open(partial, "wb") as opened:
        arrays = {name: getattr(drive, name) for name in ARRAYS}
        np.savez_compressed(opened, told=np.array(told), **arrays)
    os.replace(partial, file)


def read_drive(file):
    """Read a drive.

    Parameters
    ----------
    file : Path

    Returns
    -------
    Drive, or None where there is none that is whole
    """
    try:
        with np.load(file, allow_pickle=False) as found:
            told = json.loads(str(found["told"]))
            arrays = {name: found[name] for name in ARRAYS}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return Drive(**arrays, mistakes=tuple(told["mistakes"]), seconds=told["seconds"],
                 late=told["late"])  # fmt: skip


def late_drive(count):
    """A drive of which only its points are known, a limit of time having ended it elsewhere.

    Parameters
    ----------
    count : int, readings

    Returns
    -------
    Drive
    """
    nothing = np.full((count, 3), np.nan)
    told = ("a limit of time ended this drive when it was judged first: its points are those",)
    return Drive(nothing, np.full((count, 3, 3), np.nan), nothing, np.empty((0, 2)), told, 0.0,
                 late=True)  # fmt: skip
