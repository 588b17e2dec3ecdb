"""Signals that end a server."""

import asyncio
import contextlib
import signal


def stop_on_signals(stop):
    """Call ``stop`` on SIGINT, SIGTERM and SIGHUP."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        with contextlib.suppress(NotImplementedError, AttributeError, RuntimeError, ValueError):
            asyncio.get_running_loop().add_signal_handler(getattr(signal, name), stop)
