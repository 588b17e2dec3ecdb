"""Handshake with an RPLIDAR: device information, health status, connection attempts."""

from slamlab.devices.errors import DeviceFault, DeviceNotResponding, UnexpectedDescriptor
from slamlab.devices.rplidar.requests import Command, request
from slamlab.devices.rplidar.responses import AnswerType, Health, Info
from slamlab.devices.transport import TCP_PREFIX

MAX_ATTEMPTS = 3  # of a request without a response
TIMEOUT = 1.0  # of a response [s]
# of a response and of draining, in each pass of the baud-rate detection [s]
DETECTION_TIMEOUTS = 0.3, 0.6, TIMEOUT
# of Slamtec's models [bit/s]: A1, A2M6, A2M8; A2M7, A2M12, A3, S1; C1; S2, S3
BAUD_RATES = 115200, 256000, 460800, 1000000


def connection_attempts(name, baud):
    """Return each attempt's (timeout [s], baud rate); ``baud`` None: try several baud rates."""
    if baud is None and not name.startswith(TCP_PREFIX):
        return [(timeout, rate) for timeout in DETECTION_TIMEOUTS for rate in BAUD_RATES]
    return [(TIMEOUT, baud or BAUD_RATES[0])] * MAX_ATTEMPTS


def identify(link, timeout, detecting=False):
    """Stop the scan, request the device's Info and return it, or None if there is no response.

    ``detecting``: whether the baud rate is unknown; a device that keeps sending gets no request.
    """
    quiet = link.stop_and_drain(timeout) if detecting else link.stop_and_drain()
    if detecting and not quiet:
        return None
    _, found = link.query(request(Command.GET_INFO), AnswerType.INFO, timeout, length=20)
    return None if found is None else Info.unpack(found[1])


def not_responding_error(name, received, bauds):
    """Return DeviceNotResponding with a likely cause that is derived from the received bytes."""
    what = f"no RPLIDAR responds on {name}"
    if not name.startswith(TCP_PREFIX):
        what += f" at {', '.join(map(str, bauds))} baud"
    if b"\xaa\x55" in received:
        return DeviceNotResponding(
            f"{what}; the received frames begin with AA 55",
            "the device is a lidar from another manufacturer, such as a YDLIDAR",
            "connect an RPLIDAR",
        )
    if received:
        return DeviceNotResponding(
            f"{what}; bytes are received, such as {received[-8:].hex(' ')}, but no response",
            "the baud rate is wrong, or the port belongs to another device",
            f"check the port; {_other_rate(name, bauds)}",
        )
    return DeviceNotResponding(
        f"{what}; no bytes are received",
        "the lidar has no power, the cable carries only power, or the port belongs to another "
        "device",
        "check that the device's light is on, try another USB cable, and check the port"
        + (f"; {_other_rate(name, bauds)}" if len(bauds) == 1 else ""),
    )


def _other_rate(name, bauds):
    if len(bauds) == 1:
        return f"specify the port without a baud rate, as {name}, to try the rates {BAUD_RATES}"
    return f"to set a baud rate, append it to the port, as in {name}@230400"


def query_health(link):
    """Request and return the device's Health. Raises UnexpectedDescriptor."""
    for _ in range(MAX_ATTEMPTS):
        finder, found = link.query(
            request(Command.GET_HEALTH), AnswerType.HEALTH, TIMEOUT, length=3
        )
        if found is not None:
            return Health.unpack(found[1])
        link.stop_and_drain()
    others = ", ".join(f"0x{d.type:02X}" for d in finder.others) or "none"
    raise UnexpectedDescriptor(
        f"the lidar identifies itself, but does not report its health (other responses: {others})",
        "bytes are lost on the line because of a long cable or a hub",
        "plug the lidar directly into the computer and try again",
    )


def check_health(link):
    """Check and return the health of a device; after a protection stop, first reset it once.

    Raises DeviceFault, UnexpectedDescriptor.
    """
    health = query_health(link)
    if health.status == 2:
        link.reset()
        health = query_health(link)
    if health.status == 2:
        fault = DeviceFault(
            f"the lidar reports the health {health}, even after a reset",
            "the motor is blocked, or the power supply is too weak",
            "unplug the power, check that the motor turns freely, and reconnect the power; "
            "Slamtec's support can explain the code",
        )
        fault.health = health
        raise fault
    return health
