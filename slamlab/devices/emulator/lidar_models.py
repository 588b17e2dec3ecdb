"""Emulated RPLIDAR models: device information, baud rate, scan modes, noise."""

from dataclasses import dataclass, replace

from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_modes import ScanMode
from slamlab.simulation.range_scanners import RPLIDARS, Scanner


@dataclass(frozen=True)
class LidarModel:
    """RPLIDAR model; ``typical``: number of the typical mode; ``scanner``: noise, rotation rate."""

    number: int
    hardware: int
    firmware: tuple[int, int]
    baud: int
    modes: tuple[ScanMode, ...]
    typical: int
    scanner: Scanner


def _modes(range_max, *rows):
    """Create scan modes, numbered from 0, from rows (name, sample period [µs], answer type)."""
    return tuple(
        ScanMode(number, name, us * 1e-6, range_max, AnswerType[kind])
        for number, (name, us, kind) in enumerate(rows)
    )


SLOW = ("Standard", 508, "SCAN"), ("Express", 254, "EXPRESS"), ("Boost", 127, "ULTRA")
FAST = (
    *(("Standard", 252, "SCAN"), ("Express", 126, "EXPRESS"), ("Boost", 63, "ULTRA")),
    *(("Sensitivity", 63, "ULTRA"), ("Stability", 100, "ULTRA")),
)
A1, A2, C1 = RPLIDARS["A1"], RPLIDARS["A2"], RPLIDARS["C1"]
# Modes as listed in logs of users. Without a log (S series and C1: modes other than the typical
# one) they are assumed, within the bandwidth of the line. The driver queries them from the device.
MODELS = {
    "a1": LidarModel(0x18, 7, (1, 29), 115200, _modes(12, *SLOW), 2, A1),
    "a2m8": LidarModel(0x28, 5, (1, 29), 115200, _modes(12, *SLOW), 2, A2),
    "a2m12": LidarModel(0x2C, 6, (1, 32), 256000, _modes(12, *FAST), 3, A2),
    "a3": LidarModel(0x31, 6, (1, 29), 256000, _modes(25, *FAST), 3, replace(A2, range_max=25)),
    "c1": LidarModel(
        *(0x41, 18, (1, 2), 460800),
        _modes(16, ("Standard", 200, "SCAN"), ("DenseBoost", 200, "DENSE")),
        *(0, C1),
    ),
    "s1": LidarModel(
        *(0x61, 18, (1, 30), 256000),
        _modes(40, ("Standard", 254, "SCAN"), ("DenseBoost", 108, "DENSE")),
        *(1, replace(C1, range_max=40)),
    ),
    "s2": LidarModel(
        *(0x71, 18, (1, 1), 1000000),
        _modes(30, ("Standard", 62.5, "SCAN"), ("DenseBoost", 31.25, "DENSE")),
        *(1, replace(C1, range_max=30)),
    ),
    "s3": LidarModel(
        *(0x81, 18, (1, 2), 1000000),
        _modes(40, ("Standard", 62.5, "SCAN"), ("DenseBoost", 31.25, "ULTRA_DENSE")),
        *(1, replace(C1, range_max=40)),
    ),
}


def lidar_model(name):
    """Return the LidarModel with the given name. Raises ValueError."""
    try:
        return MODELS[name.lower()]
    except KeyError:
        raise ValueError(
            f"there is no lidar model {name!r}; available: {', '.join(MODELS)}"
        ) from None
