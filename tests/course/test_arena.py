"""Wall follower and arena: no collisions, loop closure after three laps, logs equal to the run."""

import subprocess
import sys
from itertools import accumulate
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest

from course.perturbed_rounding import environment
from course.studies.filter_comparison import with_corners
from slamlab import sources
from slamlab.geometry import compose
from slamlab.simulation import worlds
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator
from slamlab.simulation.wall_follower import WallFollower
from slamlab.sources import Source, arena_runs
from slamlab.sources.arena_runs import LAPS, ArenaRun, data_set
from tests.property_testing import assert_same_pose

FOLLOWER = WallFollower()
PERFECT = DifferentialDrive(base=0.1, tick=1e-9, radius=0.06)


def RNG(seed=0):
    return np.random.default_rng(seed)


def touched(pose, walls, half=0.06):
    """Whether a square robot stands on a wall: some stretch of it is inside of all four sides."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    a, b = ((walls[:, k : k + 2] - pose[:2]) @ [[c, -s], [s, c]] for k in (0, 2))
    with np.errstate(divide="ignore"):
        enter, leave = (-half - a) / (b - a), (half - a) / (b - a)
    first = np.minimum(enter, leave).max(axis=1).clip(0)
    return bool(np.any(first < np.maximum(enter, leave).min(axis=1).clip(max=1)))


@pytest.mark.parametrize(
    ("pose", "is_touched"),
    [
        ((0, 0, 0), False),
        ((0.13, 0, 0), False),
        ((0.15, 0, 0), True),
        ((0.13, 0, np.pi / 4), True),  # its corner
        ((5, 5, 0), False),
    ],
)
def test_a_robot_touches_a_wall_with_its_sides_and_corners(pose, is_touched):
    assert touched(np.array(pose, float), worlds.box((0, 0), (0.4, 0.4)) + 1e-7) == is_touched


class Watched(Simulator):
    poses: ClassVar[list] = []

    def step(self, *command):
        odometry = super().step(*command)
        self.poses.append(self.pose)
        return odometry


@pytest.mark.parametrize("seeds", [4, pytest.param(15, marks=pytest.mark.slow)])
def test_the_follower_never_touches_a_wall(monkeypatch, seeds):
    monkeypatch.setattr(arena_runs, "Simulator", Watched)
    for seed in range(seeds):
        Watched.poses.clear()
        source = ArenaRun(RNG(seed), laps=1)
        assert len(Watched.poses) > 300
        assert not any(touched(pose, source.world.walls) for pose in Watched.poses)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_three_laps_are_closed_with_about_a_hundred_scans_each(seed):
    source = ArenaRun(RNG(seed))
    assert 90 * LAPS < len(source) < 130 * LAPS
    x, y = (source.truth.poses[:, :2] - arena_runs.BOX_CENTRE).T
    round_about = np.unwrap(np.arctan2(y, x))
    clockwise = round_about[0] - round_about[-1]
    assert 2 * np.pi * LAPS <= clockwise < 2 * np.pi * LAPS + 0.5
    assert np.hypot(*source.truth.poses[-1, :2]) < 0.2
    steps = np.hypot(*np.diff(source.truth.poses[:, :2], axis=0).T)
    assert steps.max() < FOLLOWER.step + FOLLOWER.v * FOLLOWER.period + 0.01
    assert np.median(steps) > 0.8 * FOLLOWER.step


def test_every_scan_is_of_ninety_readings_two_degrees_apart_and_none_is_beyond_the_sensor():
    source = ArenaRun(RNG(), laps=1)
    for reading in source:
        np.testing.assert_allclose(np.diff(reading.scan.angles), np.radians(2))
        assert len(reading.scan.ranges) == 90
        assert np.nanmax(reading.scan.ranges, initial=0) <= 0.28
    assert np.all(np.diff(source.truth.times) >= arena_runs.SCAN_SECONDS)


def test_a_perfect_robots_odometry_is_the_truth():
    source = ArenaRun(RNG(3), laps=1, robot=PERFECT)
    pose = np.zeros(3)
    for reading, true in zip(source, source.truth.poses, strict=True):
        pose = compose(pose, reading.odometry)
        assert_same_pose(pose, true, tolerance=1e-5)


DRIVE = """
import sys
import numpy as np
from slamlab.sources.arena_runs import ArenaRun
run = ArenaRun(np.random.default_rng(int(sys.argv[1])), laps=1)
given = list(run)
odometry, ranges = [r.odometry for r in given], [r.scan.ranges for r in given]
np.savez(sys.argv[2], truth=run.truth.poses, odometry=odometry, ranges=ranges)
"""


@pytest.mark.parametrize("seed", [0, 65])
def test_a_drive_is_the_same_on_another_processor(tmp_path, seed):
    runs = []
    for number, env in enumerate([None, environment(1), environment(2)]):
        path = tmp_path / f"{number}.npz"
        subprocess.run([sys.executable, "-c", DRIVE, str(seed), path], env=env, check=True)
        runs.append(np.load(path))
    here, *others = runs
    for there in others:
        for name in here:
            np.testing.assert_allclose(there[name], here[name], rtol=0, atol=1e-9)
        assert any(np.any(here[name] != there[name]) for name in here)  # it does round otherwise


@pytest.mark.parametrize("seeds", [6, pytest.param(20, marks=pytest.mark.slow)])
def test_odometry_strays_farther_with_every_lap(seeds):
    off = []  # square distances from the truth, a lap and three after the start [m²]
    for seed in range(seeds):
        source = ArenaRun(RNG(seed))
        source.scanner = SimpleNamespace(scan=lambda *_: None)  # odometry is read without
        poses = list(accumulate((reading.odometry for reading in source), compose))
        after = [len(source) // 3, -1]
        off.append([np.sum((poses[k] - source.truth.poses[k])[:2] ** 2) for k in after])
    first, third = np.mean(off, axis=0)
    assert third > 1.5 * first > 1.5 * 0.01**2


def test_a_snagged_cable_changes_one_odometry_and_nothing_else():
    free = ArenaRun(RNG(4))
    snagged = free.snagged()
    assert free.snag is None and snagged.snag == data_set(4, snagged=True).snag
    np.testing.assert_array_equal(free.truth.poses, snagged.truth.poses)
    differ = []
    for i, (a, b) in enumerate(zip(free, snagged, strict=True)):
        assert a.time == b.time
        np.testing.assert_array_equal(a.scan.ranges, b.scan.ranges)
        if not np.array_equal(a.odometry, b.odometry):
            differ.append(i)
            gained = abs(b.odometry[2] - a.odometry[2])
    assert differ == [snagged.snag]
    assert len(free) / 3 <= snagged.snag < 2 * len(free) / 3
    assert np.radians(20) < gained < np.radians(40)


def test_a_log_is_the_run_again(tmp_path):
    source = sources.open("sim:arena-snagged", RNG(6))
    sources.write(source, tmp_path / "log.gz")
    log = sources.open(tmp_path / "log.gz")
    assert (log.name, log.robot, log.sensor) == (source.name, source.robot, source.sensor)
    np.testing.assert_array_equal(log.truth.poses, source.truth.poses)
    for a, b in zip(source, log, strict=True):
        assert a.time == b.time
        np.testing.assert_array_equal(a.odometry, b.odometry)
        np.testing.assert_array_equal(a.scan.ranges, b.scan.ranges)


class Corners(Source):
    """The first readings of a run, with their corners."""

    name = "corners"

    def __iter__(self):
        return iter(with_corners(ArenaRun(RNG(2), laps=1))[:30])


def test_a_log_of_corners_keeps_their_covariances(tmp_path):
    sources.write(Corners(), tmp_path / "log")
    seen = 0
    for a, b in zip(Corners(), sources.open(tmp_path / "log"), strict=True):
        for part in ("z", "ids", "R", "bisectors", "convex"):
            wrote, read = (getattr(r.observations, part) for r in (a, b))
            np.testing.assert_array_equal(wrote.ravel(), read.ravel())
        seen += len(a.observations.ids)
    assert seen > 3


def advanced(ranges, follower=FOLLOWER):
    """Pose after one round in which the scanner reads these ranges, the last one for ever."""
    left = list(ranges)
    simulator = Simulator(PERFECT, RNG())
    odometry, seconds = follower.advance(simulator, lambda: left.pop(0) if left[1:] else left[0])
    assert_same_pose(odometry, simulator.pose, tolerance=1e-6)
    return simulator.pose, seconds


def test_far_from_the_wall_it_turns_left_near_it_right_and_in_between_it_keeps_its_step():
    turn = FOLLOWER.omega * FOLLOWER.period
    pose, _ = advanced([0.3, 0.3, 0.26, 0.22])
    assert pose[2] == pytest.approx(3 * turn)
    pose, _ = advanced([0.17, 0.17, 0.22])  # the first reading is asked whether it is too far
    assert pose[2] == pytest.approx(-turn)
    pose, seconds = advanced([0.22])
    np.testing.assert_allclose(pose, [FOLLOWER.step, 0, 0], atol=1e-6)
    assert seconds == pytest.approx(FOLLOWER.step / FOLLOWER.v)
    pose, _ = advanced([0.22, 0.22, 0.22, 0.22, 0.18])  # the wall comes near: it stops short
    assert 0 < pose[0] < FOLLOWER.step


def test_in_the_open_it_reports_that_and_does_not_turn_for_ever():
    with pytest.raises(ValueError, match="no wall was found between"):
        advanced([np.inf])


@pytest.mark.parametrize(
    "settings", [{"near": 0.3}, {"near": 0.0}, {"step": 0.0}, {"v": 0.0}, {"omega": -1.0}]
)
def test_a_follower_that_cannot_follow_is_refused(settings):
    with pytest.raises(ValueError):
        WallFollower(**settings)


def test_less_than_a_lap_is_refused():
    with pytest.raises(ValueError, match="laps"):
        ArenaRun(RNG(), laps=0)
