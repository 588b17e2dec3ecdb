"""The zygote: a process that has imported what an exercise needs and forks a worker on request.

Starting Python and importing takes seconds, a fork milliseconds. No student's code and no student's
data ever reach the zygote; each worker is a copy of it as it was before anybody's notebook.

It is asked over a socket in JSON: ``{"do": "fork"}``, with the two ends of a pipe, answers
``{"ready": true}``; ``{"do": "end"}`` answers ``{"cpu": …}``, the seconds that worker took. There
is one worker at a time, in a home that each finds empty.
"""

import contextlib
import gc
import importlib
import json
import os
import shutil
import signal
import socket
import sys

from slamlab.grading import excess, jail, worker

LONGEST = 1 << 16
NOBODY = 65534
GLANCE = 0.5
"""How often it is looked at what a worker holds [s]."""


def main(control, plan):
    """Answer until the judge hangs up.

    Parameters
    ----------
    control : int, the socket's file descriptor
    plan : dict with "drives", "preload", "level", "readable", "home" and "drop", whether to
        become nobody first
    """
    control = socket.socket(fileno=control)
    if plan["drop"]:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
    for name in plan["preload"]:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    drives = importlib.import_module(plan["drives"]).DRIVES
    home = os.path.join(plan["home"], "own")
    os.mkdir(home, 0o700)
    os.environ |= {name: home for name in ("HOME", "TMPDIR", "MPLCONFIGDIR")}
    os.chdir(home)
    files = jail.rules(plan["level"], plan["readable"], home)
    gc.collect()
    gc.freeze()  # a collection would write to every page that is shared until then
    _say(control, {"ready": True})
    _answer(control, lambda handles: _fork(handles, drives, files), home)


def _answer(control, fork, home):
    pid = None
    while heard := _hear(control, pid, home):
        asked, handles = heard
        if asked["do"] == "fork":
            pid = fork(handles)
            _say(control, {"ready": True})
            continue
        cpu, pid = _end(pid), None
        _clear(home)
        _say(control, {"cpu": cpu})
        if os.listdir(home):  # what cannot be cleared away is not for the next to see
            break
    if pid is not None:
        _end(pid)


def _hear(control, pid, home):
    """What is asked, and the handles sent with it; None when the judge hung up."""
    control.settimeout(None if pid is None else GLANCE)
    while True:
        try:
            said, handles, _, _ = socket.recv_fds(control, LONGEST, 2)
            return (json.loads(said), handles) if said else None
        except TimeoutError:
            if excess.beyond_reason(pid, home):
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
        jail.close(files)
        os.closerange(3, jail.FILES)  # the judge's socket and whatever else was open
        worker.serve(drives)
    except BaseException as error:
        print(f"worker: {type(error).__name__}: {error}", file=sys.stderr, flush=True)
    finally:
        os._exit(0)


def _end(pid):
    """Kill a worker, and what it started where it could; the seconds of CPU it took."""
    for kill in (os.killpg, os.kill):
        with contextlib.suppress(ProcessLookupError):
            kill(pid, signal.SIGKILL)
    _, _, usage = os.wait4(pid, 0)
    return usage.ru_utime + usage.ru_stime


def _clear(folder):
    for entry in list(os.scandir(folder)):
        # it may be nested beyond reason
        with contextlib.suppress(OSError, RecursionError):
            if entry.is_dir(follow_symlinks=False):
                shutil.rmtree(entry)
            else:
                os.unlink(entry)


def _say(control, what):
    control.send(json.dumps(what).encode())
