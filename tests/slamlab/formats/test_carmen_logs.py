"""CARMEN logs of every kind are read rightly, or refused with line and remedy."""

import gzip
import tracemalloc

import numpy as np
import pytest

from slamlab import files, sources
from slamlab.geometry import compose
from slamlab.sources import SourceError, carmen_lasers, disk_buffer
from tests.slamlab.formats.room_runs import CENTRE, assert_read_rightly, drive, ranges

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


def settings(angles, degrees=False, step=None, count=None):
    unit = np.degrees if degrees else np.asarray
    step = np.mean(np.diff(angles)) if step is None else step
    values = unit(angles[0]), unit(np.ptp(angles)), unit(step), 81.9, 0.01
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


def corrected():
    """A log whose first pose is somebody's result, in a frame of its own that drifts."""
    frame = [np.array([3 + 0.01 * i, -2.0, 1 + 0.002 * i]) for i in range(len(DRIVE.times))]
    rows = zip(*DRIVE, frame, strict=True)
    return [flaser(t, p, first=compose(f, p)) for t, p, f in rows]


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


def one_flaser_then_robotlasers():
    first, *rest = zip(*DRIVE, strict=True)
    return [flaser(*first), *(robotlaser(*row) for row in rest)]


SICK_100 = np.radians(np.arange(-50, 50.1, 0.25))
HOKUYO = np.radians(np.linspace(-120, 120, 682))
SPARSE = np.radians(np.linspace(-45, 45, 61))
READ = {
    "FLASER of 181 ranges": log(flaser),
    "FLASER of 180 ranges": log(flaser, angles=HALF[:-1]),
    "FLASER of 361 ranges": log(flaser, angles=np.radians(np.arange(-90, 90.1, 0.5))),
    "FLASER of 401 ranges": log(flaser, angles=SICK_100),
    "PARAM: field of view": [param("laser_front_laser_fov", 240.0), *log(flaser, angles=HOKUYO)],
    "PARAM: resolution": [param("laser_laser1_resolution", 0.5), *log(flaser, angles=WIDE)],
    "PARAM: field of view and resolution": [
        param("laser_front_laser_fov", 90),
        param("laser_front_laser_resolution", 1.5),
        *log(flaser, angles=SPARSE),
    ],
    "PARAM: field of view of a whole turn": [
        param("laser_front_laser_fov", 360),
        *log(flaser, angles=np.radians(np.arange(-180, 180, 1.0))),
    ],
    "PARAM after the scans": [*log(flaser, angles=WIDE), param("laser_front_laser_fov", 270)],
    "PARAM: mounting": [
        param("robot_frontlaser_offset", 0.25),
        param("robot_frontlaser_side_offset", -0.1),
        *log(flaser, mount=AHEAD, first=CENTRE),
    ],
    "PARAM: mounting, turned in degrees": [
        param("robot_frontlaser_offset", -0.2),
        param("robot_frontlaser_side_offset", 0.05),
        param("robot_frontlaser_angular_offset", "180.0"),
        *log(flaser, mount=REAR, first=CENTRE),
    ],
    "mounting by the poses of laser and robot": log(flaser, mount=AHEAD),
    "corrected poses beside the odometry": corrected(),
    "poses of the laser, the odometry left zero": [
        param("robot_frontlaser_offset", 0.3),
        *(
            words("FLASER", len(HALF), ranges(p, HALF), p, CENTRE, tail(t))
            for t, p in zip(*DRIVE, strict=True)
        ),
    ],
    "RLASER": log(flaser, mount=REAR, name="RLASER"),
    "ROBOTLASER1": log(robotlaser, mount=AHEAD),
    "ROBOTLASER1 of 270°": log(robotlaser, angles=WIDE),
    "ROBOTLASER1 with remissions": log(robotlaser, remissions=181),
    "ROBOTLASER1 before there were remissions": log(robotlaser, remissions=None),
    "ROBOTLASER1 in degrees": log(robotlaser, angles=WIDE, degrees=True),
    "ROBOTLASER1 without a resolution": log(robotlaser, angles=SPARSE, step=0.0),
    "ROBOTLASER1 that runs clockwise": log(robotlaser, angles=WIDE[::-1]),
    "ROBOTLASER2": log(robotlaser, mount=REAR, name="ROBOTLASER2"),
    "RAWLASER1 and ODOM": [*odoms()[:200], *log(rawlaser), *odoms()[200:]],
    "RAWLASER1 after all ODOM": [*odoms(), *log(rawlaser)],
    "RAWLASER1 with its mounting": [
        param("robot_frontlaser_offset", 0.3),
        *odoms(),
        *log(rawlaser, mount=[0.3, 0, 0]),
    ],
    "RAWLASER1, whose clock is that of another computer": [*odoms(shift=5000.0), *log(rawlaser)],
    "RAWLASER1 without odometry": log(rawlaser),
    "one FLASER, then ROBOTLASER1": one_flaser_then_robotlasers(),
    "the same scans as FLASER and as ROBOTLASER1": [*log(flaser), *log(robotlaser)],
    "two lasers": front_and_rear(),
    "gfs": gfs(),
    "upside down, as CARMEN logs it": [param("laser_front_laser_flipped", 1), *log(flaser)],
    "upside down, as the laser sends it": [
        param("laser_front_laser_flipped", "on"),
        *log(flaser, angles=HALF[::-1]),
    ],
    "ranges in millimetres": log(flaser, scale=1000.0),
    "decimal commas": [line.replace(".", ",") for line in log(flaser)],
    "without host and logger's stamp": [line.rsplit(" ", 2)[0] for line in log(flaser)],
}
REPORTED = {
    "PARAM: mounting": {"mount": AHEAD},
    "PARAM: mounting, turned in degrees": {"mount": REAR},
    "mounting by the poses of laser and robot": {"mount": AHEAD},
    "RLASER": {"mount": REAR},
    "ROBOTLASER1": {"mount": AHEAD},
    "ROBOTLASER2": {"mount": REAR},
    "RAWLASER1 with its mounting": {"mount": np.array([0.3, 0, 0])},
    "two lasers": {"mount": REAR, "count": 78},
}


