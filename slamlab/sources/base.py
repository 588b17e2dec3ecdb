"""Base classes of sources: Source, and those for simulated runs and log files."""

from collections import Counter
from collections.abc import Iterator

import numpy as np

from slamlab.files import InputFile, SourceError
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Reading, Trajectory
from slamlab.sources.disk_buffer import DiskBuffer


class Source:
    """Source of readings (data stream): an iterable with models of its robot and sensor.

    Attributes
    ----------
    name : str
    robot, sensor : RobotModel, SensorModel
    has_odometry : bool, whether its readings have odometry
    notes : list of sentences about assumptions of the reader
    truth : ground-truth Trajectory, for evaluation only, or None
    damage : Counter of unusable data, by kind
    skipped : int, number of lost readings
    """

    name: str = "source"
    robot: RobotModel = RobotModel()
    sensor: SensorModel = SensorModel()
    has_odometry: bool = True
    truth: Trajectory | None = None

    def __init__(self):
        self.damage: Counter[str] = Counter()
        self.notes: list[str] = []
        self.skipped = 0

    def __iter__(self) -> Iterator[Reading]:
        raise NotImplementedError

    def __len__(self) -> int:
        """Return the number of readings, or 0 if it is unknown."""
        return 0

    @property
    def drivable(self):
        """Whether the source has a robot that accepts drive commands."""
        return type(self).drive is not Source.drive

    def drive(self, command):
        """Send a drive command (2,): speed, turn rate [m/s, rad/s]. Raises SourceError."""
        raise SourceError(f"{self.name} is a recording and cannot be driven")

    def renew(self):
        """Renew the last drive command of a robot with a command watchdog."""

    def merge(self, revolutions):
        """Merge a given number of revolutions of a lidar into one scan. Raises SourceError."""
        only = "only scans of devices and of raw recordings can be merged"
        raise SourceError(f"the scans of {self.name} cannot be merged: {only}")

    def close(self):
        """Release the resources of the source. A second call is allowed."""

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()


class SimulatedRun(Source):
    """Simulated source: the noise of reading i always comes from ``_rng(i)``."""

    def __init__(self, rng):
        super().__init__()
        self._seed = int(rng.integers(2**63))

    def __len__(self):
        return len(self.truth)

    def __iter__(self):
        for i in range(len(self)):
            yield self._reading(i)

    def _rng(self, i):
        return np.random.default_rng([self._seed, i])

    def _reading(self, i):
        raise NotImplementedError


class LogFile(Source):
    """Log file as a source; ``file`` is the InputFile, if it is already open."""

    kind = "a log"  # name of the format

    @staticmethod
    def recognises(head):
        """Return whether a file that begins with these bytes has this format (format detection)."""
        raise NotImplementedError

    def __init__(self, path, file=None):
        super().__init__()
        self.name = str(path)
        self._rows, self._first_lost = DiskBuffer(), ""
        file = InputFile(path) if file is None else file
        self._parse(file)
        if file.truncated:
            self.damage["file truncated"] += 1

    def __len__(self):
        return len(self._rows)

    def _parse(self, file):
        """Parse an InputFile."""
        raise NotImplementedError

    def _count_lost(self, kind, number):
        """Count a reading as lost because its line is damaged."""
        self.damage[kind] += 1
        self.skipped += 1
        self._first_lost = self._first_lost or f"line {number} ({kind})"

    def _nothing_usable(self, what):
        """Return the SourceError for a file without usable data."""
        lost = f"; the first of {self.skipped} lost readings is in {self._first_lost}"
        return SourceError(f"{self.name} contains no {what}{lost if self._first_lost else ''}")


def checked_command(command):
    """Return speed and turn rate of a drive command. Raises SourceError for an invalid command."""
    try:
        v, omega = (float(number) for number in command)
    except (TypeError, ValueError):
        expected = "a command must consist of speed and turn rate [m/s, rad/s]"
        raise SourceError(f"{expected}, not {command!r}") from None
    if not np.isfinite([v, omega]).all():
        raise SourceError(f"a command must consist of two finite numbers, not {command!r}")
    return v, omega
