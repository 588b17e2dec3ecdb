"""Emulators behind real ports: our drivers, other people's programs, unplugging."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import serial

from course.source import ROOT
from slamlab import worlds
from slamlab.devices.clock import Clock
from slamlab.devices.emir import Emir
from slamlab.devices.emulator import emulator_runner
from slamlab.devices.emulator.emulator_runner import EmulatorRunner, run_emulators
from slamlab.devices.emulator.fault_injection import HELP, inject_fault
from slamlab.devices.emulator.pseudo_terminal import BUFFER_SIZE
from slamlab.devices.emulator.tcp_server import TcpServer
from slamlab.devices.errors import ConnectionLost, PortError
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.requests import Command, Conf, conf, express, motor_pwm, request
from slamlab.devices.rplidar.responses import AnswerType, Descriptor, Health, Info
from slamlab.devices.transport import open_port
from tests.patience import PATIENCE, until

LOCAL = "127.0.0.1", 0, 0
needs_pty = pytest.mark.skipif(os.name != "posix", reason="this system has no pseudo-terminals")
pytestmark = pytest.mark.usefixtures("busy_machine")
ENDS = [pytest.param(None, marks=needs_pty, id="pty"), pytest.param(LOCAL, id="tcp")]


def running(tcp=None, **options):
    return run_emulators(worlds.polygon(), np.random.default_rng(0), tcp, **options)


@pytest.mark.parametrize("tcp", ENDS)
def test_our_drivers_see_the_room_and_drive_through_it(tcp):
    with (
        running(tcp) as it,
        Emir(it.ports["emir"], watchdog=None) as emir,
        RPLidar(it.ports["lidar"]) as lidar,
    ):
        assert lidar.turn(timeout=PATIENCE).complete
        emir.move(40, 0)
        for _ in range(6):
            lidar.turn(timeout=PATIENCE)
        emir.stop()
        while it.body._speeds.any():
            emir.wait()
        stands = lidar.clock.now()
        while emir.odometry.last_time < stands + 0.1:
            emir.wait()
        turn = next(turn for turn in lidar if turn.times[0] > stands)
        x, y, theta = it.body.pose
        assert x > 0.05 and abs(1.03 * emir.pose[0] - x) < 0.02  # its counts are 1.03 cm
        scan = turn.scan()
        true = it.body.world.cast((x, y), theta + scan.angles)
        off = np.abs(scan.ranges - true)[scan.valid]
        assert np.median(off) < 0.02


def opens(name):
    try:
        open_port(name).close()
    except PortError:
        return False
    return True


@pytest.mark.parametrize("tcp", ENDS)
def test_a_pulled_plug_is_noticed_and_put_in_again_it_has_its_old_name(tcp):
    with running(tcp) as it:
        name = it.ports["lidar"]
        with RPLidar(name) as lidar:
            assert lidar.turn(timeout=PATIENCE)
            it["lidar"].faults.unplugged = True
            with pytest.raises(ConnectionLost):
                while lidar.turn(timeout=PATIENCE):
                    pass
        with pytest.raises(PortError):
            RPLidar(name)
        it["lidar"].faults.unplugged = False
        until(lambda: opens(name))
        with RPLidar(name) as again:
            assert again.turn(timeout=PATIENCE)


@pytest.mark.slow
@pytest.mark.parametrize("tcp", ENDS)
def test_a_client_that_does_not_read_loses_bytes_and_holds_nothing_up(tcp):
    with running(tcp) as it:
        port = open_port(it.ports["lidar"])
        port.write(motor_pwm(660) + request(Command.SCAN))
        if tcp is None:
            until(lambda: it.dropped["lidar"] > 0)
        port.close()
        with RPLidar(it.ports["lidar"]) as lidar:
            assert lidar.turn(timeout=PATIENCE)


class Flood:
    """A device that sends more than any client's buffers hold, at once."""

    def feed(self, data, now):
        return bytes(1 << 22)


def test_what_does_not_fit_is_counted_to_the_byte():
    end = TcpServer()
    with EmulatorRunner({"flood": (Flood(), end)}):
        port = open_port(end.name)
        while not end.dropped:
            time.sleep(0.01)
    assert len(end._waiting) <= BUFFER_SIZE
    port.close()


class Watch:
    """A device that notes what time it is told."""

    def __init__(self):
        self.times = []

    def feed(self, data, now):
        self.times.append(now)
        return b""


def test_while_the_machine_stands_still_so_does_the_emulated_world(monkeypatch):
    class Stalling(Clock):
        def now(self):
            return 1e3 * super().now()

    monkeypatch.setattr(emulator_runner, "Clock", Stalling)
    watch = Watch()
    with EmulatorRunner({"watch": (watch, TcpServer())}):
        until(lambda: len(watch.times) > 5)
    assert (np.diff(watch.times) <= emulator_runner.LONGEST_STEP + 1e-9).all()


def test_a_second_client_is_sent_away():
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
        first.close()
        second.close()


def test_who_leaves_makes_room_at_once_whatever_was_unread():
    with running(LOCAL, lidar={"scanning": AnswerType.SCAN}) as it:
        for _ in range(20):
            port = open_port(it.ports["lidar"])
            port.write(request(Command.GET_INFO))
            assert port.read(100, PATIENCE)
            port.write(request(Command.SCAN))
            port.read(7, PATIENCE)
            port.close()


