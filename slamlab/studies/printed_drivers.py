"""Drivers as they are printed, for lesson 14: Tuček's listing, and Slamtec's document.

Each function does what the printed one does, mistakes included, in this course's words.
"""

from typing import ClassVar

import numpy as np

from slamlab.devices.rplidar.capsules import HEADER_SIZE


def move(speed, turn):
    """The listing's frame to drive: its checksum is a plain difference.

    Parameters
    ----------
    speed, turn : int, −100 to 100 [%]

    Returns
    -------
    str
    """
    speed, turn = speed % 256, turn % 256
    return f"#01{speed:02x}{turn:02x}{256 - 1 - speed - turn:02x}/".upper()


def transformation_is_zero(T):
    """The listing's test of whether a robot has stood still; T (3, 3); bool."""
    return T.sum() == 0


def values_for_sensors(text, wanted):
    """The listing's values of the sensors asked for.

    Parameters
    ----------
    text : str, a status frame
    wanted : list of int, numbers of sensors from 0

    Returns
    -------
    list of int
    """
    values = [int(text[i : i + 2], 16) for i in range(1, 35, 2)]
    values = [v - 256 if v > 127 else v for v in values]
    return [values[i] for i in wanted if i > 0 and i < len(values)]


def slam_routine(scans):
    """How many scans the listing's main loop uses: it ends at the first that is empty.

    Parameters
    ----------
    scans : sequence of sequences of points

    Returns
    -------
    int
    """
    used = 0
    for points in scans:
        if len(points) == 0:
            return used
        used += 1
    return used


def turns_asked_for(readings, count):
    """Turns as the listing asks for them: by a new generator each.

    Parameters
    ----------
    readings : iterator of (bool, reading), whether a turn begins there
    count : int

    Returns
    -------
    list of lists of readings
    """

    def iter_scans():
        scan = []
        for begins, reading in readings:
            if begins and scan:
                yield scan
                scan = []
            scan.append(reading)

    return [next(iter_scans()) for _ in range(count)]


class App:
    """The listing's program: its map is made in the body of the class."""

    points: ClassVar[list] = []

    def __init__(self):
        self.called = []

    def start(self):
        """Would open the lidar and begin to map."""
        self.called.append("start")

    def robot_control(self):
        """Would ask for commands and drive."""
        self.called.append("robot_control")


def main():
    """The listing's main: it makes the program, and calls nothing of it; App."""
    return App()


def bytes_sent(seconds, size=10, baud=57600):
    """Bytes of a frame that have left a serial port when its output buffer is flushed.

    Parameters
    ----------
    seconds : float, from the write to the flush [s]
    size : int, bytes written
    baud : int [bit/s]

    Returns
    -------
    int
    """
    return min(size, int(seconds * baud / 10))


def to_homogeneous(points):
    """The pseudo-code's homogeneous points: the third coordinate is never set.

    Parameters
    ----------
    points : (n, 2)

    Returns
    -------
    (3, n)
    """
    homogeneous = np.zeros((3, len(points)))
    homogeneous[:2] = points.T
    return homogeneous


def slam_routine_rounds():
    """How many rounds the pseudo-code's main loop makes while the program runs; int."""
    is_running, rounds = True, 0
    while is_running is not True:
        rounds += 1
    return rounds


def as_documented(capsule, following):
    """A capsule's points as Slamtec's document has them: an offset has a sign, k begins at 1.

    Equation (14.9).

    Parameters
    ----------
    capsule, following : bytes, 84 each

    Returns
    -------
    (32, 2) angle and distance [degree, mm]
    """
    begin, end = (((c[2] | c[3] << 8) & 0x7FFF) / 64 for c in (capsule, following))
    cabins = np.frombuffer(capsule, np.uint8, offset=HEADER_SIZE).reshape(-1, 5).astype(int)
    words = cabins[:, 0:4:2] | cabins[:, 1:4:2] << 8
    low = np.column_stack([cabins[:, 4] & 15, cabins[:, 4] >> 4])
    offset = ((words & 3) << 4 | low).ravel()
    offset = np.where(offset & 32, -(offset & 31), offset)
    angle = begin + np.arange(1, 33) / 32 * ((end - begin) % 360) - offset / 8
    return np.column_stack([angle % 360, words.ravel() >> 2])
