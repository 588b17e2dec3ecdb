"""Isolation levels: which sandbox this machine can give a worker, tested by trying to escape it."""

import os
import socket
import subprocess
import tempfile
from pathlib import Path

import slamlab
from slamlab.exercises.drives import StudentError
from slamlab.exercises.exercise import Exercise
from slamlab.grading import bubblewrap, landlock, probe, sandbox, seccomp
from slamlab.grading.worker_client import WorkerClient
from slamlab.grading.worker_pool import CAN_FORK, WorkerPool, WorkerStartError

# an exercise without tasks, for the self-test
PROBE_EXERCISE = Exercise("00", "00_probe", "A probe", (), "slamlab.grading.probe_drives")
UNSUPPORTED_PLATFORM = (
    "sandboxed workers need Linux; on macOS and Windows grade inside WSL2, a Linux container or a "
    "Linux machine, or say --isolation none for notebooks that you trust"
)
INSTALL_BUBBLEWRAP = (
    "install it: apt install bubblewrap, dnf install bubblewrap or pacman -S bubblewrap"
)
NAMESPACES_RESTRICTED = (
    "this machine keeps ordinary users from namespaces, as Ubuntu does from 24.04 on: give "
    "bubblewrap a profile of AppArmor (Ubuntu 25.04 ships one: apt install apparmor-profiles), or "
    "sysctl kernel.apparmor_restrict_unprivileged_userns=0, or grade as root, who drops his rights"
)


class IsolationError(Exception):
    """The isolation level is not available; the text says what is missing and how to get it."""


def ensure_level(level):
    """Require an isolation level: check its needs, then run the sandbox self-test.

    Parameters
    ----------
    level : str, one of ``sandbox.LEVELS``

    Raises
    ------
    IsolationError
    """
    if level == sandbox.NONE:
        return
    lacking = missing_requirement(level)
    if lacking:
        raise IsolationError(f"isolation {level!r} cannot be had here: {lacking}")
    done = self_test(level)
    if done:
        raise IsolationError(
            f"isolation {level!r} does not hold here: a worker could {done}. Nothing was graded"
        )


def missing_requirement(level):
    """The requirement of an isolation level that this machine lacks, None if it has all."""
    if not CAN_FORK:
        return UNSUPPORTED_PLATFORM
    if not seccomp.available():
        return f"no filter of system calls (seccomp) for this machine ({os.uname().machine})"
    if landlock.abi_version() < 1:
        return (
            "the kernel offers no Landlock: Linux 5.13 or later, with landlock among lsm= "
            "(see /sys/kernel/security/lsm)"
        )
    if level == sandbox.BASIC:
        if bubblewrap.drops_privileges():
            return "root cannot be sandboxed by it: grade as an ordinary user, or with 'strict'"
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
    said = (tried.stderr.strip().splitlines() or ["no reason given"])[-1][:200]
    hint = (
        NAMESPACES_RESTRICTED
        if "uid map" in said or "ermi" in said
        else "try it by hand: bwrap --version"
    )
    return f"bubblewrap fails with {said!r}; {hint}"


def self_test(level):
    """Run the sandbox self-test: what a worker of a level could do that is forbidden.

    Parameters
    ----------
    level : str

    Returns
    -------
    str, "" when every forbidden action was refused

    Raises
    ------
    IsolationError : no worker came up at all
    """
    with tempfile.TemporaryDirectory(prefix="slamlab-probe-") as folder, socket.socket() as server:
        canary = Path(folder, "canary")
        canary.write_text("not for workers")
        server.bind(("127.0.0.1", 0))
        server.listen()
        told = {
            "CANARY": str(canary),
            "ANSWERS": str(Path(slamlab.__file__).parent / "exercises" / "task.py"),
            "PORT": server.getsockname()[1],
            "JUDGE": os.getpid(),
        }
        head = "\n".join(f"{name} = {value!r}" for name, value in told.items())
        cell = head + probe.FORBIDDEN_ACTIONS + probe.REPORT
        try:
            with WorkerPool(level, warm=False) as workers:
                return _run(cell, workers)
        except (WorkerStartError, StudentError) as error:
            raise IsolationError(f"isolation {level!r}: {error}") from None


def _run(cell, workers):
    with WorkerClient(PROBE_EXERCISE, [(1, cell)], workers.start) as client:
        client.load()
        return client.problems.get(1, "")