def opened(tmp_path, lines, encode=str.encode):
    path = tmp_path / "drive.log"
    path.write_bytes(encode("\n".join(lines) + "\n"))
    return sources.open(path)


@pytest.mark.parametrize("kind", READ)
def test_a_log_is_read_correctly(tmp_path, kind):
    source = opened(tmp_path, READ[kind])
    assert_read_rightly(source, DRIVE, **REPORTED.get(kind, {}))
    assert source.skipped == 0


ENCODINGS = {
    "UTF-8 with a mark": lambda text: text.encode("utf-8-sig"),
    "UTF-16 of PowerShell": lambda text: text.replace("\n", "\r\n").encode("utf-16"),
    "carriage returns alone": lambda text: text.replace("\n", "\r").encode(),
    "gzip": lambda text: gzip.compress(text.encode()),
    "no end of the last line": lambda text: text.rstrip("\n").encode(),
}


@pytest.mark.parametrize("encode", ENCODINGS.values(), ids=ENCODINGS)
def test_a_log_is_read_in_any_encoding(tmp_path, encode):
    path = tmp_path / "drive.log"
    path.write_bytes(encode("\n".join(log(flaser)) + "\n"))
    assert_read_rightly(sources.open(path), DRIVE)


def changed(lines, row, old, new):
    lines = list(lines)
    assert old in lines[row]
    lines[row] = lines[row].replace(old, new, 1)
    return lines


