"""Read the handed-out notebooks from the archive of the pack, or from git in a clone."""

import subprocess
import zipfile
from pathlib import Path

ARCHIVE = "course/originals.zip"  # in a students' pack; see course.pack


class OriginalError(Exception):
    """The handed-out notebook is not available; the message states a remedy."""


def names(folder: Path) -> list[str]:
    """List the handed-out notebooks, such as "exercises/ex04_….ipynb". Raises OriginalError."""
    archive = folder / ARCHIVE
    if archive.is_file():
        with _opened(archive) as packed:
            return sorted(packed.namelist())
    listed = _git(folder, "ls-tree", "-r", "--name-only", "HEAD", "notebooks", "exercises")
    return sorted(name for name in listed.decode().splitlines() if name.endswith(".ipynb"))


def original(folder: Path, name: str) -> bytes:
    """Read the handed-out version of a notebook that :func:`names` lists. Raises OriginalError."""
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
        raise OriginalError(
            f"{archive} is damaged: unzip the course's pack again into another folder"
        ) from None


def _git(folder, *words):
    try:
        return subprocess.run(
            ["git", *words], cwd=folder, check=True, capture_output=True, timeout=60
        ).stdout
    except (OSError, subprocess.SubprocessError):
        raise OriginalError(
            f"the handed-out notebooks are missing: {ARCHIVE} does not exist, and git has no copy. "
            "Unzip the course's pack into another folder and copy the notebooks from there"
        ) from None