class Sdk:
    """Slamtec's ultra_simple as it is seen on the wire: asks, and must be answered."""

    def __init__(self, port):
        self.port, self.heard = port, b""

    def ask(self, data, kind, length=None, loop=False, patience=PATIENCE):
        """The payload, hunted for as the SDK does: by A5 5A and what follows."""
        self.port.write(data)
        end = time.monotonic() + patience
        while time.monotonic() < end:
            self.heard += self.port.read(4096, 0.1)
            at = self.heard.find(b"\xa5\x5a")
            found = Descriptor.unpack(self.heard[at : at + 7]) if at >= 0 else None
            if found is None or len(self.heard) < at + 7 + found.length:
                continue
            payload = self.heard[at + 7 : at + 7 + found.length]
            self.heard = b""
            assert (found.type, found.loop) == (kind, loop)
            assert length is None or found.length == length
            return payload
        raise AssertionError(f"{data.hex()} was not answered")

    def info(self):
        return Info.unpack(self.ask(request(Command.GET_INFO), AnswerType.INFO, 20))

    def conf(self, what, mode=None):
        payload = self.ask(conf(what, mode), AnswerType.CONF)
        assert int.from_bytes(payload[:4], "little") == what and len(payload) > 4
        return payload[4:]

    def stop(self):
        self.port.write(request(Command.STOP))
        time.sleep(0.1)
        self.port.write(motor_pwm(0))
        time.sleep(0.01)


@pytest.mark.slow
@pytest.mark.parametrize("tcp", ENDS)
@pytest.mark.parametrize("typical", [0, 1, 2])
def test_the_sdk_s_requests_are_answered_in_every_step(tcp, typical):
    with running(tcp, lidar={"typical": typical}) as it:
        port = open_port(it.ports["lidar"])
        sdk = Sdk(port)
        assert sdk.info().model == 0x28
        flag = sdk.ask(request(Command.GET_ACC_BOARD_FLAG, bytes(4)), AnswerType.ACC_BOARD_FLAG, 4)
        assert flag[0] & 1
        sdk.info()
        health = sdk.ask(request(Command.GET_HEALTH), AnswerType.HEALTH, 3)
        assert Health.unpack(health).status == 0
        pwm = int.from_bytes(sdk.conf(Conf.DESIRED_ROTATION)[2:4], "little")
        port.write(motor_pwm(pwm))
        time.sleep(0.01)
        sdk.stop()
        sdk.info()
        sdk.info()
        mode = int.from_bytes(sdk.conf(Conf.TYPICAL_MODE), "little")
        assert mode == typical
        sdk.stop()
        sdk.info()
        us, _, kind, name = (
            sdk.conf(what, mode)
            for what in (Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE, Conf.ANSWER_TYPE, Conf.NAME)
        )
        assert len(us) == 4 and name.endswith(b"\0")
        sdk.conf(Conf.DESIRED_ROTATION)
        port.write(motor_pwm(pwm))
        time.sleep(0.01)
        scan = request(Command.SCAN) if kind[0] == AnswerType.SCAN else express(mode)
        sizes = {AnswerType.SCAN: 5, AnswerType.EXPRESS: 84, AnswerType.ULTRA: 132}
        sdk.ask(scan, kind[0], sizes[kind[0]], loop=True)
        sdk.stop()
        port.close()


# what the guide says to do about modem lines that pseudo-terminals have not
SHIM = (ROOT / "docs" / "robots.md").read_text().split("```python\n")[1].split("```")[0]

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
def test_other_people_s_programs_get_info_health_and_scans(module, script):
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
        for text in ("run", "plug emir"):
            inject_fault(it, text, rng)
        assert not faults.stalled and not it["emir"].faults.unplugged
        for text in ("", "stall me", "flip lidar", "flip it 1", "flip lidar 2", "health x 1", "ha"):
            with pytest.raises(ValueError, match="no such switch"):
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
def test_the_command_says_its_ports_takes_faults_and_ends_with_ctrl_c():
    process = command("emulate", "--world", "room", "--tcp")
    try:
        ports = dict(process.stdout.readline().split() for _ in range(2))
        assert set(ports) == {"lidar", "emir"}
        process.stdin.write("nonsense\nhealth 1 7\n")
        process.stdin.flush()
        while "no such switch" not in process.stdout.readline():
            pass
        with RPLidar(ports["lidar"]) as lidar:
            assert lidar.info.model == 0x28
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
    assert process.returncode == 0


@needs_pty
def test_told_to_end_the_command_leaves_no_ports_behind():
    process = command("emulate")
    port = process.stdout.readline().split()[1]
    assert os.path.exists(port)
    process.terminate()
    process.communicate(timeout=PATIENCE)
    assert not os.path.exists(os.path.dirname(port))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--world", "nowhere"], "no world 'nowhere'"),
        (["--firmware", "new"], "--firmware is two numbers"),
        (["--typical", "5"], "--typical is 0, 1 or 2"),
        (["--seed", "-1"], "--seed must not be negative"),
        (["--tcp", "--host", "203.0.113.7"], "no emulator can listen"),
        (["--tcp", "--fault", "explode"], "no such switch"),
    ],
)
def test_wrong_words_are_told_in_a_line(words, said, capsys):
    from slamlab.cli import main

    assert main(["emulate", *words]) == 2
    assert said in capsys.readouterr().err


@needs_pty
def test_a_port_is_raw_from_the_start_and_nothing_comes_back():
    with running() as it:
        port = serial.Serial(it.ports["lidar"], timeout=0.3)
        port.write(b"\xa5\x25\r\n\x03\x04")
        assert port.read(10) == b""
        port.close()
