"""Open any source of readings by one string (factory): simulation, log file, ROS bag, devices."""

import json

import numpy as np

from slamlab import worlds
from slamlab.files.errors import SourceError
from slamlab.files.published_recordings import resolve
from slamlab.files.text_files import read_bytes
from slamlab.sources import breezyslam, ros_messages
from slamlab.sources.breezyslam import BreezySlamLog
from slamlab.sources.carmen import CarmenLog
from slamlab.sources.reading_log import FORMAT, ReadingLog
from slamlab.sources.rplidar_grabber import POINT_PATTERN, GrabberLog
from slamlab.sources.simulated_robot import simulation

SIMULATION_PREFIX = "sim:"  # of a simulated world's name
DEVICES_PREFIX = "devices:"  # of two serial ports
EMULATED_PREFIX = "emulated:"  # of a world's name
TOPIC_SEPARATOR = "#"  # between a ROS bag's path and its topics


def open(spec, rng=None):
    """Open a source: a simulation, a log file, a recording by its name, a ROS bag, devices.

    The file format is recognised by the content, not by the name.

    Parameters
    ----------
    spec : str or Path, ``sim:WORLD``, a file, a recording's name, or a ROS bag: its file or folder,
        where it has several scanners ``BAG#/scan``, where several odometries ``BAG#/scan,/odom``;
        or ``devices:LIDAR_PORT,EMIR_PORT``, live, or ``emulated:WORLD``, both devices emulated
    rng : numpy.random.Generator, for simulations; seed 0 by default

    Returns
    -------
    Source

    Raises
    ------
    SourceError : what is wrong and what there is
    """
    spec, rng = str(spec), np.random.default_rng(0) if rng is None else rng
    if spec.startswith(SIMULATION_PREFIX):
        return simulation(spec.removeprefix(SIMULATION_PREFIX), rng)
    if spec.startswith(DEVICES_PREFIX):
        from slamlab.sources.live_devices import devices  # drivers are no use to a log

        return devices(spec.removeprefix(DEVICES_PREFIX))
    if spec.startswith(EMULATED_PREFIX):
        from slamlab.sources.emulated_devices import EmulatedDevices

        return EmulatedDevices(_world(spec.removeprefix(EMULATED_PREFIX)), rng)
    spec = resolve(spec)
    bag, _, topics = (
        (spec, "", "") if ros_messages.is_bag(spec) else spec.rpartition(TOPIC_SEPARATOR)
    )
    if ros_messages.is_bag(bag):
        from slamlab.sources.ros_bag import RosBag  # its rotations bring SciPy, slow to import

        return RosBag(bag, topics.split(",") if topics else ())
    content, torn = read_bytes(spec)
    if not content.strip():
        raise SourceError(f"{spec} is empty: it holds no readings")
    if _is_reading_log(content):
        return ReadingLog(spec, (content, torn))
    if content.startswith(b"{"):
        from slamlab.sources.raw_recordings import RecordedDevices, is_recording

        if is_recording(content):
            return RecordedDevices(spec, (content, torn))
    if content.startswith(b"FLASER") or b"\nFLASER" in content or b"\rFLASER" in content:
        return CarmenLog(spec, (content, torn))
    if POINT_PATTERN.search(content):
        return GrabberLog(spec, (content, torn))
    if breezyslam.is_breezyslam_line(content.lstrip().split(b"\n", 1)[0]):
        return BreezySlamLog(spec, (content, torn))
    raise SourceError(
        f"{spec} is no log that slamlab knows: neither a reading log, nor a raw recording of "
        "devices, nor a CARMEN log with FLASER lines, nor the RPLIDAR grabber's text, nor a "
        "BreezySLAM log, nor a ROS bag"
    )


def _world(name):
    try:
        return worlds.by_name(name)
    except ValueError as error:
        raise SourceError(str(error)) from None


def _is_reading_log(content):
    first = content.split(b"\n", 1)[0]
    try:
        return json.loads(first)["format"] == FORMAT
    except (ValueError, TypeError, KeyError, RecursionError):
        return False
