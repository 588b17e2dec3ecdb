"""Devices are closed when the program ends, also when it is told to: no motor turns on for nobody.

A killed process (SIGKILL, power) closes nothing: the lidar then turns on, the robot drives on.
"""

import atexit
import contextlib
import os
import signal
import threading
import weakref

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
    in_main = threading.current_thread() is threading.main_thread()
    if in_main and signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        signal.signal(signal.SIGTERM, _terminated)


def close_all():
    """Close every device that is still open, the last first; none keeps another open."""
    for device in reversed(list(_open)):
        with contextlib.suppress(Exception):  # the program ends: nobody is left to be told
            device.close()


def _terminated(number, frame):
    close_all()
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)
