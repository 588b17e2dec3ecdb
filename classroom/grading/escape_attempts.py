"""Sandbox self-test (escape attempts): a cell runs in the same sandbox as submissions and tries all
actions that are forbidden in a worker.
"""

CALLS = {}
"""The function calls of the self-test's exercise, which has no tasks."""
FORBIDDEN_ACTIONS = """
import os, signal, socket, subprocess, sys, threading

def _attempt(what, act):
    try:
        act()
    except BaseException:
        return
    _done.append(what)

def _fork():
    if os.fork() == 0:
        os._exit(0)

def _other_processes():
    import time
    own = {str(os.getpid()), "self", "thread-self"}
    if not [p for p in os.listdir("/proc") if p.isdigit() and p not in own]:
        raise OSError

def _much():
    bytearray(6 << 30)

def _long_file():
    with open("long", "wb") as file:
        file.truncate(1 << 30)

_done = []
_attempt("read a file of the judge", lambda: open(CANARY).read())
_attempt("write a file next to it", lambda: open(CANARY + "-written", "w").close())
_attempt("read the course's answers", lambda: open(ANSWERS).read())
_attempt("connect to a server", lambda: socket.create_connection(("127.0.0.1", PORT), 2).close())
_attempt("open a socket", lambda: socket.socket().bind(("127.0.0.1", 0)))
_attempt("start a process", _fork)
_attempt("run a program", lambda: subprocess.run(["/bin/true"], timeout=5))
_attempt("signal the judge", lambda: os.kill(JUDGE, 0))
_attempt("signal its parent process", lambda: os.kill(os.getppid() or 1, 0))
_attempt("see other processes", _other_processes)
_attempt("allocate 6 GiB of memory", _much)
_attempt("write a file of 1 GiB", _long_file)
"""
"""Source of the cell, to follow the definitions of CANARY, ANSWERS, PORT and JUDGE."""

LIMITED_AT_NONE = ("allocate 6 GiB of memory", "write a file of 1 GiB")
"""Actions that fail even without a sandbox, because resource limits are always set."""

# the end of the cell: an error that names the successful actions
REPORT = """
if _done:
    raise RuntimeError("; ".join(_done))
"""
