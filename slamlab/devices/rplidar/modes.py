"""The ways in which an RPLIDAR can scan: asked for, for they differ with model and firmware."""

from dataclasses import dataclass

from slamlab.devices.errors import DeviceNotResponding, ProtocolError, UnsupportedMode
from slamlab.devices.rplidar.answers import Answer, SampleRate, conf_value
from slamlab.devices.rplidar.requests import Command, Conf, conf, request
from slamlab.devices.rplidar.stream import DECODERS

KNOWS_EXPRESS = 1, 17  # firmware from which on
KNOWS_CONF = 1, 24
CONF_ANSWER = 0.5  # how long to wait for one [s]
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


def ask_modes(link, info):
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


def chosen(modes, typical, wanted):
    """The mode that somebody wants.

    Parameters
    ----------
    modes : list of Mode, those there are
    typical : Mode, what the device recommends
    wanted : str or int, by name or number; None for what is recommended, or else the standard scan

    Returns
    -------
    Mode

    Raises
    ------
    UnsupportedMode
    """
    known = [mode for mode in modes if mode.answer in DECODERS]
    if wanted is None and typical in known:
        return typical
    for mode in known:
        standard = wanted is None and mode.answer == Answer.SCAN
        if standard or wanted == mode.number or str(wanted).lower() == mode.name.lower():
            return mode
    raise UnsupportedMode(
        f"this lidar has no scan mode {wanted!r}",
        "modes differ with model and firmware",
        f"take one of: {', '.join(mode.name for mode in known)}",
    )


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
