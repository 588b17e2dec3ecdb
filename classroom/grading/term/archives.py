"""Unpack zip files of submissions with limits. Zip bombs, symbolic links and paths that lead out of
the folder are refused and reported, so that no submission is lost unnoticed.
"""

import stat
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import PurePosixPath

from classroom.grading.notebooks import SubmissionError
from classroom.grading.submissions import MAX_FOLDER_DEPTH, MAX_NOTEBOOK_BYTES, too_large

MAX_MEMBERS = 20_000  # of a download
MAX_BYTES = 2 << 30  # unpacked, of a download [bytes]
MAX_STUDENT_MEMBERS = 500
MAX_STUDENT_BYTES = 100 << 20
_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)  # others may need gigabytes of memory
_DRIVE = 2  # length of C:
_BROKEN = (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, ValueError)


@dataclass(frozen=True)
class Limits:
    """Limits of one archive: number of members, and total size when unpacked [bytes]."""

    members: int = MAX_MEMBERS
    bytes: int = MAX_BYTES


OF_A_CLASS = Limits()
OF_A_STUDENT = Limits(MAX_STUDENT_MEMBERS, MAX_STUDENT_BYTES)


def is_archive(path):
    """Return whether a path is a file with the suffix .zip and not a symbolic link."""
    return path.suffix.lower() == ".zip" and path.is_file() and not path.is_symlink()


def unpack(file, folder, limits=OF_A_CLASS):
    """Unpack a zip; return the refused members as (name, reason). Files get the current time,
    because times in a zip can be forged. Raises SubmissionError if the file is not a zip or exceeds
    the limits; then none of the file's members counts.
    """
    folder.mkdir(parents=True, exist_ok=True)
    refused, left = [], limits.bytes
    try:
        with zipfile.ZipFile(file) as archive:
            members = [member for member in archive.infolist() if not member.is_dir()]
            if len(members) > limits.members:
                raise SubmissionError(
                    f"the zip has {len(members)} files; at most {limits.members} are allowed"
                )
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
                        f"the zip has more than {limits.bytes >> 20} MB when unpacked"
                    )
    except _BROKEN as error:
        raise SubmissionError(f"the file is not a complete zip: {error}") from None
    except OSError as error:
        raise SubmissionError(f"the zip cannot be read: {error.strerror}") from None
    return refused


class _Refused(Exception):
    """A member is not unpacked; the message states why."""


def _unpack_member(archive, member, folder, left):
    """Unpack a member; return its size [bytes]."""
    target = folder.joinpath(*_safe_parts(member))
    target.parent.mkdir(parents=True, exist_ok=True)
    if member.compress_type not in _METHODS:
        raise _Refused("its compression method is not supported; use Deflate")
    stem, count = target.stem, 1
    while target.exists():  # keep all files of the same name
        count += 1
        target = target.with_name(f"{stem} ({count}){target.suffix}")
    most = min(MAX_NOTEBOOK_BYTES, left) + 1
    # read at most the limit, even if the archive states a smaller size
    with archive.open(member) as source:
        data = source.read(most)
    if len(data) == most and most > MAX_NOTEBOOK_BYTES:
        raise _Refused(too_large(max(member.file_size, most)))
    target.write_bytes(data)
    return len(data)


def _safe_parts(member):
    """Return the parts of a member's path, or refuse a path that leads out of the folder."""
    name = member.filename
    if stat.S_ISLNK(member.external_attr >> 16):
        raise _Refused("it is a symbolic link, not a file")
    parts = PurePosixPath(name.replace("\\", "/")).parts
    if name.startswith(("/", "\\")) or name[1:_DRIVE] == ":" or not parts:
        raise _Refused("its path is absolute")
    if ".." in parts:
        raise _Refused("its path leads out of the zip (..)")
    if len(parts) > MAX_FOLDER_DEPTH:
        raise _Refused(f"it is nested in more than {MAX_FOLDER_DEPTH} folders")
    return parts


def _printable(text):
    text = text.encode("utf-8", "backslashreplace").decode("utf-8")
    return "".join(c if c.isprintable() else " " for c in text)[:200]
