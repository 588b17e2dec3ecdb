"""RPLIDAR text of every kind is read rightly, or refused with its reason and the remedy."""

import json
from datetime import datetime, timedelta

import numpy as np
import pytest

from slamlab import sources
from slamlab.deskewing import deskew_by_velocity
from slamlab.geometry import compose, transform
from slamlab.sources import SourceError
from tests.slamlab.formats.room_runs import assert_read_rightly, distances_to_walls, drive, ranges
from tests.slamlab.support import public

TURNS = 12
DRIVE = drive(count=TURNS, step=0.1, begin=0.0)  # at the rate that is assumed of a lidar
STEP = 2.0  # [degree]
CLOCKWISE = np.arange(0.25, 360, STEP)


def turns(start=0.0, poses=DRIVE.poses):
    """Angle clockwise [degree] and distance [mm] of the points of each turn from a pose."""
    angles = np.roll(CLOCKWISE, -int(np.searchsorted(CLOCKWISE, start)))
    for pose in poses:
        distances = 1000 * ranges(pose, -np.radians(angles))
        yield list(zip(angles.tolist(), distances.tolist(), strict=True))


def points(row, **more):
    """A line for each point: ``row`` (turn, point, angle, distance, whether a turn begins)."""
    return [
        row(k, i, angle, distance, i == 0)
        for k, turn in enumerate(turns(**more))
        for i, (angle, distance) in enumerate(turn)
    ]


def sdk(k, i, angle, distance, _):
    mark = "S " if angle >= 352 > angle - STEP else "  "
    return f"{mark} theta: {angle:.2f} Dist: {distance:08.2f} Q: 47 "


def record(*values):
    """A line as the example of a Python driver writes it."""
    return "\t".join(map(str, values))


def snapshot(turn):
    rows = [f"{angle:.4f} {distance:.1f} 47" for angle, distance in turn]
    return ["#RPLIDAR SCAN DATA", f"#COUNT={len(turn)}", "#Angule\tDistance\tQuality", *rows]


def dictionary(start, angle, distance):
    return str({"start_flag": start, "quality": 15, "angle": angle, "distance": distance})


def lists(turn):
    return str([(15, angle, distance) for angle, distance in turn])


