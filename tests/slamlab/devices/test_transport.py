"""Ports: real ones where the system has pseudo-terminals, TCP, and the message when none opens."""

import contextlib
import errno
import os
import socket
import sys
from types import SimpleNamespace

import pytest

from slamlab.devices.errors import (
    ConnectionLost,
    DataTimeout,
    DeviceFault,
    DeviceNotResponding,
    DeviceSilent,
    PortBusy,
    PortError,
    PortNotFound,
    PortPermission,
    ProtocolError,
    SlamlabError,
    UnsupportedMode,
)
from slamlab.devices.serial_ports import (
    find_lidar_port,
    find_port,
    serial_open_error,
    split_baud,
    usb_identity,
)
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
    with pytest.raises(PortBusy, match="another program"):
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
    with pytest.raises(ConnectionLost):
        for _ in range(3):
            port.read(10, 0.1)
    port.close()


@terminals
def test_reading_a_closed_port_raises_connection_lost(terminal):
    port = open_port(terminal[1])
    assert port.set_dtr(True) in (True, False)  # a terminal may have no modem lines
    port.close()
    for use in (lambda: port.read(1, 0.1), lambda: port.write(b"x")):
        with pytest.raises(ConnectionLost):
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
    with pytest.raises(ConnectionLost):
        port.read(10, 5.0)
    port.close()
    port.close()
    with pytest.raises(ConnectionLost):
        port.read(10, 0.1)
    server.close()
    with pytest.raises(PortNotFound, match="emulator"):
        open_port(name)


@pytest.mark.parametrize("name", ["socket://here", "socket://here:there", "socket://x:99999999"])
def test_a_tcp_name_that_is_invalid_is_refused(name):
    with pytest.raises(PortError, match="What to do:"):
        open_port(name)


def test_a_port_that_is_not_there_is_named_with_those_that_are():
    with pytest.raises(PortNotFound, match="Available ports"):
        open_port("/dev/ttyNOSUCH0")


@pytest.mark.parametrize(
    ("error", "kind"),
    [
        (OSError(errno.EACCES, "denied"), PortPermission),
        (OSError(errno.EAGAIN, "locked"), PortBusy),
        (OSError(errno.EBUSY, "busy"), PortBusy),
        (OSError(errno.ENOENT, "none"), PortNotFound),
        (OSError("could not open port 'COM7': FileNotFoundError(2, …)"), PortNotFound),
        (OSError(errno.ENOTTY, "no terminal"), PortError),
        (ValueError("Invalid baud rate"), PortError),
    ],
)
def test_a_refusal_is_of_its_kind_and_states_what_to_do(error, kind):
    refused = serial_open_error("/dev/x", error)
    assert type(refused) is kind
    assert refused.cause in str(refused) and refused.step in str(refused)


def test_on_windows_a_busy_port_is_not_reported_as_permission_denied(monkeypatch):
    monkeypatch.setattr(sys, "platform", "win32")
    error = OSError("could not open port 'COM3': PermissionError(13, 'Access is denied.')")
    assert type(serial_open_error("COM3", error)) is PortBusy

    text = "Cannot configure port, something went wrong. Original message: PermissionError(13, '')"
    assert type(serial_open_error("COM3", OSError(text))) is PortError  # the baud rate is unknown


@terminals
def test_an_unsupported_baud_rate_is_refused(terminal):
    with pytest.raises(PortError, match="does not support the baud rate") as refused:
        open_port(terminal[1], 10**30)
    assert type(refused.value) is PortError


def test_errors_are_of_python_s_kinds_too():
    assert issubclass(PortError, OSError) and issubclass(PortNotFound, FileNotFoundError)
    assert issubclass(ConnectionLost, ConnectionError)
    assert issubclass(DataTimeout, TimeoutError) and issubclass(DeviceNotResponding, TimeoutError)
    assert issubclass(DeviceSilent, ConnectionLost) and issubclass(DeviceSilent, DataTimeout)
    for kind in (PortError, ProtocolError, DeviceFault, ConnectionLost, UnsupportedMode):
        assert issubclass(kind, SlamlabError)


KINDS = [(0x10C4, 0xEA60), (0x1A86, 0x7523), (0x1A86, 0x55D4), (0x0403, 0x6001), (0x0403, 0x6015)]


def plugged(device, location=None, kind=KINDS[0], serial="0001", description=""):
    """A port as pyserial lists it, with the USB socket that it is in."""
    vid, pid = kind
    more = {"location": location, "serial_number": serial, "description": description}
    return SimpleNamespace(device=device, vid=vid, pid=pid, **more)


SERIAL_PORT = plugged("/dev/ttyS0", kind=(None, None), serial=None)


