"""Sensor models of range scanners (lidar, infrared, ultrasonic) with range noise and dropouts."""

from dataclasses import dataclass, replace

import numpy as np

from slamlab.models.parameters import SensorModel
from slamlab.readings import Scan

RAY_STEP = np.radians(0.5)  # between rays of a wide beam [rad]: error below 1e-5 of the range


@dataclass(frozen=True)
class Scanner:
    """Rotating range sensor at the robot's centre; ``scan`` measures a revolution from one pose.

    Parameters
    ----------
    beams : int
    range_min, range_max : float, limits of valid ranges [m]
    field_of_view : float, centred on the heading [rad]
    range_error, range_sigma, range_curvature : float, range noise: standard deviation proportional
        to the range, constant, proportional to the squared range [1, m, 1/m]
    bearing_sigma : float, standard deviation of a beam's direction [rad]
    cone : float, opening angle of a beam, which measures the nearest surface [rad]
    dropouts : float, share of the beams without a return [1]
    max_incidence : float, angle of incidence beyond which a smooth surface reflects a wide beam
        away (specular reflection) [rad]
    rate : float, rotation rate, for a sensor that moves during a revolution [Hz]
    """

    beams: int = 400
    range_min: float = 0.2
    range_max: float = 12.0
    field_of_view: float = 2 * np.pi
    range_error: float = 0.01
    range_sigma: float = 0.0
    range_curvature: float = 0.0
    bearing_sigma: float = 0.0
    cone: float = 0.0
    dropouts: float = 0.0
    max_incidence: float = np.pi / 2
    rate: float = 10.0

    def __post_init__(self):
        if self.beams < 1:
            raise ValueError(f"a scanner must have at least one beam, not {self.beams}")
        if not 0 < self.field_of_view <= 2 * np.pi:
            raise ValueError(
                f"field_of_view must be in radians, above 0 and up to 2π, not {self.field_of_view}"
            )
        if not 0 <= self.range_min < self.range_max:
            limits = f"{self.range_min} and {self.range_max} m"
            raise ValueError(f"range_min must be less than range_max; the limits are {limits}")
        if not 0 <= self.dropouts <= 1:
            raise ValueError(f"dropouts must be a share from 0 to 1, not {self.dropouts}")
        if not 0 <= self.cone < np.pi:
            raise ValueError(f"cone must be in radians, at least 0 and below π, not {self.cone}")
        if not 0 < self.max_incidence <= np.pi / 2:
            raise ValueError(
                f"max_incidence must be in radians, above 0 and up to π/2, not {self.max_incidence}"
            )
        sigmas = self.range_error, self.range_sigma, self.range_curvature, self.bearing_sigma
        if min(sigmas) < 0:
            raise ValueError("a standard deviation must not be negative")

    @property
    def angles(self):
        """Nominal beam angles (beams,) from the heading, increasing counter-clockwise [rad]."""
        half = self.field_of_view / 2
        full_circle = self.field_of_view == 2 * np.pi  # the last beam must not repeat the first
        return np.linspace(-half, half, self.beams, endpoint=not full_circle)

    @property
    def model(self):
        return SensorModel(
            range_min=self.range_min,
            range_max=self.range_max,
            field_of_view=self.field_of_view,
            range_error=self.range_error,
            range_sigma=self.range_sigma,
            # uniform distribution in the cone
            bearing_sigma=float(np.hypot(self.bearing_sigma, self.cone / np.sqrt(12))),
            range_curvature=self.range_curvature,
            half_cone=self.cone / 2,
        )

    def scan(self, world, pose, rng):
        """Scan a World from a pose (3,), with a constant number of random draws."""
        angles = self.angles
        directions = pose[2] + angles + self.bearing_sigma * rng.standard_normal(self.beams)
        noise = rng.standard_normal(self.beams)
        dropped = rng.random(self.beams) < self.dropouts

        ranges = self._nearest(world, pose[:2], directions)
        ranges[np.isinf(ranges)] = np.nan
        ranges += self.model.sigma(ranges) * noise
        with np.errstate(invalid="ignore"):
            outside = (ranges < self.range_min) | (ranges > self.range_max)
        ranges[outside | dropped] = np.nan
        return Scan(angles, ranges, range_max=self.range_max, range_min=self.range_min)

    def _nearest(self, world, position, directions):
        if self.cone == 0:
            return world.cast(position, directions)
        rays = int(np.ceil(self.cone / RAY_STEP)) + 1
        across = np.linspace(-self.cone / 2, self.cone / 2, rays)
        fan = (directions[:, None] + across).ravel()
        echoes = world.cast(position, fan).reshape(-1, rays)
        if self.max_incidence < np.pi / 2:
            echoes[_incidence(echoes, across[1] - across[0]) > self.max_incidence] = np.inf
        return echoes.min(axis=1)


