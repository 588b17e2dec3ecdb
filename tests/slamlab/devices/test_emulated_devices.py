"""Emulated devices as a source, and drives of them that were recorded in simulated time."""

import threading

import numpy as np
import pytest

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Calibration
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.emulator.emulated_robot import COUNT_SIZE
from slamlab.devices.emulator.synthetic_recording import record_synthetic_run
from slamlab.devices.errors import PortError
from slamlab.devices.recording import load
from slamlab.devices.recording.decoding import revolutions, statuses
from slamlab.files import SourceError
from slamlab.geometry import between, compose
from slamlab.simulation import worlds
from slamlab.sources import emulated_devices
from tests.property_testing import assert_same_pose

COURSE = [(0.5, 0, 0), (1.5, 50, 0), (1.0, 0, 50), (1.0, 30, 20)]


def rehearsed(path, seed=0):
    return record_synthetic_run(path, worlds.polygon(), np.random.default_rng(seed), COURSE)


@pytest.mark.slow
@pytest.mark.parametrize("tcp", [False, True])
@pytest.mark.usefixtures("busy_machine")
def test_readings_come_through_ports_and_the_truth_is_known_of_each(tcp, monkeypatch):
    if tcp:
        monkeypatch.setattr(emulated_devices, "FALLBACK_ADDRESS", ("127.0.0.1", 0, 0))
    counts = Calibration(path=COUNT_SIZE[0], angle=COUNT_SIZE[1])
    driven, world = np.zeros(3), worlds.polygon()
    with emulated_devices.EmulatedDevices(world, np.random.default_rng(0), counts) as devices:
        for k, reading in enumerate(devices):
            driven = compose(driven, reading.odometry)
            if k == 3:
                devices.drive((0.05, 0.4))  # a circle that touches nothing, however long it takes
            if k == 15:
                devices.drive((0.0, 0.0))
            truth = devices.truth
            if k >= 25 and np.ptp(truth.poses[-5:], axis=0).max() == 0:
                x, y, theta = truth.poses[-1]
                off = world.cast((x, y), theta + reading.scan.angles) - reading.scan.ranges
                # on a busy machine turns of the drive may still be on their way
                if np.nanmedian(np.abs(off)) < 0.02:
                    break
            assert k < 1000
        assert len(truth) == k + 1
        assert truth.times[-1] == pytest.approx(reading.time)
        assert_same_pose(truth.poses[0], np.zeros(3))
        assert np.abs(driven).max() > 0.05 and np.ptp(truth.poses, axis=0).max() > 0.05
    devices.close()
    assert not [t for t in threading.enumerate() if t.name == "emulator"]


def test_in_simulated_time_no_revolution_is_dropped_and_a_run_is_reproducible():
    def driven():
        rng = np.random.default_rng(0)
        with emulated_devices.EmulatedDevices(
            worlds.room(), rng, clock=SimulatedClock()
        ) as devices:
            for k, reading in enumerate(devices):
                if k % 10 == 5:
                    devices.drive((0.2, 0.4 - 0.01 * k))
                if k == 40:
                    return devices.truth.poses, reading
                assert not devices.lidar.stats["revolutions dropped"]

    (poses, last), (again, last_again) = driven(), driven()
    np.testing.assert_array_equal(poses, again)
    np.testing.assert_array_equal(last.scan.ranges, last_again.scan.ranges)
    assert last.time == pytest.approx(4.0, abs=0.02) and np.hypot(*poses[-1, :2]) > 0.5


def test_before_the_first_reading_there_is_no_truth_yet():
    with emulated_devices.EmulatedDevices(worlds.polygon(), np.random.default_rng(0)) as devices:
        assert len(devices.truth) == 0


def test_what_does_not_open_is_reported_in_one_line_and_nothing_runs_on(monkeypatch):
    def refuse(*_, **__):
        raise PortError("it does not open", "a test", "go on")

    monkeypatch.setattr(emulated_devices, "RPLidar", refuse)
    with pytest.raises(SourceError, match="What to do: go on"):
        emulated_devices.EmulatedDevices(worlds.polygon(), np.random.default_rng(0))
    assert not [t for t in threading.enumerate() if t.name == "emulator"]


def test_a_synthetic_recording_is_reproducible_by_its_seed(tmp_path):
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        rehearsed(tmp_path / name, seed)
    a, b, c = (load(tmp_path / name).records for name in "abc")
    assert a == b != c


def test_a_synthetic_recording_is_read_like_a_recording(tmp_path):
    truth = rehearsed(tmp_path / "drive")
    recording = load(tmp_path / "drive")
    assert not recording.truncated
    found = list(revolutions(recording))
    assert len(found) > 20 and all(turn.complete for turn in found[1:])
    odometry = Odometry(Calibration(path=COUNT_SIZE[0], angle=COUNT_SIZE[1]))
    for time, status in statuses(recording):
        odometry.advance(status.path, status.angle, time)
    moved = between(truth.poses[0], truth.poses[-1])
    assert_same_pose(odometry.pose_at(truth.times[-1]), moved, 0.1)  # slip, whole counts, 0.1 s
    scan, at = found[5].scan(), np.searchsorted(truth.times, found[5].times[-1])
    x, y, theta = truth.poses[at]
    off = worlds.polygon().cast((x, y), theta + scan.angles) - scan.ranges
    assert np.nanmedian(np.abs(off)) < 0.02


@pytest.mark.parametrize(("mode", "points"), [(0, 197), (1, 394), (2, 787)])
def test_a_synthetic_recording_has_the_requested_scan_mode(tmp_path, mode, points):
    path, rng = tmp_path / "drive", np.random.default_rng(0)
    record_synthetic_run(path, worlds.polygon(), rng, [(0.5, 0, 0)], mode)
    found = list(revolutions(load(tmp_path / "drive")))
    assert abs(np.median([len(turn) for turn in found]) - points) <= 2
