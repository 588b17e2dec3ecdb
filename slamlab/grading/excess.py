"""What a worker may hold and no limit of the kernel's counts: its threads and its files."""

import contextlib
import os

THREADS = 100
FILES = 10_000
BYTES = 256 << 20


def beyond_reason(pid, home):
    """Whether a worker has more threads or files than any exercise asks for.

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
        return int(threads.split()[1]) > THREADS or _full(home)
    except OSError:  # it is gone, or hides a folder
        return True


def _full(home):
    count, size, waiting = 0, 0, [home]
    while waiting:
        with contextlib.suppress(FileNotFoundError):  # it may come and go meanwhile
            for entry in os.scandir(waiting.pop()):
                size += entry.stat(follow_symlinks=False).st_blocks * 512
                count += 1
                if count > FILES or size > BYTES:
                    return True
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)
    return False
