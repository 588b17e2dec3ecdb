"""How long a device has been silent, as far as anybody listened."""

LISTENING = 0.1  # more than this since one last listened was spent on something else [s]


class Silence:
    """A silence that grows while one listens and hears nothing.

    Time in which the program did not come to listening, its machine being busy or asleep, is no
    sign of a lost device and does not count.

    Parameters
    ----------
    now : float [s]
    """

    def __init__(self, now):
        self.seconds, self._last = 0.0, now

    def listened(self, now, heard):
        """Somebody listened until now.

        Parameters
        ----------
        now : float [s]
        heard : bool, whether anything came

        Returns
        -------
        float, how long the silence is [s]
        """
        self.seconds = 0.0 if heard else self.seconds + min(now - self._last, LISTENING)
        self._last = now
        return self.seconds
