"""Tree removal: delete what a student's code left behind, however deep it is nested.

It neither recurses nor builds long paths, both of which deep folders break, and it follows no
link: each folder is opened below the one that holds it, and its own folders are moved up.
"""

import contextlib
import os
import secrets
import shutil

BY_HANDLE = os.rename in os.supports_dir_fd and os.scandir in os.supports_fd
"""Whether files are deleted relative to an open folder; not on Windows."""
FOLDER_FLAGS = getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_NOFOLLOW", 0)


def remove_tree(folder):
    """Remove a folder with all that is in it; what cannot be removed stays.

    Parameters
    ----------
    folder : path, no link
    """
    if not BY_HANDLE:
        with contextlib.suppress(RecursionError):
            shutil.rmtree(folder, ignore_errors=True)
        return
    empty_folder(folder)
    with contextlib.suppress(OSError):
        os.rmdir(folder)


def empty_folder(folder):
    """Remove all that is in a folder (POSIX); what cannot be removed stays.

    Parameters
    ----------
    folder : path, no link
    """
    with contextlib.suppress(OSError), _opened(folder) as top:
        waiting = _clear_files(top)
        while waiting:
            name = waiting.pop()
            with contextlib.suppress(OSError), _opened(name, top) as inner:
                for below in _clear_files(inner):
                    lifted = secrets.token_hex(16)  # a name that nothing in the top folder has
                    with contextlib.suppress(OSError):
                        os.rename(below, lifted, src_dir_fd=inner, dst_dir_fd=top)
                        waiting.append(lifted)
            with contextlib.suppress(OSError):
                os.rmdir(name, dir_fd=top)


@contextlib.contextmanager
def _opened(folder, within=None):
    handle = os.open(folder, os.O_RDONLY | FOLDER_FLAGS, dir_fd=within)
    try:
        yield handle
    finally:
        os.close(handle)


def _clear_files(handle):
    """Delete what is no folder in an open one; the names of its folders, made open to us."""
    with contextlib.suppress(OSError):
        os.fchmod(handle, 0o700)
    with os.scandir(handle) as entries:
        found = [(entry.name, entry.is_dir(follow_symlinks=False)) for entry in entries]
    for name, is_folder in found:
        with contextlib.suppress(OSError, NotImplementedError):
            if is_folder:  # moved and opened it must be, whatever its student forbade
                os.chmod(name, 0o700, dir_fd=handle, follow_symlinks=False)
            else:
                os.unlink(name, dir_fd=handle)
    return [name for name, is_folder in found if is_folder]
