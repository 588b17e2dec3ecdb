"""A port kept by a process of its own: whatever becomes of the program, the device is at rest."""

import contextlib
import os
import signal
import threading

import pytest

from slamlab.devices.emir import Emir, commands
from slamlab.devices.errors import ConnectionLost, PortNotFound
from slamlab.devices.kept_port import FAREWELLS, KeptPort, opener
from slamlab.devices.port_keeper import DTR, READ, WRITE, Keeper, frame, frames
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.transport import Transport
from tests.devices.conftest import busy_machine  # noqa: F401
from tests.devices.test_emulator_ports import ENDS, command, running
from tests.patience import PATIENCE, until

BYE = b"bye"


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


def keeper(port, silence=1.0):
    """A keeper, what it has told, and its time in a list."""
    told, time = [], [0.0]
    return Keeper(port, BYE, silence, told.append, lambda: time[0]), told, time


def test_frames_of_a_pipe_are_read_again_until_one_is_torn(tmp_path):
    sent = [(WRITE, b"x" * 70), (DTR, b"\1"), (READ, b"")]
    (tmp_path / "pipe").write_bytes(
        b"".join(frame(*each) for each in sent) + frame(READ, b"ab")[:-1]
    )
    with open(tmp_path / "pipe", "rb") as pipe:
        assert list(frames(pipe)) == sent


def test_bytes_go_both_ways():
    port = FakePort(b"in")
    kept, told, _ = keeper(port)
    kept.take(WRITE, b"out")
    kept.step()
    assert port.written == [b"out"] and told == [frame(READ, b"in")]


def test_a_program_that_is_silent_for_too_long_leaves_the_device_at_rest_once():
    port = FakePort()
    kept, _, time = keeper(port)
    for now in (0.0, 5.0):
        time[0] = now
        kept.take(WRITE, b"go")
        time[0] = now + 1.0
        kept.step()
        assert port.written[-1] == b"go"
        for time[0] in (now + 1.1, now + 3.0):
            kept.step()
        assert port.written[-2:] == [b"go", BYE]


def test_what_has_no_such_rule_may_be_silent():
    port = FakePort()
    kept, _, time = keeper(port, None)
    kept.take(WRITE, b"go")
    time[0] = 1e6
    kept.step()
    assert port.written == [b"go"]


def test_the_end_of_the_program_is_the_farewell():
    port = FakePort()
    kept, *_ = keeper(port)
    kept.take(WRITE, b"go")
    kept.close()
    assert port.written == [b"go", BYE] and port.closed


@pytest.mark.parametrize("tcp", ENDS)
@pytest.mark.usefixtures("busy_machine")
def test_drivers_work_through_it_and_closing_leaves_all_at_rest(tcp, monkeypatch):
    monkeypatch.setitem(FAREWELLS, "emir", (FAREWELLS["emir"][0], PATIENCE))
    with running(tcp) as it:
        with (
            Emir(it.ports["emir"], watchdog=None, opener=opener("emir")) as emir,
            RPLidar(it.ports["lidar"], opener=opener("lidar")) as lidar,
        ):
            assert lidar.turn(timeout=PATIENCE).complete
            emir.move(40, 0)
            until(lambda: it.body._speeds.any())
            until(lambda: emir.pose[0] > 0)
        until(lambda: not it.body._speeds.any() and it["lidar"].pwm == 0)
    assert not [t for t in threading.enumerate() if t.name.startswith("hears")]


def test_what_does_not_open_says_why_as_here():
    with pytest.raises(PortNotFound, match="Next: "):
        KeptPort("socket://127.0.0.1:1", 1, b"")


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
def test_a_program_that_is_killed_or_frozen_leaves_its_robot_standing(number):
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
