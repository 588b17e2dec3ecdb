"""Parser of CARMEN messages: scans (ranges, field of view, poses), odometry, true poses.

Every message ends with a timestamp, the host name, and the time of logging.
"""

from math import isfinite
from typing import NamedTuple

import numpy as np

from slamlab.sources.carmen_geometry import angles_by_settings

MAX_ODOMETRY = 1e7  # odometry beyond this is invalid [m]
MAX_DIGITS = 6  # of a count of ranges or remissions
UNKNOWN_POSE = np.full(3, np.nan)


class Layout(NamedTuple):
    """Layout of a scan message: its laser and the fields besides the ranges."""

    laser: int  # 1 front, 2 rear
    settings: bool  # type, start angle, field of view, resolution, maximum range, accuracy, mode
    poses: int  # numbers of poses: 6 of laser and robot, 3 of the robot
    rest: int = 0  # numbers between poses and timestamp


LASERS = {
    b"FLASER": Layout(1, False, 6),
    b"RLASER": Layout(2, False, 6),
    **{b"LASER%d" % n: Layout(n, False, 0) for n in (3, 4, 5)},
    **{b"ROBOTLASER%d" % n: Layout(n, True, 6, 5) for n in (1, 2)},
    **{b"RAWLASER%d" % n: Layout(n, True, 0) for n in (1, 2, 3, 4, 5)},
    b"LASER_READING": Layout(1, False, 3),  # of gfs-carmen
}
POSES = b"ODOM", b"TRUEPOS", b"SIMULATOR_POS"  # the last one of gfs-carmen
# messages without scans and poses, of CARMEN's logger and of gfs-carmen
OTHERS = frozenset(
    b"PARAM SYNC COMMENT ARM GLOBALPOS SONAR BUMPER IMU SCANMARK PANTILT POSITIONLASER VECTORMOVE"
    b" ROBOTVELOCITY FOLLOWTRAJECTORY BASEVELOCITY NMEAGGA NMEARMC MARKER WEIGHT NEFF ENTROPY"
    b" FRAME ODO_UPDATE SM_UPDATE RESAMPLE".split()
)


class ScanMessage(NamedTuple):
    """Logged scan: timestamps [s], ranges (n,) [m], poses (3,); missing values are None or NaN."""

    stamp: float
    logged: float
    ranges: np.ndarray
    settings: tuple | None  # field of view and resolution, see ``angles_by_settings``
    range_max: float
    laser: np.ndarray  # pose of the laser
    robot: np.ndarray  # pose of the robot, by odometry


def parse_scan(words, complete):
    """Parse a ScanMessage; ``complete`` states whether the line has a line end.

    Raises ValueError with the kind of damage.
    """
    layout = LASERS[words[0]]
    at = 9 if layout.settings else 2
    count = words[at - 1] if len(words) >= at else b""
    if not count.isdigit():
        raise ValueError("lines without a number of ranges" if complete else "truncated lines")
    count = int(count) if len(count) <= MAX_DIGITS else len(words)
    tail, needed = words[at + count :], layout.poses + layout.rest + 1
    if layout.settings:
        tail = _after_remissions(tail, needed)
    surplus = len(tail) - needed  # host and time of logging
    if not complete and surplus < 1:
        raise ValueError("truncated lines")
    if not 0 <= surplus <= 2:
        raise ValueError("lines with a wrong number of ranges")
    if count == 0:
        raise ValueError("scans without ranges")
    values = numbers(words[at : at + count] + tail[:needed])
    ranges, poses, stamp = values[:count], values[count : count + layout.poses], values[-1]
    if not isfinite(stamp) or not all(abs(p) < MAX_ODOMETRY for p in poses[-3:].tolist()):
        raise ValueError("lines with invalid odometry or timestamp")
    settings, range_max = None, np.nan
    if layout.settings:
        *settings, range_max = numbers(words[2:6]).tolist()
        settings = *settings, count
        angles_by_settings(*settings)  # raises if they are inconsistent
    return ScanMessage(
        stamp=float(stamp),
        logged=_number(tail[-1]) if surplus == 2 else np.nan,
        ranges=ranges,
        settings=settings,
        range_max=range_max,
        laser=poses[:3] if layout.poses == 6 else UNKNOWN_POSE,
        robot=poses[-3:] if layout.poses else UNKNOWN_POSE,
    )


def parse_pose(words):
    """Parse a message named in POSES; return timestamp, time of logging [s], robot pose (3,)."""
    end = 8 if len(words) > 5 else 5  # gfs-carmen has no speeds
    values = numbers(words[1:end])
    if len(values) < end - 1 or not np.isfinite(values).all():
        raise ValueError("unreadable poses")
    logged = _number(words[end + 1]) if len(words) > end + 1 else np.nan
    return float(values[-1]), logged, *values[:3].tolist()


def numbers(words):
    """Convert words with a decimal point or comma to numbers (n,)."""
    try:
        values = np.fromiter(map(float, words), float, len(words))
    except ValueError:
        values = np.array([_number(word.replace(b",", b"."), None) for word in words])
    if values.dtype != float or b"_" in b"".join(words):  # Python accepts 1_000 as a number
        raise ValueError("lines with a word instead of a number")
    return values


def _number(word, otherwise=np.nan):
    try:
        return float(word)
    except ValueError:
        return otherwise


def _after_remissions(tail, needed):
    """Return the words after a scan's remissions; old logs lack even the number of remissions."""
    if tail and tail[0].isdigit():
        rest = tail[1 + int(tail[0][:MAX_DIGITS]) :]
        if len(rest) >= needed and _number(rest[needed - 1], None) is not None:
            return rest
    return tail
