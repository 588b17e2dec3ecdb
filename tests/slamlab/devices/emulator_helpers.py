"""Emulated devices fed by hand, in simulated time."""

import numpy as np

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.devices.emulator.in_memory_emulators import InMemoryEmulators
from slamlab.devices.emulator.lidar_models import lidar_model
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.emulator.serial_line import Faults
from slamlab.devices.errors import PortError, SlamlabError
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.responses import DESCRIPTOR_SIZE, Descriptor
from slamlab.devices.rplidar.scan_stream import DECODERS
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.simulation.worlds.world import World
from tests.slamlab.devices.byte_streams import room

POLL_INTERVAL = 0.002  # how often a device is asked [s]
HALL = World([(-30, -30, 30, -30), (30, -30, 30, 30), (30, 30, -30, 30), (-30, 30, -30, -30)])
IDEAL = DifferentialDrive(tick=1e-6)
COUNT = 0.01, np.radians(2)  # what the thesis takes a count for


def body_in(world=HALL, counts=COUNT, **options):
    """An ideal robot."""
    options.setdefault("robot", IDEAL)
    return EmulatedRobot(world, np.random.default_rng(1), counts=counts, **options)


def machine(model="a2m8", **options):
    """An emulated lidar in a room without corners, spinning."""
    return RPLidarEmulator(lambda times, angles: room(angles), lidar_model(model), **options)


class Bench:
    """An emulated lidar in that room, its time, and the rates that its port was opened at."""

    def __init__(self, model="a2m8", refused=(), **options):
        self.clock, self.opened, self.refused = SimulatedClock(100.0), [], refused
        self.faults = options.setdefault("faults", Faults())
        self.machine = machine(model, **options)
        self.emulators = InMemoryEmulators({"lidar": self.machine}, self.clock)

    def opener(self, name, baud):
        self.opened.append(baud)
        if baud in self.refused:
            raise PortError("it does not open", "its driver does not know the speed", "try others")
        return self.emulators.opener("lidar", baud)

    def lidar(self, port="lidar", **options):
        options.setdefault("opener", self.opener)
        return RPLidar(port, clock=self.clock, **options)

    def commands(self):
        return [command for command, _ in self.machine.requests]


def assert_right(turn):
    """A complete revolution in that room, in steps of 8 mm in the ultra mode."""
    assert turn.complete
    assert np.abs(turn.range_mm - room(turn.angle_deg)).max() < 12


def receive(device, data, begin, seconds, grain=POLL_INTERVAL):
    """What a device sends from a time on, having been fed data: bytes."""
    received = [device.feed(data, begin)]
    for k in range(1, round(seconds / grain) + 1):
        received.append(device.feed(b"", begin + k * grain))
    return b"".join(received)


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


def assert_helps(error):
    """Every error states what, why, and what to do."""
    assert isinstance(error, SlamlabError)
    assert error.what and error.cause and error.step
    assert f"{error.what}. Likely cause: {error.cause}. What to do: {error.step}." == str(error)
