"""Decoding of raw recordings: revolutions (turns) of the lidar, statuses of eMIR, timestamps."""

from slamlab.devices.emir.frames import Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.errors import ProtocolError
from slamlab.devices.recording.recording_file import EVENT, RX, TX
from slamlab.devices.rplidar.request_parser import RequestParser
from slamlab.devices.rplidar.requests import NON_INTERRUPTING, SCAN_COMMANDS, Command, Conf
from slamlab.devices.rplidar.response_finder import ResponseFinder
from slamlab.devices.rplidar.responses import AnswerType, SampleRate, conf_value
from slamlab.devices.rplidar.scan_stream import DECODERS, ScanStream

DEFAULT_PERIODS = {
    AnswerType.SCAN: 508e-6,
    AnswerType.EXPRESS: 254e-6,
    AnswerType.ULTRA: 127e-6,
    AnswerType.DENSE: 127e-6,
}
"""Sample periods of an A2's modes, where a recording does not tell them [s]."""


SINGLE_ANSWERS = {
    Command.GET_LIDAR_CONF: AnswerType.CONF,
    Command.GET_SAMPLERATE: AnswerType.SAMPLERATE,
}
"""Answer types of the requests whose single answer is decoded here."""


def turns(recording):
    """Decode the whole revolutions (turns) of the lidar.

    Parameters
    ----------
    recording : Recording

    Yields
    ------
    Turn, its times on the recording's clock
    """
    lidar = RecordedLidar(recording.baud("lidar"))
    for record in recording.of("lidar"):
        yield from lidar.feed(record)


def statuses(recording):
    """Decode the statuses of eMIR.

    Parameters
    ----------
    recording : Recording

    Yields
    ------
    float, Status : when its last byte came [s], and what it says
    """
    framer = Framer()
    for record in recording.of("emir", RX):
        for content in framer.feed(record.data):
            yield record.time, Status.unpack(content)


class RecordedLidar:
    """Decoder of a recorded lidar: follows requests and responses to know the scan mode.

    Parameters
    ----------
    baud : int [bit/s]
    """

    def __init__(self, baud):
        self._baud, self._parser = baud, RequestParser()
        self._periods, self._rate = {}, None  # by number of the mode, as the lidar said
        self._asked, self._finder, self._stream, self._gap = None, None, None, False

    def feed(self, record):
        """Decode a record into the revolutions that ended with it: list of Turn."""
        try:
            return self._feed(record)
        except ProtocolError:  # damaged on the line: the driver gave up here, too
            self._stream = None
            return []

    def _feed(self, record):
        if record.kind == TX:
            for request in self._parser.feed(record.data, record.time):
                self._request(*request)
        elif record.kind == EVENT:
            self._gap = self._gap or record.data.startswith(b"gap")
        elif self._stream is not None:
            return self._stream.feed(record.data, record.time)
        elif self._finder is not None:
            found = self._finder.feed(record.data)
            if found is not None:
                return self._response(*found, record.time)
        return []

    def _request(self, command, payload):
        if command in NON_INTERRUPTING:
            return
        self._asked, self._stream = (command, payload), None
        scans = command in SCAN_COMMANDS
        kind = tuple(DECODERS) if scans else SINGLE_ANSWERS.get(command)
        self._finder = None if kind is None else ResponseFinder(kind, loop=scans)

    def _response(self, descriptor, payload, now):
        finder, self._finder = self._finder, None
        command, asked = self._asked
        if command == Command.GET_SAMPLERATE and len(payload) == 4:
            self._rate = SampleRate.unpack(payload)
        elif command == Command.GET_LIDAR_CONF:
            what, mode = (int.from_bytes(asked[a:b], "little") for a, b in ((0, 4), (4, 6)))
            if what == Conf.US_PER_SAMPLE:
                self._periods[mode] = 1e-6 * conf_value(what, payload)
        elif command in SCAN_COMMANDS:
            answer = AnswerType(descriptor.type)
            mode = asked[0] if command == Command.EXPRESS_SCAN and asked else 0
            period = self._period(answer, mode)
            self._stream = ScanStream(answer, period, self._baud, now, self._gap)
            self._gap = False
            return self._stream.feed(finder.rest, now) if finder.rest else []
        return []

    def _period(self, answer, mode):
        if self._rate is not None:
            return self._rate.standard if answer == AnswerType.SCAN else self._rate.express
        legacy = mode == 0 and answer != AnswerType.SCAN  # capsules without a mode
        default = DEFAULT_PERIODS[answer]
        return default if legacy else self._periods.get(mode, default)
