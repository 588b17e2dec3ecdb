"""What a recording says: whole turns of the lidar, statuses of eMIR, by the times in the file."""

from slamlab.devices.emir.frames import Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.errors import ProtocolError
from slamlab.devices.recording.records import EVENT, RX, TX
from slamlab.devices.rplidar.answers import Answer, SampleRate, conf_value
from slamlab.devices.rplidar.finder import Finder
from slamlab.devices.rplidar.parser import RequestParser
from slamlab.devices.rplidar.requests import GOES_ON, SCANS, Command, Conf
from slamlab.devices.rplidar.stream import DECODERS, Stream

USUAL = {
    Answer.SCAN: 508e-6,
    Answer.EXPRESS: 254e-6,
    Answer.ULTRA: 127e-6,
    Answer.DENSE: 127e-6,
}
"""Periods of an A2's modes, where a recording does not say [s]."""


def turns(recording):
    """Whole turns of the lidar.

    Parameters
    ----------
    recording : Recording

    Yields
    ------
    Turn, its times on the recording's clock
    """
    listener = LidarListener(recording.baud("lidar"))
    for record in recording.of("lidar"):
        yield from listener.take(record)


def statuses(recording):
    """What eMIR said of itself.

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


class LidarListener:
    """Follows what was asked and answered, to know what the endless answers are.

    Parameters
    ----------
    baud : int [bit/s]
    """

    def __init__(self, baud):
        self._baud, self._parser = baud, RequestParser()
        self._periods, self._rate = {}, None  # by number of the mode, as the lidar said
        self._asked, self._finder, self._stream, self._gap = None, None, None, False

    def take(self, record):
        """Turns that ended with a record: list of Turn."""
        try:
            return self._take(record)
        except ProtocolError:  # damaged on the line: the driver gave up here, too
            self._stream = None
            return []

    def _take(self, record):
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
                return self._answer(*found, record.time)
        return []

    def _request(self, command, payload):
        if command in GOES_ON:
            return
        self._asked, self._stream = (command, payload), None
        kinds = {Command.GET_LIDAR_CONF: Answer.CONF, Command.GET_SAMPLERATE: Answer.SAMPLERATE}
        scans = command in SCANS
        kind = tuple(DECODERS) if scans else kinds.get(command)
        self._finder = None if kind is None else Finder(kind, loop=scans)

    def _answer(self, descriptor, payload, now):
        finder, self._finder = self._finder, None
        command, asked = self._asked
        if command == Command.GET_SAMPLERATE and len(payload) == 4:
            self._rate = SampleRate.unpack(payload)
        elif command == Command.GET_LIDAR_CONF:
            what, mode = (int.from_bytes(asked[a:b], "little") for a, b in ((0, 4), (4, 6)))
            if what == Conf.US_PER_SAMPLE:
                self._periods[mode] = 1e-6 * conf_value(what, payload)
        elif command in SCANS:
            answer = Answer(descriptor.type)
            mode = asked[0] if command == Command.EXPRESS_SCAN and asked else 0
            self._stream = Stream(answer, self._period(answer, mode), self._baud, now, self._gap)
            self._gap = False
            return self._stream.feed(finder.rest, now) if finder.rest else []
        return []

    def _period(self, answer, mode):
        if self._rate is not None:
            return self._rate.standard if answer == Answer.SCAN else self._rate.express
        legacy = mode == 0 and answer != Answer.SCAN  # the first capsules, asked for without a mode
        return USUAL[answer] if legacy else self._periods.get(mode, USUAL[answer])
