"""Published drivers with their mistakes: Tuček's listing and Slamtec's document (lesson 14)."""

from typing import ClassVar

import numpy as np

from slamlab.devices.rplidar.capsules import ExpressDecoder


def move(speed, turn):
    """Return the listing's frame for a speed and a turn [%]; its checksum is a difference."""
    speed, turn = speed % 256, turn % 256
    return f"#01{speed:02x}{turn:02x}{256 - 1 - speed - turn:02x}/".upper()


def transformation_is_zero(T):
    """Return whether a robot with motion T (3, 3) stood still, according to the listing's test."""
    return T.sum() == 0


def values_for_sensors(text, wanted):
    """Return the values of the given sensors that the listing reads from a status frame."""
    values = [int(text[i : i + 2], 16) for i in range(1, 35, 2)]
    values = [v - 256 if v > 127 else v for v in values]
    return [values[i] for i in wanted if i > 0 and i < len(values)]


def slam_routine(scans):
    """Count the scans that the listing's loop uses; the loop ends at an empty scan."""
    used = 0
    for points in scans:
        if len(points) == 0:
            return used
        used += 1
    return used


def requested_turns(readings, count):
    """Return scans in the way in which the listing requests them: each from a new generator."""

    def iter_scans():
        scan = []
        for begins, reading in readings:
            if begins and scan:
                yield scan
                scan = []
            scan.append(reading)

    return [next(iter_scans()) for _ in range(count)]


class App:
    """The listing's program, whose class body creates its map."""

    points: ClassVar[list] = []

    def __init__(self):
        self.called = []

    def start(self):
        """Record a call; the published function instead opens the lidar and makes the map."""
        self.called.append("start")

    def robot_control(self):
        """Record a call; the published function instead asks for commands and drives the robot."""
        self.called.append("robot_control")


def main():
    """Run the listing's main, which creates the program and calls nothing."""
    return App()


def bytes_sent(seconds, size=10, baud=57600):
    """Return the number of bytes that a serial port has sent before its buffer is flushed after
    some seconds."""
    return min(size, int(seconds * baud / 10))


def to_homogeneous(points):
    """Return the pseudo-code's homogeneous points (3, n), whose third coordinate is never set."""
    homogeneous = np.zeros((3, len(points)))
    homogeneous[:2] = points.T
    return homogeneous


def slam_routine_iterations():
    """Count the iterations of the pseudo-code's main loop."""
    is_running, iterations = True, 0
    while is_running is not True:
        iterations += 1
    return iterations


def as_documented(capsule, following):
    """Decode a capsule's points (32, 2) [degree, mm] according to Slamtec's document, in which an
    offset has a sign and k begins at 1. Equation (14.9)."""
    begin, end = (((c[2] | c[3] << 8) & 0x7FFF) / 64 for c in (capsule, following))
    cabins = np.frombuffer(capsule, np.uint8, offset=ExpressDecoder.header)
    cabins = cabins.reshape(-1, 5).astype(int)
    words = cabins[:, 0:4:2] | cabins[:, 1:4:2] << 8
    low = np.column_stack([cabins[:, 4] & 15, cabins[:, 4] >> 4])
    offset = ((words & 3) << 4 | low).ravel()
    offset = np.where(offset & 32, -(offset & 31), offset)
    angle = begin + np.arange(1, 33) / 32 * ((end - begin) % 360) - offset / 8
    return np.column_stack([angle % 360, words.ravel() >> 2])
