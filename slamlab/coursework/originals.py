"""Notebooks as they were handed out: from the pack's archive, or from git in a clone."""

import subprocess
import zipfile
from pathlib import Path

ARCHIVE = "slamlab/data/originals.zip"  # in a students' pack; see course.pack


class OriginalError(Exception):
    """There is no handed-out form of a notebook here; the text says what to do."""


def names(folder: Path) -> list[str]:
    """List the notebooks that were handed out.

    Parameters
    ----------
    folder : Path, of the course

    Returns
    -------
    list of str such as "exercises/ex04_models_and_jacobians.ipynb", sorted

    Raises
    ------
    OriginalError : neither an archive nor git knows them
    """
    archive = folder / ARCHIVE
    if archive.is_file():
        with _opened(archive) as packed:
            return sorted(packed.namelist())
    listed = _git(folder, "ls-tree", "-r", "--name-only", "HEAD", "notebooks", "exercises")
    return sorted(name for name in listed.decode().splitlines() if name.endswith(".ipynb"))


def original(folder: Path, name: str) -> bytes:
    """Read the handed-out form of a notebook.

    Parameters
    ----------
    folder : Path, of the course
    name : str, as :func:`names` lists it

    Returns
    -------
    bytes

    Raises
    ------
    OriginalError : it is not known here
    """
    archive = folder / ARCHIVE
    if archive.is_file():
        with _opened(archive) as packed:
            try:
                return packed.read(name)
            except (KeyError, zipfile.BadZipFile):
                raise OriginalError(f"{name} was not handed out with this pack") from None
    return _git(folder, "show", f"HEAD:./{name}")


def _opened(archive):
    try:
        return zipfile.ZipFile(archive)
    except (OSError, zipfile.BadZipFile):
        raise OriginalError(f"{archive} is damaged: unzip the course again elsewhere") from None


def _git(folder, *words):
    try:
        return subprocess.run(
            ["git", *words], cwd=folder, check=True, capture_output=True, timeout=60
        ).stdout
    except (OSError, subprocess.SubprocessError):
        raise OriginalError(
            f"the handed-out notebooks are not here: {ARCHIVE} is missing and git does not know "
            "them; unzip the course's pack into another folder and copy from there"
        ) from None
