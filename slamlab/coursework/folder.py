"""Folder of the course: where it stands, and whether progress is kept in this process."""

import os
from pathlib import Path

FOLDERS = ("notebooks", "exercises")
NO_COURSE = "go into the course's folder first, the one with notebooks/ and exercises/"
# set by who runs notebooks without a student: the build, the worker of the judge
OFF = "SLAMLAB_NO_PROGRESS"
_RUN_BY_MACHINES = (OFF, "NBGRADER_EXECUTION", "PYTEST_VERSION")


def course_folder(start="."):
    """Find the folder of the course: the nearest one that holds lessons and exercises.

    Parameters
    ----------
    start : Path, where to begin; its parents are looked at, too

    Returns
    -------
    Path, or None where there is none
    """
    start = Path(start).resolve()
    for place in (start, *start.parents):
        if all((place / name).is_dir() for name in FOLDERS):
            return place
    return None


def is_progress_kept():
    """Whether progress is kept: a student runs this, no build, test or grader.

    Returns
    -------
    bool
    """
    return not any(name in os.environ for name in _RUN_BY_MACHINES)
