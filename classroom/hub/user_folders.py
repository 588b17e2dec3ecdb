"""Safe reading and writing of files in the homes of students, who may replace files by links.

Each folder is opened by its handle, and links are not followed, even if a student creates them
during the access. So a grader with the right to read all homes reads only regular files of the
student, and writes only into folders of the student."""

import os
import secrets
import stat
from contextlib import contextmanager, suppress

FOLDER = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
FILE = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC


class UserFolderError(Exception):
    """A file is missing, or is not a file of the student; the message states the reason."""


@contextmanager
def opened_user_folder(users, student):
    """Open a student's home; yield its handle and the student's user id. Raises UserFolderError."""
    if "/" in student or student.startswith("."):
        raise UserFolderError("this is not the name of a home folder")
    with _opened(os.path.join(users, student), FOLDER) as home:
        yield home, os.fstat(home).st_uid


def read(home, owner, path, most):
    """Return the bytes of a student's file.

    home : int, handle of the home. owner : int, the student's user id. path : PurePosixPath in the
    home. most : int, size of the largest file that is read [bytes]. Raises UserFolderError."""
    with (
        _folder(home, owner, path.parent.parts) as folder,
        _opened(path.name, FILE, folder) as file,
    ):
        found = os.fstat(file)
        if not stat.S_ISREG(found.st_mode):
            raise UserFolderError(f"{path} is not a file")
        if found.st_uid != owner or found.st_nlink != 1:
            raise UserFolderError(f"{path} is another person's file, or a second name of a file")
        with open(file, "rb", closefd=False) as opened:
            data = opened.read(most + 1)
    if len(data) > most:
        raise UserFolderError(f"{path} is larger than {most / 1e6:.0f} MB")
    return data


def replace(home, owner, path, data):
    """Write a file that belongs to the student, atomically, and create its last folder.

    The parameters are those of :func:`read`; data : bytes. Raises UserFolderError, OSError."""
    group = os.fstat(home).st_gid
    *outer, last = path.parent.parts
    with _folder(home, owner, outer) as folder:
        with suppress(FileExistsError):
            os.mkdir(last, 0o700, dir_fd=folder)
        with _opened(last, FOLDER, folder) as inner:
            if os.fstat(inner).st_uid not in (owner, os.geteuid()):
                raise UserFolderError(f"{last} is another person's folder")
            os.fchown(inner, owner, group)
            draft = f".{secrets.token_hex(8)}"
            made = os.open(draft, NEW, 0o600, dir_fd=inner)
            with open(made, "wb") as file:
                file.write(data)
                os.fchown(made, owner, group)
            os.replace(draft, path.name, src_dir_fd=inner, dst_dir_fd=inner)


@contextmanager
def _opened(name, flags, folder=None):
    """Open a file or folder, and close it; raise UserFolderError with the reason."""
    try:
        handle = os.open(name, flags, dir_fd=folder)
    except OSError as error:
        raise UserFolderError(f"{name}: {_reason(error)}") from None
    try:
        yield handle
    finally:
        os.close(handle)


def _reason(error):
    if isinstance(error, FileNotFoundError):
        return "missing"
    if isinstance(error, NotADirectoryError) or error.errno == 40:  # ELOOP
        return "is a link, or not a folder"
    return error.strerror.lower()


@contextmanager
def _folder(home, owner, parts):
    """Open a folder below a home, one part after the other."""
    if not parts:
        yield home
        return
    with _opened(parts[0], FOLDER, home) as folder:
        if os.fstat(folder).st_uid != owner:
            raise UserFolderError(f"{parts[0]} is another person's folder")
        with _folder(folder, owner, parts[1:]) as last:
            yield last
