"""Fault injection through real ports: stale bytes, slow readers, unplugging, blocked motors."""

import time
from contextlib import contextmanager

import numpy as np
import pytest

from slamlab import worlds
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Emir
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.errors import ConnectionLost, DeviceFault
from slamlab.devices.recording import Recorder, load
from slamlab.devices.recording.decoding import turns
from slamlab.devices.recording.recording_file import EVENT
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.responses import AnswerType, Health
from slamlab.devices.transport import open_port
from tests.devices.byte_streams import stream
from tests.devices.test_emulator_ports import ENDS, running
from tests.patience import PATIENCE, until

PERIOD = 0.1  # of a turn [s]
pytestmark = pytest.mark.usefixtures("busy_machine")
both = pytest.mark.parametrize("tcp", ENDS)


@contextmanager
def lidar(tcp, device=None, **options):
    """An emulated lidar behind a port, and our driver."""
    with running(tcp, lidar=device) as it, RPLidar(it.ports["lidar"], **options) as driver:
        yield it, driver


@both
@pytest.mark.parametrize("count", [33, 2000])
def test_stale_bytes_in_flight_are_passed_over(tcp, count):
    with running(tcp) as it:
        it["lidar"].faults.stale = stream(AnswerType.SCAN, 2000)[-count:]
        with RPLidar(it.ports["lidar"]) as driver:
            assert not it["lidar"].faults.stale  # they came, and nothing was asked twice
            assert it["lidar"].requests.count((Command.GET_INFO, b"")) == 1
            assert driver.info.firmware == (1, 29) and driver.health == Health(0, 0)
            assert driver.turn(timeout=PATIENCE).complete


@both
@pytest.mark.parametrize("mode", [AnswerType.SCAN, AnswerType.ULTRA])
def test_a_lidar_that_scans_on_for_a_program_that_died_is_taken_over(tcp, mode):
    with running(tcp, lidar={"scanning": mode}) as it:
        dead = open_port(it.ports["lidar"])
        assert dead.read(300, PATIENCE)
        dead.close()
        with RPLidar(it.ports["lidar"]) as driver:
            assert it["lidar"].requests[0] == (Command.STOP, b"")
            assert driver.turn(timeout=PATIENCE).complete
            assert not driver.stats["bytes dropped"]


@pytest.mark.parametrize("latest", [True, False])
def test_who_takes_half_a_second_a_scan_gets_the_newest_and_the_rest_is_counted(latest):
    it = run_emulators(worlds.polygon(), np.random.default_rng(0), clock=SimulatedClock())
    with RPLidar(it.ports["lidar"], opener=it.opener, clock=it.clock) as driver:
        first = driver.turn()
        number, taken = driver.stats["turns dropped"] + 1, 1
        for _ in range(8):
            it.clock.sleep(0.5)
            made = driver.stats["turns"]
            turn = driver.turn(latest)
            taken += 1
            # which turn it is, its own times tell; two are kept
            this = number + round((turn.times[-1] - first.times[-1]) / PERIOD)
            assert this == made - (0 if latest else 1)
        driver.stop()
        stats = driver.stats
        assert stats["turns"] == 40 + 1 and not stats["bytes dropped"]
        # those not dropped were taken, or passed over, or the last one is kept
        passed, kept = (8, 0) if latest else (0, 1)
        assert stats["turns dropped"] == stats["turns"] - taken - passed - kept


@both
@pytest.mark.parametrize("name", ["lidar", "emir"])
def test_a_plug_pulled_in_mid_scan_is_noticed(tcp, name):
    with running(tcp) as it, Emir(it.ports["emir"]) as emir, RPLidar(it.ports["lidar"]) as driver:
        assert driver.turn(timeout=PATIENCE)
        it[name].faults.unplugged = True
        end = time.monotonic() + PATIENCE
        # how soon, the drivers' tests say in simulated time and the benchmark in real time
        with pytest.raises(ConnectionLost) as lost:
            while time.monotonic() < end:
                driver.turn(timeout=PATIENCE) if name == "lidar" else emir.wait()
        assert lost.value.step


@both
def test_plugged_in_again_the_lidar_scans_on_where_that_is_wanted_and_the_gap_is_marked(
    tcp, tmp_path
):
    with Recorder(tmp_path / "a.raw", {}) as recorder:
        opener = recorder.opener("lidar")
        with lidar(tcp, reconnect=True, opener=opener) as (it, driver):
            driver.start("express")
            assert not driver.turn(timeout=PATIENCE).after_gap
            it["lidar"].faults.unplugged = True
            until(lambda: driver._session.link is None)
            it["lidar"].faults.unplugged = False
            seen = []
            while not (seen and seen[-1].after_gap):
                seen.append(driver.turn(timeout=PATIENCE))
            assert driver.turn(timeout=PATIENCE).complete
            assert driver.stats["reconnects"] == 1 and driver.mode.name == "Express"
    recording = load(tmp_path / "a.raw")
    events = [event.data for event in recording.of("lidar", EVENT)]
    assert sum(event.startswith(b"gap") for event in events) >= 1
    assert [turn.after_gap for turn in turns(recording)].count(True) == 1


@both
def test_plugged_in_again_the_robot_tells_its_way_on_and_stands(tcp):
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


@both
def test_a_lidar_that_protects_itself_is_reset_once_and_scans(tcp):
    with lidar(tcp, {"health": (2, 4)}) as (it, driver):
        assert [command for command, _ in it["lidar"].requests].count(Command.RESET) == 1
        assert driver.health == Health(0, 0)
        assert driver.turn(timeout=PATIENCE).complete


@both
def test_a_lidar_that_stays_ill_is_told_with_its_code_and_its_motor_stops(tcp):
    with running(tcp, lidar={"health": (2, 0x0204), "reset_heals": False}) as it:
        with pytest.raises(DeviceFault, match=r"0x0204.*unplug its power") as refused:
            RPLidar(it.ports["lidar"])
        assert refused.value.health == Health(2, 0x0204)
        until(lambda: it["lidar"].pwm == 0)
