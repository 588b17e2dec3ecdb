"""The end of whatever listens: Ctrl-C, or a signal that asks it to go."""

import asyncio
import contextlib
import signal


def end_on_signals(end):
    """Call something at SIGINT, SIGTERM and SIGHUP, where the running loop may hear of them.

    Parameters
    ----------
    end : callable()
    """
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        with contextlib.suppress(NotImplementedError, AttributeError, RuntimeError, ValueError):
            asyncio.get_running_loop().add_signal_handler(getattr(signal, name), end)
