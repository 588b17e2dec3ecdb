"""What is done with an RPLIDAR before it scans: silence it, ask who and how it is."""

from slamlab.devices.errors import (
    DeviceFault,
    DeviceNotResponding,
    UnexpectedDescriptor,
)
from slamlab.devices.rplidar.answers import Answer, Health, Info
from slamlab.devices.rplidar.requests import Command, request

TRIES = 3
ANSWER = 1.0  # how long to wait for one [s]
BAUDS = 115200, 256000, 460800, 1000000


def identify(link):
    """Silence the device and ask who it is.

    Parameters
    ----------
    link : Link

    Returns
    -------
    Info, or None when it did not say
    """
    for _ in range(TRIES):
        link.quiet()
        _, found = link.ask(request(Command.GET_INFO), Answer.INFO, ANSWER, length=20)
        if found is not None:
            return Info.unpack(found[1])
    return None


def not_responding(link, bauds):
    """The error for a device that does not say who it is.

    Parameters
    ----------
    link : Link
    bauds : speeds tried [bit/s]

    Returns
    -------
    DeviceNotResponding
    """
    tried = ", ".join(f"{baud}" for baud in bauds)
    what = f"no RPLIDAR answers on {link.port.name} at {tried} baud"
    if b"\xaa\x55" in link.heard:
        return DeviceNotResponding(
            f"{what}; frames that begin with AA 55 come instead",
            "this is another maker's lidar, such as a YDLIDAR",
            "use an RPLIDAR",
        )
    if link.heard:
        return DeviceNotResponding(
            f"{what}; bytes come, such as {link.heard[-8:].hex(' ')}, but no answer",
            "the speed is another, or this is another device's port",
            f"give its baud, one of {BAUDS}, or baud=None to try them all; check the port",
        )
    return DeviceNotResponding(
        f"{what}; nothing comes at all",
        "no power, a cable that only carries power, or another device's port",
        "check that its light is on, try another USB cable, check the port",
    )


def ask_health(link):
    """Ask how the device is.

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
    for _ in range(TRIES):
        finder, found = link.ask(request(Command.GET_HEALTH), Answer.HEALTH, ANSWER, length=3)
        if found is not None:
            return Health.unpack(found[1])
        link.quiet()
    others = ", ".join(f"0x{d.type:02X}" for d in finder.others) or "none"
    raise UnexpectedDescriptor(
        f"the lidar said who it is, but not how it is (other answers: {others})",
        "bytes are lost on the line: a long cable, or a hub",
        "plug it into the computer itself and try again",
    )


def healthy(link):
    """Health of a device that may scan; one that protects itself is started anew, once.

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
    health = ask_health(link)
    if health.status == 2:
        link.reset()
        health = ask_health(link)
    if health.status == 2:
        fault = DeviceFault(
            f"the lidar's health is {health}, after a reset too",
            "its motor is blocked or its power is weak; the code tells Slamtec more",
            "unplug its power, see that it turns freely, plug it in again",
        )
        fault.health = health
        raise fault
    return health
