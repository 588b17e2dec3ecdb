"""Sources of readings: simulations, logs, recordings, all opened by one function."""

import json

import numpy as np

from slamlab.sources import bagfile, breezyslam
from slamlab.sources.base import Source, SourceError
from slamlab.sources.breezyslam import BreezySlamLog
from slamlab.sources.carmen import CarmenLog
from slamlab.sources.grabber import POINT, GrabberLog
from slamlab.sources.readinglog import FORMAT, ReadingLog, write
from slamlab.sources.recordings import located, recording
from slamlab.sources.simulation import simulation
from slamlab.sources.text import read_bytes

__all__ = ["Source", "SourceError", "open", "recording", "simulation", "write"]

SIMULATED = "sim:"
DEVICES = "devices:"
TOPICS = "#"  # behind a bag's path


def open(spec, rng=None):
    """Open a source: a simulation, a log file, a recording by its name, devices.

    What a file is, its content tells, not its name.

    Parameters
    ----------
    spec : str or Path, ``sim:WORLD``, a file, a recording's name, or a ROS bag: its file or folder,
        where it has several scanners ``BAG#/scan``, where several odometries ``BAG#/scan,/odom``;
        or ``devices:LIDAR_PORT,EMIR_PORT``, live
    rng : numpy.random.Generator, for simulations; seed 0 by default

    Returns
    -------
    Source

    Raises
    ------
    SourceError : what is wrong and what there is
    """
    spec = str(spec)
    if spec.startswith(SIMULATED):
        rng = np.random.default_rng(0) if rng is None else rng
        return simulation(spec.removeprefix(SIMULATED), rng)
    if spec.startswith(DEVICES):
        from slamlab.devices.source import devices  # drivers are no use to a log

        return devices(spec.removeprefix(DEVICES))
    spec = located(spec)
    bag, _, topics = (spec, "", "") if bagfile.is_bag(spec) else spec.rpartition(TOPICS)
    if bagfile.is_bag(bag):
        from slamlab.sources.rosbag import RosBag  # its rotations bring SciPy, slow to import

        return RosBag(bag, topics.split(",") if topics else ())
    content, torn = read_bytes(spec)
    if not content.strip():
        raise SourceError(f"{spec} is empty: it holds no readings")
    if _is_reading_log(content):
        return ReadingLog(spec, (content, torn))
    if content.startswith(b"{"):
        from slamlab.devices.recording.source import RecordedDevices, is_recording

        if is_recording(content):
            return RecordedDevices(spec, (content, torn))
    if content.startswith(b"FLASER") or b"\nFLASER" in content or b"\rFLASER" in content:
        return CarmenLog(spec, (content, torn))
    if POINT.search(content):
        return GrabberLog(spec, (content, torn))
    if breezyslam.looks_like(content.lstrip().split(b"\n", 1)[0]):
        return BreezySlamLog(spec, (content, torn))
    raise SourceError(
        f"{spec} is no log that slamlab knows: neither a reading log, nor a raw recording of "
        "devices, nor a CARMEN log with FLASER lines, nor the RPLIDAR grabber's text, nor a "
        "BreezySLAM log, nor a ROS bag"
    )


def _is_reading_log(content):
    first = content.split(b"\n", 1)[0]
    try:
        return json.loads(first)["format"] == FORMAT
    except (ValueError, TypeError, KeyError, RecursionError):
        return False
