"""Calibration overrides by the user: extrinsic calibration of the lidar, field of view, units."""

from dataclasses import dataclass, replace

import numpy as np

from slamlab.files import SourceError


@dataclass(frozen=True)
class CalibrationOverrides:
    """Calibration values that replace those of a source; none by default. Raises SourceError if a
    number is out of range.

    ``lidar_yaw`` is counter-clockwise relative to the robot [degree], ``field_of_view`` is in
    degrees; the scales are the units of the ranges and of the odometry's distances [m] and turns
    [rad].
    """

    upside_down: bool = False
    lidar_yaw: float = 0.0
    field_of_view: float | None = None
    range_scale: float = 1.0
    odometry_scale: float = 1.0
    turn_scale: float = 1.0
    ignore_odometry: bool = False

    def __post_init__(self):
        numbers = self.range_scale, self.odometry_scale, self.turn_scale, self.lidar_yaw
        if not np.isfinite(numbers).all() or 0 in numbers[:3] or self.range_scale < 0:
            raise SourceError(f"scales must be finite and not 0, not {numbers[:3]}")
        if self.field_of_view is not None and not 0 < self.field_of_view <= 360:
            raise SourceError(
                f"a field of view must be above 0 and at most 360 degrees, not {self.field_of_view}"
            )

    def reading(self, reading):
        """Apply the overrides to a Reading."""
        odometry, scan = reading.odometry, reading.scan
        if odometry is not None:
            scales = self.odometry_scale, self.odometry_scale, self.turn_scale
            odometry = None if self.ignore_odometry else odometry * np.array(scales)
        if scan is not None and len(scan.angles):
            scan = self._scan(scan)
        return replace(reading, odometry=odometry, scan=scan)

    def _scan(self, scan):
        angles, ranges, s = scan.angles, scan.ranges, self.range_scale
        if self.field_of_view is not None:
            span = np.ptp(angles)  # also of angles in degrees
            angles = angles * (np.radians(self.field_of_view) / span if span else 1.0)
        if self.upside_down:
            angles = -angles
        angles = angles + np.radians(self.lidar_yaw)
        limits = {"range_min": scan.range_min * s, "range_max": scan.range_max * s}
        return replace(scan, angles=angles, ranges=ranges * s, **limits)


class OverriddenSource:
    """A source with calibration overrides."""

    def __init__(self, source, overrides):
        self._source, self._overrides = source, overrides
        self.has_odometry = source.has_odometry and not overrides.ignore_odometry

    def __getattr__(self, name):
        return getattr(self._source, name)

    def __len__(self):
        return len(self._source)

    def __iter__(self):
        return map(self._overrides.reading, self._source)

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self._source.close()

    @property
    def sensor(self):
        sensor, scale = self._source.sensor, self._overrides.range_scale
        return replace(
            sensor, range_min=sensor.range_min * scale, range_max=sensor.range_max * scale
        )

    def drive(self, command):
        reading = self._source.drive(command)
        return None if reading is None else self._overrides.reading(reading)


def override_calibration(source, overrides):
    """Apply CalibrationOverrides to a source; without overrides, return the source unchanged."""
    return source if overrides == CalibrationOverrides() else OverriddenSource(source, overrides)
