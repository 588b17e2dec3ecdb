"""Drive lock (lease, dead man's switch): one client holds it, and it expires unless renewed."""

import time

LOCK_TIMEOUT = 1.0  # after which a lock that is not renewed expires [s]


class LockTaken(ValueError):
    """Another client holds the lock."""


class DriveLock:
    """Lock that expires if it is not renewed within ``timeout`` [s]."""

    def __init__(self, timeout=LOCK_TIMEOUT, clock=time.monotonic):
        self._timeout, self._clock = timeout, clock
        self._holder, self._renewed = None, 0.0

    @property
    def holder(self):
        if self._holder is not None and self._clock() - self._renewed > self._timeout:
            self._holder = None
        return self._holder

    def acquire(self, who):
        """Acquire or renew the lock. LockTaken: another client holds the lock."""
        if self.holder not in (None, who):
            raise LockTaken("another client is driving: wait until the robot stops, or stop it")
        self._holder, self._renewed = who, self._clock()

    def renew(self, who):
        """If ``who`` holds the lock, renew it and return True."""
        holds = self.holder == who
        if holds:
            self._renewed = self._clock()
        return holds

    def release(self, who):
        if self._holder == who:
            self._holder = None
