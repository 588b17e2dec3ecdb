"""Why a port does not open, said so that a beginner on any system can do something about it."""

import errno
import sys

from slamlab.devices.errors import PortBusy, PortError, PortNotFound, PortPermission
from slamlab.devices.ports import ports

BUSY = {errno.EBUSY, errno.EAGAIN}
ABSENT = {errno.ENOENT, errno.ENODEV, errno.ENXIO, errno.ENOTDIR}
FORBIDDEN = {errno.EACCES, errno.EPERM}


def why_not_open(name, error):
    """The error to raise for a serial port that did not open.

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
    denied = code in FORBIDDEN or "PermissionError" in text
    if code in BUSY or (denied and sys.platform == "win32"):
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
    if code in ABSENT or "FileNotFoundError" in text:
        return PortNotFound(
            f"there is no port {name}",
            "the device is not plugged in, the cable only carries power, or the name is another",
            f"plug it in and look which port appears; there are now: {listed()}{_spelling(name)}",
        )
    return PortError(
        f"the port {name} does not open ({text})",
        "it is no serial port, or its driver does not know the speed",
        f"check the name; there are now: {listed()}",
    )


def why_not_reached(name, error):
    """The error to raise for a TCP connection that was not made.

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


def listed():
    """The serial ports there are, as text."""
    return ", ".join(f"{port.device} ({port.description})" for port in ports()) or "none"


def _spelling(name):
    if sys.platform == "darwin" and "/tty." in name:
        return f"; on macOS use {name.replace('/tty.', '/cu.')}"
    return ""
