"""Landlock: restrict the file-system access of a sandboxed worker (Linux 5.13 or later). The
restriction needs no privilege and cannot be undone.
"""

import ctypes
import errno
import os
import struct

CREATE, ADD_RULE, RESTRICT = 444, 445, 446  # system calls, same on every machine
EXECUTE, WRITE, READ, LIST = 1, 2, 4, 8  # access rights, bits
ALL_BY_ABI = {1: (1 << 13) - 1, 2: (1 << 14) - 1, 3: (1 << 15) - 1, 5: (1 << 16) - 1}
"""All file access rights in each version of Landlock."""
DEVICES = 1 << 6 | 1 << 11  # create a device, which is never allowed
TCP = 1 | 2  # bind and connect, since version 4
SCOPES = 1 | 2  # no abstract sockets of others, no signals to the outside; since version 6


def abi_version():
    """Return the kernel's Landlock version, or 0 if the kernel has no Landlock."""
    if os.name != "posix":
        return 0
    try:
        return max(0, ctypes.CDLL(None, use_errno=True).syscall(CREATE, None, 0, 1))
    except AttributeError:  # no such function: not Linux
        return 0


def create_ruleset(readable, writable, listed=()):
    """Return the descriptor of a ruleset that denies all file access, except to files in
    ``readable`` paths and ``writable`` folders, and to names in and below ``listed`` folders.
    Raises OSError.
    """
    abi = abi_version()
    if abi < 1:
        raise OSError(errno.ENOSYS, "the kernel has no Landlock")
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
    """Restrict this process permanently; ``no_new_privs`` must be set. Raises OSError."""
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
