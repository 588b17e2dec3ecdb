"""Safe shutdown: at exit and on signals except SIGKILL, devices are closed and motors stop."""

import atexit
import contextlib
import os
import signal
import threading
import weakref

# termination signals: from another program, from a closed terminal, on Windows
TERMINATION_SIGNALS = [
    getattr(signal, name) for name in ("SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
]

_open = weakref.WeakKeyDictionary()  # in the order of opening
_installed = False


class Closeable:
    """Base class of context managers that call close() on exit."""

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()


def close_at_exit(device):
    """Register an object; when the program ends, its close() is called, maybe repeatedly."""
    global _installed
    _open[device] = True
    if not _installed:
        _installed = True
        atexit.register(close_all)
    if threading.current_thread() is threading.main_thread():  # others may not set handlers
        for number in TERMINATION_SIGNALS:
            if signal.getsignal(number) is signal.SIG_DFL:
                signal.signal(number, _on_signal)


def close_all():
    """Close every open device, beginning with the one that was opened last."""
    for device in reversed(list(_open)):
        with contextlib.suppress(Exception):  # the program ends: no caller remains
            device.close()


def _on_signal(number, frame):
    close_all()
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)
