"""The terminal as a driver: each line that is typed there is done, and its answer printed."""

import sys
import threading

from slamlab.console.desk import TERMINAL


def hear(desk, loop, lines=None):
    """Let a thread hear the terminal until its end, which ends nothing else.

    Parameters
    ----------
    desk : Desk
    loop : event loop in which the desk lives
    lines : iterable of str; what is typed, by default
    """

    def execute(line):
        try:
            said = desk.execute(TERMINAL, line)
        except ValueError as error:
            said = str(error)
        print(said, flush=True)

    def listen():
        for line in sys.stdin if lines is None else lines:
            if loop.is_closed():
                return
            loop.call_soon_threadsafe(execute, line)

    threading.Thread(target=listen, name="hears the terminal", daemon=True).start()
