"""The watchdog process stops the device however the client program ends."""

import contextlib
import os
import signal
import threading

import pytest

from slamlab.devices.emir import Emir, commands
from slamlab.devices.errors import ConnectionLost, PortNotFound
from slamlab.devices.port_watchdog import DTR, READ, WRITE, PortWatchdog, frame, frames
from slamlab.devices.port_watchdog_client import STOP_COMMANDS, WatchdogPort, opener
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.transport import Transport
from tests.slamlab.devices.conftest import busy_machine  # noqa: F401
from tests.slamlab.devices.test_emulator_ports import ENDS, command, running
from tests.timeouts import PATIENCE, until

STOP = b"stop"


class FakePort(Transport):
    """A port that gives what it is to read and keeps what was written."""

    def __init__(self, *pieces):
        self.pieces, self.written, self.closed = list(pieces), [], False

    def read(self, n, timeout):
        return self.pieces.pop(0) if self.pieces else b""

    def write(self, data):
        self.written.append(data)

    def close(self):
        self.closed = True


def fake_watchdog(port, timeout=1.0):
    """A PortWatchdog, the frames that it sent, and its time in a list."""
    sent, time = [], [0.0]
    return PortWatchdog(port, STOP, timeout, sent.append, lambda: time[0]), sent, time


def test_frames_of_a_pipe_are_read_again_until_one_is_truncated(tmp_path):
    sent = [(WRITE, b"x" * 70), (DTR, b"\1"), (READ, b"")]
    (tmp_path / "pipe").write_bytes(
        b"".join(frame(*each) for each in sent) + frame(READ, b"ab")[:-1]
    )
    with open(tmp_path / "pipe", "rb") as pipe:
        assert list(frames(pipe)) == sent


def test_bytes_pass_in_both_directions_and_without_a_timeout_only_closing_stops():
    port = FakePort(b"in")
    watchdog, sent, time = fake_watchdog(port, None)
    watchdog.handle(WRITE, b"out")
    time[0] = 1e6
    watchdog.step()
    assert port.written == [b"out"] and sent == [frame(READ, b"in")]
    watchdog.close()
    assert port.written == [b"out", STOP] and port.closed


def test_the_stop_command_is_sent_once_after_the_watchdog_timeout():
    port = FakePort()
    watchdog, _, time = fake_watchdog(port)
    for now in (0.0, 5.0):
        time[0] = now
        watchdog.handle(WRITE, b"go")
        time[0] = now + 1.0
        watchdog.step()
        assert port.written[-1] == b"go"
        for time[0] in (now + 1.1, now + 3.0):
            watchdog.step()
        assert port.written[-2:] == [b"go", STOP]


@pytest.mark.parametrize("tcp", ENDS)
@pytest.mark.usefixtures("busy_machine")
def test_drivers_work_through_the_watchdog_and_closing_stops_both_devices(tcp, monkeypatch):
    monkeypatch.setitem(STOP_COMMANDS, "emir", (STOP_COMMANDS["emir"][0], PATIENCE))
    with running(tcp) as it:
        with (
            Emir(it.ports["emir"], watchdog=None, opener=opener("emir")) as emir,
            RPLidar(it.ports["lidar"], opener=opener("lidar")) as lidar,
        ):
            assert lidar.revolution(timeout=PATIENCE).complete
            emir.move(40, 0)
            until(lambda: it.body._speeds.any())
            until(lambda: emir.pose[0] > 0)
        until(lambda: not it.body._speeds.any() and it["lidar"].pwm == 0)
    assert not [t for t in threading.enumerate() if t.name.startswith("receives")]


def test_a_port_that_does_not_open_raises_the_error_of_the_watchdog():
    with pytest.raises(PortNotFound, match="What to do: "):
        WatchdogPort("socket://127.0.0.1:1", 1, b"")


@pytest.mark.parametrize("tcp", ENDS)
@pytest.mark.usefixtures("busy_machine")
def test_a_process_that_is_killed_is_a_lost_connection(tcp):
    with running(tcp) as it:
        port = opener("emir")(it.ports["emir"], 57600)
        with contextlib.closing(port):
            port.process.kill()
            with pytest.raises(ConnectionLost):
                while True:
                    port.read(100, 1.0)
            with pytest.raises(ConnectionLost):
                port.write(commands.stop())


posix = pytest.mark.skipif(os.name != "posix", reason="signals cannot be sent to one there")


@pytest.mark.slow
@posix
@pytest.mark.parametrize("number", ["SIGKILL", "SIGSTOP", "SIGTERM", "SIGINT", "SIGHUP"])
def test_the_robot_stops_when_its_program_is_killed_or_suspended(number):
    pytest.importorskip("tornado")  # slamlab live serves a page
    with running(ENDS[0].values[0]) as it:
        ports = ",".join(it.ports.values())
        live = command("live", f"devices:{ports}", "--no-open")
        try:
            live.stdout.readline()
            live.stdin.write("3, 360\n")
            live.stdin.flush()
            until(lambda: it.body._speeds.any() or live.poll() is not None)
            assert live.poll() is None, live.communicate()
            live.send_signal(getattr(signal, number))
            until(lambda: not it.body._speeds.any())
            if number == "SIGSTOP":
                live.send_signal(signal.SIGCONT)
            else:
                until(lambda: it["lidar"].pwm == 0)
                assert live.wait(PATIENCE) == (-signal.SIGKILL if number == "SIGKILL" else 0)
        finally:
            live.kill()
            live.communicate()
