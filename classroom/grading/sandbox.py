"""Sandbox: resource limits, Landlock, seccomp in a worker; ``worker_client`` has the timeouts."""

import contextlib
import ctypes
import os

from classroom.grading import landlock, seccomp

NONE, BASIC, STRICT = "none", "basic", "strict"
LEVELS = (NONE, BASIC, STRICT)
"""Isolation levels: none (resource limits only), basic (+ Landlock, seccomp), strict (+
bubblewrap)."""

MEMORY_LIMIT = 1536 << 20  # address space beyond that of the libraries, RLIMIT_AS [bytes]
FILE_SIZE_LIMIT = 16 << 20  # longest file, RLIMIT_FSIZE [bytes]
OPEN_FILES_LIMIT = 128  # file descriptors, RLIMIT_NOFILE
CPU_LIMIT = 300  # CPU time of the whole process, RLIMIT_CPU [s]
NO_NEW_PRIVILEGES = 38  # prctl option that Landlock and seccomp require
CLOSE_RANGE, LAST_DESCRIPTOR = 436, 0xFFFFFFFF  # system call, same on every machine; its maximum
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random")


def create_ruleset(level, readable, home, listed=()):
    """Return the descriptor of a Landlock ruleset, or None for NONE. The ruleset permits reading
    ``readable`` paths, writing in ``home``, and listing names in ``listed`` folders. Raises
    OSError.
    """
    if level == NONE:
        return None
    seccomp.prepare()
    return landlock.create_ruleset([*readable, *DEVICES], [home, "/dev/null"], listed)


def close_from(first, kept=None):
    """Close all inherited descriptors of a forked process from ``first`` on, except ``kept``."""
    parts = [(first, LAST_DESCRIPTOR)]
    if kept is not None and kept >= first:
        parts = [(first, kept - 1), (kept + 1, LAST_DESCRIPTOR)]
    libc = ctypes.CDLL(None, use_errno=True)
    for low, high in parts:
        if low <= high and libc.syscall(CLOSE_RANGE, low, high, 0):
            _close_one_by_one(low, high)


def _close_one_by_one(low, high):
    """Close descriptors where ``close_range`` is missing (kernels before 5.9) or refused
    (containers).
    """
    try:
        opened = [int(number) for number in os.listdir("/proc/self/fd")]
    except OSError:
        opened = range(low, min(high, os.sysconf("SC_OPEN_MAX")) + 1)
    for number in opened:
        if low <= number <= high:
            with contextlib.suppress(OSError):  # the descriptor of the listing is closed already
                os.close(number)


def restrict_process(files=None):
    """Sandbox this process permanently: set resource limits and, given a ruleset, restrict files
    and system calls. Raises OSError.
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
    """Return the mapped memory [bytes], or an estimate if the kernel does not report it."""
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return 2 << 30
