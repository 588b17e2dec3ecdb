"""Zips of submissions, unpacked with limits: a bomb, a link or a path that leads out is refused.

What is refused is told, member by member, so that nothing handed in is lost without a word.
"""

import stat
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from slamlab.grading.notebooks import SubmissionError
from slamlab.grading.submissions import MAX_FOLDER_DEPTH, MAX_NOTEBOOK_BYTES

MAX_MEMBERS = 20_000  # of a download
MAX_BYTES = 2 << 30  # unpacked, of a download [bytes]
MAX_STUDENT_MEMBERS = 500
MAX_STUDENT_BYTES = 100 << 20
_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)  # others may ask for gigabytes of memory
_DRIVE = 2  # letters of C:
_BROKEN = (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, ValueError)


@dataclass(frozen=True)
class Limits:
    """The limits of one archive: its members and its bytes unpacked."""

    members: int = MAX_MEMBERS
    bytes: int = MAX_BYTES


OF_A_CLASS = Limits()
OF_A_STUDENT = Limits(MAX_STUDENT_MEMBERS, MAX_STUDENT_BYTES)


def is_archive(path):
    """Whether a path is a file called .zip, and no link."""
    return path.suffix.lower() == ".zip" and path.is_file() and not path.is_symlink()


def unpack(file, folder, limits=OF_A_CLASS):
    """Unpack a zip; each file's time is now, for what a zip says of it is anybody's.

    Parameters
    ----------
    file : Path
    folder : Path, made
    limits : Limits

    Returns
    -------
    list of (name of a member, why it was refused)

    Raises
    ------
    SubmissionError : it is no zip, or has more than the limits; nothing of it counts then
    """
    folder.mkdir(parents=True, exist_ok=True)
    refused, left = [], limits.bytes
    try:
        with zipfile.ZipFile(file) as archive:
            members = [member for member in archive.infolist() if not member.is_dir()]
            if len(members) > limits.members:
                raise SubmissionError(f"a zip of {len(members)} files, more than {limits.members}")
            for member in members:
                try:
                    left -= _unpack_member(archive, member, folder, left)
                except (_Refused, OSError) as error:
                    why = error.strerror if isinstance(error, OSError) else str(error)
                    refused.append((_printable(member.filename), why))
                except _BROKEN as error:
                    refused.append((_printable(member.filename), f"damaged: {error}"))
                if left < 0:
                    raise SubmissionError(
                        f"a zip of more than {limits.bytes >> 20} MB unpacked: refused"
                    )
    except _BROKEN as error:
        raise SubmissionError(f"not a zip, or a part of one: {error}") from None
    except OSError as error:
        raise SubmissionError(f"cannot be read: {error.strerror}") from None
    return refused


class _Refused(Exception):
    """A member that is not unpacked, and why."""


def _unpack_member(archive, member, folder, left):
    """Unpack one member; how many bytes it had."""
    target = folder.joinpath(*_safe_parts(member))
    target.parent.mkdir(parents=True, exist_ok=True)
    if member.compress_type not in _METHODS:
        raise _Refused("compressed in a way that is not read; use the plain one")
    count = 1
    while target.exists():  # two of one name: both stay
        count += 1
        target = target.with_name(f"{target.stem} ({count}){target.suffix}")
    most = min(MAX_NOTEBOOK_BYTES, left) + 1
    # not all of it at once, and never more than it may have, whatever the archive says
    with archive.open(member) as source:
        data = source.read(most)
    if len(data) == most and most > MAX_NOTEBOOK_BYTES:
        raise _Refused(f"more than {MAX_NOTEBOOK_BYTES >> 20} MB unpacked")
    target.write_bytes(data)
    return len(data)


def _safe_parts(member):
    """The parts of a member's path, when it leads to a place below the folder."""
    name = member.filename
    if stat.S_ISLNK(member.external_attr >> 16):
        raise _Refused("a link, not a file")
    parts = PurePosixPath(name.replace("\\", "/")).parts
    if name.startswith(("/", "\\")) or name[1:_DRIVE] == ":" or not parts:
        raise _Refused("its path is absolute")
    if ".." in parts:
        raise _Refused("its path leads out of the zip (..)")
    if len(parts) > MAX_FOLDER_DEPTH:
        raise _Refused(f"more than {MAX_FOLDER_DEPTH} folders in folders")
    return parts


def _printable(text):
    text = text.encode("utf-8", "backslashreplace").decode("utf-8")
    return "".join(c if c.isprintable() else " " for c in text)[:200]


def unpacked_places(folder):
    """The files of an unpacked archive, sorted; what computers add by themselves is left out."""
    found = (Path(path) for path in folder.rglob("*") if path.is_file())
    return sorted(path for path in found if not _is_hidden(path.relative_to(folder)))


def _is_hidden(path):
    return any(part.startswith(".") or part == "__MACOSX" for part in path.parts)
