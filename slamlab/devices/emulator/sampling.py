"""The turning head of an emulated RPLIDAR: when it measures where, and the packets of that."""

from functools import partial

import numpy as np

from slamlab.devices.emulator.packets import PACKERS

FULL_PWM, FULL_RATE = 660, 10.0  # turns a second [Hz]
READY = 1.5  # periods from a packet's last sample until it can be sent (Slamtec's SDK)
LONGEST = 1.0  # of samples made at a time: who does not ask for longer has lost them [s]


class Motor:
    """What turns the head; its state outlives connections.

    Parameters
    ----------
    pwm : int, 0 to 1023
    spin_up : float, time until the rotation is even [s]
    angle : float, where it stands at first [degree]
    """

    def __init__(self, pwm, spin_up, angle=0.0):
        self.pwm, self.spin_up = pwm, spin_up
        self.even, self._known = -np.inf, (0.0, angle)

    @property
    def rate(self):
        """float, turns a second [Hz]."""
        return self.pwm / FULL_PWM * FULL_RATE

    def begin(self, now):
        """It stands where it stands at first just now."""
        self._known = now, self._known[1]

    def turn(self, pwm, now):
        """Turn as fast as that from now on."""
        if pwm and not self.pwm:
            self.even = now + self.spin_up
        self._known = now, float(self.angles(now))
        self.pwm = pwm

    def angles(self, times):
        """Where it stands at times from the last change on, growing over the turns [degree]."""
        at, angle = self._known
        return angle + 360 * self.rate * (times - at)


class Sampling:
    """A scan that runs.

    Parameters
    ----------
    mode : Mode
    motor : Motor
    measure : callable(times (n,) [s], directions (n,) clockwise [degree]) -> (n,) [mm], 0 nothing
    at : float, when it begins [s]
    """

    def __init__(self, mode, motor, measure, at):
        self._mode, self._motor, self._measure = mode, motor, measure
        self._begin, self._taken, self._first = at, 0, True
        self._packer, self._size, self._ahead = PACKERS[mode.answer]

    def wait(self, until):
        """Measure nothing before that [s]."""
        if until > self._next:
            self._begin, self._taken = until, 0

    def packets(self, now):
        """Packets whose samples are taken by now, and when each is ready.

        Parameters
        ----------
        now : float [s]

        Yields
        ------
        bytes, float [s]
        """
        self.wait(now - LONGEST)
        period, size = self._mode.period, self._size
        step = 360 * self._motor.rate * period
        count = int((now - self._next) / period - READY - self._ahead) // size
        together = max(count, 1) if size == 1 else 1  # nodes are packed many at a time
        while count > 0:
            samples = self._taken + np.arange(together * size + self._ahead)
            times = self._begin + period * samples
            look, angles = partial(self._look, times), self._motor.angles(times)
            packets = self._packer(angles, step, look, self._first)
            yield from zip(packets, times[size - 1 :: size] + READY * period, strict=True)
            self._taken += together * size
            self._first, count = False, count - together

    def _look(self, times, angles):
        return self._measure(times, np.mod(angles, 360))

    @property
    def _next(self):
        return self._begin + self._mode.period * self._taken
