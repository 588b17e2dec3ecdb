"""Sandbox: resource limits (quotas), Landlock, seccomp, set in a worker before student code."""

import contextlib
import ctypes
import os

from slamlab.grading import landlock, seccomp

NONE, BASIC, STRICT = "none", "basic", "strict"
LEVELS = (NONE, BASIC, STRICT)
"""Isolation levels: resource limits only; + Landlock, seccomp (basic); + bubblewrap (strict)."""

MEMORY_LIMIT = 1536 << 20  # address space beyond what the libraries take, RLIMIT_AS [bytes]
FILE_SIZE_LIMIT = 16 << 20  # longest file, RLIMIT_FSIZE [bytes]
OPEN_FILES_LIMIT = 128  # file descriptors, RLIMIT_NOFILE
CPU_LIMIT = 300  # CPU time of the whole process, RLIMIT_CPU [s]
NO_NEW_PRIVILEGES = 38  # prctl, without which Landlock and seccomp take no orders
CLOSE_RANGE, LAST_DESCRIPTOR = 436, 0xFFFFFFFF  # a system call, alike on every machine; its most
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random")


def create_ruleset(level, readable, home, listed=()):
    """Create the ruleset of file-system access (Landlock) of a level.

    Parameters
    ----------
    level : str, one of LEVELS
    readable : list of paths
    home : str, the folder in which it may write
    listed : list of paths of folders of which names may be listed, no more

    Returns
    -------
    int, a file descriptor for :func:`restrict_process`; None where the level has none

    Raises
    ------
    OSError : the kernel does not offer it
    """
    if level == NONE:
        return None
    seccomp.prepare()
    return landlock.create_ruleset([*readable, *DEVICES], [home, "/dev/null"], listed)


def close_from(first, kept=None):
    """Close all file descriptors from a number on: none of a forked process' parent is left.

    Parameters
    ----------
    first : int
    kept : int or None, one that stays open
    """
    parts = [(first, LAST_DESCRIPTOR)]
    if kept is not None and kept >= first:
        parts = [(first, kept - 1), (kept + 1, LAST_DESCRIPTOR)]
    libc = ctypes.CDLL(None, use_errno=True)
    for low, high in parts:
        if low <= high and libc.syscall(CLOSE_RANGE, low, high, 0):
            _close_one_by_one(low, high)


def _close_one_by_one(low, high):
    """As ``close_range``, where the kernel (before 5.9) or a container refuses it."""
    try:
        opened = [int(number) for number in os.listdir("/proc/self/fd")]
    except OSError:
        opened = range(low, min(high, os.sysconf("SC_OPEN_MAX")) + 1)
    for number in opened:
        if low <= number <= high:
            with contextlib.suppress(OSError):  # the list's own is closed already
                os.close(number)


def restrict_process(files=None):
    """Sandbox this process for good: resource limits; with a ruleset, files and system calls, too.

    Parameters
    ----------
    files : int or None, of :func:`create_ruleset`

    Raises
    ------
    OSError : the kernel does not offer it
    """
    _set_resource_limits()
    if files is None:
        return
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0):
        raise OSError(ctypes.get_errno(), "no_new_privs")
    landlock.restrict(files)
    seccomp.restrict(os.getpid())


def _set_resource_limits():
    try:
        import resource
    except ImportError:  # not on Windows
        return
    limits = {
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_FSIZE: FILE_SIZE_LIMIT,
        resource.RLIMIT_NOFILE: OPEN_FILES_LIMIT,
        resource.RLIMIT_CPU: CPU_LIMIT,
        resource.RLIMIT_AS: _mapped_memory() + MEMORY_LIMIT,
    }
    for what, most in limits.items():
        _, hard = resource.getrlimit(what)
        most = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (most, most))


def _mapped_memory():
    """Memory this process has mapped [bytes]; a guess where the kernel does not tell."""
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 2 << 30
