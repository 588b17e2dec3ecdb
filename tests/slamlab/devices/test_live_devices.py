"""Live devices as a source: readings, commands, errors in one line."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import devices as drivers
from slamlab import sources
from slamlab.devices.errors import ConnectionLost
from slamlab.geometry import compose
from slamlab.models.parameters import SensorModel
from slamlab.sources import SourceError
from slamlab.sources import live_devices as source
from tests.property_testing import assert_same_pose
from tests.slamlab.devices.ready_devices import ReadyEmir, ReadyLidar, turn

GONE = ConnectionLost("it is gone", "unplugged", "plug it in")


def test_the_odometry_of_a_reading_is_the_motion_between_revolutions():
    ends = [51.0, 51.1, 51.25, 53.0]
    lidar, emir = ReadyLidar([turn(end) for end in ends]), ReadyEmir()
    with source.LiveDevices(lidar, emir) as devices:
        readings = list(devices)
    assert emir.renewed == 4 and lidar.closed and emir.closed  # its watchdog was renewed
    assert [r.time for r in readings] == pytest.approx([0, 0.1, 0.25, 2.0])
    assert_same_pose(readings[0].odometry, np.zeros(3))
    pose = emir.pose_at(ends[0])
    for reading, end in zip(readings[1:], ends[1:], strict=True):
        pose = compose(pose, reading.odometry)
        assert_same_pose(pose, emir.pose_at(end))
    assert np.hypot(*readings[1].odometry[:2]) == pytest.approx(0.01, rel=1e-3)
    assert readings[1].odometry[2] == pytest.approx(np.radians(2))


def test_a_scan_is_in_the_robots_frame_for_any_mounting_angle():
    (straight,) = source.LiveDevices(ReadyLidar([turn(51.0)]))
    (turned,) = source.LiveDevices(ReadyLidar([turn(51.0)]), front=90.0)
    assert straight.scan.valid.all()
    assert np.allclose(straight.scan.angles, -np.radians(np.arange(360)))
    assert np.allclose(turned.scan.angles - straight.scan.angles, np.pi / 2)


def test_revolutions_with_gaps_are_counted_and_kept():
    devices = source.LiveDevices(ReadyLidar([turn(51.0), turn(51.1, complete=False)]))
    assert len(list(devices)) == 2
    assert devices.damage == {"revolutions with a gap": 1}
    again = replace(turn(51.1), after_gap=True)
    devices = source.LiveDevices(ReadyLidar([turn(51.0), again, turn(51.2)]))
    assert len(list(devices)) == 3 and devices.damage == {"reconnections": 1}


def test_it_is_drivable_where_there_is_a_robot():
    emir = ReadyEmir()
    devices = source.LiveDevices(ReadyLidar([turn(51.0)]), emir)
    assert devices.drivable and len(devices) == 0 and devices.name == "devices:lidar,emir"
    assert devices.drive([0.2, -0.3]) is None
    assert emir.driven == [(0.2, -0.3)]
    (reading,) = devices
    assert np.array_equal(reading.control, [0.2, -0.3])
    alone = source.LiveDevices(ReadyLidar([]))
    assert not alone.drivable
    with pytest.raises(SourceError, match="no robot"):
        alone.drive([0, 0])


@pytest.mark.parametrize("command", [None, "fast", [1], [np.nan, 0], [1, 2, 3]])
def test_a_command_that_is_invalid_is_refused(command):
    emir = ReadyEmir()
    with pytest.raises(SourceError, match="command"):
        source.LiveDevices(ReadyLidar([]), emir).drive(command)
    assert not emir.driven


def test_a_connection_lost_meanwhile_is_an_error_of_the_source_in_one_line():
    with pytest.raises(SourceError, match="What to do:") as refused:
        list(source.LiveDevices(ReadyLidar([turn(51.0)], GONE), ReadyEmir()))
    assert "\n" not in str(refused.value)
    emir = ReadyEmir()
    emir.error = GONE
    with pytest.raises(SourceError, match="gone"):
        list(source.LiveDevices(ReadyLidar([turn(51.0)]), emir))


def test_ports_that_do_not_open_are_reported_in_one_line():
    for spec in ("devices:/dev/ttyNOSUCH0,/dev/ttyNOSUCH1", "devices:a,b,c"):
        with pytest.raises(SourceError) as refused:
            sources.open(spec)
        assert "\n" not in str(refused.value)


def test_another_lidar_is_opened_by_its_prefix_and_brings_its_sensor(monkeypatch):
    toy = ReadyLidar([turn(51.0)])
    toy.sensor, asked = SensorModel(range_max=7.0), []
    monkeypatch.setitem(drivers.LIDARS, "toy:", "Toy")
    monkeypatch.setattr(
        drivers, "Toy", lambda port, **how: asked.append(port) or toy, raising=False
    )
    with sources.open("toy:/dev/ttyUSB0") as opened:
        (reading,) = opened
    assert asked == ["/dev/ttyUSB0"] and opened.name == "toy:lidar"
    assert opened.sensor.range_max == reading.scan.range_max == 7.0


def test_the_robot_is_closed_if_the_lidar_does_not_open(monkeypatch):
    emir = ReadyEmir()
    monkeypatch.setattr(source, "Emir", lambda port, **options: emir)
    with pytest.raises(SourceError, match=r"the port .* does not exist"):
        sources.open("devices:/dev/ttyNOSUCH0,e")
    assert emir.closed
