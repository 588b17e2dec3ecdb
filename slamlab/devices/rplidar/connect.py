"""What is done with an RPLIDAR before it scans: find it, ask how it is, ask what it can do."""

from dataclasses import dataclass

from slamlab.devices.errors import (
    DeviceFault,
    DeviceNotResponding,
    ProtocolError,
    UnexpectedDescriptor,
)
from slamlab.devices.rplidar.answers import Answer, Health, Info, SampleRate, conf_value
from slamlab.devices.rplidar.requests import Command, Conf, conf, request

TRIES = 3
ANSWER = 1.0  # how long to wait for one [s]
CONF_ANSWER = 0.5  # [s]
KNOWS_EXPRESS = 1, 17  # firmware from which on
KNOWS_CONF = 1, 24
BAUDS = 115200, 256000, 460800, 1000000
USUAL_RATE = SampleRate(508e-6, 254e-6)
USUAL_RANGE = 16.0  # of firmware that cannot be asked [m], as Slamtec's SDK has it


@dataclass(frozen=True)
class Mode:
    """A way to scan: ``period`` from one sample to the next [s], ``range_max`` [m], answer type."""

    number: int
    name: str
    period: float
    range_max: float
    answer: int


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


def modes(link, info):
    """Ask in which ways the device can scan; firmware that cannot be asked has two.

    Parameters
    ----------
    link : Link
    info : Info

    Returns
    -------
    list of Mode, and the Mode that the device recommends
    """
    if info.firmware >= KNOWS_CONF:
        try:
            count = _conf(link, Conf.MODE_COUNT)
            found = [_mode(link, number) for number in range(min(count, 16))]
            typical = _conf(link, Conf.TYPICAL_MODE)
            if found:
                return found, found[typical if typical < len(found) else 0]
        except (ProtocolError, DeviceNotResponding):
            link.quiet()  # firmware that keeps silent about it: as the older ones
    rate = USUAL_RATE
    _, answer = link.ask(request(Command.GET_SAMPLERATE), Answer.SAMPLERATE, CONF_ANSWER, length=4)
    if answer is not None:
        rate = SampleRate.unpack(answer[1])
    found = [Mode(0, "Standard", rate.standard, USUAL_RANGE, Answer.SCAN)]
    if info.firmware >= KNOWS_EXPRESS:
        found.append(Mode(0, "Express", rate.express, USUAL_RANGE, Answer.EXPRESS))
    return found, found[-1]


def _mode(link, number):
    us, range_max, answer, name = (
        _conf(link, what, number)
        for what in (Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE, Conf.ANSWER_TYPE, Conf.NAME)
    )
    return Mode(number, name, us * 1e-6, range_max, answer)


def _conf(link, what, mode=None):
    _, found = link.ask(conf(what, mode), Answer.CONF, CONF_ANSWER)
    if found is None:
        raise DeviceNotResponding(
            f"the lidar does not answer about its configuration 0x{what:02X}",
            "its firmware is older than that question",
            "use the standard scan",
        )
    return conf_value(what, found[1])
