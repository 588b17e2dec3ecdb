"""Serial ports: port enumeration, search for the RPLIDAR's USB adapter, port errors."""

import errno
import os
import sys
from typing import NamedTuple

from serial.tools import list_ports

from slamlab.devices.errors import PortBusy, PortError, PortNotFound, PortPermission

# USB vendor and product ids of the adapters of RPLIDARs; other devices use them as well
LIDAR_USB_IDS = {
    (0x10C4, 0xEA60): "CP210x",
    (0x1A86, 0x7523): "CH340",
    (0x1A86, 0x55D4): "CH9102",
    (0x0403, 0x6001): "FT232",
    (0x0403, 0x6015): "FT231X",
}
BUSY_ERRNOS = {errno.EBUSY, errno.EAGAIN}  # port in use
NOT_FOUND_ERRNOS = {errno.ENOENT, errno.ENODEV, errno.ENXIO, errno.ENOTDIR}  # no such port
PERMISSION_ERRNOS = {errno.EACCES, errno.EPERM}  # permission denied


def ports():
    """Return this computer's serial ports, each as a pyserial ListPortInfo (port enumeration)."""
    return sorted(list_ports.comports(), key=lambda port: port.device)


def split_baud(name):
    """Split ``PORT@BAUD`` into the port and the baud rate; for ``PORT`` alone, the rate is None."""
    port, at, baud = name.rpartition("@")
    return (port, int(baud)) if at and baud.isdecimal() else (name, None)


def find_lidar_port(found=None):
    """Return the name of the port of the only RPLIDAR adapter. Raises PortNotFound."""
    found = ports() if found is None else found
    matches = {}  # by adapter: on macOS two drivers can list one adapter twice
    for port in found:
        if (port.vid, port.pid) in LIDAR_USB_IDS:
            matches.setdefault(_adapter(port), port)
    if len(matches) == 1:
        return next(iter(matches.values())).device
    if matches:
        raise PortNotFound(
            f"{len(matches)} ports may belong to the lidar: {_listed(matches.values())}",
            "several USB adapters of these types are plugged in",
            "specify one of the ports, or unplug the other adapters",
        )
    raise PortNotFound(
        "no USB adapter of an RPLIDAR is plugged in",
        "the cable carries only power, or the adapter's driver is not installed "
        f"({', '.join(LIDAR_USB_IDS.values())})",
        f"try another cable, or specify the port. Available ports: {_listed(found) or 'none'}",
    )


class UsbIdentity(NamedTuple):
    """Serial number or socket of a USB adapter, by which it is found after reconnection."""

    device: tuple  # vendor, product, serial number
    location: str | None  # path of the USB socket
    unique: bool  # whether the serial number is unique: many adapters have none, or 0001


def usb_identity(name, found=None):
    """Return the UsbIdentity of the adapter on a port, or None if there is no USB adapter."""
    found = ports() if found is None else found
    for port in found:
        if port.vid is not None and _same_port(name, port.device):
            duplicates = {_adapter(other) for other in found if _usb(other) == _usb(port)}
            unique = bool(port.serial_number) and len(duplicates) == 1
            return UsbIdentity(_usb(port), _location(port), unique)
    return None


def find_port(identity, found=None):
    """Return the present port of the adapter that has the given UsbIdentity, or None."""
    if identity is None:
        return None
    matches = [
        port for port in (ports() if found is None else found) if _usb(port) == identity.device
    ]
    found_again = [port for port in matches if _location(port) == identity.location is not None]
    if not found_again and identity.unique and len({_adapter(p) for p in matches}) == 1:
        found_again = matches
    return found_again[0].device if found_again else None


def _usb(port):
    return port.vid, port.pid, port.serial_number


def _location(port):
    return getattr(port, "location", None)


def _adapter(port):
    """Return a key that is the same for all ports of one adapter."""
    return *_usb(port), _location(port) or port.device


def _same_port(name, device):
    """Return whether two names denote one port, despite links, case, or tty and cu on macOS."""
    names = [n.removeprefix("\\\\.\\").replace("/tty.", "/cu.").casefold() for n in (name, device)]
    return names[0] == names[1] or os.path.realpath(name) == os.path.realpath(device)


def serial_open_error(name, error):
    """Return the PortError for a pyserial exception: port not found, permission denied or busy."""
    code, text = getattr(error, "errno", None), str(error)
    # on Windows pyserial gives only a text, and a port in use is "access denied"
    speed = text.startswith("Cannot configure port")  # on Windows: an unsupported baud rate
    denied = not speed and (code in PERMISSION_ERRNOS or "PermissionError" in text)
    if code in BUSY_ERRNOS or (denied and sys.platform == "win32"):
        return PortBusy(
            f"the port {name} is in use",
            "another program or another notebook uses the port",
            "close that program, or restart the other notebook's kernel",
        )
    if denied:
        return PortPermission(
            f"permission to open the port {name} is denied",
            "your user is not in the group that owns serial ports",
            "run 'sudo usermod -aG dialout $USER' (on Arch: uucp), then log out and in again",
        )
    if code in NOT_FOUND_ERRNOS or "FileNotFoundError" in text:
        return PortNotFound(
            f"the port {name} does not exist",
            "the device is not plugged in, the cable carries only power, or the name is wrong",
            "plug in the device and check which port appears. "
            f"Available ports: {port_list()}{_macos(name)}",
        )
    return PortError(
        f"the port {name} cannot be opened ({text})",
        "the device is not a serial port, or the driver does not support the baud rate",
        f"check the name. Available ports: {port_list()}",
    )


def tcp_connect_error(name, error):
    """Return the PortError for a failed TCP connection."""
    kind = PortError if isinstance(error, ValueError) else PortNotFound
    return kind(
        f"{name} cannot be reached ({error})",
        "no emulator runs at this address, or the host or the port number is wrong",
        "start the emulator and copy the address that the emulator prints",
    )


def port_list():
    return _listed(ports()) or "none"


def _listed(found):
    return ", ".join(
        f"{port.device} ({port.description})" if port.description else port.device for port in found
    )


def _macos(name):
    if sys.platform == "darwin" and "/tty." in name:
        return f". On macOS, use {name.replace('/tty.', '/cu.')}"
    return ""
