"""Zygote (fork server): a process that has imported the modules of an exercise and forks workers in
milliseconds. The zygote never receives student code or data, so each worker starts from the same
state.

Its socket accepts JSON: ``{"do": "fork"}`` with two ends of a pipe, answer ``{"ready": true}``;
``{"do": "cpu"}``, answer ``{"cpu": …}`` [s]; ``{"do": "end"}``, same answer. The zygote runs one
worker at a time, in a home folder that is empty at the start.
"""

import contextlib
import gc
import importlib
import json
import os
import signal
import socket
import sys

from classroom.grading import quotas, sandbox, tree_removal, worker

MAX_MESSAGE_BYTES = 1 << 16  # of a control message [bytes]
NOBODY_UID = 65534  # user and group to which root changes
ALWAYS_NEEDED = ("resource", "classroom.checks")
"""Modules that every worker imports, for its limits and for the notebook's first cell."""
QUOTA_CHECK_SECONDS = 0.1
"""Interval at which a worker's quotas are checked [s]."""


def main(control, plan):
    """Serve until the judge closes the socket with the descriptor ``control``. ``plan["drop"]``
    states whether to change to the user nobody first.
    """
    control = socket.socket(fileno=control)
    if plan["drop"]:
        os.setgroups([])
        os.setgid(NOBODY_UID)
        os.setuid(NOBODY_UID)
    for name in (*ALWAYS_NEEDED, *plan["preload"]):
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    calls = importlib.import_module(plan["calls"]).CALLS
    home = os.path.join(plan["home"], "own")
    os.mkdir(home, 0o700)
    os.environ |= {name: home for name in ("HOME", "TMPDIR", "MPLCONFIGDIR")}
    os.chdir(home)
    files = sandbox.create_ruleset(plan["level"], plan["readable"], home, plan["listed"])
    gc.collect()
    gc.freeze()  # a garbage collection would write to all memory pages shared with workers
    _send(control, {"ready": True})
    _serve(control, lambda handles: _fork(handles, calls, files), home)


def _serve(control, fork, home):
    pid = None
    while received := _receive(control, pid, home):
        request, handles = received
        if request["do"] == "fork":
            pid = fork(handles)
            _send(control, {"ready": True})
            continue
        if request["do"] == "cpu":
            _send(control, {"cpu": _cpu_so_far(pid)})
            continue
        cpu, pid = _kill(pid), None
        tree_removal.empty_folder(home)
        _send(control, {"cpu": cpu})
        if os.listdir(home):  # the next worker must not see remaining files
            break
    if pid is not None:
        _kill(pid)


def _receive(control, pid, home):
    """Receive a request and its handles; return None if the judge has closed the socket."""
    control.settimeout(None if pid is None else QUOTA_CHECK_SECONDS)
    while True:
        try:
            message, handles, _, _ = socket.recv_fds(control, MAX_MESSAGE_BYTES, 2)
            return (json.loads(message), handles) if message else None
        except TimeoutError:
            if quotas.quota_exceeded(pid, home):
                os.kill(pid, signal.SIGKILL)


def _fork(handles, calls, files):
    pid = os.fork()
    if pid:
        for handle in handles:
            os.close(handle)
        return pid
    try:  # from here on in the worker
        os.setsid()
        for number, handle in enumerate(handles):
            os.dup2(handle, number)
        # close the judge's socket and all other open descriptors
        sandbox.close_from(3, kept=files)
        sandbox.restrict_process(files)
        if files is not None:
            os.close(files)
        worker.serve(calls)
    except BaseException as error:
        print(f"worker: {type(error).__name__}: {error}", file=sys.stderr, flush=True)
    finally:
        os._exit(0)


def _cpu_so_far(pid):
    """Return the CPU time [s] of a worker's threads, as counted by the kernel."""
    with open(f"/proc/{pid}/stat") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _kill(pid):
    """Kill a worker and its child processes; return its CPU time [s]."""
    for kill in (os.killpg, os.kill):
        with contextlib.suppress(ProcessLookupError):
            kill(pid, signal.SIGKILL)
    _, _, usage = os.wait4(pid, 0)
    return usage.ru_utime + usage.ru_stime


def _send(control, what):
    control.send(json.dumps(what).encode())
