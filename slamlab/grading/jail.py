"""The walls round a student's code, put up inside its own process before a line of it runs."""

import os

NONE, BASIC, STRICT = "none", "basic", "strict"
LEVELS = (NONE, BASIC, STRICT)
"""From no walls at all to all of them; ``strict`` adds bubblewrap's namespaces to ``basic``."""

MEMORY = 1536 << 20  # beyond what the libraries take [bytes]
FILE = 16 << 20  # longest file [bytes]
FILES = 128  # open at once
CPU = 300  # of the whole process [s]
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random")


def close(level, readable=(), home=None):
    """Bound this process: memory, time, files; above "none" system calls and files, too.

    Parameters
    ----------
    level : str, one of LEVELS
    readable : list of paths; above "none"
    home : str, the folder in which it may write; above "none"

    Raises
    ------
    OSError : a wall cannot be put up here
    """
    _limit()
    if level == NONE:
        return
    from slamlab.grading import landlock, seccomp

    landlock.restrict([*readable, *DEVICES], [home, "/dev/null"])
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
