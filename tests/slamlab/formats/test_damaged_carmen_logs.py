"""Damage of a CARMEN log is counted, and what cannot be read is refused with its reason."""

import numpy as np
import pytest

from slamlab.geometry import compose
from slamlab.sources import SourceError
from tests.slamlab.formats.carmen_writing import (
    DRIVE,
    HALF,
    HOKUYO,
    LINES,
    RAW,
    WIDE,
    flaser,
    front_and_rear,
    log,
    odoms,
    opened,
    param,
    rawlaser,
    robotlaser,
    tail,
    words,
)
from tests.slamlab.formats.room_runs import CENTRE, assert_read_rightly


def changed(lines, row, old, new):
    lines = list(lines)
    assert old in lines[row]
    lines[row] = lines[row].replace(old, new, 1)
    return lines


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
    "headings in degrees": (
        log(lambda t, p: flaser(t, p * [1, 1, 180 / np.pi])),
        "CARMEN log: the headings match the path in degrees, not in radians; multiply them",
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


def test_where_the_stamps_stand_still_the_loggers_are_taken(tmp_path):
    lines = [flaser(0.0, p).rsplit(" ", 1)[0] + f" {t}" for t, p in zip(*DRIVE, strict=True)]
    assert_read_rightly(opened(tmp_path, lines), DRIVE)


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
