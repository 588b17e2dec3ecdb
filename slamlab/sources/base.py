"""Interface (base class) of every source: readings, robot and sensor models, damage counted."""

from collections import Counter
from collections.abc import Iterator

from slamlab.files.errors import SourceError
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Reading, Trajectory


class Source:
    """Source of readings (data stream): an iterable that describes its robot and sensor.

    Subclasses set ``name`` and yield from ``__iter__``. ``damage`` counts, by kind, what could not
    be used; ``skipped`` is how many readings were lost to it. ``truth`` is for evaluation only and
    None where nobody knows it.
    """

    name: str = "source"
    robot: RobotModel = RobotModel()
    sensor: SensorModel = SensorModel()
    truth: Trajectory | None = None

    def __init__(self):
        self.damage: Counter[str] = Counter()
        self.skipped = 0

    def __iter__(self) -> Iterator[Reading]:
        raise NotImplementedError

    def __len__(self) -> int:
        """Number of readings, 0 where that is not known."""
        return 0

    @property
    def drivable(self):
        """bool, whether there is a robot that takes drive commands."""
        return type(self).drive is not Source.drive

    def drive(self, command):
        """Drive the robot by a velocity command; most sources are recordings and refuse.

        Raises
        ------
        SourceError
        """
        raise SourceError(f"{self.name} is a recording: it cannot be driven")

    def renew(self):
        """Renew the last drive command, for a robot that stops where nobody does."""

    def merge(self, turns):
        """Merge several turns of a lidar into the scan of one reading: more points, fewer readings.

        Parameters
        ----------
        turns : int, how many

        Raises
        ------
        SourceError : that is no number of turns, or there are none in this source
        """
        raise SourceError(
            f"{self.name} has no turns of a lidar to merge: devices and recordings do"
        )

    def close(self):
        """Close the source: release what it holds; may be called twice."""

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()
