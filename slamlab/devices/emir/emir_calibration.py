"""Odometry calibration of eMIR: a drive of 1 m and four 90° rotations, measured by the counters."""

import numpy as np

from slamlab.devices.emir.wheel_odometry import CounterUnwrapper
from slamlab.devices.errors import DeviceNotResponding

DISTANCE, ROTATION = 1.0, 90  # commanded, at counts of 1 cm and 2° [m, degree]
STATUSES_AT_REST = 5  # statuses with constant counters, after which the robot is at rest


def calibration_run(emir, at_rest=lambda: None):
    """Drive 1 m ahead, then rotate four times by 90° to the left, as measured by the counters.

    Calls at_rest() before and after each part. Returns the counts of distance and angle, (2,) int.
    Raises ConnectionLost, DeviceNotResponding.
    """
    at_rest()
    path, _ = _counts_of(emir, lambda: emir.translate(DISTANCE, 100))
    at_rest()
    angle = 0
    for _ in range(4):
        angle += _counts_of(emir, lambda: emir.rotate(ROTATION, 50))[1]
        at_rest()
    return np.array([path, angle])


def _counts_of(emir, command):
    """Send a command, wait until the robot stops, and return counts (2,) of distance and angle."""
    counters, total, still = [CounterUnwrapper(), CounterUnwrapper()], np.zeros(2, int), 0
    _advance(counters, emir.status)
    command()
    while still < STATUSES_AT_REST:
        status = emir.wait()
        if status is None:
            raise DeviceNotResponding(
                "eMIR sends no status",
                "the connection was closed, or eMIR was switched off",
                "connect to eMIR and start again",
            )
        steps = _advance(counters, status)
        total += steps
        still = 0 if steps.any() else still + 1
    return total


def _advance(counters, status):
    values = status.path, status.angle
    return np.array([c.advance(v) for c, v in zip(counters, values, strict=True)])
