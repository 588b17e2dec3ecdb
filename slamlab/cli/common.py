"""Helpers shared by the commands: random generator, source that ends at Ctrl-C, damage report."""

import signal
import threading

SOURCES = (
    "a log file, a ROS bag, a raw recording of devices, sim:WORLD, a recording's name, or, live, "
    "devices:LIDAR_PORT,EMIR_PORT"
)
INTERRUPTED = 130  # the exit code after Ctrl-C, as of shells


def generator(seed):
    """The random generator of ``--seed``; ValueError where the seed is negative."""
    import numpy as np  # late: a help text should come at once

    if seed < 0:
        raise ValueError(f"--seed must not be negative, got {seed}")
    return np.random.default_rng(seed)


def damage_line(source):
    """Count a source's corrupt data (damage), as the end of a line; empty where there is none."""
    kinds = ", ".join(f"{kind}: {count}" for kind, count in source.damage.items())
    return f"; damage: {kinds}" if kinds else ""


class Interruptible:
    """Wrapper of a source that ends it, not the program, at Ctrl-C or when devices are lost.

    At Ctrl-C a live one is closed at once, so that its robot stops; pressed again it ends the
    program, too. In all else it is the source. ``ended`` says why it ended early, empty if it did
    not, and ``code`` is the exit code for that.

    Parameters
    ----------
    source : Source
    """

    def __init__(self, source):
        self._source, self.ended, self.code = source, "", 0

    def __getattr__(self, name):
        return getattr(self._source, name)

    def __len__(self):
        return len(self._source)

    def __iter__(self):
        from slamlab.files.errors import SourceError  # late, as above

        begun, in_main = False, threading.current_thread() is threading.main_thread()
        before = signal.signal(signal.SIGINT, self._pressed) if in_main else None
        try:
            for reading in self._source:
                if self.ended:
                    return
                begun = True
                yield reading
        except SourceError as error:
            if not begun:
                raise
            self.ended, self.code = str(error), 2
        finally:
            if in_main:  # no other thread hears of Ctrl-C
                signal.signal(signal.SIGINT, before)

    def _pressed(self, number, frame):
        if self.ended:
            raise KeyboardInterrupt
        self.ended, self.code = "ended by Ctrl-C", INTERRUPTED
        self._source.close()
