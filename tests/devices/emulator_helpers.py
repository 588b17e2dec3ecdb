"""Emulated devices fed by hand, in simulated time."""

import numpy as np

from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.rplidar.responses import DESCRIPTOR_SIZE, Descriptor
from slamlab.devices.rplidar.scan_stream import DECODERS

POLL_INTERVAL = 0.002  # how often a device is asked [s]


def smooth_room(times, directions):
    """Distances in a room without corners, from 1 to 5 m, that never changes [mm]."""
    return 3000 + 2000 * np.sin(np.radians(directions) * 2)


def machine(**options):
    """An emulated lidar in that room, spinning."""
    return RPLidarEmulator(smooth_room, **options)


def receive(device, data, begin, seconds, grain=POLL_INTERVAL):
    """What a device sends from a time on, having been fed data: bytes."""
    heard = [device.feed(data, begin)]
    for k in range(1, round(seconds / grain) + 1):
        heard.append(device.feed(b"", begin + k * grain))
    return b"".join(heard)


def answers(data):
    """Descriptors and payloads of answers that follow each other without anything between."""
    found = []
    while data:
        descriptor = Descriptor.unpack(data[:DESCRIPTOR_SIZE])
        assert descriptor is not None and not descriptor.loop, data[:DESCRIPTOR_SIZE].hex()
        end = DESCRIPTOR_SIZE + descriptor.length
        found.append((descriptor.type, data[DESCRIPTOR_SIZE:end]))
        data = data[end:]
    return found


def nodes(data):
    """Nodes of an endless answer from its descriptor on, and the decoder."""
    descriptor = Descriptor.unpack(data[:DESCRIPTOR_SIZE])
    assert descriptor is not None and descriptor.loop, data[:DESCRIPTOR_SIZE].hex()
    decoder = DECODERS[descriptor.type]()
    return decoder.feed(data[DESCRIPTOR_SIZE:]), decoder
