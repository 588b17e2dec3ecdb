"""CARMEN logs of every kind are read rightly."""

import gzip
import os
import tracemalloc
from threading import Thread

import numpy as np
import pytest

from slamlab import files, sources
from slamlab.evaluation import load_relations
from slamlab.geometry import compose
from slamlab.sources import SourceError, carmen_lasers, disk_buffer
from tests.slamlab.formats.carmen_writing import (
    AHEAD,
    DRIVE,
    HALF,
    HOKUYO,
    LINES,
    RAW,
    REAR,
    WIDE,
    flaser,
    front_and_rear,
    gfs,
    log,
    odom,
    odoms,
    opened,
    param,
    rawlaser,
    robotlaser,
    tail,
    words,
)
from tests.slamlab.formats.room_runs import CENTRE, assert_read_rightly, ranges


def corrected():
    """A log whose first pose is somebody's result, in a frame of its own that drifts."""
    frame = [np.array([3 + 0.01 * i, -2.0, 1 + 0.002 * i]) for i in range(len(DRIVE.times))]
    rows = zip(*DRIVE, frame, strict=True)
    return [flaser(t, p, first=compose(f, p)) for t, p, f in rows]


def one_flaser_then_robotlasers():
    first, *rest = zip(*DRIVE, strict=True)
    return [flaser(*first), *(robotlaser(*row) for row in rest)]


SICK_100 = np.radians(np.arange(-50, 50.1, 0.25))
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
    "ROBOTLASER1 whose field of view is a beam too wide": log(robotlaser, view=np.radians(181)),
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


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_is_read_from_its_first_line(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = Thread(target=pipe.write_text, args=["\n".join(LINES) + "\n"], daemon=True)
    writer.start()
    assert_read_rightly(sources.open(pipe), DRIVE)
    writer.join()
    with pytest.raises(SourceError, match="pipe is a pipe, but it is read twice: write it to"):
        load_relations(pipe)


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
        ([flaser(t, DRIVE.poses[3]) for t in DRIVE.times], False),  # dead encoders
        ([*(odom(t, DRIVE.poses[3]) for t in DRIVE.times), *log(rawlaser)], False),
        ([flaser(t, CENTRE) for t in DRIVE.times[:1]], True),  # where every robot begins
        ([*odoms(), *(flaser(t, CENTRE) for t in DRIVE.times)], True),
    ],
)
def test_no_odometry_is_not_odometry_of_zero(tmp_path, lines, message):
    source = opened(tmp_path, lines)
    assert source.has_odometry == message
    assert all((reading.odometry is None) != message for reading in source)


@pytest.mark.parametrize("unit", ["milliseconds", "microseconds", "nanoseconds"])
@pytest.mark.parametrize("lines", [log(flaser), RAW], ids=["FLASER", "RAWLASER1 and ODOM"])
def test_timestamps_in_other_units_are_read_in_seconds(tmp_path, unit, lines):
    factor = {"milliseconds": 1e3, "microseconds": 1e6, "nanoseconds": 1e9}[unit]
    rows = [line.rsplit(" ", 3) for line in lines]
    lines = [
        f"{row} {float(t) * factor:.0f} {host} {float(u) * factor:.0f}" for row, t, host, u in rows
    ]
    source = opened(tmp_path, lines)
    assert_read_rightly(source, DRIVE)
    assert source.notes[-1] == f"the timestamps are read as {unit}"


@pytest.mark.parametrize("limit", [30.0, 81.9, 0.0])
def test_the_maximum_range_is_read_and_what_stands_for_no_return_is_none(tmp_path, limit):
    lines = [line.replace(" 81.900000 ", f" {limit:.6f} ") for line in log(robotlaser)]
    lines = [line.replace(line.split()[40], "81.83") for line in lines]
    source = opened(tmp_path, lines)
    assert source.sensor.range_max == (limit if 0 < limit < 80 else 80)
    assert all(not reading.scan.valid[40 - 9] for reading in source)


def test_a_long_log_is_read_in_memory_that_does_not_grow_with_it(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "HEAD", 50_000)
    monkeypatch.setattr(disk_buffer, "IN_MEMORY", 100_000)
    monkeypatch.setattr(carmen_lasers, "MAX_SAMPLE", 20)
    peaks = []
    for times in (2, 6):
        tracemalloc.start()
        source = opened(tmp_path, LINES * times, lambda text: gzip.compress(text.encode()))
        tracemalloc.reset_peak()
        source = sources.open(source.name)
        assert sum(1 for _ in source) == len(source) == times * len(LINES)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.5 * peaks[0]
