"""Worker quotas that the kernel's resource limits do not cover: threads, files, disk space."""

import contextlib
import os
import stat

from classroom.grading.sandbox import FILE_SIZE_LIMIT

MAX_THREADS = 100  # of one worker
MAX_FILES = 10_000  # in its home folder, folders included
MAX_BYTES = 256 << 20  # disk space of its home folder and of open deleted files [bytes]


def quota_exceeded(pid, home):
    """Return whether a worker has too many threads, or too many files or bytes in ``home``."""
    try:
        with open(f"/proc/{pid}/status") as file:
            threads = next(line for line in file if line.startswith("Threads:"))
        if int(threads.split()[1]) > MAX_THREADS:
            return True
        return _home_exceeds_quota(home, _deleted_bytes(pid, home))
    except OSError:  # the worker has ended, or it hides a folder
        return True


def _home_exceeds_quota(home, size):
    count, waiting = 0, [home]
    while waiting:
        with contextlib.suppress(FileNotFoundError):  # deleted in the meantime
            for entry in os.scandir(waiting.pop()):
                size += entry.stat(follow_symlinks=False).st_blocks * 512
                count += 1
                if count > MAX_FILES or size > MAX_BYTES:
                    return True
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)
    return size > MAX_BYTES


def _deleted_bytes(pid, home):
    """Return the disk space [bytes] of deleted files that the worker still has open or mapped.

    The size of a mapped file that is not open is unknown, so FILE_SIZE_LIMIT is assumed.
    """
    sizes = {}
    try:
        handles = os.listdir(f"/proc/{pid}/fd")
    except PermissionError:  # root became nobody; its home is then a file system of limited size
        return 0
    for handle in handles:
        with contextlib.suppress(FileNotFoundError):
            found = os.stat(f"/proc/{pid}/fd/{handle}")
            if stat.S_ISREG(found.st_mode) and found.st_nlink == 0:
                sizes[found.st_ino] = found.st_blocks * 512
    below = os.fsencode(os.path.join(os.path.realpath(home), ""))
    with open(f"/proc/{pid}/maps", "rb") as file:
        for line in file:
            if line.endswith(b" (deleted)\n"):
                parts = line.split(maxsplit=5)
                if parts[5].startswith(below):
                    sizes.setdefault(int(parts[4]), FILE_SIZE_LIMIT)
    return sum(sizes.values())
