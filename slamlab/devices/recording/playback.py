"""Playback (replay) of a recording as emulated devices: recorded responses to live requests.

Single answers come as long after the request as they did. The streams of both devices run on one
timeline, so that a lidar asked for later than in the recording still fits the robot's odometry.
"""

from collections import deque

import numpy as np

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.recording.recording_file import CHANNELS, RX
from slamlab.devices.recording.request_response import exchanges, split_descriptor
from slamlab.devices.rplidar.request_parser import RequestParser
from slamlab.devices.rplidar.requests import SCAN_COMMANDS, Command


class Timeline:
    """Playback clock shared by all devices: maps the time now to the recorded time.

    Parameters
    ----------
    recording : Recording
    speed : float, times as fast as it was
    """

    def __init__(self, recording, speed=1.0):
        if not speed > 0:
            raise ValueError(f"speed is above 0, not {speed}")
        self._speed, self._reference = speed, None
        begins = [_first_stream(recording, channel) for channel in CHANNELS]
        self._all_streaming = max((begin for begin in begins if begin is not None), default=0.0)

    def recorded_time(self, now):
        """Recorded time [s] at a time now, float; −∞ before anything runs."""
        if self._reference is None:
            return -np.inf
        begin, recorded = self._reference
        return recorded + (now - begin) * self._speed

    def start_stream(self, first, last, now):
        """Jump to a stream that goes from a first to a last time, unless it is being played."""
        if not first <= self.recorded_time(now) <= last:
            together = self._all_streaming
            self._reference = now, together if first < together <= last else first


class PlayedStream:
    """Recorded data stream of a device, played along the timeline.

    Parameters
    ----------
    timeline : Timeline
    """

    def __init__(self, timeline):
        self._timeline, self._chunks = timeline, deque()

    def begin(self, chunks, now):
        """Start to play what of (time, bytes) chunks is still to come."""
        self.end()
        if chunks:
            self._timeline.start_stream(chunks[0][0], chunks[-1][0], now)
            position = self._timeline.recorded_time(now)
            self._chunks.extend(chunk for chunk in chunks if chunk[0] >= position)

    def end(self):
        """Stop playing."""
        self._chunks.clear()

    def __bool__(self):
        return bool(self._chunks)

    def take(self, now):
        """Take the bytes that are due by now."""
        position, due = self._timeline.recorded_time(now), []
        while self._chunks and self._chunks[0][0] <= position:
            due.append(self._chunks.popleft()[1])
        return b"".join(due)


class LidarPlayback:
    """Playback of a recorded RPLIDAR, as an emulated device.

    Parameters
    ----------
    recording : Recording
    timeline : Timeline

    ``unanswered`` are requests to which the recording has no response.
    """

    def __init__(self, recording, timeline):
        self._exchanges = exchanges(recording)
        self._stream = PlayedStream(timeline)
        self._parser, self._at, self._answers = RequestParser(), 0, []
        self.unanswered = []

    def feed(self, data, now):
        """Feed bytes from the client, and return those due by now."""
        for command, payload in self._parser.feed(data, now):
            if command != Command.SET_MOTOR_PWM:  # has no answer, and a scan goes on
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
        """Match a request to the next such exchange, from the start again after the last."""
        later = [*range(self._at, len(self._exchanges)), *range(self._at)]
        for k in later:
            exchange = self._exchanges[k]
            if (exchange.command, exchange.payload) == (command, payload) and exchange.received:
                self._at = k + 1
                return exchange
        return None


class EmirPlayback:
    """Playback of a recorded eMIR: it drives as recorded, whatever it is commanded.

    Parameters
    ----------
    recording : Recording
    timeline : Timeline
    """

    def __init__(self, recording, timeline):
        self._chunks = [(r.time, r.data) for r in recording.of("emir", RX)]
        self._stream, self._framer = PlayedStream(timeline), Framer(COMMAND)

    def feed(self, data, now):
        """Feed bytes from the client, and return those due by now."""
        for opcode, on, _ in self._framer.feed(data):
            if opcode == commands.INFO and on != 1:
                self._stream.end()
            elif opcode == commands.INFO and not self._stream:
                self._stream.begin(self._chunks, now)
        return self._stream.take(now)


def playback(recording, speed=1.0):
    """Play back the devices of a recording.

    Parameters
    ----------
    recording : Recording
    speed : float, times as fast as it was

    Returns
    -------
    dict of LidarPlayback and EmirPlayback by channel, those that were recorded
    """
    timeline, kinds = Timeline(recording, speed), {"lidar": LidarPlayback, "emir": EmirPlayback}
    there = {record.channel for record in recording.records}
    return {name: kinds[name](recording, timeline) for name in CHANNELS if name in there}


def _first_stream(recording, channel):
    """When a device first sent its stream [s], or None."""
    if channel == "emir":
        return next((record.time for record in recording.of("emir", RX)), None)
    for exchange in exchanges(recording):
        if exchange.command in SCAN_COMMANDS and (chunks := split_descriptor(exchange.received)[1]):
            return chunks[0][0]
    return None
