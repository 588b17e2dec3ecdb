"""Scan modes of an RPLIDAR: queried from the device; selected by name, by number or by default."""

from dataclasses import dataclass, replace

from slamlab.devices.errors import DeviceNotResponding, ProtocolError, UnsupportedMode
from slamlab.devices.rplidar.requests import Command, Conf, conf, request
from slamlab.devices.rplidar.responses import AnswerType, SampleRate, conf_value
from slamlab.devices.rplidar.scan_stream import DECODERS
from slamlab.simulation.range_scanners import RPLIDARS

CONF_TIMEOUT = 0.5  # of a configuration response [s]
MAX_MODES = 16  # queried at most
# sample periods of a lidar that does not report them, or reports 0 as some S3 do [s]
DEFAULT_PERIODS = {
    AnswerType.SCAN: 508e-6,
    AnswerType.EXPRESS: 254e-6,
    AnswerType.HQ: 127e-6,
    AnswerType.ULTRA: 127e-6,
    AnswerType.DENSE: 31.25e-6,
    AnswerType.ULTRA_DENSE: 31.25e-6,
}
DEFAULT_RANGE = 16.0  # of a lidar that does not report it [m], as in Slamtec's SDK
PLAUSIBLE_PERIODS, PLAUSIBLE_RANGES = (1e-6, 1e-2), (1.0, 1000.0)  # [s], [m]


@dataclass(frozen=True)
class ScanMode:
    """Scan mode with sample ``period`` [s], ``range_max`` [m] and answer type."""

    number: int
    name: str
    period: float
    range_max: float
    answer_type: int

    @property
    def known(self):
        """Whether there is a decoder for the answer type of the mode."""
        return self.answer_type in DECODERS

    def sensor(self, info):
        """Return the SensorModel of a lidar in this mode."""
        similar = RPLIDARS.get(info.short_name) or RPLIDARS["A2" if info.series == "A" else "C1"]
        return replace(similar.model, range_max=self.range_max)


def query_modes(link, info):
    """Query and return the scan modes, among them a standard scan, and the recommended mode."""
    found, typical = [], None
    if info.has_conf:
        try:
            count = query_conf(link, Conf.MODE_COUNT)
            found = [_mode(link, number) for number in range(min(count, MAX_MODES))]
            number = query_conf(link, Conf.TYPICAL_MODE)
            typical = next((mode for mode in found if mode.number == number), None)
        except (ProtocolError, DeviceNotResponding):
            link.stop_and_drain()  # the firmware does not respond: as with older firmware
            found = []
    if any(mode.answer_type == AnswerType.SCAN for mode in found):
        return found, typical or found[0]
    rate = _sample_rate(link)
    legacy = [ScanMode(0, "Standard", rate.standard, DEFAULT_RANGE, AnswerType.SCAN)]
    if not found and info.has_express:
        legacy.append(ScanMode(0, "Express", rate.express, DEFAULT_RANGE, AnswerType.EXPRESS))
    return found + legacy, typical or legacy[-1]


def select_mode(modes, typical, wanted):
    """Select a scan mode by name or number, and return the mode and a warning (or "").

    ``wanted`` None: the recommended mode. The standard scan replaces a mode whose answer type has
    no decoder. Raises UnsupportedMode.
    """
    mode = typical if wanted is None else _find(modes, wanted)
    if mode is None:
        raise UnsupportedMode(
            f"this lidar has no scan mode {wanted!r}",
            "the scan modes depend on the model and the firmware",
            f"choose one of: {', '.join(mode.name for mode in modes if mode.known)}",
        )
    if mode.known:
        return mode, ""
    reason = f"scan mode {mode.name} sends data of an unknown type (0x{mode.answer_type:02X})"
    return standard_mode(modes, reason)


def standard_mode(modes, reason):
    """Return the standard scan as a fallback, and a warning that states the reason."""
    mode = next(mode for mode in modes if mode.answer_type == AnswerType.SCAN)
    return mode, f"{reason}: the standard scan is used instead"


def _find(modes, wanted):
    matches = [m for m in modes if wanted == m.number or str(wanted).lower() == m.name.lower()]
    return min(matches, key=lambda mode: not mode.known, default=None)


def _mode(link, number):
    us, range_max, answer, name = (
        query_conf(link, what, number)
        for what in (Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE, Conf.ANSWER_TYPE, Conf.NAME)
    )
    return ScanMode(number, name, *plausible(us, range_max, answer), answer)


def plausible(us, range_max, answer):
    """Return sample period [s] and range [m]; defaults replace implausible or missing values."""
    period, (low, high) = (us or 0) * 1e-6, PLAUSIBLE_PERIODS
    if not low <= period <= high:
        period = DEFAULT_PERIODS.get(answer, DEFAULT_PERIODS[AnswerType.SCAN])
    low, high = PLAUSIBLE_RANGES
    return period, range_max if low <= (range_max or 0) <= high else DEFAULT_RANGE


def _sample_rate(link):
    data = request(Command.GET_SAMPLERATE)
    _, answer = link.query(data, AnswerType.SAMPLERATE, CONF_TIMEOUT, length=4)
    if answer is not None:
        return SampleRate.unpack(answer[1])
    return SampleRate(DEFAULT_PERIODS[AnswerType.SCAN], DEFAULT_PERIODS[AnswerType.EXPRESS])


def query_conf(link, what, mode=None):
    """Query a configuration value from the lidar. Raises DeviceNotResponding, ProtocolError."""
    _, found = link.query(conf(what, mode), AnswerType.CONF, CONF_TIMEOUT)
    if found is None:
        raise DeviceNotResponding(
            f"the lidar does not respond to configuration request 0x{what:02X}",
            "the firmware is older than this request",
            "use the standard scan",
        )
    return conf_value(what, found[1])
