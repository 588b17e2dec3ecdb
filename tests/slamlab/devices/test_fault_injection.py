"""Slow readers, and unplugged devices behind real ports."""

import numpy as np
import pytest

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Emir
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.errors import PortError
from slamlab.devices.recording import Recorder, load
from slamlab.devices.recording.decoding import revolutions
from slamlab.devices.recording.recording_file import EVENT
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.transport import open_port
from slamlab.simulation import worlds
from tests.slamlab.devices.test_emulator_ports import ENDS, running
from tests.timeouts import PATIENCE, until

PERIOD = 0.1  # of a turn [s]
pytestmark = pytest.mark.usefixtures("busy_machine")
both = pytest.mark.parametrize("tcp", ENDS)


@pytest.mark.parametrize("latest", [True, False])
def test_a_slow_consumer_gets_the_newest_scan_and_drops_are_counted(latest):
    it = run_emulators(worlds.polygon(), np.random.default_rng(0), clock=SimulatedClock())
    with RPLidar(it.ports["lidar"], opener=it.opener, clock=it.clock) as driver:
        first = driver.revolution()
        number, taken = driver.stats["revolutions dropped"] + 1, 1
        for _ in range(8):
            it.clock.sleep(0.5)
            made = driver.stats["revolutions"]
            turn = driver.revolution(latest)
            taken += 1
            # its own times identify the turn; two are kept
            this = number + round((turn.times[-1] - first.times[-1]) / PERIOD)
            assert this == made - (0 if latest else 1)
        driver.stop()
        stats = driver.stats
        assert stats["revolutions"] == 40 + 1 and not stats["bytes dropped"]
        # those not dropped were taken, or passed over, or the last one is kept
        passed, kept = (8, 0) if latest else (0, 1)
        assert stats["revolutions dropped"] == stats["revolutions"] - taken - passed - kept


@both
def test_the_lidar_driver_reconnects_after_replugging_and_marks_the_gap(tcp, tmp_path):
    with Recorder(tmp_path / "a.raw", {}) as recorder:
        opener = recorder.opener("lidar")
        with (
            running(tcp) as it,
            RPLidar(it.ports["lidar"], reconnect=True, opener=opener) as driver,
        ):
            driver.start("express")
            assert not driver.revolution(timeout=PATIENCE).after_gap
            it["lidar"].faults.unplugged = True
            until(lambda: driver._session.link is None)
            with pytest.raises(PortError):
                open_port(it.ports["lidar"])
            it["lidar"].faults.unplugged = False
            seen = []
            while not (seen and seen[-1].after_gap):
                seen.append(driver.revolution(timeout=PATIENCE))
            assert driver.revolution(timeout=PATIENCE).complete
            assert driver.stats["reconnects"] == 1 and driver.mode.name == "Express"
    recording = load(tmp_path / "a.raw")
    events = [event.data for event in recording.of("lidar", EVENT)]
    assert sum(event.startswith(b"gap") for event in events) >= 1
    assert [turn.after_gap for turn in revolutions(recording)].count(True) == 1


@both
def test_the_robot_driver_reconnects_and_the_robot_is_at_rest(tcp):
    with running(tcp) as it, Emir(it.ports["emir"], reconnect=True, watchdog=None) as emir:
        emir.move(40, 0)
        until(lambda: emir.pose[0] > 0.05)
        it["emir"].faults.unplugged = True
        until(lambda: not it._devices["emir"][1].plugged)
        it["emir"].faults.unplugged = False
        until(lambda: emir.stats["reconnects"] == 1 and not it.body._speeds.any())
        x, last = it.body.pose[0], emir.stats["frames"]
        until(lambda: emir.stats["frames"] > last + 2)
        assert emir.error is None
        assert abs(1.03 * emir.pose[0] - x) < 0.02  # with what it drove meanwhile
