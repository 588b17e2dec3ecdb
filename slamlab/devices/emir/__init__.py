"""eMIR driver: text protocol and wheel odometry of the faculty's robot.

Read in this order:

- ``frames`` (framing, checksum), ``commands``, ``status``: the protocol
- ``wheel_odometry``: pose from encoder counters; ``receiver``: status and odometry from frames
- ``session``: one connection, watchdog; ``driver``: Emir; ``emir_calibration``: calibration run
"""

from slamlab.devices.emir.driver import Emir
from slamlab.devices.emir.wheel_odometry import Calibration

__all__ = ["Calibration", "Emir"]
