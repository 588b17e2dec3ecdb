"""Raw recording of devices (every byte) as a source: deterministic replay of the readings."""

from collections import Counter, deque

from slamlab.devices.emir import Calibration
from slamlab.devices.emir.receiver import EmirReceiver
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.recording.decoding import RecordedLidar, turns
from slamlab.devices.recording.recording_file import RX, TX, is_recording, parse
from slamlab.files.errors import SourceError
from slamlab.sources.lidar_on_robot import LidarOnRobot

__all__ = ["RecordedDevices", "is_recording"]


class RecordedDevices(LidarOnRobot):
    """Replay of a raw recording: readings of an RPLIDAR, and an eMIR robot where there was one.

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
        compression = "its compression is damaged or cut off" if torn else ""
        self._recording = parse(content, self.name, salvage=True, truncated=compression)
        self._has_robot = any(self._recording.of("emir", RX))
        self._make_odometry = lambda: Odometry(calibration or Calibration(), saturates)
        if next(turns(self._recording), None) is None:
            raise SourceError(
                f"{path} holds no whole turn of a lidar: what does 'slamlab replay --info' say?"
            )

    def __iter__(self):
        self._odometry = self._make_odometry()
        self.damage = Counter({"file torn": 1} if self._recording.truncated else {})
        return super().__iter__()

    def _turns(self):
        baud, queue = self._recording.baud, deque()
        lidar, emir = RecordedLidar(baud("lidar")), EmirReceiver(self._odometry, baud("emir"))
        for record in self._recording.records:
            if record.channel == "lidar":
                queue.extend(lidar.feed(record))
            elif record.kind == TX:
                emir.sent(record.data)
            elif record.kind == RX:
                emir.received(record.data, record.time)
            while queue and (not self._has_robot or queue[0].times[-1] <= self._odometry.last_time):
                yield queue.popleft()
        yield from queue

    def _pose_at(self, time):
        return self._odometry.pose_at(time)
