"""USB adapters: found by their ids, and found again after replugging."""

import os
from types import SimpleNamespace

import pytest

from slamlab.devices.errors import PortNotFound
from slamlab.devices.serial_ports import find_lidar_port, find_port, split_baud, usb_identity

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
    [("com3", "COM3"), ("\\\\.\\COM12", "COM12"), ("/dev/tty.usbserial-1", "/dev/cu.usbserial-1")],
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