LINES = log(flaser)
RAW = [*odoms(), *log(rawlaser)]
LEFT = {  # readings, where it is not one that is lost
    "lines without a CARMEN message": 40,
    "scans before or after all ODOM messages": 33,
    "unreadable poses": 40,
}
DAMAGED = {  # what is counted, and the lines
    "lines with a wrong number of ranges": changed(
        log(robotlaser, remissions=3), 7, " 3 120", " 7 120"
    ),
    "lines with a word instead of a number": changed(
        LINES, 7, f" {DRIVE.times[7]:.6f}", " 1_007.5"
    ),
    "scans of another length": [
        *LINES[:9],
        flaser(DRIVE.times[9], DRIVE.poses[9], HALF[:90]),
        *LINES[10:],
    ],
    "scans with inconsistent field of view, resolution and number of ranges": changed(
        log(robotlaser), 7, " 0.017453 ", " 0.034906 "
    ),
    "scans without a field of view": changed(
        log(robotlaser), 7, "-1.570796 3.141593 0.017453", "0 0 0"
    ),
    "scans without ranges": [words("FLASER 0", CENTRE, CENTRE, tail(999.0)), *LINES[1:]],
    "lines without a CARMEN message": [*LINES[:9], "FLAS3R 181 1.0", *LINES[9:]],
    "scans before or after all ODOM messages": [*odoms()[60:], *log(rawlaser)],
    "unreadable poses": [*RAW[:5], "ODOM 1.0 2.0", *RAW[6:]],
}


@pytest.mark.parametrize("damage", DAMAGED)
def test_damage_costs_the_readings_it_touches_and_is_counted(tmp_path, damage):
    source, count = opened(tmp_path, DAMAGED[damage]), LEFT.get(damage, 39)
    assert source.damage == {damage: max(1, len(DRIVE.times) - count)}
    assert source.skipped == len(DRIVE.times) - count
    assert_read_rightly(source, DRIVE, count=count)


REFUSED = {
    "settings alone": (
        [param("robot_front_laser_max", 80), "SYNC x"],
        "no readable scan of a laser",
    ),
    "odometry alone": (odoms(), "no readable scan of a laser"),
    "nothing but damage": (
        [*odoms(), "RAWLASER1 0 1 2", "RAWLASER1"],
        r"the first of 2 lost readings is in line 334 \(lines without a number of ranges\)",
    ),
    "odometry of another time": (
        [*(line.rsplit(" ", 1)[0] for line in odoms(shift=9000.0)), *log(rawlaser)],
        "no usable scan: 40 are scans before or after all ODOM messages",
    ),
    "PARAM lines that contradict the scans": (
        [
            param("laser_front_laser_fov", 270),
            param("laser_front_laser_resolution", 0.25),
            *log(flaser, angles=WIDE),
        ],
        "PARAM lines contradict the scans: field of view 270°, resolution 0.25°, 541 ranges",
    ),
    "a resolution that is more than a turn": (
        [param("laser_front_laser_resolution", 1.0), *log(flaser, angles=WIDE)],
        "PARAM lines contradict the scans",
    ),
    "messages that contradict themselves": (
        log(robotlaser, step=np.radians(3.0)),
        r"first of 40 lost readings is in line 1 \(scans with inconsistent field of view",
    ),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_a_log_that_cannot_be_read_is_refused_with_its_reason(tmp_path, kind):
    lines, reported = REFUSED[kind]
    with pytest.raises(SourceError, match=reported) as refused:
        opened(tmp_path, lines)
    assert "\n" not in str(refused.value) and "drive.log" in str(refused.value)


def test_true_poses_are_the_lasers_at_the_times_of_its_scans(tmp_path):
    true = [
        words("TRUEPOS", DRIVE.at(t), CENTRE, tail(t), places=6)
        for t in np.linspace(DRIVE.times[0] - 0.1, DRIVE.times[-2], 200)
    ]
    source = opened(tmp_path, [*log(robotlaser, mount=AHEAD), *true])
    assert np.allclose(source.truth.times, DRIVE.times[:-1])
    assert np.allclose(source.truth.poses, compose(DRIVE.poses[:-1], AHEAD), atol=0.01)


def test_gfs_knows_the_true_poses_of_a_simulation(tmp_path):
    source = opened(tmp_path, gfs())
    assert np.allclose(source.truth.poses, DRIVE.poses, atol=1e-3)


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (LINES, True),
        (RAW, True),
        (log(rawlaser), False),
        ([flaser(t, CENTRE) for t in DRIVE.times], False),  # zeros: a lidar without a robot
        ([flaser(t, CENTRE) for t in DRIVE.times[:1]], True),  # where every robot begins
        ([*odoms(), *(flaser(t, CENTRE) for t in DRIVE.times)], True),
    ],
)
def test_no_odometry_is_not_odometry_of_zero(tmp_path, lines, message):
    source = opened(tmp_path, lines)
    assert source.has_odometry == message
    assert all((reading.odometry is None) != message for reading in source)


