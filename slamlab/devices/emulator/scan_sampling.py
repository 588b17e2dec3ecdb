"""Sampling of the emulated RPLIDAR: motor rotation, sample times, packets."""

from functools import partial

import numpy as np

from slamlab.devices.emulator.packet_encoder import ENCODERS, encode_noise
from slamlab.devices.rplidar.requests import NOMINAL_PWM, NOMINAL_RPM

SEND_DELAY = 1.5  # periods between a packet's last sample and its transmission (Slamtec's SDK)
NOISE = encode_noise, 32, 0  # encoder of an unknown answer type
MAX_BACKLOG = 1.0  # of samples that are encoded at a time; older ones are lost [s]


class Motor:
    """Motor that rotates steadily after ``spin_up`` [s], with a ``rate`` [Hz] at NOMINAL_PWM."""

    def __init__(self, pwm, spin_up, angle=0.0, rate=NOMINAL_RPM / 60):
        self.pwm, self.spin_up, self._nominal_rate = pwm, spin_up, rate
        self.steady_from, self._known = -np.inf, (0.0, angle)

    @property
    def rate(self):
        """Rotation rate [Hz]."""
        return self.pwm / NOMINAL_PWM * self._nominal_rate

    def begin(self, now):
        self._known = now, self._known[1]

    def set_pwm(self, pwm, now):
        """Set the motor's PWM duty cycle at the time ``now`` [s]."""
        if pwm and not self.pwm:
            self.steady_from = now + self.spin_up
        self._known = now, float(self.angles(now))
        self.pwm = pwm

    def angles(self, times):
        """Return the unwrapped angles [degree] at times [s] after the last change of the speed."""
        at, angle = self._known
        return angle + 360 * self.rate * (times - at)


class ScanSampler:
    """Sampler of a running scan that encodes samples into packets of an answer type."""

    def __init__(self, mode, answer_type, motor, measure, at):
        self._mode, self._motor, self._measure = mode, motor, measure
        self._begin, self._taken, self._first = at, 0, True
        self._packer, self._size, self._ahead = ENCODERS.get(answer_type, NOISE)

    def wait(self, until):
        """Pause the sampling until the given time [s]."""
        if until > self._next:
            self._begin, self._taken = until, 0

    def packets(self, now):
        """Yield each packet that is complete at ``now`` [s], and its transmission time [s]."""
        self.wait(now - MAX_BACKLOG)
        period, size = self._mode.period, self._size
        step = 360 * self._motor.rate * period
        count = int((now - self._next) / period - SEND_DELAY - self._ahead) // size
        together = max(count, 1) if size == 1 else 1  # nodes are encoded many at a time
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
