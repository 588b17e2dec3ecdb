"""Playback (replay) of a recording as emulated devices that respond to live requests.

Single responses come after their recorded delays. The streams of both devices share a timeline.
"""

from collections import deque
from dataclasses import dataclass, field

import numpy as np

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.recording.recording_file import CHANNELS, EVENT, RX, TX
from slamlab.devices.rplidar.requests import MOTOR_COMMANDS, SCAN_COMMANDS, Command, RequestParser
from slamlab.devices.rplidar.responses import DESCRIPTOR_SYNC, ResponseFinder
from slamlab.devices.rplidar.scan_stream import DECODERS


@dataclass
class Exchange:
    """A request, and the (time, bytes) chunks received after it and before the next request."""

    command: int
    payload: bytes
    time: float
    received: list = field(default_factory=list)


def exchanges(recording):
    """Return the requests with their responses, but without motor commands."""
    parser, found = RequestParser(), []
    for record in recording.of("lidar"):
        if record.kind == TX:
            for command, payload in parser.feed(record.data, record.time):
                if command not in MOTOR_COMMANDS:
                    found.append(Exchange(command, payload, record.time))
        elif record.kind != EVENT and found:
            found[-1].received.append((record.time, record.data))
    for exchange in found:  # at a wrong baud rate there is no response
        if DESCRIPTOR_SYNC not in b"".join(data for _, data in exchange.received):
            exchange.received = []
    return found


def split_descriptor(received):
    """Split received chunks into a descriptor and the (time, bytes) chunks after it."""
    finder = ResponseFinder(tuple(DECODERS), loop=True)
    for k, (time, data) in enumerate(received):
        if (found := finder.feed(data)) is not None:
            rest = [(time, finder.rest)] if finder.rest else []
            return found[0].pack(), rest + received[k + 1 :]
    return b"", []


class Timeline:
    """Recorded time [s] for all devices; it advances ``speed`` times as fast as real time."""

    def __init__(self, recording, speed=1.0):
        if not speed > 0:
            raise ValueError(f"speed must be positive, not {speed}")
        self._speed, self._reference = speed, None
        begins = [_first_stream(recording, channel) for channel in CHANNELS]
        self._all_streaming = max((begin for begin in begins if begin is not None), default=0.0)

    def recorded_time(self, now):
        """Return the recorded time [s], or −∞ before the first stream starts."""
        if self._reference is None:
            return -np.inf
        begin, recorded = self._reference
        return recorded + (now - begin) * self._speed

    def start_stream(self, first, last, now):
        """Jump to a stream with times ``first`` to ``last`` [s], unless it is already playing."""
        if not first <= self.recorded_time(now) <= last:
            together = self._all_streaming
            self._reference = now, together if first < together <= last else first


class PlayedStream:
    """Data stream of a device, which is replayed along the timeline."""

    def __init__(self, timeline):
        self._timeline, self._chunks = timeline, deque()

    def begin(self, chunks, now):
        """Start to replay the (time, bytes) chunks whose times have not yet been reached."""
        self.end()
        if chunks:
            self._timeline.start_stream(chunks[0][0], chunks[-1][0], now)
            position = self._timeline.recorded_time(now)
            self._chunks.extend(chunk for chunk in chunks if chunk[0] >= position)

    def end(self):
        self._chunks.clear()

    def __bool__(self):
        return bool(self._chunks)

    def take(self, now):
        """Return the bytes of the stream that are due until ``now`` [s]."""
        position, due = self._timeline.recorded_time(now), []
        while self._chunks and self._chunks[0][0] <= position:
            due.append(self._chunks.popleft()[1])
        return b"".join(due)


class LidarPlayback:
    """Recorded RPLIDAR; ``unanswered``: requests without a recorded response."""

    def __init__(self, recording, timeline):
        self._exchanges, self.baud = exchanges(recording), recording.baud("lidar")
        self._stream = PlayedStream(timeline)
        self._parser, self._at, self._answers = RequestParser(), 0, []
        self.unanswered = []

    def feed(self, data, now):
        for command, payload in self._parser.feed(data, now):
            if command not in MOTOR_COMMANDS:  # they do not end a scan
                self._request(command, payload, now)
        due = [data for time, data in self._answers if time <= now]
        self._answers = [(time, data) for time, data in self._answers if time > now]
        return b"".join(due) + (b"" if self._answers else self._stream.take(now))

    def _request(self, command, payload, now):
        self._stream.end()
        self._answers = []
        if command == Command.STOP:
            return
        exchange = self._match(command, payload)
        if exchange is None:
            self.unanswered.append((command, payload))
        elif command in SCAN_COMMANDS:
            descriptor, chunks = split_descriptor(exchange.received)
            self._answers = [(now, descriptor)]
            self._stream.begin(chunks, now)
        else:
            self._answers = [(now + time - exchange.time, data) for time, data in exchange.received]

    def _match(self, command, payload):
        """Return the next exchange with this request, or None; the first follows the last one."""
        later = [*range(self._at, len(self._exchanges)), *range(self._at)]
        for k in later:
            exchange = self._exchanges[k]
            if (exchange.command, exchange.payload) == (command, payload) and exchange.received:
                self._at = k + 1
                return exchange
        return None


class EmirPlayback:
    """Recorded eMIR, which moves as in the recording, whatever commands it receives."""

    def __init__(self, recording, timeline):
        self._chunks = [(r.time, r.data) for r in recording.of("emir", RX)]
        self._stream, self._framer = PlayedStream(timeline), Framer(COMMAND)

    def feed(self, data, now):
        for opcode, on, _ in self._framer.feed(data):
            if opcode == commands.INFO and on != 1:
                self._stream.end()
            elif opcode == commands.INFO and not self._stream:
                self._stream.begin(self._chunks, now)
        return self._stream.take(now)


def playback(recording, speed=1.0):
    """Return a dict of emulated devices that replay a recording at ``speed`` times real time."""
    timeline, kinds = Timeline(recording, speed), {"lidar": LidarPlayback, "emir": EmirPlayback}
    recorded = {record.channel for record in recording.records}
    return {name: kinds[name](recording, timeline) for name in CHANNELS if name in recorded}


def _first_stream(recording, channel):
    """Return the start time of a device's first stream [s], or None if it has no stream."""
    if channel == "emir":
        return next((record.time for record in recording.of("emir", RX)), None)
    for exchange in exchanges(recording):
        if exchange.command in SCAN_COMMANDS and (chunks := split_descriptor(exchange.received)[1]):
            return chunks[0][0]
    return None
