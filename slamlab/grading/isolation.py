"""Which walls this machine can put round a worker, found out by trying to get through them."""

import os
import socket
import subprocess
import tempfile
from pathlib import Path

import slamlab
from slamlab.checks.drives import StudentError
from slamlab.checks.exercise import Exercise
from slamlab.grading import bubblewrap, jail, landlock, probe, seccomp
from slamlab.grading.client import Client
from slamlab.grading.workers import FORKS, CannotStart, Workers

NOBODYS = Exercise("00", "00_probe", "A probe", (), "slamlab.grading.no_drives")
ELSEWHERE = (
    "bounded workers need Linux; on macOS and Windows grade inside WSL2, a Linux container or a "
    "Linux machine, or say --isolation none for notebooks that you trust"
)
INSTALL = "install it: apt install bubblewrap, dnf install bubblewrap or pacman -S bubblewrap"
NAMESPACES = (
    "this machine keeps ordinary users from namespaces, as Ubuntu does from 24.04 on: give "
    "bubblewrap a profile of AppArmor (Ubuntu 25.04 ships one: apt install apparmor-profiles), or "
    "sysctl kernel.apparmor_restrict_unprivileged_userns=0, or grade as root, who drops his rights"
)


class Refused(Exception):
    """The level asked for cannot be had; the text says what is missing and how to get it."""


def ensure(level):
    """Make sure that workers of a level are kept from what it forbids.

    Parameters
    ----------
    level : str, one of ``jail.LEVELS``

    Raises
    ------
    Refused
    """
    if level == jail.NONE:
        return
    lacking = missing(level)
    if lacking:
        raise Refused(f"isolation {level!r} cannot be had here: {lacking}")
    done = attempts(level)
    if done:
        raise Refused(
            f"isolation {level!r} does not hold here: a worker could {done}. Nothing was graded"
        )


def missing(level):
    """What a level needs and this machine lacks, None where nothing is seen to be missing."""
    if not FORKS:
        return ELSEWHERE
    if not seccomp.available():
        return f"no filter of system calls for this machine ({os.uname().machine})"
    if landlock.version() < 1:
        return (
            "the kernel offers no Landlock: Linux 5.13 or later, with landlock among lsm= "
            "(see /sys/kernel/security/lsm)"
        )
    if level == jail.BASIC:
        if bubblewrap.drops_root():
            return "root cannot be bounded by it: grade as an ordinary user, or with 'strict'"
        return None
    if bubblewrap.program() is None:
        return f"bubblewrap (bwrap) is not installed; {INSTALL}"
    return _refusal_of_bubblewrap()


def _refusal_of_bubblewrap():
    words = [bubblewrap.program(), "--unshare-all", "--ro-bind", "/", "/", "true"]
    try:
        tried = subprocess.run(words, capture_output=True, text=True, timeout=20, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"bubblewrap does not run: {error}"
    if tried.returncode == 0:
        return None
    said = (tried.stderr.strip().splitlines() or ["no reason given"])[-1][:200]
    hint = NAMESPACES if "uid map" in said or "ermi" in said else "try it by hand: bwrap --version"
    return f"bubblewrap fails with {said!r}; {hint}"


def attempts(level):
    """What a worker of a level could do that it must not.

    Parameters
    ----------
    level : str

    Returns
    -------
    str, "" when every attempt was refused

    Raises
    ------
    Refused : no worker came up at all
    """
    with tempfile.TemporaryDirectory(prefix="slamlab-probe-") as folder, socket.socket() as server:
        canary = Path(folder, "canary")
        canary.write_text("not for workers")
        server.bind(("127.0.0.1", 0))
        server.listen()
        told = {
            "CANARY": str(canary),
            "ANSWERS": str(Path(slamlab.__file__).parent / "checks" / "task.py"),
            "PORT": server.getsockname()[1],
            "JUDGE": os.getpid(),
        }
        head = "\n".join(f"{name} = {value!r}" for name, value in told.items())
        cell = head + probe.ATTEMPTS + probe.REPORT
        try:
            with Workers(level, warm=False) as workers:
                return _run(cell, workers)
        except (CannotStart, StudentError) as error:
            raise Refused(f"isolation {level!r}: {error}") from None


def _run(cell, workers):
    with Client(NOBODYS, [(1, cell)], workers.start) as client:
        client.load()
        return client.problems.get(1, "")
