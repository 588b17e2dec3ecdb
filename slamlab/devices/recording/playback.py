"""A recording played to programs as if the devices were there: answers matched to requests.

Single answers come as long after the request as they did. The streams of both devices run on one
timeline, so that a lidar asked for later than in the recording still fits the robot's odometry.
"""

from collections import deque

import numpy as np

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.recording.exchanges import exchanges, split
from slamlab.devices.recording.records import CHANNELS, RX
from slamlab.devices.rplidar.parser import RequestParser
from slamlab.devices.rplidar.requests import SCANS, Command


class Timeline:
    """Which moment of a recording it is now, for all its devices.

    Parameters
    ----------
    recording : Recording
    speed : float, times as fast as it was
    """

    def __init__(self, recording, speed=1.0):
        if not speed > 0:
            raise ValueError(f"speed is above 0, not {speed}")
        self._speed, self._anchor = speed, None
        begins = [_first_stream(recording, channel) for channel in CHANNELS]
        self._all_there = max((begin for begin in begins if begin is not None), default=0.0)

    def at(self, now):
        """float, the recorded time [s]; −∞ before anything runs."""
        if self._anchor is None:
            return -np.inf
        begin, recorded = self._anchor
        return recorded + (now - begin) * self._speed

    def enter(self, first, last, now):
        """Begin with a stream that goes from a first to a last moment, unless it is under way."""
        if not first <= self.at(now) <= last:
            self._anchor = now, self._all_there if first < self._all_there <= last else first


class Played:
    """What a device sent without end, given as the timeline goes.

    Parameters
    ----------
    timeline : Timeline
    """

    def __init__(self, timeline):
        self._timeline, self._chunks = timeline, deque()

    def begin(self, chunks, now):
        """Give what of (time, bytes) chunks is still to come."""
        self.end()
        if chunks:
            self._timeline.enter(chunks[0][0], chunks[-1][0], now)
            position = self._timeline.at(now)
            self._chunks.extend(chunk for chunk in chunks if chunk[0] >= position)

    def end(self):
        """Give no more."""
        self._chunks.clear()

    def __bool__(self):
        return bool(self._chunks)

    def take(self, now):
        """What has come by now: bytes."""
        position, due = self._timeline.at(now), []
        while self._chunks and self._chunks[0][0] <= position:
            due.append(self._chunks.popleft()[1])
        return b"".join(due)


class LidarPlayback:
    """A recorded RPLIDAR.

    Parameters
    ----------
    recording : Recording
    timeline : Timeline

    ``unanswered`` are requests to which the recording has no answer.
    """

    def __init__(self, recording, timeline):
        self._exchanges = exchanges(recording)
        self._stream = Played(timeline)
        self._parser, self._at, self._answers = RequestParser(), 0, []
        self.unanswered = []

    def feed(self, data, now):
        """Take bytes in, give bytes out: as an emulated device."""
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
        elif command in SCANS:
            descriptor, chunks = split(exchange.came)
            self._answers = [(now, descriptor)]
            self._stream.begin(chunks, now)
        else:
            self._answers = [(now + time - exchange.time, data) for time, data in exchange.came]

    def _match(self, command, payload):
        """The next such exchange, from the start again when there is no further one."""
        later = [*range(self._at, len(self._exchanges)), *range(self._at)]
        for k in later:
            exchange = self._exchanges[k]
            if (exchange.command, exchange.payload) == (command, payload) and exchange.came:
                self._at = k + 1
                return exchange
        return None


class EmirPlayback:
    """A recorded eMIR: it goes its recorded way, whatever it is told.

    Parameters
    ----------
    recording : Recording
    timeline : Timeline
    """

    def __init__(self, recording, timeline):
        self._chunks = [(r.time, r.data) for r in recording.of("emir", RX)]
        self._stream, self._framer = Played(timeline), Framer(COMMAND)

    def feed(self, data, now):
        """Take bytes in, give bytes out: as an emulated device."""
        for opcode, on, _ in self._framer.feed(data):
            if opcode == commands.INFO and on != 1:
                self._stream.end()
            elif opcode == commands.INFO and not self._stream:
                self._stream.begin(self._chunks, now)
        return self._stream.take(now)


def playback(recording, speed=1.0):
    """The devices of a recording.

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
        if exchange.command in SCANS and (chunks := split(exchange.came)[1]):
            return chunks[0][0]
    return None
