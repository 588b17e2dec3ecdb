"""Receive timeout (watchdog of the data stream): how long a device has sent nothing."""

MAX_INCREMENT = 0.1  # most that one update adds [s]: the program was not reading in the rest


class ReceiveTimer:
    """Time since data was last received, counted only while the program was reading.

    Time in which the program did not come to read, its machine being busy or asleep, is no sign of
    a lost device and does not count towards the timeout.

    Parameters
    ----------
    now : float [s]
    """

    def __init__(self, now):
        self.elapsed, self._last = 0.0, now

    def update(self, now, received):
        """Take in the outcome of a read that has just ended.

        Parameters
        ----------
        now : float [s]
        received : bool, whether anything came

        Returns
        -------
        float, how long nothing was received [s]
        """
        self.elapsed = 0.0 if received else self.elapsed + min(now - self._last, MAX_INCREMENT)
        self._last = now
        return self.elapsed
