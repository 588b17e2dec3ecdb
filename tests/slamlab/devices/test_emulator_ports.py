"""Emulators behind real ports: clients of any kind, other people's programs, the command."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import serial

from slamlab.devices.clock import Clock
from slamlab.devices.emulator import emulator_runner
from slamlab.devices.emulator.emulator_runner import EmulatorRunner, run_emulators
from slamlab.devices.emulator.fault_injection import HELP, inject_fault
from slamlab.devices.emulator.pseudo_terminal import BUFFER_SIZE
from slamlab.devices.emulator.tcp_server import TcpServer
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.requests import Command, request
from slamlab.devices.transport import open_port
from slamlab.simulation import worlds
from tests.timeouts import PATIENCE, until

LOCAL = "127.0.0.1", 0, 0
needs_pty = pytest.mark.skipif(os.name != "posix", reason="this system has no pseudo-terminals")
pytestmark = pytest.mark.usefixtures("busy_machine")
ENDS = [pytest.param(None, marks=needs_pty, id="pty"), pytest.param(LOCAL, id="tcp")]


def running(tcp=None, **options):
    return run_emulators(worlds.polygon(), np.random.default_rng(0), tcp, **options)


def test_data_that_no_client_takes_are_dropped_and_counted():
    class Flood:
        def feed(self, data, now):
            return bytes(1 << 22)

    end = TcpServer()
    with EmulatorRunner({"flood": (Flood(), end)}):
        port = open_port(end.name)
        while not end.dropped:
            time.sleep(0.01)
    assert len(end._waiting) <= BUFFER_SIZE
    port.close()


def test_the_emulated_world_pauses_while_the_machine_is_suspended(monkeypatch):
    class Stalling(Clock):
        def now(self):
            return 1e3 * super().now()

    class Watch:
        def feed(self, data, now):
            times.append(now)
            return b""

    times = []
    monkeypatch.setattr(emulator_runner, "Clock", Stalling)
    with EmulatorRunner({"watch": (Watch(), TcpServer())}):
        until(lambda: len(times) > 5)
    assert (np.diff(times) <= emulator_runner.LONGEST_STEP + 1e-9).all()


def test_a_second_client_is_refused():
    with running(LOCAL) as it:
        first = open_port(it.ports["lidar"])
        first.write(request(Command.GET_INFO))
        assert first.read(100, PATIENCE)
        second = open_port(it.ports["lidar"])
        with pytest.raises(ConnectionLost):
            for _ in range(100):
                second.read(100, 0.1)
        first.write(request(Command.GET_INFO))
        assert first.read(100, PATIENCE)
        second.close()
        for _ in range(20):  # who leaves makes room, in the middle of a scan too
            first.write(request(Command.SCAN))
            first.read(7, PATIENCE)
            first.close()
            first = open_port(it.ports["lidar"])
            first.write(request(Command.GET_INFO))
            assert first.read(100, PATIENCE)
        first.close()


# the guide's advice on modem lines, which pseudo-terminals lack
GUIDE = Path(__file__).parents[3] / "docs" / "robots.md"  # not beside the library alone
SHIM = GUIDE.read_text().split("```python\n")[1].split("```")[0] if GUIDE.exists() else ""

ROBOTICIA = (
    SHIM
    + """
import sys
from rplidar import RPLidar
lidar = RPLidar(sys.argv[1])
info = lidar.get_info()
assert info["model"] == 0x28 and info["firmware"] == (1, 29), info
assert lidar.get_health() == ("Good", 0)
for kind in ("normal", "express"):
    sizes = [len(scan) for scan, _ in zip(lidar.iter_scans(kind), range(4))]
    assert min(sizes[1:]) > 100, sizes
    lidar.stop()
    lidar.stop_motor()
lidar.disconnect()
"""
)

PYRPLIDAR = (
    SHIM
    + """
import sys, time
from pyrplidar import PyRPlidar
lidar = PyRPlidar()
lidar.connect(sys.argv[1], 115200, 3)
info, health = lidar.get_info(), lidar.get_health()
assert (info.model, info.firmware_minor, health.status) == (0x28, 29, 0)
assert lidar.get_samplerate().t_standard == 508
assert lidar.get_scan_mode_typical() == 2 and len(lidar.get_scan_modes()) == 3
lidar.set_motor_pwm(660)
time.sleep(1)
starts = lidar.start_scan, lidar.force_scan, *(
    lambda mode=mode: lidar.start_scan_express(mode) for mode in (1, 2)
)
for start in starts:
    points = [point for point, _ in zip(start()(), range(2000))]
    assert sum(point.start_flag for point in points) >= 1
    assert sum(500 < point.distance < 3000 for point in points) > 1500
    lidar.stop()
    time.sleep(0.5)
    port = lidar.lidar_serial._serial
    while port.in_waiting:  # it takes what comes next for the answer
        port.reset_input_buffer()
        time.sleep(0.5)
