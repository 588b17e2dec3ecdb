"""eMIR driver: the faculty's wheeled robot, its text protocol and wheel odometry.

Read in this order:

- ``frames``: text frames with a checksum; ``commands``, ``status``: what they hold
- ``wheel_odometry``: counters unwrapped to a pose; ``receiver``: frames to status and odometry
- ``session``: one connection, with its keep-alive; ``driver``: Emir, with its watchdog
- ``calibration_drive``: a metre and four quarter turns, to be measured by hand
"""

from slamlab.devices.emir.driver import Emir
from slamlab.devices.emir.wheel_odometry import Calibration

__all__ = ["Calibration", "Emir"]
