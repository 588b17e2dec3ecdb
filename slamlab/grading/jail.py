"""The walls round a student's code, put up inside its own process before a line of it runs."""

import ctypes
import os

from slamlab.grading import landlock, seccomp

NONE, BASIC, STRICT = "none", "basic", "strict"
LEVELS = (NONE, BASIC, STRICT)
"""From no walls at all to all of them; ``strict`` adds bubblewrap's namespaces to ``basic``."""

MEMORY = 1536 << 20  # beyond what the libraries take [bytes]
FILE = 16 << 20  # longest file [bytes]
FILES = 128  # open at once
CPU = 300  # of the whole process [s]
NO_NEW_PRIVILEGES = 38  # prctl, without which Landlock and seccomp take no orders
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random")


def rules(level, readable, home):
    """What files a process behind the walls of a level may use, made ready once for many.

    Parameters
    ----------
    level : str, one of LEVELS
    readable : list of paths
    home : str, the folder in which it may write

    Returns
    -------
    int, a file descriptor for :func:`close`; None where the level has no such walls

    Raises
    ------
    OSError : a wall cannot be put up here
    """
    if level == NONE:
        return None
    return landlock.rules([*readable, *DEVICES], [home, "/dev/null"])


def close(files=None):
    """Bound this process for good: memory and time; with rules, files and system calls, too.

    Parameters
    ----------
    files : int or None, of :func:`rules`

    Raises
    ------
    OSError : a wall cannot be put up here
    """
    _limit()
    if files is None:
        return
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0):
        raise OSError(ctypes.get_errno(), "no_new_privs")
    landlock.restrict(files)
    seccomp.restrict(os.getpid())


def _limit():
    try:
        import resource
    except ImportError:  # not on Windows
        return
    limits = {
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_FSIZE: FILE,
        resource.RLIMIT_NOFILE: FILES,
        resource.RLIMIT_CPU: CPU,
        resource.RLIMIT_AS: _size() + MEMORY,
    }
    for what, most in limits.items():
        _, hard = resource.getrlimit(what)
        most = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (most, most))


def _size():
    """Memory this process has mapped [bytes]; a guess where the kernel does not tell."""
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 2 << 30
