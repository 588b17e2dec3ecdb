"""Scans of a lidar on a robot: deskewed to the pose at their end, merged, also of recordings."""

import json

import numpy as np
import pytest
from hypothesis import given

from slamlab import sources
from slamlab.cli import main
from slamlab.deskewing import deskew, merge_scans
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Calibration, commands
from slamlab.devices.emir.session import Session
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.devices.emulator.in_memory_emulators import InMemoryEmulators
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.recording import Recorder, load
from slamlab.devices.recording.decoding import revolutions
from slamlab.devices.rplidar.requests import Command, motor_pwm, request
from slamlab.geometry import between, compose, transform
from slamlab.readings import Scan
from slamlab.simulation import worlds
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.sources import SourceError
from slamlab.sources import live_devices as source
from slamlab.sources.lidar_on_robot import EMIR_MODEL
from tests.property_testing import assert_same_pose, poses
from tests.slamlab.devices.ready_devices import ReadyEmir, ReadyLidar, turn

THESIS = 0.01, np.radians(2)  # what a count is there [m, rad]
COURSE = [(1.0, 0, 0), (2.0, 60, 20), (1.0, -30, -40), (2.0, 50, 50), (1.0, 0, 0)]


@given(poses, poses)
def test_a_scan_in_motion_is_deskewed_to_the_pose_at_its_end(begin, motion):
    motion = np.append(motion[:2] / 40, motion[2] / 3)  # half a metre and a radian at most
    end, times = compose(begin, motion), np.linspace(7.0, 7.1, 200)
    share = (times - 7.0) / 0.1
    angles = np.linspace(0, -2 * np.pi, 200)
    wall = transform(begin, 5 * np.column_stack([np.cos(2 * angles), np.sin(3 * angles)]))
    seen = between(compose(begin, share[:, None] * motion), np.column_stack([wall, 0 * share]))
    skewed = Scan(np.arctan2(seen[:, 1], seen[:, 0]), np.hypot(seen[:, 0], seen[:, 1]))
    skewed.ranges[3] = np.nan
    straight = deskew(skewed, times, begin, end)
    assert np.isnan(straight.ranges[3]) and straight.angles[3] == skewed.angles[3]
    rest = np.arange(200) != 3
    xy = np.column_stack([np.cos(straight.angles), np.sin(straight.angles)])
    found = transform(end, (straight.ranges[:, None] * xy)[rest])
    assert np.allclose(found, wall[rest], atol=1e-6)


@given(poses, poses)
def test_merged_scans_show_the_room_as_seen_from_the_last_pose(a, b):
    a, b = (np.append(pose[:2] / 40, pose[2]) for pose in (a, b))
    walls = 5 * np.column_stack([np.cos(np.arange(7.0)), np.sin(np.arange(7.0))])
    scans = []
    for pose in (a, b):
        x, y = transform(between(pose, np.zeros(3)), walls).T
        angles = -np.sort(-np.mod(np.arctan2(y, x), 2 * np.pi))
        scans.append(Scan(angles, np.full(7, np.nan), 12.0))
        order = np.argsort(-np.mod(np.arctan2(y, x), 2 * np.pi))
        scans[-1].ranges[:] = np.hypot(x, y)[order]
    both = merge_scans(scans, [a, b])
    assert len(both.ranges) == 14 and both.range_max == 12.0
    found = transform(b, both.points())
    apart = np.linalg.norm(found[:, None] - walls, axis=2)
    assert (apart.min(axis=1) < 1e-9).all() and (np.sum(apart < 1e-9, axis=0) == 2).all()
    clockwise = np.mod(scans[1].angles[0] - both.angles, 2 * np.pi)
    assert (np.diff(clockwise) >= 0).all()


def test_readings_of_merged_revolutions_have_all_points_and_the_motion():
    turns = [turn(51.0 + k / 10) for k in range(7)]
    single = list(source.LiveDevices(ReadyLidar(turns), ReadyEmir()))
    devices = source.LiveDevices(ReadyLidar(turns), ReadyEmir())
    devices.merge(3)
    merged = list(devices)
    assert [len(reading.scan.ranges) for reading in merged] == [3 * 360, 3 * 360, 360]
    assert [reading.time for reading in merged] == pytest.approx([0, 0.3, 0.4])
    way = compose(compose(single[3].odometry, single[4].odometry), single[5].odometry)
    assert_same_pose(merged[1].odometry, way)
    assert_same_pose(merged[2].odometry, single[6].odometry)
    for wrong in (0, -1, 1.5, None):
        with pytest.raises(SourceError, match="a whole number above 0"):
            devices.merge(wrong)
    with pytest.raises(SourceError, match="cannot be merged"):
        sources.open("sim:room").merge(2)


