"""Families of simulated worlds (test scenarios): parameters of floors, odometry and sensors.

After about ten metres, odometry alone is useless, but careful SLAM is not."""

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
"""A cheap lidar: a beam every 2°, up to 8 m, about as noisy as the data sheet of the A2 allows."""


@dataclass(frozen=True)
class WorldFamily:
    """A family of worlds. plans : see ``draw_floor_plan``. Raises ValueError."""

    name: str
    plans: tuple = (
        ("rcrcr", "rcrcr"),
        ("rcrrcr", "rcrcr"),
        ("rcrrcr", "crrc"),
    )  # (columns, rows) of floors.draw_floor_plan
    metres: tuple = (25.0, 60.0)  # shortest and longest route, roughly [m]
    identical_rooms: bool = False  # whether all rooms are identical, with the same furniture
    closed: float = 0.0  # probability of a room without a door [1]
    bare: bool = False  # whether corridors have no furniture
    slip: float = 0.012  # of each wheel after a metre, standard deviation [m/√m]
    wheels: float = 0.006  # standard deviation of the scale of each wheel [1]
    lidar: Scanner = field(default=LIDAR)
    range_bias: float = 0.0  # relative error of all ranges, of random sign [1]
    lost_scans: float = 0.0  # share of the readings with an empty scan, some consecutive [1]
    people: int = 0  # number of people who walk around
    kidnapped: bool = False  # whether the robot is carried to another position
    landmarks: int = 0  # point landmarks in each cell, observed instead of a scan; 0: lidar

    def __post_init__(self):
        if not 20 <= self.metres[0] <= self.metres[1] <= 70:
            raise ValueError(f"routes must be 20 to 70 m, so that paths stay below 100 m: {self}")


WORLD_FAMILIES = {
    family.name: family
    for family in (
        WorldFamily("plain"),
        WorldFamily("symmetric", plans=(("rcrcr", "rcrcr"),), identical_rooms=True, bare=True),
        WorldFamily(
            "corridor", plans=(("rrrrrr", "rcr"), ("rrrrr", "rcr")), closed=0.75, bare=True
        ),
        WorldFamily("kidnapped", kidnapped=True),
        WorldFamily("range-bias", range_bias=0.01),
        WorldFamily("people", people=6),
        WorldFamily("dropouts", lidar=replace(LIDAR, dropouts=0.3), lost_scans=0.1),
    )
}
"""The families of worlds in a contest, by name."""

LANDMARKS = WorldFamily("landmarks", landmarks=2)
"""Point landmarks with ids instead of a lidar, for practice with a filter."""


def strata(family, count):
    """Return lengths of routes (count,) [m], evenly distributed over the range of the family."""
    low, high = family.metres
    return low + (np.arange(count) + 0.5) / count * (high - low)
