"""Seccomp: the system-call filter of a sandboxed worker, in classic BPF (Linux only). The filter is
an allow list (whitelist), so unknown calls are refused. The worker cannot start processes, run
programs, make connections, or affect other processes.
"""

import ctypes
import errno
import functools
import os
import platform
import struct

ARCHITECTURES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
"""The kernel's number for each machine that has a filter."""

# name: (number on x86_64, on aarch64), None if the machine does not have the call
ALLOWED = {
    "read": (0, 63), "write": (1, 64), "open": (2, None), "close": (3, 57), "stat": (4, None),
    "fstat": (5, 80), "lstat": (6, None), "poll": (7, None), "lseek": (8, 62), "mmap": (9, 222),
    "mprotect": (10, 226), "munmap": (11, 215), "brk": (12, 214), "rt_sigaction": (13, 134),
    "rt_sigprocmask": (14, 135), "rt_sigreturn": (15, 139), "pread64": (17, 67),
    "pwrite64": (18, 68), "readv": (19, 65), "writev": (20, 66), "access": (21, None),
    "pipe": (22, None), "select": (23, None), "sched_yield": (24, 124), "mremap": (25, 216),
    "msync": (26, 227), "mincore": (27, 232), "madvise": (28, 233), "dup": (32, 23),
    "dup2": (33, None), "pause": (34, None), "nanosleep": (35, 101), "getitimer": (36, 102),
    "alarm": (37, None), "setitimer": (38, 103), "getpid": (39, 172), "exit": (60, 93),
    "wait4": (61, 260), "uname": (63, 160), "flock": (73, 32), "fsync": (74, 82),
    "fdatasync": (75, 83), "ftruncate": (77, 46), "getdents": (78, None), "getcwd": (79, 17),
    "chdir": (80, 49), "rename": (82, None), "mkdir": (83, None), "rmdir": (84, None),
    "unlink": (87, None), "readlink": (89, None), "umask": (95, 166), "gettimeofday": (96, 169),
    "getrlimit": (97, 163), "getrusage": (98, 165), "sysinfo": (99, 179), "times": (100, 153),
    "getuid": (102, 174), "getgid": (104, 176), "geteuid": (107, 175), "getegid": (108, 177),
    "getppid": (110, 173), "getpgrp": (111, None), "rt_sigpending": (127, 136),
    "rt_sigtimedwait": (128, 137), "rt_sigsuspend": (130, 133), "sigaltstack": (131, 132),
    "gettid": (186, 178), "futex": (202, 98), "sched_getaffinity": (204, 123),
    "getdents64": (217, 61), "set_tid_address": (218, 96), "restart_syscall": (219, 128),
    "fadvise64": (221, 223), "clock_gettime": (228, 113), "clock_getres": (229, 114),
    "clock_nanosleep": (230, 115), "exit_group": (231, 94), "epoll_wait": (232, None),
    "epoll_ctl": (233, 21), "openat": (257, 56), "mkdirat": (258, 34), "newfstatat": (262, 79),
    "unlinkat": (263, 35), "renameat": (264, 38), "readlinkat": (267, 78), "faccessat": (269, 48),
    "pselect6": (270, 72), "ppoll": (271, 73), "set_robust_list": (273, 99),
    "epoll_pwait": (281, 22), "eventfd2": (290, 19), "epoll_create1": (291, 20),
    "dup3": (292, 24), "pipe2": (293, 59), "renameat2": (316, 276), "getrandom": (318, 278),
    "statx": (332, 291), "rseq": (334, 293), "faccessat2": (439, 439), "membarrier": (324, 283),
    "getcpu": (309, 168),
}  # fmt: skip
CLONE, CLONE3 = (56, 220), (435, 435)
KILL, TGKILL, PRCTL, IOCTL, PRLIMIT = (62, 129), (234, 131), (157, 167), (16, 29), (302, 261)
FCNTL = (72, 25)

CLONE_THREAD = 0x10000
PR_SET_SECCOMP, FILTER = 22, 2
THREAD_NAME_OPTIONS = (15, 16)  # PR_SET_NAME, PR_GET_NAME
# F_DUPFD, its close-on-exec form, flags of descriptors and files, locks; not F_SETOWN, which can
# signal any process, nor F_SETPIPE_SZ, which allocates memory that no limit counts
FCNTL_COMMANDS = (0, 1030, 1, 2, 3, 4, 5, 6, 7)
IOCTL_REQUESTS = (0x5401, 0x5450, 0x5451, 0x541B)  # TCGETS, FIONCLEX, FIOCLEX, FIONREAD