def table(header, *columns, **more):
    """A table by a header and what is in each column."""
    rows = points(
        lambda k, i, a, d, s: ",".join(
            {
                "degree": f"{a:.3f}",
                "radian": f"{np.radians(a):.5f}",
                "mm": f"{d:.1f}",
                "cm": f"{d / 10:.2f}",
                "m": f"{d / 1000:.4f}",
                "quality": "47" if i % 5 else "15",
                "start": str(s),
                "0 or 1": str(int(s)),
                "turn": str(k),
                "s": f"{1000 + 0.1 * (k + (i + 1) / len(CLOCKWISE)):.6f}",
                "ms of a turn": str(5_000_000 + 100 * k),
                "date": str(datetime(2024, 5, 1) + timedelta(seconds=k // 10)),
            }[column]
            for column in columns
        ),
        **more,
    )
    return [header, *rows] if header else rows


HEADER = [
    "Ultra simple LIDAR data grabber for RPLIDAR.",
    "Version: 1.11.0",
    "RPLidar health status : 0",
]
SDK = [*HEADER, *points(sdk)]
READ = {
    "SDK": SDK,
    "SDK, printed as bytes": [f"b'{line}'" for line in SDK],
    "SDK, read in a viewer": [line.strip() for line in SDK],
    "RoboStudio, one scan after the other": [
        line for turn in turns(start=352) for line in snapshot(turn)
    ],
    "measurements a line": points(lambda k, i, a, d, s: record(s, 15, a, d)),
    "measurements a line, as tuples": points(lambda k, i, a, d, s: f"({s}, 15, {a}, {d})"),
    "scans a line": [lists(turn) for turn in turns()],
    "scans a line, as JSON": [json.dumps([[15, a, d] for a, d in turn]) for turn in turns()],
    "arrays of NumPy": points(lambda k, i, a, d, s: f" [ 15. {a:.4f} {d:.2f}]"),
    "dictionaries": points(lambda k, i, a, d, s: dictionary(s, a, d)),
    "scans a line, of numbers of NumPy": [
        str([(15, np.float64(a), np.float64(d)) for a, d in turn]) for turn in turns()
    ],
    "dictionaries, numbered": points(lambda k, i, a, d, s: f"{i} {dictionary(s, a, d)}"),
    "dictionaries of a scan a line": [
        "[" + ", ".join(dictionary(not i, a, d) for i, (a, d) in enumerate(turn)) + "]"
        for turn in turns()
    ],
    "JSON a line": points(lambda k, i, a, d, s: json.dumps({"angle": a, "distance": d})),
    "distance before angle": points(lambda k, i, a, d, s: f"Dist={d}, Angle={a}"),
    "words and units": points(
        lambda k, i, a, d, s: f"Angle: {a:6.1f}°  Distance: {d:6.0f}mm Quality: 15"
    ),
    "table": table("angle,distance,quality", "degree", "mm", "quality"),
    "table in radians and metres": table("angle_rad,distance_m", "radian", "m"),
    "table in radians and metres, not said": table("angle,range", "radian", "m"),
    "table in centimetres": table("Angle [deg];Distance [cm]".replace(";", ","), "degree", "cm"),
    "table with numbers of scans": table("scan,angle,distance", "turn", "degree", "mm", start=352),
    "table with marks": table("start_flag,theta,dist,qua", "0 or 1", "degree", "mm", "quality"),
    "table with dates": table(
        "Timestamp,Quality,Angle (degrees),Distance (mm)", "date", "quality", "degree", "mm"
    ),
    "table with semicolons and decimal commas": [
        line.replace(",", ";").replace(".", ",")
        for line in table("angle,distance,quality", "degree", "mm", "quality")
    ],
    "table with blanks": [
        line.replace(",", "  ") for line in table("# angle,distance", "degree", "mm")
    ],
    "columns angle, distance": table("", "degree", "mm"),
    "columns quality, angle, distance": table("", "quality", "degree", "mm"),
    "columns start, quality, angle, distance": table("", "start", "quality", "degree", "mm"),
    "columns 0 or 1, angle, distance, quality": table("", "0 or 1", "degree", "mm", "quality"),
    "columns angle, distance in radians and metres": table("", "radian", "m", "quality"),
}


def opened(tmp_path, lines, encoding="utf-8"):
    path = tmp_path / "lidar.txt"
    path.write_text("\n".join(lines) + "\n", encoding=encoding)
    return sources.open(path)


@pytest.mark.parametrize("kind", READ)
def test_text_is_read_correctly(tmp_path, kind):
    source = opened(tmp_path, READ[kind])
    assert not source.has_odometry
    assert_read_rightly(source, DRIVE, beams=len(CLOCKWISE))
    assert source.skipped == 0


def test_one_snapshot_of_robostudio_is_one_scan(tmp_path):
    (scan,) = turns(start=352, poses=DRIVE.poses[:1])
    assert_read_rightly(opened(tmp_path, snapshot(scan)), DRIVE, count=1)


def test_a_truncated_revolution_is_left_out_and_not_counted_as_lost(tmp_path):
    source = opened(tmp_path, SDK[100:-100])
    assert len(source) == TURNS - 2 and source.skipped == 0
    assert [r.time for r in source] == pytest.approx(DRIVE.times[1:-1])


@pytest.mark.parametrize("kind", ["SDK", "measurements a line", "dictionaries", "table"])
def test_lost_lines_cost_their_points_and_are_counted(tmp_path, kind):
    lines = list(READ[kind])
    for row in (700, 900, 901):
        lines[row] = lines[row][: len(lines[row]) // 3]
    lines[1500] = "\x00\x01\x02"
    if kind == "SDK":
        lines[1100] = "   theta: 22.50 Dist: -2.00 Q: 47"
    source = opened(tmp_path, lines)
    assert source.damage == {"lines without a readable point": 3 + (kind == "SDK")}
    assert source.skipped == 0  # points, none of the turns
    assert_read_rightly(source, DRIVE)


def test_a_revolution_ends_without_its_start_flag(tmp_path):
    lines = [line for line in READ["measurements a line"] if not line.startswith("True")]
    first = READ["measurements a line"][: 3 * len(CLOCKWISE)]
    source = opened(tmp_path, [*first, *lines[3 * (len(CLOCKWISE) - 1) :]])
    assert all(np.ptp(r.scan.angles) < 7.0 for r in source)  # no scan of two turns
    assert len(source) >= TURNS - 3


def test_directions_without_a_return_are_kept_or_left_out_as_they_were_written(tmp_path):
    def row(k, i, angle, distance, start):
        return f"{angle:.2f},{0 if angle < 90 else distance:.1f}"

    rows = ["angle,distance", *points(row)]
    assert_read_rightly(opened(tmp_path, rows), DRIVE, beams=135)
    returns = [line for line in rows if not line.endswith(",0.0")]
    # the first and the last may have been cut off
    assert_read_rightly(opened(tmp_path, returns), DRIVE, count=TURNS - 2)


def test_measured_times_are_those_of_the_readings(tmp_path):
    columns = "s", "degree", "mm"
    source = opened(tmp_path, table("t,angle_deg,dist_mm", *columns))
    readings = list(source)
    assert [r.time for r in readings] == pytest.approx(1000.1 + DRIVE.times)
    assert readings[3].scan.times[0] == pytest.approx(-0.1 * (1 - 1 / len(CLOCKWISE)), abs=1e-5)
    assert readings[3].scan.times[-1] == 0.0


def test_the_unit_of_times_is_determined_by_the_period_of_revolutions(tmp_path):
    source = opened(tmp_path, table("timestamp,angle,distance", "ms of a turn", "degree", "mm"))
    assert [r.time for r in source] == pytest.approx(5000.0 + DRIVE.times)


def test_the_beams_of_a_moving_lidar_are_deskewed_by_their_times(tmp_path):
    # the SDK prints a turn by angle, though it began at 352°
    motion = np.array([0.1, 0.03, 0.12])
    since_begin = ((CLOCKWISE - 352) % 360) / 360
    lines, begin = [], DRIVE.poses[5]
    for _ in range(3):
        for angle, share in zip(CLOCKWISE, since_begin, strict=True):
            pose = compose(begin, share * motion)
            distance = 1000 * ranges(pose, [-np.radians(angle)])[0]
            lines.append(sdk(0, 0, angle, distance, False))
        begin = compose(begin, motion)
    source = opened(tmp_path, lines)
    end = compose(DRIVE.poses[5], motion)
    for reading in source:
        still = deskew_by_velocity(reading.scan, motion, 0.1)
        assert distances_to_walls(transform(end, still.points())).max() < 0.01
        assert distances_to_walls(transform(end, reading.scan.points())).max() > 0.05
        end = compose(end, motion)


@pytest.mark.parametrize(("factor", "limit"), [(1, 12.0), (3, 25.0), (5, 40.0)])
def test_the_range_is_that_of_a_model_that_sees_so_far(tmp_path, factor, limit):
    lines = points(lambda k, i, a, d, s: f"theta: {a:.2f} Dist: {factor * d:.2f} Q: 47")
    assert opened(tmp_path, lines).sensor.range_max == limit


REFUSED = {
    "less than a turn": (SDK[: len(HEADER) + 120], "no complete revolution of a lidar"),
    "angles to either side": (
        points(lambda k, i, a, d, s: f"angle: {a - 180:.2f} distance: {d:.2f}"),
        "angles begin at -179.75, so their direction is unknown",
    ),
    "distances between millimetres and metres": (
        points(lambda k, i, a, d, s: f"angle: {a:.2f} distance: {80 + i % 5}"),
        "the unit of the distance 82 is ambiguous. To set it, insert the first line angle_deg,",
    ),
    "a header that contradicts its distances": (
        table("angle,distance_mm", "degree", "m"),
        r"unit of the distance is mm .* \(such as .*\) suggest m. Correct the text",
    ),
    "angles of no turn": (
        ["angle,distance", *(f"{0.001 * i:.3f},{1500 + i}" for i in range(900))],
        "the unit of the angle 0.889.* is ambiguous",
    ),
    "columns of which two could be the distance": (
        points(lambda k, i, a, d, s: f"{a:.2f} {d:.2f} {d / 2:.3f}"),
        "a table of numbers without column names .*: insert a header line",
    ),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_text_that_cannot_be_read_is_refused_with_its_reason(tmp_path, kind):
    lines, reported = REFUSED[kind]
    with pytest.raises(SourceError, match=reported) as refused:
        opened(tmp_path, lines)
    assert "lidar.txt" in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize(("name", "turns"), [("1", 8), ("2", 22), ("3", 19)])
def test_the_recordings_of_an_a2_have_their_revolutions(name, turns):
    source = sources.open(public(f"rplidar-a2-{name}"))
    assert len(source) == turns and not source.damage
    assert all(355 < len(r.scan.ranges) < 540 for r in source)
