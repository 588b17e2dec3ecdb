"""Zygote (fork server): a process that has imported what an exercise needs and forks workers.

Starting Python and importing takes seconds, a fork milliseconds. No student's code and no student's
data ever reach the zygote; each worker is a copy of it as it was before anybody's notebook.

It is asked over a socket in JSON: ``{"do": "fork"}``, with the two ends of a pipe, answers
``{"ready": true}``; ``{"do": "cpu"}`` answers ``{"cpu": …}``, the seconds that worker took so far;
``{"do": "end"}`` ends it and answers the same. There is one worker at a time, in a home that each
finds empty.
"""

import contextlib
import gc
import importlib
import json
import os
import signal
import socket
import sys

from slamlab.grading import quotas, sandbox, tree_removal, worker

MAX_MESSAGE_BYTES = 1 << 16  # of a control message [bytes]
NOBODY_UID = 65534  # user and group that root becomes
ALWAYS_NEEDED = ("resource", "slamlab.checks")
"""Modules that each worker would import: for its limits, and in a notebook's first cell."""
QUOTA_CHECK_SECONDS = 0.1
"""Interval at which a worker's quotas are checked [s]."""


def main(control, plan):
    """Run the zygote: serve requests until the judge closes the control socket.

    Parameters
    ----------
    control : int, the socket's file descriptor
    plan : dict with "drives", "preload", "level", "readable", "listed", "home" and "drop",
        whether to become nobody first
    """
    control = socket.socket(fileno=control)
    if plan["drop"]:
        os.setgroups([])
        os.setgid(NOBODY_UID)
        os.setuid(NOBODY_UID)
    for name in (*ALWAYS_NEEDED, *plan["preload"]):
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    drives = importlib.import_module(plan["drives"]).DRIVES
    home = os.path.join(plan["home"], "own")
    os.mkdir(home, 0o700)
    os.environ |= {name: home for name in ("HOME", "TMPDIR", "MPLCONFIGDIR")}
    os.chdir(home)
    files = sandbox.create_ruleset(plan["level"], plan["readable"], home, plan["listed"])
    gc.collect()
    gc.freeze()  # a collection would write to every page that is shared until then
    _send(control, {"ready": True})
    _serve(control, lambda handles: _fork(handles, drives, files), home)


def _serve(control, fork, home):
    pid = None
    while heard := _receive(control, pid, home):
        asked, handles = heard
        if asked["do"] == "fork":
            pid = fork(handles)
            _send(control, {"ready": True})
            continue
        if asked["do"] == "cpu":
            _send(control, {"cpu": _cpu_so_far(pid)})
            continue
        cpu, pid = _kill(pid), None
        tree_removal.empty_folder(home)
        _send(control, {"cpu": cpu})
        if os.listdir(home):  # what cannot be cleared away is not for the next to see
            break
    if pid is not None:
        _kill(pid)


def _receive(control, pid, home):
    """What is asked, and the handles sent with it; None when the judge hung up."""
    control.settimeout(None if pid is None else QUOTA_CHECK_SECONDS)
    while True:
        try:
            said, handles, _, _ = socket.recv_fds(control, MAX_MESSAGE_BYTES, 2)
            return (json.loads(said), handles) if said else None
        except TimeoutError:
            if quotas.quota_exceeded(pid, home):
                os.kill(pid, signal.SIGKILL)


def _fork(handles, drives, files):
    pid = os.fork()
    if pid:
        for handle in handles:
            os.close(handle)
        return pid
    try:  # from here on in the worker
        os.setsid()
        for number, handle in enumerate(handles):
            os.dup2(handle, number)
        # the judge's socket goes, and whatever else was open, however many they are
        sandbox.close_from(3, kept=files)
        sandbox.restrict_process(files)
        if files is not None:
            os.close(files)
        worker.serve(drives)
    except BaseException as error:
        print(f"worker: {type(error).__name__}: {error}", file=sys.stderr, flush=True)
    finally:
        os._exit(0)


def _cpu_so_far(pid):
    """Seconds of CPU that a worker took, all its threads together; from the kernel, not from it."""
    with open(f"/proc/{pid}/stat") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _kill(pid):
    """Kill a worker, and what it started where it could; the seconds of CPU it took."""
    for kill in (os.killpg, os.kill):
        with contextlib.suppress(ProcessLookupError):
            kill(pid, signal.SIGKILL)
    _, _, usage = os.wait4(pid, 0)
    return usage.ru_utime + usage.ru_stime


def _send(control, what):
    control.send(json.dumps(what).encode())
