"""Simulated range scanners: lidar (laser scanner), infrared, ultrasonic; noise and dropouts."""

from dataclasses import dataclass

import numpy as np

from slamlab.models.parameters import SensorModel
from slamlab.readings import Scan

RAY_STEP = np.radians(0.5)  # between rays of a wide beam [rad]: off by 1e-5 of the range at most


@dataclass(frozen=True)
class Scanner:
    """A rotating range sensor in the robot's centre, looking along its heading; noise parameters.

    A beam flies at its nominal angle plus noise and is reported at the nominal angle; the range
    gets noise that grows with it. A wide beam returns the nearest surface in its cone. A whole
    turn is taken from one pose.

    Parameters
    ----------
    beams : int, beams a scan
    range_min, range_max : float [m]; a reading outside is empty
    field_of_view : float, field of view, centred on the heading [rad]
    range_error : float, standard deviation as a share of the range [1]
    range_sigma : float, standard deviation at range zero [m]
    range_curvature : float, standard deviation per range squared, of sensors whose signal falls off
        as 1/r [1/m]
    bearing_sigma : float, standard deviation of a beam's direction [rad]
    cone : float, full opening angle of a beam [rad]
    dropouts : float, share of the beams that return nothing [1]
    max_incidence : float, off square on, up to which a surface echoes in a wide beam; smooth ones
        mirror sound away beyond some 30°, so that the echo is lost [rad]
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

    def __post_init__(self):
        if self.beams < 1:
            raise ValueError(f"a scanner needs at least one beam, not {self.beams}")
        if not 0 < self.field_of_view <= 2 * np.pi:
            raise ValueError(f"field_of_view is in radians, above 0 to 2π: {self.field_of_view}")
        if not 0 <= self.range_min < self.range_max:
            raise ValueError(
                f"range_min < range_max, not from {self.range_min} to {self.range_max} m"
            )
        if not 0 <= self.dropouts <= 1:
            raise ValueError(f"dropouts is a share, 0 to 1: {self.dropouts}")
        if not 0 <= self.cone < np.pi:
            raise ValueError(f"cone is an angle in radians, 0 to below π: {self.cone}")
        if not 0 < self.max_incidence <= np.pi / 2:
            raise ValueError(f"max_incidence is in radians, above 0 to π/2: {self.max_incidence}")
        sigmas = self.range_error, self.range_sigma, self.range_curvature, self.bearing_sigma
        if min(sigmas) < 0:
            raise ValueError("a standard deviation is not negative")

    @property
    def angles(self):
        """(beams,) nominal beam angles, counter-clockwise from the heading, increasing [rad]."""
        half = self.field_of_view / 2
        whole_turn = self.field_of_view == 2 * np.pi  # its last beam would repeat its first
        return np.linspace(-half, half, self.beams, endpoint=not whole_turn)

    @property
    def model(self):
        """Range sensor parameters for an estimator, a SensorModel."""
        return SensorModel(
            range_min=self.range_min,
            range_max=self.range_max,
            field_of_view=self.field_of_view,
            range_error=self.range_error,
            range_sigma=self.range_sigma,
            # anywhere in the cone, all places alike
            bearing_sigma=float(np.hypot(self.bearing_sigma, self.cone / np.sqrt(12))),
            range_curvature=self.range_curvature,
            half_cone=self.cone / 2,
        )

    def scan(self, world, pose, rng):
        """Simulate a scan: one revolution of the scanner in a world, with noise and dropouts.

        Parameters
        ----------
        world : World
        pose : (3,) [m, m, rad]
        rng : numpy.random.Generator; the same number of draws whatever is seen

        Returns
        -------
        Scan, in the robot's frame; NaN where nothing came back
        """
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
        """The nearest surface in each beam's cone."""
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
    """How far off square on each ray of a fan meets a surface: tan ι = |∂r/∂β| / r [rad]."""
    with np.errstate(invalid="ignore"):  # from nothing to nothing
        slopes = np.abs(np.diff(ranges, axis=1)) / step
        # the flatter side counts: an edge is no slope
        flatter = np.fmin(
            np.pad(slopes, ((0, 0), (1, 0)), constant_values=np.inf),
            np.pad(slopes, ((0, 0), (0, 1)), constant_values=np.inf),
        )
        return np.arctan(flatter / ranges)


RPLIDAR_A2 = Scanner(
    range_error=0.001,
    range_curvature=0.00054,
    bearing_sigma=np.radians(0.1),
    dropouts=0.005,
)
"""An RPLIDAR A2: 400 beams a turn (0.9° apart), 0.2 to 12 m by its data sheet.

Noise and dropouts are fitted to three recordings of an A2 standing still, 49 turns (lesson 02):

- Noise: what a reading differs by from the line between its neighbours in the turn before, at 2 to
  13 m, up to 50° off square on. Told by the median in bins of range and of incidence ι, it is
  σ² = (0.11 % r)² + (0.54 mm/m² r²)² + (r tan ι 0.11°)², the 95 % intervals being 0.09 to 0.13 %,
  0.50 to 0.58 mm/m², 0.09 to 0.12°. That is 0.16 % of a range of 2.4 m and 0.63 % of 11.5 m: an A2
  triangulates. Its data sheet allows 0.75 % throughout, Smolec simulates 1 %.
- Dropouts: 2.8 % of all readings are empty, most of them at edges and into the open, turn after
  turn. Lost are 0.99 % where the turn before saw a surface (people are in it), 0.23 % where the
  turn after saw it, too.

Not in it: gross errors at edges, errors that repeat from turn to turn, more dropouts far off. Nor
is the number of beams as steady: it fell from 539 to 356 (0.7° to 1.0°) as the motor spun up.
"""

GP2D120 = Scanner(
    beams=90,
    range_min=0.04,
    range_max=0.28,
    field_of_view=np.radians(178),
    range_error=0.0,
    range_curvature=0.125,
)
"""The MAK thesis' Sharp GP2D120 on a servo: 90 infrared readings, 2° apart, 0.04 to 0.30 m.

Its voltage falls as 1/r, about 0.12 V·m, so 15 mV of noise are 1 mm at 0.1 m and 11 mm at 0.3 m.
As in the thesis a reading over 0.28 m is none (chapter 8).
"""

ULTRASONIC = Scanner(
    beams=37,
    range_min=0.02,
    range_max=4.0,
    field_of_view=np.pi,
    range_error=0.01,
    range_sigma=0.003,
    cone=np.radians(25),
)
"""The EKF note's ultrasonic scanner on a servo: 37 readings 5° apart, each from a cone of 25°.

The note gives no figures; these are those of a common 40 kHz ranger.
"""
