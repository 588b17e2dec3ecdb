"""Open a source of readings from one string (factory); the file format is detected."""

import numpy as np

from slamlab.devices import LIDARS
from slamlab.files import InputFile, SourceError
from slamlab.simulation import worlds
from slamlab.sources import ros_bag_files
from slamlab.sources.breezyslam import BreezySlamLog
from slamlab.sources.carmen import CarmenLog
from slamlab.sources.public_datasets import resolve
from slamlab.sources.reading_log import ReadingLog
from slamlab.sources.rplidar_text import RplidarText
from slamlab.sources.simulated_robot import simulation
from slamlab.sources.unsupported_formats import describe, is_binary

SIMULATION_PREFIX = "sim:"  # of a simulated world's name
EMULATED_PREFIX = "emulated:"  # of a world's name
TOPIC_SEPARATOR = "#"  # between the path of a ROS bag and its topics
LOGS = ReadingLog, CarmenLog, BreezySlamLog, RplidarText  # tried in this order


def open(spec, rng=None, carried=False):
    """Open a source of readings; the format of a file is detected from its content. Returns a
    Source. Raises SourceError, or ExtraMissing without ``rosbags``.

    Parameters
    ----------
    spec : str or Path: ``sim:WORLD``, a log, a raw recording, the name of a public data set; a ROS
        bag, with ``#/scan`` or ``#/scan,/odom`` to choose among several topics;
        ``devices:LIDAR_PORT,EMIR_PORT``, or another prefix of LIDARS; ``emulated:WORLD``
    rng : numpy.random.Generator for simulations; seed 0 by default
    carried : bool, whether the emulated lidar is hand-held in a flat, without a robot
    """
    spec, rng = str(spec), np.random.default_rng(0) if rng is None else rng
    if carried and not spec.startswith(EMULATED_PREFIX):
        raise SourceError(f"only an emulated lidar can be hand-held (emulated:flat), not {spec}")
    if spec.startswith(SIMULATION_PREFIX):
        return simulation(spec.removeprefix(SIMULATION_PREFIX), rng)
    if spec.startswith(tuple(LIDARS)):
        from slamlab.sources.live_devices import devices  # a log does not need the drivers

        at = spec.index(":") + 1
        return devices(spec[at:], prefix=spec[:at])
    if spec.startswith(EMULATED_PREFIX):
        from slamlab.sources.emulated_devices import EmulatedDevices

        try:
            world = worlds.by_name(spec.removeprefix(EMULATED_PREFIX))
        except ValueError as error:
            raise SourceError(str(error)) from None
        return EmulatedDevices(world, rng, carried=carried)
    spec = resolve(spec)
    bag, _, topics = spec.rpartition(TOPIC_SEPARATOR)
    if ros_bag_files.is_bag(spec):
        bag, topics = spec, ""
    if ros_bag_files.is_bag(bag):
        from slamlab.sources.ros_bag import RosBag  # imports SciPy, which is slow

        return RosBag(bag, topics.split(",") if topics else ())
    file = InputFile(spec)
    head = file.head()
    if not head.strip():
        raise SourceError(f"{spec} is empty and contains no readings")
    if head.startswith(b"{"):
        from slamlab.devices.recording.recording_file import is_recording

        if is_recording(head):
            from slamlab.sources.raw_recordings import RecordedDevices

            content = b"".join(file)
            return RecordedDevices(spec, (content, file.truncated))
    for log in LOGS:
        if log.recognises(head) and not is_binary(head):
            return log(spec, file)
    known = ", ".join(log.kind for log in LOGS)
    raise SourceError(
        f"{spec} has no format that slamlab can read: it {describe(head)}. Supported formats are "
        f"{known}, raw recordings of devices, and ROS bags"
    )
