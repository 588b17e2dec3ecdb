"""A raw recording as a source of readings: as its devices would give them, and again the same."""

from collections import Counter, deque

from slamlab.devices.emir import Calibration
from slamlab.devices.emir.listener import EmirListener
from slamlab.devices.emir.odometry import Odometry
from slamlab.devices.readings import Carried
from slamlab.devices.recording.decoded import LidarListener, turns
from slamlab.devices.recording.records import RX, TX, is_recording, parse
from slamlab.sources.base import SourceError

__all__ = ["RecordedDevices", "is_recording"]


class RecordedDevices(Carried):
    """Readings of an RPLIDAR, and an eMIR where there was one, of which every byte was recorded.

    Of a file that is torn or damaged what comes before that is read, and ``damage`` tells it.

    Parameters
    ----------
    path : str
    content : (bytes, bool) what ``read_bytes`` gave for it
    calibration : Calibration of the robot
    saturates : bool, whether its counters stop at ±128, see :class:`Emir`
    front : float, where the robot's front lies for the lidar, clockwise [degree]

    Raises
    ------
    SourceError : it cannot be read, or holds no whole turn of a lidar
    """

    def __init__(self, path, content, calibration=None, saturates=False, front=0.0):
        super().__init__(str(path), front)
        content, torn = content
        packing = "its packing is damaged or cut off" if torn else ""
        self._recording = parse(content, self.name, salvage=True, torn=packing)
        self._moves = any(self._recording.of("emir", RX))
        self._begin = lambda: Odometry(calibration or Calibration(), saturates)
        if next(turns(self._recording), None) is None:
            raise SourceError(
                f"{path} holds no whole turn of a lidar: what does 'slamlab replay --info' say?"
            )

    def __iter__(self):
        self._odometry = self._begin()
        self.damage = Counter({"file torn": 1} if self._recording.torn else {})
        return super().__iter__()

    def _turns(self):
        baud, waiting = self._recording.baud, deque()
        lidar, emir = LidarListener(baud("lidar")), EmirListener(self._odometry, baud("emir"))
        for record in self._recording.records:
            if record.channel == "lidar":
                waiting.extend(lidar.take(record))
            elif record.kind == TX:
                emir.told(record.data)
            elif record.kind == RX:
                emir.hear(record.data, record.time)
            while waiting and (not self._moves or waiting[0].times[-1] <= self._odometry.until):
                yield waiting.popleft()
        yield from waiting

    def _pose_at(self, time):
        return self._odometry.pose_at(time)
