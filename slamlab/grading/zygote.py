"""The zygote: a process that has imported what an exercise needs and forks a worker on request.

Starting Python and importing takes seconds, a fork milliseconds. No student's code and no student's
data ever reach the zygote; each worker is a copy of it as it was before anybody's notebook.

It is asked over a socket in JSON: ``{"do": "fork"}``, with the two ends of a pipe, answers
``{"pid": …}``; ``{"do": "end", "pid": …}`` answers ``{"cpu": …}``, the seconds that worker took.
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

from slamlab.grading import jail, worker

LONGEST = 1 << 16
NOBODY = 65534


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
    gc.collect()
    gc.freeze()  # a collection would write to every page that is shared until then
    _say(control, {"ready": True})
    homes, count = {}, 0
    while True:
        said, handles, _, _ = socket.recv_fds(control, LONGEST, 2)
        if not said:
            break
        asked = json.loads(said)
        if asked["do"] == "fork":
            count += 1
            home = os.path.join(plan["home"], str(count))
            pid = _fork(control, handles, drives, plan, home)
            homes[pid] = home
            _say(control, {"pid": pid})
        else:
            _say(control, {"cpu": _end(asked["pid"], homes.pop(asked["pid"]))})
    for pid, home in homes.items():
        _end(pid, home)


def _fork(control, handles, drives, plan, home):
    os.mkdir(home, 0o700)
    pid = os.fork()
    if pid:
        for handle in handles:
            os.close(handle)
        return pid
    try:  # from here on in the worker
        os.setsid()
        control.close()
        for number, handle in enumerate(handles):
            os.dup2(handle, number)
            os.close(handle)
        os.chdir(home)
        os.environ |= {name: home for name in ("HOME", "TMPDIR", "MPLCONFIGDIR")}
        jail.close(plan["level"], plan["readable"], home)
        worker.serve(drives)
    except BaseException as error:
        print(f"worker: {type(error).__name__}: {error}", file=sys.stderr, flush=True)
    finally:
        os._exit(0)


def _end(pid, home):
    """Kill a worker, and what it started where it could; the seconds of CPU it took."""
    for kill in (os.killpg, os.kill):
        with contextlib.suppress(ProcessLookupError):
            kill(pid, signal.SIGKILL)
    _, _, usage = os.wait4(pid, 0)
    # what a student leaves behind may be nested beyond reason; nobody else can read it
    with contextlib.suppress(OSError, RecursionError):
        shutil.rmtree(home, ignore_errors=True)
    return usage.ru_utime + usage.ru_stime


def _say(control, what):
    control.send(json.dumps(what).encode())
