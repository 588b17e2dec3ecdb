"""Scan modes of an RPLIDAR (standard, express, boost): queried, as model and firmware differ."""

from dataclasses import dataclass

from slamlab.devices.errors import DeviceNotResponding, ProtocolError, UnsupportedMode
from slamlab.devices.rplidar.requests import Command, Conf, conf, request
from slamlab.devices.rplidar.responses import AnswerType, SampleRate, conf_value
from slamlab.devices.rplidar.scan_stream import DECODERS

EXPRESS_SINCE = 1, 17  # firmware (major, minor) from which on
CONF_SINCE = 1, 24  # the same, for GET_LIDAR_CONF
CONF_TIMEOUT = 0.5  # of a configuration response [s]
DEFAULT_SAMPLE_RATE = SampleRate(508e-6, 254e-6)  # of firmware that does not tell it [s]
DEFAULT_RANGE = 16.0  # of firmware that cannot be asked [m], as Slamtec's SDK has it


@dataclass(frozen=True)
class ScanMode:
    """Scan mode: sample ``period`` [s], ``range_max`` [m], answer type."""

    number: int
    name: str
    period: float
    range_max: float
    answer_type: int


def query_modes(link, info):
    """Query the scan modes that the device supports; firmware that cannot be asked has two.

    Parameters
    ----------
    link : Link
    info : Info

    Returns
    -------
    list of ScanMode, and the ScanMode that the device recommends
    """
    if info.firmware >= CONF_SINCE:
        try:
            count = _conf(link, Conf.MODE_COUNT)
            found = [_mode(link, number) for number in range(min(count, 16))]
            typical = _conf(link, Conf.TYPICAL_MODE)
            if found:
                return found, found[typical if typical < len(found) else 0]
        except (ProtocolError, DeviceNotResponding):
            link.stop_and_drain()  # firmware that keeps silent about it: as the older ones
    rate = DEFAULT_SAMPLE_RATE
    data = request(Command.GET_SAMPLERATE)
    _, answer = link.query(data, AnswerType.SAMPLERATE, CONF_TIMEOUT, length=4)
    if answer is not None:
        rate = SampleRate.unpack(answer[1])
    found = [ScanMode(0, "Standard", rate.standard, DEFAULT_RANGE, AnswerType.SCAN)]
    if info.firmware >= EXPRESS_SINCE:
        found.append(ScanMode(0, "Express", rate.express, DEFAULT_RANGE, AnswerType.EXPRESS))
    return found, found[-1]


def select_mode(modes, typical, wanted):
    """Select a scan mode by name or number.

    Parameters
    ----------
    modes : list of ScanMode, those there are
    typical : ScanMode, what the device recommends
    wanted : str or int, by name or number; None for what is recommended, or else the standard scan

    Returns
    -------
    ScanMode

    Raises
    ------
    UnsupportedMode
    """
    known = [mode for mode in modes if mode.answer_type in DECODERS]
    if wanted is None and typical in known:
        return typical
    for mode in known:
        standard = wanted is None and mode.answer_type == AnswerType.SCAN
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
    return ScanMode(number, name, us * 1e-6, range_max, answer)


def _conf(link, what, mode=None):
    _, found = link.query(conf(what, mode), AnswerType.CONF, CONF_TIMEOUT)
    if found is None:
        raise DeviceNotResponding(
            f"the lidar does not answer about its configuration 0x{what:02X}",
            "its firmware is older than that question",
            "use the standard scan",
        )
    return conf_value(what, found[1])