def test_a_scan_from_a_robot_that_stands_is_left_as_it_is():
    scan, pose = turn(51.0).scan(), np.array([1.0, 2.0, 3.0])
    assert deskew(scan, turn(51.0).times, pose, pose) is scan


def recorded(path, world, course, saturates=False):
    """Record a drive in simulated time, by the drivers; the true poses by time on its clock."""
    clock, rng = SimulatedClock(30.0), np.random.default_rng(1)
    body = EmulatedRobot(world, rng, robot=DifferentialDrive(tick=1e-6), counts=THESIS)
    machines = {
        "lidar": RPLidarEmulator(MovingLidar(body, rng)),
        "emir": EmirEmulator(body, saturates=saturates),
    }
    true, memory = [], InMemoryEmulators(machines, clock).opener
    with Recorder(path, {}, clock) as recorder:
        openers = {name: recorder.opener(name, memory) for name in machines}
        lidar = openers["lidar"]("lidar", 115200)
        lidar.write(motor_pwm(660) + request(Command.SCAN))
        emir = Session(
            "emir", 57600, Odometry(Calibration(), saturates), None, openers["emir"], clock
        )
        for seconds, v, omega in course:
            emir.move(commands.move(v, omega), repeated=True)
            end = clock.now() + seconds
            while clock.now() < end:
                lidar.read(4096, 0.01)
                emir.step()
                true.append((clock.now(), *body.pose))
        emir.close()
    times, *poses = np.unwrap(np.array(true), axis=0).T
    return lambda at: np.array([np.interp(at, times, column) for column in poses])


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    """A recorded drive in the room."""
    path = tmp_path_factory.mktemp("drive") / "a.raw"
    recorded(path, worlds.by_name("room"), COURSE)
    return path


@pytest.mark.parametrize("saturates", [False, True])
def test_a_recording_is_a_source_whose_scans_lie_where_the_room_is(tmp_path, saturates):
    world, path = worlds.by_name("room"), tmp_path / "a.raw.gz"
    true_at = recorded(path, world, COURSE, saturates)
    with sources.open(path) as source:
        readings = list(source)
        again = list(source)
    assert len(readings) > 50 and not source.damage
    assert source.robot == EMIR_MODEL and not source.drivable
    assert [r.time for r in readings] == [r.time for r in again]
    first = next(revolutions(load(path))).times[-1]
    believed = true_at(first)
    for reading in readings:
        believed = compose(believed, reading.odometry)
        true = true_at(first + reading.time)
        assert_same_pose(believed, true, 0.09)  # whole counts, of 2° and 1 cm
        distances = world.cast(true[:2], true[2] + reading.scan.angles)
        assert np.nanmedian(np.abs(distances - reading.scan.ranges)) < 0.03


def test_a_truncated_recording_is_read_up_to_its_end_and_reported(drive, tmp_path, capsys):
    torn, content, whole = tmp_path / "torn.raw", drive.read_bytes(), list(sources.open(drive))
    for end in np.linspace(0.2, 0.99, 5) * len(content):
        torn.write_bytes(content[: int(end)])
        source = sources.open(torn)
        readings = list(source)
        assert 0 < len(readings) < len(whole) and source.damage["file truncated"] == 1
        for a, b in zip(readings, whole, strict=False):
            np.testing.assert_array_equal(a.scan.ranges.shape, b.scan.ranges.shape)
    hurt = bytearray(content)
    hurt[len(content) // 2] ^= 1
    torn.write_bytes(hurt)
    assert main(["run", str(torn), "--estimator", "odometry"]) == 0
    assert "file truncated: 1" in capsys.readouterr().out
    torn.write_bytes(content[:2000])
    with pytest.raises(SourceError, match="no complete revolution"):
        sources.open(torn)


def test_revolutions_of_a_recording_are_merged(drive, tmp_path):
    assert main(["run", str(drive), "--merge", "4", "--out", str(tmp_path)]) == 0
    frames = json.loads((tmp_path / "summary.json").read_text())["frames"]
    assert frames == -(-len(list(sources.open(drive))) // 4)