def test_where_the_stamps_stand_still_the_loggers_are_taken(tmp_path):
    lines = [flaser(0.0, p).rsplit(" ", 1)[0] + f" {t}" for t, p in zip(*DRIVE, strict=True)]
    assert_read_rightly(opened(tmp_path, lines), DRIVE)


def test_a_dead_encoder_is_passed_on_as_it_is(tmp_path):
    stuck = [flaser(t, DRIVE.poses[3]) for t in DRIVE.times]
    source = opened(tmp_path, stuck)
    assert source.has_odometry and np.allclose([r.odometry for r in source], 0)


@pytest.mark.parametrize("limit", [30.0, 81.9, 0.0])
def test_the_maximum_range_is_read_and_what_stands_for_no_return_is_none(tmp_path, limit):
    lines = [line.replace(" 81.900000 ", f" {limit:.6f} ") for line in log(robotlaser)]
    lines = [line.replace(line.split()[40], "81.83") for line in lines]
    source = opened(tmp_path, lines)
    assert source.sensor.range_max == (limit if 0 < limit < 80 else 80)
    assert all(not reading.scan.valid[40 - 9] for reading in source)


def test_other_lasers_are_named(tmp_path):
    source = opened(tmp_path, front_and_rear())
    assert source.damage == {"unused scans of ROBOTLASER1, in addition to ROBOTLASER2": 39}
    assert source.skipped == 0


def test_a_missing_field_of_view_is_reported_as_guessed(tmp_path):
    source = opened(tmp_path, log(flaser, angles=HOKUYO))
    assert "682 ranges cover 180°" in source.notes[0]
    assert not opened(tmp_path, LINES).notes


def set_back(lines, at, seconds):
    """A log whose computer's clock is set back meanwhile."""
    for line in lines:
        stamp, host, logged = line.rsplit(" ", 3)[1:]
        if float(stamp) > at:
            later = f"{float(stamp) - seconds:.6f} {host} {float(logged) - seconds:.6f}"
            line = f"{line.rsplit(' ', 3)[0]} {later}"
        yield line


def test_scans_find_their_odometry_though_the_clock_is_set_back(tmp_path):
    both = sorted([*odoms(), *log(rawlaser)], key=lambda line: float(line.split()[-3]))
    source = opened(tmp_path, list(set_back(both, DRIVE.times[20] + 0.01, 4.0)))
    assert source.damage == {"timestamps that run backwards": 1}
    pose = DRIVE.poses[0]
    for true, reading in zip(DRIVE.poses, source, strict=True):
        pose = compose(pose, reading.odometry)
        assert np.allclose(pose, true, atol=0.02)


def test_a_long_log_is_read_in_memory_that_does_not_grow_with_it(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "HEAD", 50_000)
    monkeypatch.setattr(disk_buffer, "IN_MEMORY", 100_000)
    monkeypatch.setattr(carmen_lasers, "MAX_SAMPLE", 20)
    peaks = []
    for times in (2, 10):
        tracemalloc.start()
        source = opened(tmp_path, LINES * times, lambda text: gzip.compress(text.encode()))
        tracemalloc.reset_peak()
        source = sources.open(source.name)
        assert sum(1 for _ in source) == len(source) == times * len(LINES)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.5 * peaks[0]
