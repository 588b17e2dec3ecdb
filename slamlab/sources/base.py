"""What every source offers: readings, a description of its robot and sensor, damage counted."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from slamlab.readings import Reading, Trajectory


class SourceError(ValueError):
    """A source cannot be opened or holds nothing usable; the text says what to do."""


@dataclass(frozen=True)
class RobotModel:
    """A robot's odometry: how wrong it is.

    Parameters
    ----------
    distance_error : float, standard deviation as a share of the distance [1]
    turn_error : float, standard deviation as a share of the turn [1]
    turn_per_metre : float, standard deviation of the turn picked up per metre [rad/m]
    radius : float, for drawing [m]
    """

    distance_error: float = 0.05
    turn_error: float = 0.05
    turn_per_metre: float = 0.05
    radius: float = 0.15


@dataclass(frozen=True)
class SensorModel:
    """A range sensor: what it can see and how well.

    Parameters
    ----------
    range_min, range_max : float [m]
    field_of_view : float [rad]
    range_error : float, standard deviation as a share of the range [1]
    range_sigma : float, standard deviation at range zero [m]
    bearing_sigma : float [rad]
    """

    range_min: float = 0.0
    range_max: float = np.inf
    field_of_view: float = 2 * np.pi
    range_error: float = 0.01
    range_sigma: float = 0.0
    bearing_sigma: float = 0.005


class Source:
    """Yields readings; describes its robot and sensor; closes.

    Subclasses set ``name`` and yield from ``__iter__``. ``damage`` counts, by kind, what could not
    be used. ``truth`` is for evaluation only and None where nobody knows it.
    """

    name: str = "source"
    robot: RobotModel = RobotModel()
    sensor: SensorModel = SensorModel()
    truth: Trajectory | None = None

    def __init__(self):
        self.damage: Counter[str] = Counter()

    def __iter__(self) -> Iterator[Reading]:
        raise NotImplementedError

    def __len__(self) -> int:
        """How many readings will come, 0 where that is not known."""
        return 0

    def drive(self, command):
        """Command the robot; most sources are recordings and refuse.

        Raises
        ------
        SourceError
        """
        raise SourceError(f"{self.name} is a recording: it cannot be driven")

    def close(self):
        """Release what the source holds; may be called twice."""

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()
