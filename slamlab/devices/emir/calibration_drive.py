"""Calibration drive of eMIR: a metre and four quarter turns by its own count."""

import numpy as np

from slamlab.devices.emir.wheel_odometry import CounterUnwrapper
from slamlab.devices.errors import DeviceNotResponding

WAY, QUARTER = 1.0, 90  # asked for, at a count of 1 cm and 2° [m, degree]
STILL = 5  # statuses without a count more: the robot stands


def calibration_drive(emir, at_rest=lambda: None):
    """Drive 1 m ahead, then turn by four quarters to the left, all by the robot's own count.

    Parameters
    ----------
    emir : Emir
    at_rest : callable without arguments, called before the drive and after each of its five parts

    Returns
    -------
    (2,) int, counts of the path while it drove, and of the angle while it turned

    Raises
    ------
    ConnectionLost, DeviceNotResponding
    """
    at_rest()
    path, _ = _counts_of(emir, lambda: emir.translate(WAY, 100))
    at_rest()
    angle = 0
    for _ in range(4):
        angle += _counts_of(emir, lambda: emir.rotate(QUARTER, 50))[1]
        at_rest()
    return np.array([path, angle])


def _counts_of(emir, order):
    """Counts of path and angle that an order takes, until the robot stands."""
    counters, total, still = [CounterUnwrapper(), CounterUnwrapper()], np.zeros(2, int), 0
    _advance(counters, emir.status)
    order()
    while still < STILL:
        status = emir.wait()
        if status is None:
            raise DeviceNotResponding(
                "eMIR says no more", "it was closed or switched off", "open it and begin again"
            )
        steps = _advance(counters, status)
        total += steps
        still = 0 if steps.any() else still + 1
    return total


def _advance(counters, status):
    values = status.path, status.angle
    return np.array([c.advance(v) for c, v in zip(counters, values, strict=True)])
