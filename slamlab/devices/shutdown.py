"""Clean shutdown: devices are closed at exit and on signals, so that motors stop.

A killed process (SIGKILL, power) closes nothing: the lidar then turns on, the robot drives on.
"""

import atexit
import contextlib
import os
import signal
import threading
import weakref

TERMINATION_SIGNALS = [
    getattr(signal, name) for name in ("SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
]
"""Signals that end a program: from another one, from a closing terminal, on Windows."""

_open = weakref.WeakKeyDictionary()  # keeps their order
_installed = False


def close_at_exit(device):
    """Register a device to be closed when the program ends (atexit and signal handlers).

    Parameters
    ----------
    device : object with close(), which may be called twice
    """
    global _installed
    _open[device] = True
    if not _installed:
        _installed = True
        atexit.register(close_all)
    if threading.current_thread() is threading.main_thread():  # no other may
        for number in TERMINATION_SIGNALS:
            if signal.getsignal(number) is signal.SIG_DFL:
                signal.signal(number, _on_signal)


def close_all():
    """Close every device that is still open, the last first; none keeps another open."""
    for device in reversed(list(_open)):
        with contextlib.suppress(Exception):  # the program ends: nobody is left to be told
            device.close()


def _on_signal(number, frame):
    close_all()
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)
