"""Messages of CARMEN logs for a drive through a room."""

import numpy as np

from slamlab import sources
from slamlab.geometry import compose
from tests.slamlab.formats.room_runs import CENTRE, drive, ranges

DRIVE = drive()
HALF = np.radians(np.arange(-90, 90.5, 1.0))  # of a SICK
WIDE = np.radians(np.linspace(-135, 135, 541))
AHEAD = np.array([0.25, -0.1, 0.0])  # where a laser is mounted
REAR = np.array([-0.2, 0.05, np.pi])


def words(*parts, places=4):
    return " ".join(
        str(part)
        if isinstance(part, (str, int))
        else " ".join(f"{v:.{places}f}" for v in np.ravel(part))
        for part in parts
    )


def tail(time, logged=None):
    return words(f"{time:.6f}", "host", f"{time if logged is None else logged:.6f}")


def flaser(time, robot, angles=HALF, mount=CENTRE, name="FLASER", first=None, scale=1.0):
    """A scan and the poses of laser and robot, in CARMEN's old message."""
    laser = compose(robot, mount)
    seen = ranges(laser, angles) * scale
    poses = laser if first is None else first
    return words(name, len(seen), seen, poses, robot, tail(time))


def settings(angles, degrees=False, step=None, count=None, view=None):
    unit = np.degrees if degrees else np.asarray
    step = np.mean(np.diff(angles)) if step is None else step
    view = np.ptp(angles) if view is None else view
    values = unit(angles[0]), unit(view), unit(step), 81.9, 0.01
    return words("0", *(f"{float(v):.6f}" for v in values), "0")


def robotlaser(time, robot, angles=HALF, mount=CENTRE, name="ROBOTLASER1", remissions=0, **more):
    laser = compose(robot, mount)
    seen = ranges(laser, angles)
    return words(
        name,
        settings(angles, **more),
        len(seen),
        seen,
        *([] if remissions is None else [remissions, np.full(remissions, 120.0)]),
        laser,
        robot,
        "0.3 0.0 0.5 0.4 1000000.0",
        tail(time),
    )


def rawlaser(time, robot, angles=HALF, mount=CENTRE, number=1, logged=None):
    seen = ranges(compose(robot, mount), angles)
    return words(f"RAWLASER{number}", settings(angles), len(seen), seen, 0, tail(time, logged))


def odom(time, robot, logged=None):
    return words("ODOM", robot, "0.3 0.1 0.0", tail(time, logged), places=6)


def log(message, **more):
    """The drive as a log of one message a scan."""
    return [message(t, p, **more) for t, p in zip(*DRIVE, strict=True)]


def odoms(shift=0.0):
    """ODOM messages between the scans, and a little before and after."""
    times = np.linspace(DRIVE.times[0] - 0.1, DRIVE.times[-1] + 0.1, 333)
    return [odom(t + shift, DRIVE.at(t), logged=t) for t in times]


def param(name, *value):
    return words("PARAM", name, *map(str, value), "nohost 0")


def gfs():
    lines = ["# of gfs-carmen"]
    for t, p in zip(*DRIVE, strict=True):
        lines += [
            words("SIMULATOR_POS", p, f"{t:.6f}"),
            words("ODOM", p, f"{t:.6f}"),
            words("ODO_UPDATE 1", p, "0.0", f"{t:.6f}"),
            words("LASER_READING", len(HALF), ranges(p, HALF), p, f"{t:.6f}"),
            words("SM_UPDATE 1", p, "0.0"),
            "NEFF 30",
        ]
    return lines


def front_and_rear():
    """A robot of two lasers; the rear one is twice as fast."""
    lines, times = [], np.arange(DRIVE.times[0], DRIVE.times[-1], 0.125)
    for i, t in enumerate(times):
        lines.append(robotlaser(t, DRIVE.at(t), mount=REAR, name="ROBOTLASER2"))
        if i % 2 == 0:
            lines.append(robotlaser(t, DRIVE.at(t), mount=AHEAD))
    return lines


HOKUYO = np.radians(np.linspace(-120, 120, 682))


def opened(tmp_path, lines, encode=str.encode):
    path = tmp_path / "drive.log"
    path.write_bytes(encode("\n".join(lines) + "\n"))
    return sources.open(path)


LINES = log(flaser)
RAW = [*odoms(), *log(rawlaser)]