LOAD, EQUAL, ANY_BIT, AT_LEAST, RETURN = 0x20, 0x15, 0x45, 0x35, 0x06
ALLOW, DENY, KILL_PROCESS = 0x7FFF0000, 0x00050000, 0x80000000
NUMBER, ARCHITECTURE, ARGUMENTS = 0, 4, 16  # offsets in the filter's input
X32 = 0x40000000  # first number of the calls of x86_64's x32 ABI


def restrict(pid):
    """Install the seccomp filter: refuse all system calls that are not allowed, and signals to
    processes other than ``pid`` (this process), permanently. ``no_new_privs`` must be set. Raises
    OSError.
    """
    machine = platform.machine()
    if machine not in ARCHITECTURES:
        raise OSError(errno.ENOSYS, f"there is no list of system calls for {machine}")
    program = _bpf_program(machine, pid)
    buffer = ctypes.create_string_buffer(program, len(program))
    described = ctypes.create_string_buffer(
        struct.pack("HxxxxxxP", len(program) // 8, ctypes.addressof(buffer))
    )
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(PR_SET_SECCOMP, FILTER, described, 0, 0):
        raise OSError(ctypes.get_errno(), "seccomp")


def prepare():
    """Build the common part of all filters; call this before workers are forked."""
    if available():
        _bpf_program(platform.machine(), 0)


def _bpf_program(machine, pid):
    column = list(ARCHITECTURES).index(machine)
    parts = [_unconditional(machine)]
    for call in (KILL, TGKILL):
        parts += _allow_if_argument(call[column], 0, EQUAL, [pid], errno.EPERM)
    parts.append(_instruction(RETURN, DENY | errno.EPERM))
    return b"".join(parts)


@functools.cache
def _unconditional(machine):
    """Return the part of the filter that is the same for every process."""
    column = list(ARCHITECTURES).index(machine)
    parts = [
        _instruction(LOAD, ARCHITECTURE),
        _instruction(EQUAL, ARCHITECTURES[machine], 1, 0),
        _instruction(RETURN, KILL_PROCESS),
        _instruction(LOAD, NUMBER),
        _instruction(AT_LEAST, X32, 0, 1),
        _instruction(RETURN, DENY | errno.EPERM),
    ]
    for numbers in ALLOWED.values():
        if numbers[column] is not None:
            parts += [_instruction(EQUAL, numbers[column], 0, 1), _instruction(RETURN, ALLOW)]
    # glibc then falls back to clone, whose flags the filter can check
    parts += [_instruction(EQUAL, CLONE3[column], 0, 1), _instruction(RETURN, DENY | errno.ENOSYS)]
    parts += _allow_if_argument(CLONE[column], 0, ANY_BIT, [CLONE_THREAD], errno.EPERM)
    parts += _allow_if_argument(PRLIMIT[column], 0, EQUAL, [0], errno.EPERM)
    parts += _allow_if_argument(PRCTL[column], 0, EQUAL, THREAD_NAME_OPTIONS, errno.EPERM)
    parts += _allow_if_argument(FCNTL[column], 1, EQUAL, FCNTL_COMMANDS, errno.EPERM)
    parts += _allow_if_argument(IOCTL[column], 1, EQUAL, IOCTL_REQUESTS, errno.ENOTTY)
    return b"".join(parts)


def _allow_if_argument(number, argument, test, values, error):
    """Return instructions that allow a call if its argument passes the test for some value."""
    inner = [_instruction(LOAD, ARGUMENTS + 8 * argument)]
    for value in values:
        inner += [_instruction(test, value, 0, 1), _instruction(RETURN, ALLOW)]
    inner.append(_instruction(RETURN, DENY | error))
    return [_instruction(EQUAL, number, 0, len(inner)), *inner]


def _instruction(code, k, jump_true=0, jump_false=0):
    return struct.pack("HBBI", code, jump_true, jump_false, k)


def available():
    """Return whether a filter exists for this machine."""
    return os.name == "posix" and platform.machine() in ARCHITECTURES
