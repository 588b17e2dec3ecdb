"""Decoding of raw recordings into revolutions of the lidar and statuses of eMIR."""

from collections import Counter

from slamlab.devices.emir.frames import Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.errors import ProtocolError
from slamlab.devices.recording.recording_file import EVENT, RX, TX
from slamlab.devices.rplidar.requests import (
    NON_INTERRUPTING,
    SCAN_COMMANDS,
    Command,
    Conf,
    RequestParser,
)
from slamlab.devices.rplidar.responses import (
    AnswerType,
    Info,
    ResponseFinder,
    SampleRate,
    conf_value,
)
from slamlab.devices.rplidar.scan_modes import ScanMode, plausible
from slamlab.devices.rplidar.scan_stream import DECODERS, ScanStream

# answer types of the requests whose single response is decoded here
SINGLE_ANSWERS = {
    Command.GET_INFO: AnswerType.INFO,
    Command.GET_LIDAR_CONF: AnswerType.CONF,
    Command.GET_SAMPLERATE: AnswerType.SAMPLERATE,
}


def revolutions(recording):
    """Yield each Revolution of the lidar; its times refer to the recording's clock."""
    lidar = RecordedLidar(recording.baud("lidar"))
    for record in recording.of("lidar"):
        yield from lidar.feed(record)


def statuses(recording):
    """Yield (time of the last byte [s], Status) for each recorded status."""
    framer = Framer()
    for record in recording.of("emir", RX):
        for content in framer.feed(record.data):
            yield record.time, Status.unpack(content)


class RecordedLidar:
    """Decoder of a recorded lidar that finds ``info`` and ``mode`` in requests and responses.

    ``damage`` counts dropped bytes, failed checksums and resynchronisations.
    """

    def __init__(self, baud):
        self._baud, self._parser = baud, RequestParser()
        self.info = self.mode = self._rate = None
        self._conf, self._damage = {}, Counter()  # reported values by key and mode
        self._asked, self._finder, self._stream, self._gap = None, None, None, False

    @property
    def damage(self):
        return self._damage + (self._stream.decoder.damage if self._stream else Counter())

    def feed(self, record):
        """Process a record and return the revolutions that it completes."""
        try:
            return self._feed(record)
        except ProtocolError:  # corrupted on the line: the driver raised the same error
            self._end_stream()
            return []

    def _end_stream(self):
        self._damage, self._stream = self.damage, None

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
        self._asked = command, payload
        self._end_stream()
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
            self._conf[what, mode] = conf_value(what, payload)
        elif command == Command.GET_INFO and len(payload) == 20:
            self.info = Info.unpack(payload)
        elif command in SCAN_COMMANDS and DECODERS[descriptor.type].size == descriptor.length:
            answer = AnswerType(descriptor.type)
            self.mode = self._mode(answer, asked[0] if asked else 0)
            self._stream = ScanStream(answer, self.mode.period, self._baud, now, self._gap)
            self._gap = False
            return self._stream.feed(finder.rest, now) if finder.rest else []
        return []

    def _mode(self, answer, number):
        """Return the ScanMode of the running scan, given the requested mode number."""
        types = {
            mode: kind for (what, mode), kind in self._conf.items() if what == Conf.ANSWER_TYPE
        }
        if answer == AnswerType.SCAN:
            number = next((mode for mode, kind in types.items() if kind == answer), 0)
        elif number == 0 and types.get(0) != answer:
            number = -1  # legacy capsules of firmware without scan modes
        keys = Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE
        us, range_max = (self._conf.get((key, number)) for key in keys)
        if us is None and self._rate is not None:
            us = 1e6 * (self._rate.standard if answer == AnswerType.SCAN else self._rate.express)
        return ScanMode(number, answer.name, *plausible(us, range_max, answer), answer)
