"""Devices are closed when the program ends, also when it is told to: no motor turns on for nobody.

A killed process (SIGKILL, power) closes nothing: the lidar then turns on, the robot drives on.
"""

import atexit
import contextlib
import os
import signal
import threading
import weakref

SIGNALS = [
    getattr(signal, name) for name in ("SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
]
"""Signals that tell a program to end: by another, by its terminal's closing, on Windows."""

_open = weakref.WeakKeyDictionary()  # keeps their order
_ready = False


def closed_at_exit(device):
    """Have a device closed when the program ends.

    Parameters
    ----------
    device : object with close(), which may be called twice
    """
    global _ready
    _open[device] = True
    if not _ready:
        _ready = True
        atexit.register(close_all)
    if threading.current_thread() is threading.main_thread():  # no other may
        for number in SIGNALS:
            if signal.getsignal(number) is signal.SIG_DFL:
                signal.signal(number, _terminated)


def close_all():
    """Close every device that is still open, the last first; none keeps another open."""
    for device in reversed(list(_open)):
        with contextlib.suppress(Exception):  # the program ends: nobody is left to be told
            device.close()


def _terminated(number, frame):
    close_all()
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)
