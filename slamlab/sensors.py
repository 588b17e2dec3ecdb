"""Range sensors: what a lidar reports of a world, with its noise, gaps and limits."""

from dataclasses import dataclass

import numpy as np

from slamlab.hardware import SensorModel
from slamlab.readings import Scan


@dataclass(frozen=True)
class Lidar:
    """A turning laser range finder in the robot's centre, looking along its heading.

    A beam flies at its nominal angle plus noise and is reported at the nominal angle; the range
    gets noise that grows with it. A whole turn is taken from one pose.

    Parameters
    ----------
    beams : int, beams a scan
    range_min, range_max : float [m]; a reading outside is empty
    field_of_view : float, centred on the heading [rad]
    range_error : float, standard deviation as a share of the range [1]
    range_sigma : float, standard deviation at range zero [m]
    bearing_sigma : float, standard deviation of a beam's direction [rad]
    dropouts : float, share of the beams that return nothing [1]
    """

    beams: int = 400
    range_min: float = 0.2
    range_max: float = 12.0
    field_of_view: float = 2 * np.pi
    range_error: float = 0.01
    range_sigma: float = 0.0
    bearing_sigma: float = 0.0
    dropouts: float = 0.0

    def __post_init__(self):
        if self.beams < 1:
            raise ValueError(f"a lidar needs at least one beam, not {self.beams}")
        if not 0 < self.field_of_view <= 2 * np.pi:
            raise ValueError(f"field_of_view is in radians, above 0 to 2π: {self.field_of_view}")
        if not 0 <= self.range_min < self.range_max:
            raise ValueError(f"ranges from {self.range_min} to {self.range_max} m are none")
        if not 0 <= self.dropouts <= 1:
            raise ValueError(f"dropouts is a share, 0 to 1: {self.dropouts}")
        if min(self.range_error, self.range_sigma, self.bearing_sigma) < 0:
            raise ValueError("a standard deviation is not negative")

    @property
    def angles(self):
        """(beams,) nominal directions, counter-clockwise from the heading, increasing [rad]."""
        half = self.field_of_view / 2
        whole_turn = self.field_of_view == 2 * np.pi  # its last beam would repeat its first
        return np.linspace(-half, half, self.beams, endpoint=not whole_turn)

    @property
    def model(self):
        """What an estimator is told of this sensor, a SensorModel."""
        return SensorModel(
            range_min=self.range_min,
            range_max=self.range_max,
            field_of_view=self.field_of_view,
            range_error=self.range_error,
            range_sigma=self.range_sigma,
            bearing_sigma=self.bearing_sigma,
        )

    def scan(self, world, pose, rng):
        """One turn of the lidar in a world.

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

        ranges = world.cast(pose[:2], directions)
        ranges[np.isinf(ranges)] = np.nan
        ranges += np.hypot(self.range_error * ranges, self.range_sigma) * noise
        with np.errstate(invalid="ignore"):
            outside = (ranges < self.range_min) | (ranges > self.range_max)
        ranges[outside | dropped] = np.nan
        return Scan(angles, ranges, range_max=self.range_max, range_min=self.range_min)


RPLIDAR_A2 = Lidar(range_error=0.004, bearing_sigma=np.radians(0.1), dropouts=0.03)
"""An RPLIDAR A2: 400 beams a turn (0.9° apart), 0.2 to 12 m by its data sheet.

The noise is that of real recordings of an A2 standing still: σ 0.34–0.46 % of the range, 2.4–3.9 %
empty returns. The data sheet allows 0.75 %, Smolec simulates 1 %:
``dataclasses.replace(RPLIDAR_A2, range_error=0.01)``.
"""
