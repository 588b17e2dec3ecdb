"""What a recorded lidar was asked, and what came then."""

from dataclasses import dataclass, field

from slamlab.devices.recording.records import EVENT, TX
from slamlab.devices.rplidar.finder import Finder
from slamlab.devices.rplidar.parser import RequestParser
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.stream import DECODERS


@dataclass
class Exchange:
    """A request and what came then: (time, bytes) each, up to the next request."""

    command: int
    payload: bytes
    time: float
    came: list = field(default_factory=list)


def exchanges(recording):
    """What the lidar was asked and what came: list of Exchange, without those for the motor."""
    parser, found = RequestParser(), []
    for record in recording.of("lidar"):
        if record.kind == TX:
            for command, payload in parser.feed(record.data, record.time):
                if command != Command.SET_MOTOR_PWM:
                    found.append(Exchange(command, payload, record.time))
        elif record.kind != EVENT and found:
            found[-1].came.append((record.time, record.data))
    return found


def split(came):
    """The descriptor of an endless answer, and the (time, bytes) chunks after it."""
    finder = Finder(tuple(DECODERS), loop=True)
    for k, (time, data) in enumerate(came):
        if (found := finder.feed(data)) is not None:
            rest = [(time, finder.rest)] if finder.rest else []
            return found[0].pack(), rest + came[k + 1 :]
    return b"", []
