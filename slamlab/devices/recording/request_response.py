"""Request/response pairs (exchanges) of a recorded lidar."""

from dataclasses import dataclass, field

from slamlab.devices.recording.recording_file import EVENT, TX
from slamlab.devices.rplidar.request_parser import RequestParser
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.response_finder import ResponseFinder
from slamlab.devices.rplidar.scan_stream import DECODERS


@dataclass
class Exchange:
    """Request and response: what was received, (time, bytes) each, up to the next request."""

    command: int
    payload: bytes
    time: float
    received: list = field(default_factory=list)


def exchanges(recording):
    """Pair the requests with their responses: list of Exchange, without those for the motor."""
    parser, found = RequestParser(), []
    for record in recording.of("lidar"):
        if record.kind == TX:
            for command, payload in parser.feed(record.data, record.time):
                if command != Command.SET_MOTOR_PWM:
                    found.append(Exchange(command, payload, record.time))
        elif record.kind != EVENT and found:
            found[-1].received.append((record.time, record.data))
    return found


def split_descriptor(received):
    """Split scan data into the response descriptor and the (time, bytes) chunks after it."""
    finder = ResponseFinder(tuple(DECODERS), loop=True)
    for k, (time, data) in enumerate(received):
        if (found := finder.feed(data)) is not None:
            rest = [(time, finder.rest)] if finder.rest else []
            return found[0].pack(), rest + received[k + 1 :]
    return b"", []
