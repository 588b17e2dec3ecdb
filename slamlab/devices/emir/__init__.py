"""eMIR, the faculty's robot: its frames of text, and a driver that adds up its way."""

from slamlab.devices.emir.odometry import Calibration
from slamlab.devices.emir.robot import Emir

__all__ = ["Calibration", "Emir"]
