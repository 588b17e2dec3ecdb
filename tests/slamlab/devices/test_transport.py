"""Transports: bytes go both ways, and a lost connection or a refusal states what to do."""

import contextlib
import errno
import os
import socket
import sys

import pytest

from slamlab.devices import errors
from slamlab.devices.serial_ports import serial_open_error
from slamlab.devices.transport import open_port
from tests.timeouts import PATIENCE

terminals = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")


@pytest.fixture
def terminal():
    """The other end of a pseudo-terminal, and its name."""
    import tty

    other, end = os.openpty()
    tty.setraw(end)
    yield other, os.ttyname(end)
    for fd in (other, end):
        with contextlib.suppress(OSError):
            os.close(fd)


@terminals
def test_bytes_go_both_ways_through_a_terminal(terminal):
    other, name = terminal
    port = open_port(name, 256000)
    os.write(other, b"hello")
    assert port.read(2, 1.0) + port.read(100, 1.0) == b"hello"
    assert port.read(10, 0.01) == b""
    port.write(b"\x00\xa5\x0a")
    assert os.read(other, 10) == b"\x00\xa5\x0a"
    port.close()
    port.close()


@terminals
def test_a_port_belongs_to_one_program_at_a_time(terminal):
    port = open_port(terminal[1])
    with pytest.raises(errors.PortBusy, match="another program"):
        open_port(terminal[1])
    port.close()
    open_port(terminal[1]).close()


@terminals
def test_a_closed_other_end_is_a_lost_connection():
    import tty

    other, end = os.openpty()
    tty.setraw(end)
    port = open_port(os.ttyname(end))
    os.close(end)
    os.close(other)
    with pytest.raises(errors.ConnectionLost):
        for _ in range(3):
            port.read(10, 0.1)
    port.close()


@terminals
def test_reading_a_closed_port_raises_connection_lost(terminal):
    port = open_port(terminal[1])
    assert port.set_dtr(True) in (True, False)  # a terminal may have no modem lines
    port.close()
    for use in (lambda: port.read(1, 0.1), lambda: port.write(b"x")):
        with pytest.raises(errors.ConnectionLost):
            use()
    assert not port.set_dtr(True)


def test_tcp_goes_both_ways_and_its_end_is_a_lost_connection():
    server = socket.create_server(("127.0.0.1", 0))
    name = f"socket://127.0.0.1:{server.getsockname()[1]}"
    port = open_port(name)
    other, _ = server.accept()
    other.sendall(b"hello")
    assert port.read(100, 5.0) == b"hello"
    assert port.read(100, 0.01) == b""
    port.write(b"back")
    assert other.recv(10) == b"back"
    other.close()
    with pytest.raises(errors.ConnectionLost):
        port.read(10, 5.0)
    port.close()
    port.close()
    with pytest.raises(errors.ConnectionLost):
        port.read(10, 0.1)
    server.close()
    with pytest.raises(errors.PortNotFound, match="emulator"):
        open_port(name)


@pytest.mark.parametrize("name", ["socket://here", "socket://here:there", "socket://x:99999999"])
def test_a_tcp_name_that_is_invalid_is_refused(name):
    with pytest.raises(errors.PortError, match="What to do:"):
        open_port(name)


def test_a_port_that_is_not_there_is_named_with_those_that_are():
    with pytest.raises(errors.PortNotFound, match="Available ports"):
        open_port("/dev/ttyNOSUCH0")


@pytest.mark.parametrize(
    ("error", "kind"),
    [
        (OSError(errno.EACCES, "denied"), errors.PortPermission),
        (OSError(errno.EAGAIN, "locked"), errors.PortBusy),
        (OSError(errno.EBUSY, "busy"), errors.PortBusy),
        (OSError(errno.ENOENT, "none"), errors.PortNotFound),
        (OSError("could not open port 'COM7': FileNotFoundError(2, …)"), errors.PortNotFound),
        (OSError(errno.ENOTTY, "no terminal"), errors.PortError),
        (ValueError("Invalid baud rate"), errors.PortError),
    ],
)
def test_a_refusal_is_of_its_kind_and_states_what_to_do(error, kind):
    refused = serial_open_error("/dev/x", error)
    assert type(refused) is kind
    assert refused.cause in str(refused) and refused.step in str(refused)


def test_on_windows_a_busy_port_is_not_reported_as_permission_denied(monkeypatch):
    monkeypatch.setattr(sys, "platform", "win32")
    error = OSError("could not open port 'COM3': PermissionError(13, 'Access is denied.')")
    assert type(serial_open_error("COM3", error)) is errors.PortBusy

    text = "Cannot configure port, something went wrong. Original message: PermissionError(13, '')"
    assert (
        type(serial_open_error("COM3", OSError(text))) is errors.PortError
    )  # the baud rate is unknown


@terminals
def test_an_unsupported_baud_rate_is_refused(terminal):
    with pytest.raises(errors.PortError, match="does not support the baud rate") as refused:
        open_port(terminal[1], 10**30)
    assert type(refused.value) is errors.PortError


def test_errors_are_of_python_s_kinds_too():
    assert issubclass(errors.PortError, OSError) and issubclass(
        errors.PortNotFound, FileNotFoundError
    )
    assert issubclass(errors.ConnectionLost, ConnectionError)
    assert issubclass(errors.DataTimeout, TimeoutError) and issubclass(
        errors.DeviceNotResponding, TimeoutError
    )
    assert issubclass(errors.DeviceSilent, errors.ConnectionLost) and issubclass(
        errors.DeviceSilent, errors.DataTimeout
    )
    for kind in (
        errors.PortError,
        errors.ProtocolError,
        errors.DeviceFault,
        errors.ConnectionLost,
        errors.UnsupportedMode,
    ):
        assert issubclass(kind, errors.SlamlabError)


@terminals
def test_devices_are_closed_when_the_program_ends_or_on_request():
    import subprocess
    import textwrap

    script = textwrap.dedent("""
        import os, signal, sys
        from slamlab.devices.shutdown import close_at_exit
        class Device:
            def __init__(self, name): self.name = name
            def close(self):
                print("closed", self.name, flush=True)
                if self.name == "bad": raise OSError("unplugged")
        kept = [Device("bad"), Device("good")]
        for device in kept: close_at_exit(device)
        if sys.argv[1] == "term": os.kill(os.getpid(), signal.SIGTERM)
    """)
    for how, code in (("exit", 0), ("term", -15)):
        ended = subprocess.run(
            [sys.executable, "-c", script, how], capture_output=True, text=True, timeout=PATIENCE
        )
        assert ended.returncode == code
        assert sorted(ended.stdout.split("\n")[:2]) == ["closed bad", "closed good"]