lidar.set_motor_pwm(0)
lidar.disconnect()
"""
)


@pytest.mark.slow
@needs_pty
@pytest.mark.parametrize(
    ("module", "script"),
    [("rplidar", ROBOTICIA), ("pyrplidar", PYRPLIDAR)],
    ids=["roboticia", "py"],
)
def test_other_peoples_programs_get_info_health_and_scans(module, script):
    pytest.importorskip(module, reason=f"{module} is not installed: see clients.txt")
    with running() as it:
        command = [sys.executable, "-c", script, it.ports["lidar"]]
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
        assert done.returncode == 0, done.stderr[-2000:]
        assert not it["lidar"].line.dropped


def test_faults_are_switched_by_words():
    rng = np.random.default_rng(0)
    with running(LOCAL) as it:
        faults = it["lidar"].faults
        for text in ("flip lidar 0.01", "lose emir 0.5", "stale lidar 33", "silent lidar 0x52"):
            inject_fault(it, text, rng)
        assert (faults.flip, it["emir"].faults.lose) == (0.01, 0.5)
        assert len(faults.stale) == 33 and faults.silent == {0x52}
        for text in ("answer lidar", "stall", "health 2 0x0004", "spin-up 5", "unplug emir"):
            inject_fault(it, text, rng)
        assert faults.stalled and not faults.silent and it["lidar"].health == (2, 4)
        assert it["lidar"].motor.spin_up == 5 and it["emir"].faults.unplugged
        for text in ("run", "plug emir", "blind", "unknown-type"):
            inject_fault(it, text, rng)
        assert faults.blind and faults.unknown_type
        for text in ("see", "known-type"):
            inject_fault(it, text, rng)
        assert not (faults.blind or faults.unknown_type or faults.stalled)
        assert not it["emir"].faults.unplugged
        for text in ("", "stall me", "flip lidar", "flip it 1", "flip lidar 2", "health x 1", "ha"):
            with pytest.raises(ValueError, match="unknown command"):
                inject_fault(it, text, rng)
        assert all(line.split()[0] in HELP for line in HELP.splitlines())


# as the fixture busy_machine does
COMMAND = """
import sys
from slamlab import cli
from slamlab.devices.emir import session
from slamlab.devices.rplidar import scan_stream
session.RECEIVE_TIMEOUT = scan_stream.RECEIVE_TIMEOUT = 30.0
sys.exit(cli.main())
"""


def command(*words):
    """The command line, running; what it prints comes line by line."""
    return subprocess.Popen(
        [sys.executable, "-c", COMMAND, *words],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    )


@pytest.mark.skipif(os.name != "posix", reason="Ctrl-C cannot be sent to one process there")
def test_the_command_prints_its_ports_takes_faults_and_ends_with_ctrl_c():
    process = command("emulate", "--world", "room", "--tcp")
    try:
        ports = dict(process.stdout.readline().split() for _ in range(2))
        assert set(ports) == {"lidar", "emir"}
        process.stdin.write("nonsense\nhealth 1 7\n")
        process.stdin.flush()
        while "unknown command" not in process.stdout.readline():
            pass
        with RPLidar(ports["lidar"]) as lidar:
            assert lidar.info.model == 0x28
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
    assert process.returncode == 0


@needs_pty
def test_terminated_the_command_leaves_no_ports_behind():
    process = command("emulate")
    port = process.stdout.readline().split()[1]
    assert os.path.exists(port)
    process.terminate()
    process.communicate(timeout=PATIENCE)
    assert not os.path.exists(os.path.dirname(port))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--world", "nowhere"], "no world 'nowhere'"),
        (["--firmware", "new"], "--firmware must be two numbers"),
        (["--typical", "5"], "--typical must be 0, 1 or 2"),
        (["--model", "c1", "--typical", "2"], "--typical must be 0 or 1, not 2"),
        (["--model", "a9"], "there is no lidar model 'a9'; available: a1, a2m8, "),
        (["--seed", "-1"], "--seed must not be negative"),
        (["--tcp", "--host", "203.0.113.7"], "the emulator cannot listen"),
        (["--host", "127.0.0.1"], "set a TCP address: add --tcp"),
        (["--tcp", "--fault", "explode"], "unknown command"),
        (["--carried", "--world", "polygon"], "no walk; available: flat, flat-2"),
    ],
)
def test_wrong_words_are_reported_in_a_line(words, message, capsys):
    from slamlab.cli import main

    assert main(["emulate", *words]) == 2
    assert message in capsys.readouterr().err


@needs_pty
def test_a_port_is_raw_from_the_start_and_nothing_comes_back():
    with running() as it:
        port = serial.Serial(it.ports["lidar"], timeout=0.3)
        port.write(b"\xa5\x25\r\n\x03\x04")
        assert port.read(10) == b""
        port.close()
