"""Time limit and captured output of a student's function in a notebook."""

import contextlib
import io
import signal
import threading


class TimeLimitExceeded(KeyboardInterrupt):
    """The time limit expired; a KeyboardInterrupt, so that no ``except Exception`` catches it."""


def can_limit_time():
    """Whether wall-clock time can be limited: on POSIX, in the main thread."""
    return hasattr(signal, "setitimer") and (threading.current_thread() is threading.main_thread())


@contextlib.contextmanager
def time_limit(seconds, cpu=False):
    """Raise :class:`TimeLimitExceeded` after a number of seconds, if a limit can be set.

    cpu : whether the seconds are CPU time instead of wall-clock time."""
    if not can_limit_time():
        yield
        return

    def strike(_signal, _frame):
        raise TimeLimitExceeded

    names = ("ITIMER_PROF", "SIGPROF") if cpu else ("ITIMER_REAL", "SIGALRM")
    timer, number = (getattr(signal, name) for name in names)
    before = signal.signal(number, strike)
    # the timer repeats, in case a bare except caught the first exception
    signal.setitimer(timer, seconds, 0.5)
    try:
        yield
    finally:
        signal.setitimer(timer, 0)
        signal.signal(number, before)


class CapturedOutput(io.TextIOBase):
    """A stream that keeps the first ``most`` printed characters and counts the rest."""

    def __init__(self, most=400):
        self._most, self._kept, self._length = most, [], 0

    def writable(self):
        return True

    def write(self, text):
        room = self._most - self._length
        if room > 0:
            self._kept.append(text[:room])
        self._length += len(text)
        return len(text)

    @property
    def text(self):
        """The captured text, with a note of the number of characters that were cut off."""
        more = self._length - self._most
        kept = "".join(self._kept).rstrip("\n")
        return f"{kept}\n… and {more} more characters" if more > 0 else kept


@contextlib.contextmanager
def capture_output(most=400):
    """Capture the output of the block, and yield a CapturedOutput."""
    printed = CapturedOutput(most)
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        yield printed
