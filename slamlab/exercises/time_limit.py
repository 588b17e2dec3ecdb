"""Time limit (timeout) and captured output of a student's function inside a notebook."""

import contextlib
import io
import signal
import threading


class TimeLimitExceeded(KeyboardInterrupt):
    """The timeout expired; a KeyboardInterrupt, so that no ``except Exception`` swallows it."""


def can_limit_time():
    """Whether a wall-clock limit can be set here: on POSIX, in the main thread."""
    return hasattr(signal, "setitimer") and (threading.current_thread() is threading.main_thread())


@contextlib.contextmanager
def time_limit(seconds, cpu=False):
    """Raise :class:`TimeLimitExceeded` in the block after so many seconds, where that can be done.

    Parameters
    ----------
    seconds : float [s]
    cpu : bool, of CPU time, which does not depend on what else the machine does
    """
    if not can_limit_time():
        yield
        return

    def strike(_signal, _frame):
        raise TimeLimitExceeded

    names = ("ITIMER_PROF", "SIGPROF") if cpu else ("ITIMER_REAL", "SIGALRM")
    timer, number = (getattr(signal, name) for name in names)
    before = signal.signal(number, strike)
    # it strikes again, in case a bare except swallowed the first
    signal.setitimer(timer, seconds, 0.5)
    try:
        yield
    finally:
        signal.setitimer(timer, 0)
        signal.signal(number, before)


class CapturedOutput(io.TextIOBase):
    """Captured output: keeps the first characters of what is printed and counts the rest.

    Parameters
    ----------
    most : int, characters kept
    """

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
        """The captured text, with a note of how much was cut off."""
        more = self._length - self._most
        kept = "".join(self._kept).rstrip("\n")
        return f"{kept}\n… and {more} characters more" if more > 0 else kept


@contextlib.contextmanager
def capture_output(most=400):
    """Capture what the block prints to standard output and error.

    Parameters
    ----------
    most : int, characters kept

    Yields
    ------
    CapturedOutput
    """
    printed = CapturedOutput(most)
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        yield printed
