"""Emulated devices fed by hand, in simulated time."""

import numpy as np

from slamlab.devices.emulator.rplidar import RplidarMachine
from slamlab.devices.rplidar.answers import DESCRIPTOR, Descriptor
from slamlab.devices.rplidar.stream import DECODERS

GRAIN = 0.002  # how often a device is asked [s]


def smooth_room(times, directions):
    """Distances in a room without corners, from 1 to 5 m, that never changes [mm]."""
    return 3000 + 2000 * np.sin(np.radians(directions) * 2)


def machine(**options):
    """An emulated lidar in that room, spinning."""
    return RplidarMachine(smooth_room, **options)


def hear(device, data, begin, seconds, grain=GRAIN):
    """What a device sends from a time on, having been fed data: bytes."""
    heard = [device.feed(data, begin)]
    for k in range(1, round(seconds / grain) + 1):
        heard.append(device.feed(b"", begin + k * grain))
    return b"".join(heard)


def answers(data):
    """Descriptors and payloads of answers that follow each other without anything between."""
    found = []
    while data:
        descriptor = Descriptor.unpack(data[:DESCRIPTOR])
        assert descriptor is not None and not descriptor.loop, data[:DESCRIPTOR].hex()
        end = DESCRIPTOR + descriptor.length
        found.append((descriptor.type, data[DESCRIPTOR:end]))
        data = data[end:]
    return found


def nodes(data):
    """Nodes of an endless answer from its descriptor on, and the decoder."""
    descriptor = Descriptor.unpack(data[:DESCRIPTOR])
    assert descriptor is not None and descriptor.loop, data[:DESCRIPTOR].hex()
    decoder = DECODERS[descriptor.type]()
    return decoder.feed(data[DESCRIPTOR:]), decoder