def test_a_replugged_adapter_is_identified_by_its_serial_number():
    first, other = plugged("/dev/ttyUSB0", serial="7"), plugged("/dev/ttyUSB0")
    known = usb_identity("/dev/ttyUSB0", [first, plugged("/dev/ttyUSB1")])
    again = [plugged("/dev/ttyUSB2", serial="7"), other]
    assert find_port(known, again) == "/dev/ttyUSB2"
    assert find_port(known, [plugged("/dev/ttyUSB0", serial="8")]) is None
    assert usb_identity("/dev/x", [other]) is None and find_port(None, [other]) is None


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("device", ["/dev/ttyUSB3", "/dev/cu.usbserial-1420", "COM7"])
def test_every_adapter_that_rplidars_come_with_is_found_under_any_system_s_names(kind, device):
    others = [plugged("/dev/ttyACM0", "1-1", (0x2341, 0x43)), SERIAL_PORT]
    assert find_lidar_port([*others, plugged(device, "1-2", kind, None)]) == device


def test_one_of_several_adapters_must_be_named():
    found = [plugged("COM3", "1-2", description="CP2102"), plugged("COM4", "1-3", KINDS[1])]
    with pytest.raises(PortNotFound) as refused:
        find_lidar_port(found)
    assert refused.value.what == "2 ports may belong to the lidar: COM3 (CP2102), COM4"
    assert "specify one" in refused.value.step
    with pytest.raises(PortNotFound, match=r"no USB adapter.*Available ports: /dev/ttyS0"):
        find_lidar_port([SERIAL_PORT])


def test_an_adapter_that_macos_lists_twice_is_one():
    names = "/dev/cu.SLAB_USBtoUART", "/dev/cu.usbserial-0001"
    found = [plugged(name, "20-2") for name in names]
    assert find_lidar_port(found) == names[0]
    identity = usb_identity(names[1], found)
    assert identity.unique and find_port(identity, found[1:]) == names[1]


def test_two_adapters_with_one_serial_number_are_distinguished_by_their_sockets():
    lidar, robot = plugged("/dev/ttyUSB0", "1-1.2"), plugged("/dev/ttyUSB1", "1-1.3")
    known = usb_identity("/dev/ttyUSB0", [lidar, robot])
    assert not known.unique
    assert find_port(known, [robot]) is None  # the lidar is out: the robot's port is not its
    swapped = [plugged("/dev/ttyUSB0", "1-1.3"), plugged("/dev/ttyUSB2", "1-1.2")]
    assert find_port(known, swapped) == "/dev/ttyUSB2"
    assert find_port(known, [plugged("/dev/ttyUSB0", "2-1")]) is None  # it could be either
    # one that was alone may come back in another socket, but beside a twin it could be either
    alone = usb_identity("/dev/ttyUSB0", [lidar])
    assert find_port(alone, [plugged("/dev/ttyUSB5", "2-1")]) == "/dev/ttyUSB5"
    assert find_port(alone, [plugged("/dev/a", "2-1"), plugged("/dev/b", "2-2")]) is None
    assert find_port(alone, [plugged("/dev/a", "2-1"), plugged("/dev/b", "1-1.2")]) == "/dev/b"


def test_an_adapter_without_a_serial_number_is_identified_by_its_socket():
    known = usb_identity("/dev/ttyUSB0", [plugged("/dev/ttyUSB0", "1-2", KINDS[1], None)])
    assert find_port(known, [plugged("/dev/ttyUSB4", "1-2", KINDS[1], None)]) == "/dev/ttyUSB4"
    assert find_port(known, [plugged("/dev/ttyUSB0", "1-3", KINDS[1], None)]) is None


@pytest.mark.parametrize(
    ("name", "device"),
    [
        ("com3", "COM3"),
        ("\\\\.\\COM12", "COM12"),
        ("/dev/tty.usbserial-1", "/dev/cu.usbserial-1"),
    ],
)
def test_a_port_has_several_names(name, device):
    assert usb_identity(name, [plugged(device, "1-2")]).location == "1-2"


@pytest.mark.skipif(os.name != "posix", reason="links take a right there")
def test_a_port_named_by_a_link_is_known(tmp_path):
    (tmp_path / "ttyUSB0").touch()
    (tmp_path / "rplidar").symlink_to(tmp_path / "ttyUSB0")
    found = [plugged(str(tmp_path / "ttyUSB0"), "1-2")]
    assert usb_identity(str(tmp_path / "rplidar"), found).location == "1-2"


@pytest.mark.parametrize(
    ("named", "port", "baud"),
    [
        ("/dev/ttyUSB0@256000", "/dev/ttyUSB0", 256000),
        ("COM3", "COM3", None),
        ("@1000000", "", 1000000),
        ("/dev/by@id/x", "/dev/by@id/x", None),
        ("/dev/x@fast", "/dev/x@fast", None),
        ("socket://h:1@9600", "socket://h:1", 9600),
        ("", "", None),
    ],
)
def test_a_baud_rate_can_be_appended_to_a_port(named, port, baud):
    assert split_baud(named) == (port, baud)


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
