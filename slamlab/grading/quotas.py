"""Quotas of a worker that no resource limit of the kernel counts: threads, files, disk space."""

import contextlib
import os

MAX_THREADS = 100  # of one worker
MAX_FILES = 10_000  # in its home, folders included
MAX_BYTES = 256 << 20  # disk space of its home [bytes]


def quota_exceeded(pid, home):
    """Whether a worker exceeds its quota of threads, files or disk space.

    Parameters
    ----------
    pid : int
    home : str, the folder in which it writes

    Returns
    -------
    bool
    """
    try:
        with open(f"/proc/{pid}/status") as file:
            threads = next(line for line in file if line.startswith("Threads:"))
        return int(threads.split()[1]) > MAX_THREADS or _home_exceeds_quota(home)
    except OSError:  # it is gone, or hides a folder
        return True


def _home_exceeds_quota(home):
    count, size, waiting = 0, 0, [home]
    while waiting:
        with contextlib.suppress(FileNotFoundError):  # it may come and go meanwhile
            for entry in os.scandir(waiting.pop()):
                size += entry.stat(follow_symlinks=False).st_blocks * 512
                count += 1
                if count > MAX_FILES or size > MAX_BYTES:
                    return True
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)
    return False
