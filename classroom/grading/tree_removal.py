"""Remove folder trees that student code left behind, however deeply nested. Recursion and long
paths fail for deep trees, so neither is used. Symbolic links are not followed. Each folder is
opened relative to its parent, and its subfolders are moved up.
"""

import contextlib
import os
import secrets
import shutil

BY_HANDLE = os.rename in os.supports_dir_fd and os.scandir in os.supports_fd
"""Whether files can be deleted relative to an open folder (not on Windows)."""
FOLDER_FLAGS = getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_NOFOLLOW", 0)


def remove_tree(folder):
    """Remove a folder (not a link) and its contents, as far as possible."""
    if not BY_HANDLE:
        with contextlib.suppress(RecursionError):
            shutil.rmtree(folder, ignore_errors=True)
        return
    empty_folder(folder)
    with contextlib.suppress(OSError):
        os.rmdir(folder)


def empty_folder(folder):
    """Remove the contents of a folder (not a link), as far as possible; POSIX only."""
    with contextlib.suppress(OSError), _opened(folder) as top:
        waiting = _clear_files(top)
        while waiting:
            name = waiting.pop()
            with contextlib.suppress(OSError), _opened(name, top) as inner:
                for below in _clear_files(inner):
                    lifted = secrets.token_hex(16)  # a name that is unused in the top folder
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
    """Delete the files in an open folder; make its folders accessible and return them."""
    with contextlib.suppress(OSError):
        os.fchmod(handle, 0o700)
    with os.scandir(handle) as entries:
        found = [(entry.name, entry.is_dir(follow_symlinks=False)) for entry in entries]
    for name, is_folder in found:
        with contextlib.suppress(OSError, NotImplementedError):
            if is_folder:  # it must be moved and opened, even if student code forbids it
                os.chmod(name, 0o700, dir_fd=handle, follow_symlinks=False)
            else:
                os.unlink(name, dir_fd=handle)
    return [name for name, is_folder in found if is_folder]
