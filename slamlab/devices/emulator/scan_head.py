"""Rotating scan head of the emulated RPLIDAR: motor angle, sampling times, packets."""

from functools import partial

import numpy as np

from slamlab.devices.emulator.packet_encoder import ENCODERS

NOMINAL_PWM, NOMINAL_RATE = 660, 10.0  # and its rotation rate [Hz]
SEND_DELAY = 1.5  # periods from a packet's last sample until it can be sent (Slamtec's SDK)
MAX_BACKLOG = 1.0  # of samples made at a time; older ones are lost [s]


class Motor:
    """Motor of the scan head; its state outlives connections.

    Parameters
    ----------
    pwm : int, 0 to 1023
    spin_up : float, time until the rotation is even [s]
    angle : float, where it stands at first [degree]
    """

    def __init__(self, pwm, spin_up, angle=0.0):
        self.pwm, self.spin_up = pwm, spin_up
        self.steady_from, self._known = -np.inf, (0.0, angle)

    @property
    def rate(self):
        """Rotation rate [Hz], float."""
        return self.pwm / NOMINAL_PWM * NOMINAL_RATE

    def begin(self, now):
        """Start the motor's clock at its first angle."""
        self._known = now, self._known[1]

    def turn(self, pwm, now):
        """Set the motor's PWM from now on."""
        if pwm and not self.pwm:
            self.steady_from = now + self.spin_up
        self._known = now, float(self.angles(now))
        self.pwm = pwm

    def angles(self, times):
        """Motor angle at times since the last change, unwrapped over revolutions [degree]."""
        at, angle = self._known
        return angle + 360 * self.rate * (times - at)


class ScanSampler:
    """Samples of a running scan, taken on time and encoded into packets.

    Parameters
    ----------
    mode : ScanMode
    motor : Motor
    measure : callable(times (n,) [s], directions (n,) clockwise [degree]) -> (n,) [mm], 0 nothing
    at : float, when it begins [s]
    """

    def __init__(self, mode, motor, measure, at):
        self._mode, self._motor, self._measure = mode, motor, measure
        self._begin, self._taken, self._first = at, 0, True
        self._packer, self._size, self._ahead = ENCODERS[mode.answer_type]

    def wait(self, until):
        """Measure nothing before a time [s]."""
        if until > self._next:
            self._begin, self._taken = until, 0

    def packets(self, now):
        """Packets whose samples are complete by now, and when each is ready to be sent.

        Parameters
        ----------
        now : float [s]

        Yields
        ------
        bytes, float [s]
        """
        self.wait(now - MAX_BACKLOG)
        period, size = self._mode.period, self._size
        step = 360 * self._motor.rate * period
        count = int((now - self._next) / period - SEND_DELAY - self._ahead) // size
        together = max(count, 1) if size == 1 else 1  # nodes are packed many at a time
        while count > 0:
            samples = self._taken + np.arange(together * size + self._ahead)
            times = self._begin + period * samples
            measure, angles = partial(self._measure_at, times), self._motor.angles(times)
            packets = self._packer(angles, step, measure, self._first)
            yield from zip(packets, times[size - 1 :: size] + SEND_DELAY * period, strict=True)
            self._taken += together * size
            self._first, count = False, count - together

    def _measure_at(self, times, angles):
        return self._measure(times, np.mod(angles, 360))

    @property
    def _next(self):
        return self._begin + self._mode.period * self._taken
