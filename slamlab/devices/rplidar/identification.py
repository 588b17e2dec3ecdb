"""Connection handshake with an RPLIDAR: stop a scan, ask device information and health."""

from slamlab.devices.errors import (
    DeviceFault,
    DeviceNotResponding,
    UnexpectedDescriptor,
)
from slamlab.devices.rplidar.requests import Command, request
from slamlab.devices.rplidar.responses import AnswerType, Health, Info

MAX_ATTEMPTS = 3  # of a request without a response
TIMEOUT = 1.0  # of a response [s]
BAUD_RATES = 115200, 256000, 460800, 1000000  # of Slamtec's models [bit/s]


def identify(link):
    """Identify the device: stop its scan and ask its device information.

    Parameters
    ----------
    link : Link

    Returns
    -------
    Info, or None when it did not say
    """
    for _ in range(MAX_ATTEMPTS):
        link.stop_and_drain()
        _, found = link.query(request(Command.GET_INFO), AnswerType.INFO, TIMEOUT, length=20)
        if found is not None:
            return Info.unpack(found[1])
    return None


def not_responding_error(link, bauds):
    """Error for a device that does not identify itself, by what came instead.

    Parameters
    ----------
    link : Link
    bauds : baud rates tried [bit/s]

    Returns
    -------
    DeviceNotResponding
    """
    tried = ", ".join(f"{baud}" for baud in bauds)
    what = f"no RPLIDAR answers on {link.port.name} at {tried} baud"
    if b"\xaa\x55" in link.last_bytes:
        return DeviceNotResponding(
            f"{what}; frames that begin with AA 55 come instead",
            "this is another maker's lidar, such as a YDLIDAR",
            "use an RPLIDAR",
        )
    if link.last_bytes:
        return DeviceNotResponding(
            f"{what}; bytes come, such as {link.last_bytes[-8:].hex(' ')}, but no answer",
            "the speed (baud rate) is another, or this is another device's port",
            f"give its baud, one of {BAUD_RATES}, or baud=None to try them all; check the port",
        )
    return DeviceNotResponding(
        f"{what}; nothing comes at all",
        "no power, a cable that only carries power, or another device's port",
        "check that its light is on, try another USB cable, check the port",
    )


def query_health(link):
    """Ask the device's health.

    Parameters
    ----------
    link : Link

    Returns
    -------
    Health

    Raises
    ------
    UnexpectedDescriptor
    """
    for _ in range(MAX_ATTEMPTS):
        finder, found = link.query(
            request(Command.GET_HEALTH), AnswerType.HEALTH, TIMEOUT, length=3
        )
        if found is not None:
            return Health.unpack(found[1])
        link.stop_and_drain()
    others = ", ".join(f"0x{d.type:02X}" for d in finder.others) or "none"
    raise UnexpectedDescriptor(
        f"the lidar identifies itself, but does not tell its health (other answers: {others})",
        "bytes are lost on the line: a long cable, or a hub",
        "plug it into the computer itself and try again",
    )


def check_health(link):
    """Check the health of a device before it scans; one that protects itself is reset, once.

    Parameters
    ----------
    link : Link

    Returns
    -------
    Health

    Raises
    ------
    DeviceFault, UnexpectedDescriptor
    """
    health = query_health(link)
    if health.status == 2:
        link.reset()
        health = query_health(link)
    if health.status == 2:
        fault = DeviceFault(
            f"the lidar's health is {health}, after a reset too",
            "its motor is blocked or its power is weak; the code tells Slamtec more",
            "unplug its power, see that it turns freely, plug it in again",
        )
        fault.health = health
        raise fault
    return health