def _incidence(ranges, step):
    """Compute the angle of incidence ι [rad] of each ray of a fan: tan ι = |∂r/∂β| / r."""
    with np.errstate(invalid="ignore"):  # between two beams without a return
        derivatives = np.abs(np.diff(ranges, axis=1)) / step
        # the smaller derivative of both sides: the larger one may be an edge
        smaller = np.fmin(
            np.pad(derivatives, ((0, 0), (1, 0)), constant_values=np.inf),
            np.pad(derivatives, ((0, 0), (0, 1)), constant_values=np.inf),
        )
        return np.arctan(smaller / ranges)


# An A2 with 400 beams per revolution. Noise and dropouts are fitted to three recordings at rest (49
# revolutions, 2 to 13 m, angles of incidence up to 50°): σ² = (0.11 % r)² + (0.54 mm/m² r²)² +
# (r tan ι 0.11°)². Smolec's thesis states 0.75 % and simulates 1 %. 0.2 to 1 % of the beams on a
# surface are dropouts. Gross errors at edges and repeated (systematic) errors are not modelled.
RPLIDAR_A2 = Scanner(
    range_error=0.001, range_curvature=0.00054, bearing_sigma=np.radians(0.1), dropouts=0.005
)
# An A1M8 by its data sheet: 8000 samples/s, 5.5 revolutions/s, 0.15 to 12 m, 1 % of the range.
RPLIDAR_A1 = Scanner(
    beams=1455, range_min=0.15, bearing_sigma=np.radians(0.1), dropouts=0.01, rate=5.5
)
# A C1 (time of flight) by its data sheet: 5000 samples/s, 10 revolutions/s, 0.05 to 12 m,
# ±30 mm = 2 σ.
RPLIDAR_C1 = Scanner(
    beams=500,
    range_min=0.05,
    range_error=0.0,
    range_sigma=0.015,
    bearing_sigma=np.radians(0.1),
    dropouts=0.005,
)
# with all samples of a revolution: an A2 measures 8000 per second in its boost mode
RPLIDARS = {"A1": RPLIDAR_A1, "A2": replace(RPLIDAR_A2, beams=800), "C1": RPLIDAR_C1}
# The MAK thesis' infrared sensor on a servo, beams 2° apart; ranges over 0.28 m are invalid.
# Its voltage is about 0.12 V·m / r: a noise of 15 mV is 1 mm at 0.1 m, and 11 mm at 0.3 m.
GP2D120 = Scanner(
    beams=90,
    range_min=0.04,
    range_max=0.28,
    field_of_view=np.radians(178),
    range_error=0.0,
    range_curvature=0.125,
)
# The EKF note's sensor on a servo, beams 5° apart; parameters of a common 40 kHz sensor.
ULTRASONIC = Scanner(
    beams=37,
    range_min=0.02,
    range_max=4.0,
    field_of_view=np.pi,
    range_error=0.01,
    range_sigma=0.003,
    cone=np.radians(25),
)
