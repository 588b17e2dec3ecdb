"""Why a port does not open, as errors for beginners: permission denied, port busy, not found."""

import errno
import sys

from slamlab.devices.errors import PortBusy, PortError, PortNotFound, PortPermission
from slamlab.devices.serial_ports import ports

BUSY_ERRNOS = {errno.EBUSY, errno.EAGAIN}  # port in use
NOT_FOUND_ERRNOS = {errno.ENOENT, errno.ENODEV, errno.ENXIO, errno.ENOTDIR}  # no such port
PERMISSION_ERRNOS = {errno.EACCES, errno.EPERM}  # permission denied


def serial_open_error(name, error):
    """Translate the error of opening a serial port: permission, busy, not found.

    Parameters
    ----------
    name : str
    error : OSError or ValueError, from pyserial

    Returns
    -------
    PortError
    """
    code, text = getattr(error, "errno", None), str(error)
    # on Windows pyserial says it in words only, and a port in use is "access denied"
    denied = code in PERMISSION_ERRNOS or "PermissionError" in text
    if code in BUSY_ERRNOS or (denied and sys.platform == "win32"):
        return PortBusy(
            f"the port {name} is in use",
            "another program or another notebook has it open",
            "close that program, or restart the other notebook's kernel",
        )
    if denied:
        return PortPermission(
            f"the port {name} may not be opened by you",
            "your user is not in the group that owns serial ports",
            "run 'sudo usermod -aG dialout $USER' (on Arch: uucp), log out and in again",
        )
    if code in NOT_FOUND_ERRNOS or "FileNotFoundError" in text:
        return PortNotFound(
            f"there is no port {name}",
            "the device is not plugged in, the cable only carries power, or the name is another",
            f"plug it in and look which port appears; there are now: {port_list()}{_macos(name)}",
        )
    return PortError(
        f"the port {name} does not open ({text})",
        "it is no serial port, or its driver does not know the speed",
        f"check the name; there are now: {port_list()}",
    )


def tcp_connect_error(name, error):
    """Translate the error of a TCP connection that was not made.

    Parameters
    ----------
    name : str
    error : OSError or ValueError

    Returns
    -------
    PortError
    """
    kind = PortError if isinstance(error, ValueError) else PortNotFound
    return kind(
        f"{name} cannot be reached ({error})",
        "no emulator runs there, or host and port number are other ones",
        "start the emulator and copy the address that it prints",
    )


def port_list():
    """Serial ports of this machine, as text."""
    return ", ".join(f"{port.device} ({port.description})" for port in ports()) or "none"


def _macos(name):
    if sys.platform == "darwin" and "/tty." in name:
        return f"; on macOS use {name.replace('/tty.', '/cu.')}"
    return ""
