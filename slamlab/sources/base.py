"""What every source offers: readings, a description of its robot and sensor, damage counted."""

from collections import Counter
from collections.abc import Iterator

from slamlab.hardware import RobotModel, SensorModel
from slamlab.readings import Reading, Trajectory


class SourceError(ValueError):
    """A source cannot be opened or holds nothing usable; the text says what to do."""


class Source:
    """Yields readings; describes its robot and sensor; closes.

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
        """How many readings will come, 0 where that is not known."""
        return 0

    @property
    def drivable(self):
        """bool, whether there is a robot to command."""
        return type(self).drive is not Source.drive

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
