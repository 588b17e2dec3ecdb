"""Families of worlds: what their floors, wheels and sensors have in common. A new one is a line.

The numbers are such that odometry alone is lost after some ten metres, a careful SLAM is not.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from slamlab.simulation.range_scanners import Scanner

LIDAR = Scanner(
    beams=180,
    range_min=0.1,
    range_max=8.0,
    range_error=0.008,
    range_sigma=0.005,
    bearing_sigma=np.radians(0.3),
    dropouts=0.01,
)
"""A cheap lidar: a beam every 2°, up to 8 m, about as noisy as the A2's data sheet allows."""


@dataclass(frozen=True)
class Family:
    """A family of worlds.

    Parameters
    ----------
    name : str
    plans : tuple of (columns, rows), see :func:`slamlab.project.floors.draw_floor`
    metres : (2,) shortest and longest tour, roughly [m]
    alike : bool, whether rooms are alike to the last chair
    closed : float, chance of a room to be closed [1]
    bare : bool, whether corridors stay empty
    slip : float, of each wheel after a metre, standard deviation [m/√m]
    wheels : float, standard deviation of each wheel's scale [1]
    lidar : Scanner
    range_bias : float, by which share ranges are off, too long or too short by chance [1]
    lost_scans : float, share of the readings whose scan is empty, some in a row [1]
    people : int, how many walk about
    kidnapped : bool, whether the robot is carried to another place on the way
    landmarks : int, point landmarks with ids in each cell, seen instead of a scan; 0 for a lidar

    Raises
    ------
    ValueError : tours too short or too long
    """

    name: str
    plans: tuple = (("rcrcr", "rcrcr"), ("rcrrcr", "rcrcr"), ("rcrrcr", "crrc"))
    metres: tuple = (25.0, 60.0)
    alike: bool = False
    closed: float = 0.0
    bare: bool = False
    slip: float = 0.012
    wheels: float = 0.006
    lidar: Scanner = field(default=LIDAR)
    range_bias: float = 0.0
    lost_scans: float = 0.0
    people: int = 0
    kidnapped: bool = False
    landmarks: int = 0

    def __post_init__(self):
        if not 20 <= self.metres[0] <= self.metres[1] <= 70:
            raise ValueError(f"tours are from 20 to 70 m, so that drives stay under 100: {self}")


FAMILIES = {
    family.name: family
    for family in (
        Family("plain"),
        Family("symmetric", plans=(("rcrcr", "rcrcr"),), alike=True, bare=True),
        Family("corridor", plans=(("rrrrrr", "rcr"), ("rrrrr", "rcr")), closed=0.75, bare=True),
        Family("kidnapped", kidnapped=True),
        Family("range-bias", range_bias=0.01),
        Family("people", people=6),
        Family("dropouts", lidar=replace(LIDAR, dropouts=0.3), lost_scans=0.1),
    )
}
"""The families that a contest draws from, by name."""

LANDMARKS = Family("landmarks", landmarks=2)
"""Point landmarks with ids instead of a lidar: for practice with a filter."""


def strata(family, count):
    """Lengths of tours spread over the family's range, so that every set has short and long ones.

    Parameters
    ----------
    family : Family
    count : int, worlds

    Returns
    -------
    (count,) [m]
    """
    low, high = family.metres
    return low + (np.arange(count) + 0.5) / count * (high - low)
