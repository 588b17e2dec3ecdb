"""Isolation levels: check which sandbox this machine supports, and test it with escape attempts."""

import os
import socket
import subprocess
import tempfile
from pathlib import Path

import classroom
from classroom.exercises.exercise import Exercise
from classroom.exercises.function_calls import StudentError
from classroom.grading import bubblewrap, escape_attempts, landlock, sandbox, seccomp
from classroom.grading.worker_client import WorkerClient
from classroom.grading.worker_pool import CAN_FORK, WorkerPool, WorkerStartError

# an exercise without tasks, for the self-test
SELF_TEST_EXERCISE = Exercise("00", "00_probe", "A probe", (), "classroom.grading.escape_attempts")
UNSUPPORTED_PLATFORM = (
    "sandboxed workers need Linux; on macOS and Windows, grade in WSL2, in a Linux container or on "
    "a Linux machine, or use --isolation none for notebooks that you trust"
)
INSTALL_BUBBLEWRAP = (
    "install it: apt install bubblewrap, dnf install bubblewrap or pacman -S bubblewrap"
)
NAMESPACES_RESTRICTED = (
    "ordinary users cannot create namespaces on this machine (the default since Ubuntu 24.04); "
    "give bubblewrap an AppArmor profile (Ubuntu 25.04 has one: apt install apparmor-profiles), "
    "or set sysctl kernel.apparmor_restrict_unprivileged_userns=0, or grade as root, whose "
    "privileges are then dropped"
)


class IsolationError(Exception):
    """The level is not available; the message states what is missing and how to provide it."""


def ensure_level(level):
    """Check a level's requirements and run its self-test. Raises IsolationError."""
    if level == sandbox.NONE:
        return
    lacking = missing_requirement(level)
    if lacking:
        raise IsolationError(f"isolation {level!r} is not available here: {lacking}")
    done = self_test(level)
    if done:
        raise IsolationError(
            f"isolation {level!r} does not work here: a worker could {done}. Nothing was graded"
        )


def missing_requirement(level):
    """Return the requirement of a level that this machine does not meet, or None."""
    if not CAN_FORK:
        return UNSUPPORTED_PLATFORM
    if not seccomp.available():
        return f"there is no system-call filter (seccomp) for {os.uname().machine} machines"
    if landlock.abi_version() < 1:
        return (
            "the kernel has no Landlock: use Linux 5.13 or later, with landlock in lsm= "
            "(see /sys/kernel/security/lsm)"
        )
    if level == sandbox.BASIC:
        if bubblewrap.drops_privileges():
            return "it does not restrict root: grade as an ordinary user, or use 'strict'"
        return None
    if bubblewrap.executable() is None:
        return f"bubblewrap (bwrap) is not installed; {INSTALL_BUBBLEWRAP}"
    return _bubblewrap_error()


def _bubblewrap_error():
    words = [bubblewrap.executable(), "--unshare-all", "--ro-bind", "/", "/", "true"]
    try:
        tried = subprocess.run(words, capture_output=True, text=True, timeout=20, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"bubblewrap does not run: {error}"
    if tried.returncode == 0:
        return None
    message = (tried.stderr.strip().splitlines() or ["no reason given"])[-1][:200]
    hint = (
        NAMESPACES_RESTRICTED
        if "uid map" in message or "ermi" in message
        else "test it with bwrap --version"
    )
    return f"bubblewrap fails with {message!r}; {hint}"


def self_test(level):
    """Return the forbidden actions that a worker could perform, or "" if there are none. Raises
    IsolationError if no worker starts.
    """
    with tempfile.TemporaryDirectory(prefix="slamlab-probe-") as folder, socket.socket() as server:
        canary = Path(folder, "canary")
        canary.write_text("not for workers")
        server.bind(("127.0.0.1", 0))
        server.listen()
        constants = {
            "CANARY": str(canary),
            "ANSWERS": str(Path(classroom.__file__).parent / "exercises" / "task.py"),
            "PORT": server.getsockname()[1],
            "JUDGE": os.getpid(),
        }
        head = "\n".join(f"{name} = {value!r}" for name, value in constants.items())
        cell = head + escape_attempts.FORBIDDEN_ACTIONS + escape_attempts.REPORT
        try:
            with WorkerPool(level, warm=False) as workers:
                return _run(cell, workers)
        except (WorkerStartError, StudentError) as error:
            raise IsolationError(f"isolation {level!r}: {error}") from None


def _run(cell, workers):
    with WorkerClient(SELF_TEST_EXERCISE, [(1, cell)], workers.start) as client:
        client.load()
        return client.problems.get(1, "")
