"""Raw recording of devices as a source: deterministic replay of the readings."""

from collections import Counter, deque

import numpy as np

from slamlab.devices.emir import Calibration
from slamlab.devices.emir.receiver import EmirReceiver
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.recording.decoding import RecordedLidar
from slamlab.devices.recording.recording_file import RX, TX, parse
from slamlab.files import SourceError
from slamlab.sources.lidar_on_robot import LidarOnRobot


class RecordedDevices(LidarOnRobot):
    """Readings of a recorded RPLIDAR, with or without an eMIR robot, up to the first damage.

    Raises SourceError for a file without a complete revolution.
    """

    def __init__(self, path, content):
        super().__init__(str(path))
        content, truncated = content
        compression = "its compression is damaged or truncated" if truncated else ""
        self._recording = parse(content, self.name, salvage=True, truncated=compression)
        self.has_odometry = any(self._recording.of("emir", RX))
        lidar = RecordedLidar(self._recording.baud("lidar"))
        if not any(lidar.feed(record) for record in self._recording.of("lidar")):
            advice = "'slamlab replay --info' shows its contents"
            raise SourceError(f"{path} contains no complete revolution of a lidar; {advice}")
        if lidar.info is not None:
            self.sensor = lidar.mode.sensor(lidar.info)

    def __iter__(self):
        self._odometry = Odometry(Calibration())
        self.damage = Counter({"file truncated": 1} if self._recording.truncated else {})
        return super().__iter__()

    def _revolutions(self):
        baud, queue = self._recording.baud, deque()
        lidar, emir = RecordedLidar(baud("lidar")), EmirReceiver(self._odometry, baud("emir"))
        for record in self._recording.records:
            if record.channel == "lidar":
                queue.extend(lidar.feed(record))
            elif record.kind == TX:
                emir.sent(record.data)
            elif record.kind == RX:
                emir.received(record.data, record.time)
            known = self._odometry.last_time if self.has_odometry else np.inf
            while queue and queue[0].times[-1] <= known:
                yield queue.popleft()
        yield from queue

    def _pose_at(self, time):
        return self._odometry.pose_at(time)
