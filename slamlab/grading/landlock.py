"""Landlock: file-system access of a sandboxed worker, to read and to write (Linux 5.13 or later).

It needs no privilege and cannot be undone. Reading is granted folder by folder; writing in one.
"""

import ctypes
import errno
import os
import struct

CREATE, ADD_RULE, RESTRICT = 444, 445, 446  # system calls, alike on every machine
EXECUTE, WRITE, READ, LIST = 1, 2, 4, 8  # access rights, bits
ALL_BY_ABI = {1: (1 << 13) - 1, 2: (1 << 14) - 1, 3: (1 << 15) - 1, 5: (1 << 16) - 1}
"""Every right to files that a version of Landlock knows."""
DEVICES = 1 << 6 | 1 << 11  # make a device: nobody may
TCP = 1 | 2  # bind and connect, since version 4
SCOPES = 1 | 2  # no foreign abstract sockets, no signals to outside, since version 6


def abi_version():
    """The version of Landlock's ABI in this kernel, 0 where there is none."""
    if os.name != "posix":
        return 0
    try:
        return max(0, ctypes.CDLL(None, use_errno=True).syscall(CREATE, None, 0, 1))
    except AttributeError:  # no such function: not Linux
        return 0


def create_ruleset(readable, writable, listed=()):
    """Create a Landlock ruleset that denies all file-system access but to the paths named.

    Parameters
    ----------
    readable : list of paths, files or folders with all below; what is not there is left out
    writable : list of folders
    listed : list of folders, in which and below which names may be listed

    Returns
    -------
    int, their file descriptor

    Raises
    ------
    OSError : the kernel offers no Landlock
    """
    abi = abi_version()
    if abi < 1:
        raise OSError(errno.ENOSYS, "the kernel offers no Landlock")
    rights = ALL_BY_ABI[max(v for v in ALL_BY_ABI if v <= abi)]
    attributes = struct.pack("QQQ", rights, TCP if abi >= 4 else 0, SCOPES if abi >= 6 else 0)
    size = 24 if abi >= 6 else 16 if abi >= 4 else 8
    libc = ctypes.CDLL(None, use_errno=True)
    ruleset = _checked(libc.syscall(CREATE, attributes, size, 0))
    for path in readable:
        _allow(libc, ruleset, path, READ | LIST)
    for path in listed:
        _allow(libc, ruleset, path, LIST)
    for path in writable:
        _allow(libc, ruleset, path, rights & ~DEVICES & ~EXECUTE)
    return ruleset


def restrict(ruleset):
    """Restrict this process to a ruleset for good; ``no_new_privs`` must be set already.

    Parameters
    ----------
    ruleset : int, of :func:`create_ruleset`

    Raises
    ------
    OSError
    """
    _checked(ctypes.CDLL(None, use_errno=True).syscall(RESTRICT, ruleset, 0))


def _allow(libc, ruleset, path, rights):
    try:
        handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except FileNotFoundError:
        return
    try:
        if not os.path.isdir(path):
            rights &= READ | WRITE | EXECUTE | 1 << 14  # a file takes no rights of folders
        rule = ctypes.create_string_buffer(struct.pack("=Qi", rights, handle))
        _checked(libc.syscall(ADD_RULE, ruleset, 1, rule, 0))
    finally:
        os.close(handle)


def _checked(result):
    if result < 0:
        raise OSError(ctypes.get_errno(), "Landlock: " + os.strerror(ctypes.get_errno()))
    return result
