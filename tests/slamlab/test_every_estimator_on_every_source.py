"""Every estimator on every kind of source runs to its end, and is held to the truth."""

from functools import cache
from itertools import islice
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emulator.synthetic_recording import record_synthetic_run
from slamlab.devices.recording import load
from slamlab.devices.recording.decoding import revolutions
from slamlab.estimators.factory import WITHOUT_ODOMETRY
from slamlab.geometry import between
from slamlab.readings import Trajectory
from slamlab.simulation import worlds
from slamlab.sources.base import Source
from slamlab.sources.emulated_devices import EmulatedDevices
from tests.slamlab.formats import carmen_writing as carmen
from tests.slamlab.formats import test_rplidar_text as rplidar_text
from tests.slamlab.formats.room_runs import Drive, ranges

READINGS, MERGED = 20, 5
# farthest from the truth at the end, of estimators that match scans and of the others [m, rad]
MATCHED, FILTERED = (0.05, np.radians(3)), (0.25, np.radians(12))
# of the theses, faults included: they only have to end
AS_PRINTED = ("icp-plain", "walls-foot-points")


class Held(Source):
    """The first readings of a source, held in memory, with the truth as far as they go."""

    def __init__(self, source, truth=None, before=None, most=READINGS):
        super().__init__()
        self.name, self.robot, self.sensor = source.name, source.robot, source.sensor
        self.has_odometry, self.readings = source.has_odometry, []
        for k, reading in enumerate(islice(source, most)):
            if before is not None:
                before(k)
            self.readings.append(reading)
        truth = source.truth if truth is None else truth
        self.truth = Trajectory(truth.times[:most], truth.poses[:most])

    def __len__(self):
        return len(self.readings)

    def __iter__(self):
        return iter(self.readings)


def emulated(commands=None, merge=1, carried=False):
    """Emulated devices, driven by commands {reading: command}."""
    world = worlds.by_name("flat" if carried else "room")
    rng = np.random.default_rng(4)
    with EmulatedDevices(world, rng, clock=SimulatedClock(), carried=carried) as devices:
        devices.merge(merge)

        def drive(k):
            if k in (commands or {}):
                devices.drive(commands[k])

        return Held(devices, before=drive, most=READINGS if merge == 1 else MERGED)


def recorded(merge=1):
    folder = Path(mkdtemp())
    motions = [(0.3, 0, 0), (1.5, 60, 0), (1.5, 20, 40)]
    rng = np.random.default_rng(4)
    driven = record_synthetic_run(folder / "drive.rec", worlds.by_name("room"), rng, motions)
    whole = [turn.times[-1] for turn in revolutions(load(folder / "drive.rec"))]
    with sources.open(folder / "drive.rec") as source:
        source.merge(merge)
        ends = [*whole[merge - 1 :: merge], whole[-1]][:READINGS]
        poses = Drive(driven.times, driven.poses).at(ends)
        most = READINGS if merge == 1 else MERGED
        return Held(source, Trajectory(np.array(ends), poses), most=most)


def written(lines):
    path = Path(mkdtemp()) / "a.log"
    path.write_text("\n".join(lines) + "\n")
    return path


def logged(*messages):
    drive = carmen.DRIVE
    return Held(sources.open(written(messages)), Trajectory(drive.times, drive.poses))


def grabbed():
    lines = rplidar_text.points(rplidar_text.sdk)
    drive, source = rplidar_text.DRIVE, sources.open(written(lines))
    held = Held(source, Trajectory(drive.times, drive.poses))
    # the first and the last turn of such a text are seldom whole
    held.truth = held.truth if len(held) == len(drive.times) else None
    return held


def bagged():
    writing = pytest.importorskip("tests.slamlab.formats.bag_writing", reason="rosbags is absent")
    path, drive = Path(mkdtemp()) / "bag", carmen.DRIVE
    angles = np.linspace(-1.5, 1.5, 181)
    with writing.Bag(path, "mcap") as bag:
        for time, pose in zip(*drive, strict=True):
            bag.scan(time, ranges(pose, angles))
    return Held(sources.open(path), Trajectory(drive.times, drive.poses))


def reading_log():
    path = Path(mkdtemp()) / "a.jsonl.gz"
    sources.write(Held(sources.open("sim:room", np.random.default_rng(3))), path)
    return Held(sources.open(path))


SOURCES = {
    "simulated": lambda: Held(sources.open("sim:room", np.random.default_rng(3))),
    "carried, simulated": lambda: Held(sources.open("sim:flat-carried", np.random.default_rng(3))),
    "emulated, still": emulated,
    "emulated, driving": lambda: emulated({3: (0.15, 0.0)}),
    "emulated, turning": lambda: emulated({3: (0.0, 0.5)}),
    "emulated, merged": lambda: emulated({1: (0.1, 0.2)}, merge=3),
    "emulated, carried": lambda: emulated(carried=True),
    "raw recording": recorded,
    "raw recording, merged": lambda: recorded(merge=3),
    "reading log": reading_log,
    "CARMEN, FLASER": lambda: logged(*carmen.log(carmen.flaser)),
    "CARMEN, ROBOTLASER1": lambda: logged(*carmen.log(carmen.robotlaser)),
    "CARMEN, RAWLASER and ODOM": lambda: logged(*carmen.log(carmen.rawlaser), *carmen.odoms()),
    "RPLIDAR text": grabbed,
    "ROS bag of scans alone": bagged,
}
held = cache(lambda kind: SOURCES[kind]())


@pytest.mark.parametrize("name", estimators.NAMES)
@pytest.mark.parametrize("kind", SOURCES)
def test_an_estimator_runs_to_the_end_and_is_near_the_truth(kind, name):
    source = held(kind)
    if not source.has_odometry and name not in WITHOUT_ODOMETRY:
        with pytest.raises(
            ValueError, match=r"has no odometry, which .* needs; use icp, graph, walls"
        ):
            estimators.make(name, source)
        return
    result = estimators.run(source, estimators.make(name, source))
    poses = result.trajectory.poses
    assert poses.shape == (len(source), 3) and np.isfinite(poses).all()
    assert result.estimator.layers()
    truth = source.truth
    if name in AS_PRINTED or truth is None:
        return
    x, y, turn = between(between(truth.poses[0], truth.poses[-1]), between(poses[0], poses[-1]))
    far, turned = MATCHED if name in WITHOUT_ODOMETRY else FILTERED
    assert np.hypot(x, y) < far and abs(turn) < turned
